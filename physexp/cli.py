"""The command line. Heavy libraries are imported by the command that needs them, so that `--help` is quick."""

from collections.abc import Callable
import contextlib
import dataclasses
import io
import json
import os
from pathlib import Path
import re
import sys
from typing import Annotated, Generic, Literal, TypeVar, Union, get_args

import tyro
from tyro.conf import OmitArgPrefixes, Positional

from physexp.agents import config as agent_config
from physexp.analysis import config as config_lib

Config = TypeVar("Config", bound=agent_config.AgentConfig)
BenchSection = Literal[
    "reset", "batch", "training", "peers", "pixels", "pretrained", "replay", "distributed", "learning"
]

_EXTRAS = {"matplotlib": "analysis", "pandas": "analysis", "stable_baselines3": "bench", "sb3_contrib": "bench",
           "tensorboard": "tensorboard", "ray": "distributed"}  # fmt: skip
"""Libraries that some commands need, and the extra that brings each."""


@dataclasses.dataclass
class Tasks:
    """List the tasks.

    Attributes:
      json: print JSON.
    """

    json: bool = False

    def run(self) -> None:
        from physexp import suite

        rows = []
        for domain, name in suite.ALL_TASKS:
            task = suite.load_task(domain, name)
            rows.append({"domain": domain, "task": name, "interactions": task.num_interactions,
                         "labels": task.num_labels, "step_limit": task.rules.step_limit})  # fmt: skip
        _show_rows(rows, self.json)


@dataclasses.dataclass
class Train(Generic[Config]):
    """Train an agent; `--agent ppo --help` shows what PPO may be told.

    Attributes:
      domain: the domain: which_is_heavier or towers.
      task: the task; `physexp tasks` lists them.
      difficulty: the paper's beta, for Which is Heavier.
      control_timestep: time between actions, s.
      replay_every: environment steps between replays, which go into the run's folder; 0 for none.
      agent: a3c, the paper's, or ppo.
      config: what the agent is told.
      run_dir: the run's folder; by default one named after the run, under runs/.
      tensorboard: write the metrics for TensorBoard too.
      resume: continue the run in that folder, with its own configuration.
      cluster: train on a cluster of Ray: HOST:PORT of its head; auto for the one that runs here, or else a local one.
    """

    domain: Positional[str]
    task: Positional[str]
    config: OmitArgPrefixes[Config]
    agent: Literal["a3c", "ppo"] = "a3c"
    difficulty: float | None = None
    control_timestep: float | None = None
    replay_every: int = config_lib.REPLAY_EVERY
    run_dir: Path | None = None
    tensorboard: bool = False
    resume: bool = False
    cluster: str | None = None

    def run(self) -> None:
        from physexp.analysis import progress, training
        from physexp.analysis import run as run_lib

        config = config_lib.TrainConfig(
            domain=self.domain, task=self.task, difficulty=self.difficulty, control_timestep=self.control_timestep,
            replay_every=self.replay_every, agent=self.config,
        )  # fmt: skip
        run = run_lib.Run(self.run_dir or Path("runs") / config.name)
        if self.resume:
            if (run.config.domain, run.config.task) != (self.domain, self.task):
                raise ValueError(f"{run.path} holds a run of {run.config.domain}/{run.config.task}; name that task")
        else:
            training.check(config, self.cluster is not None)
        with contextlib.ExitStack() as stack:
            if self.cluster is not None:
                from physexp.analysis import cluster

                stack.enter_context(cluster.joined(self.cluster))
            if not self.resume:
                run.create(config)
            logs: list[Callable[[dict], None]] = [stack.enter_context(progress.Progress(run.config))]
            if self.tensorboard:
                from physexp.analysis import tensorboard

                logs.append(stack.enter_context(tensorboard.TensorBoard(run)))

            def report(row: dict) -> None:
                for log in logs:
                    log(row)

            training.train(run, report, self.cluster is not None, _warn)
        print(run.path)


@dataclasses.dataclass
class Evaluate:
    """Play episodes with a trained agent and measure how well it answers.

    Attributes:
      target: the folder of a run, or domain/task for the agent that comes with the package.
      episodes: how many to play.
      interaction: learned, or random: interaction actions are replaced by uniformly drawn ones (paper, Section 5.3).
      greedy: take the likeliest action instead of drawing one.
      device: where convolutions are computed: cpu, cuda, or auto for the GPU where there is one.
      seed: of the environments and the actions; by default one that training never uses.
      json: print JSON.
    """

    target: Positional[str]
    episodes: int = 1000
    interaction: Literal["learned", "random"] = "learned"
    greedy: bool = False
    device: agent_config.Device = "auto"
    seed: int | None = None
    json: bool = False

    def run(self) -> None:
        from physexp.analysis import evaluation

        network, config = evaluation.find_agent(self.target)
        seed = evaluation.SEED if self.seed is None else self.seed
        played = evaluation.play(network, config, self.episodes, self.interaction, self.greedy, seed,
                                 device=self.device)  # fmt: skip
        _show(played.summary(config.agent.discount), self.json)


@dataclasses.dataclass
class Replay:
    """Write episodes of a trained agent for the rerun viewer: the scene, what the agent saw, believed and did.

    Attributes:
      target: the folder of a run, or domain/task for the agent that comes with the package.
      compare: another one, to be shown side by side on the same instances.
      episodes: how many.
      output: the file; by default replay.rrd.
      interaction: learned, or random: interaction actions are replaced by uniformly drawn ones (paper, Section 5.3).
      select: any, or those that are wrong or right, the longest, or the hardest.
      seed: of the environments and the actions; by default one that training never uses.
      view: open the viewer afterwards.
      web: open the viewer in a browser afterwards.
    """

    target: Positional[str]
    compare: str | None = None
    episodes: int = 4
    output: Path = Path("replay.rrd")
    interaction: Literal["learned", "random"] = "learned"
    select: Literal["any", "wrong", "right", "longest", "hardest"] = "any"
    seed: int | None = None
    view: bool = False
    web: bool = False

    def run(self) -> None:
        from physexp.analysis import evaluation, replay

        if self.view:
            replay.check_display()
        seed = evaluation.SEED if self.seed is None else self.seed
        targets = [self.target] if self.compare is None else [self.target, self.compare]
        path = replay.replay(targets, self.episodes, self.output, self.interaction, self.select, seed, _tell)
        print(path)
        if self.view or self.web:
            replay.view(path, self.web, _tell)


@dataclasses.dataclass
class Play:
    """Play yourself, in the terminal, beside the ideal experimenter and a trained agent.

    Attributes:
      domain: the domain.
      task: the task; features need no GL.
      difficulty: the paper's beta, for Which is Heavier.
      seed: of the environment; by default one from the operating system.
      view: show the scene in rerun's viewer as well, where there is a display.
    """

    domain: Positional[str]
    task: Positional[str]
    difficulty: float | None = None
    seed: int | None = None
    view: bool = False

    def run(self) -> None:
        from physexp.analysis import play

        play.play(self.domain, self.task, self.difficulty, self.seed, self.view)


@dataclasses.dataclass
class Publish:
    """Keep a run's agent, in half precision, as one that `physexp.agents.load_pretrained` returns.

    Attributes:
      run_dir: the folder of a run.
      output_dir: where the agent and its card go; by default into the package.
      episodes: how many to play for the evaluation on the card.
    """

    run_dir: Positional[Path]
    output_dir: Path | None = None
    episodes: int = 10_000

    def run(self) -> None:
        from physexp.agents import pretrained
        from physexp.analysis import publishing
        from physexp.analysis import run as run_lib

        print(publishing.publish(run_lib.Run(self.run_dir), self.output_dir or pretrained.FOLDER, self.episodes))


@dataclasses.dataclass
class Ideal:
    """Print what an ideal experimenter achieves: nobody can expect a larger return.

    Attributes:
      domain: which_is_heavier (one poke reveals a mass exactly) or towers (physics is known).
      difficulty: the paper's beta, for Which is Heavier.
      blocks: how many blocks, for Which is Heavier.
      task: the task, for towers.
      resolution: what the observer of a tower can tell apart: metres for features, differing pixels for images; 0 is
        every bit.
      discount: the agent's gamma; by default 0.95, or 0.98 for towers.
      json: print JSON.
    """

    domain: Positional[Literal["which_is_heavier", "towers"]]
    difficulty: float = 5.0
    blocks: int = 4
    task: Literal["direct_features", "fist_features", "direct_pixels", "fist_pixels"] = "fist_features"
    resolution: float = 0.0
    discount: float | None = None
    json: bool = False

    def run(self) -> None:
        discount = config_lib.DISCOUNT[self.domain] if self.discount is None else self.discount
        if self.domain == "which_is_heavier":
            from physexp.analysis.ideal import which_is_heavier

            summary = which_is_heavier.solve(self.difficulty, discount, self.blocks).summary()
        else:
            from physexp.analysis.ideal import towers

            summary = towers.solve(self.task, self.resolution, discount).summary()
        _show(summary, self.json)


@dataclasses.dataclass
class Reproduce:
    """Reproduce an experiment of the paper: train its agents, let them play, draw its figure, test its claims.

    What is done already is not done again; a sweep that was stopped goes on where it was.

    Attributes:
      experiment: mass_gap, learning_heavier, population, individual, random_heavier, learning_towers, waiting,
        random_towers, ideal_gap, learners, or all.
      seeds: agents in each condition; by default 10 from features and 3 from pixels.
      observations: what the agents see.
      results_dir: where everything goes.
      jobs: agents trained at a time; by default one a core.
      frames: environment steps of training, for a rehearsal; by default each condition's own budget.
      cluster: train on a cluster of Ray: HOST:PORT of its head; auto for the one that runs here, or else a local one.
    """

    experiment: Positional[str]
    seeds: int | None = None
    observations: Literal["features", "pixels", "all"] = "all"
    results_dir: Path = Path("results")
    jobs: int | None = None
    frames: int | None = None
    cluster: str | None = None

    def run(self) -> None:
        from physexp.analysis import reproduce
        from physexp.analysis.experiments import base, conditions

        experiments = reproduce.choose(self.experiment)
        with contextlib.ExitStack() as stack:
            submit = None
            if self.cluster is not None:
                from physexp.analysis import cluster

                stack.enter_context(cluster.joined(self.cluster))
                submit = cluster.submit
            reproduce.run(
                experiments, base.Results(self.results_dir),
                observations=conditions.OBSERVATIONS if self.observations == "all" else (self.observations,),
                num_seeds=self.seeds, num_processes=self.jobs, frames=self.frames, submit=submit, report=_tell,
            )  # fmt: skip


@dataclasses.dataclass
class Report:
    """Write report.md and report.html of the stored results: every figure, and every claim with its verdict.

    Attributes:
      results_dir: where the results are.
    """

    results_dir: Path = Path("results")

    def run(self) -> None:
        from physexp.analysis import report
        from physexp.analysis.experiments import base

        print(report.write(base.Results(self.results_dir), _tell))


@dataclasses.dataclass
class Bench:
    """Measure every performance figure, side by side.

    Attributes:
      sections: which figures; all but learning by default, since learning takes hours.
      results_dir: where the results of the experiments are, or go, for the learning figures.
      json: print JSON.
    """

    sections: Positional[tuple[BenchSection, ...]] = get_args(BenchSection)[:-1]
    results_dir: Path = Path("results")
    json: bool = False

    def run(self) -> None:
        from physexp.analysis import bench

        rows = []
        for row in bench.run(self.sections, self.results_dir):
            rows.append(row)
            if not self.json:
                print(bench.line(row), flush=True)
        if self.json:
            print(json.dumps(rows, indent=1))


@dataclasses.dataclass
class Doctor:
    """Tell what this machine offers.

    Attributes:
      json: print JSON.
    """

    json: bool = False

    def run(self) -> None:
        from physexp.analysis import doctor

        _show(doctor.examine(), self.json)


@dataclasses.dataclass
class Demo:
    """Train Which is Heavier for a minute or two, and compare the agent with randomized interaction.

    Attributes:
      run_dir: the folder of the run; what it held before is replaced.
    """

    run_dir: Path = Path("runs/demo")

    def run(self) -> None:
        from physexp.analysis import demo

        demo.run(self.run_dir)


def main() -> None:
    """The entry point: runs a command; an error of the user's is one line and exit status 2."""
    try:
        try:
            _run(sys.argv[1:])
        finally:
            sys.stdout.flush()
    except BrokenPipeError:  # Who read the output, `head` for one, has seen enough.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        sys.exit(1)


def _run(arguments: list[str]) -> None:
    command = _parse(arguments)
    try:
        command.run()
    except BrokenPipeError:
        raise
    except (ValueError, OSError) as error:
        print(f"physexp: {error}", file=sys.stderr)
        sys.exit(2)
    except ModuleNotFoundError as error:
        if error.name not in _EXTRAS:
            raise
        print(f"physexp: {error.name} is not installed; pip install 'physexp[{_EXTRAS[error.name]}]'", file=sys.stderr)
        sys.exit(1)
    except RuntimeError as error:
        print(f"physexp: {error}", file=sys.stderr)
        sys.exit(1)
    except KeyboardInterrupt:
        print("physexp: interrupted", file=sys.stderr)
        sys.exit(130)


def _parse(arguments: list[str]):
    """The command that the arguments describe; the defaults of `train` are those of its task and of its agent."""
    algorithm: Literal["a3c", "ppo"] = "ppo" if _follows("--agent", "ppo", arguments) else "a3c"
    preset = config_lib.preset(*(arguments[1:3] if arguments[:1] == ["train"] else ()), algorithm=algorithm)
    train: Train = Train(domain=tyro.MISSING, task=tyro.MISSING, config=preset, agent=algorithm)
    train_type = Train[config_lib.ALGORITHMS[algorithm]]  # type: ignore[valid-type]
    commands = Union[  # noqa: UP007
        Annotated[Tasks, tyro.conf.subcommand("tasks")],
        Annotated[train_type, tyro.conf.subcommand("train", default=train)],
        Annotated[Evaluate, tyro.conf.subcommand("evaluate")],
        Annotated[Replay, tyro.conf.subcommand("replay")],
        Annotated[Play, tyro.conf.subcommand("play")],
        Annotated[Publish, tyro.conf.subcommand("publish")],
        Annotated[Ideal, tyro.conf.subcommand("ideal")],
        Annotated[Reproduce, tyro.conf.subcommand("reproduce")],
        Annotated[Report, tyro.conf.subcommand("report")],
        Annotated[Bench, tyro.conf.subcommand("bench")],
        Annotated[Doctor, tyro.conf.subcommand("doctor")],
        Annotated[Demo, tyro.conf.subcommand("demo")],
    ]
    description = "Environments in which an agent must experiment, and agents that learn to."
    refusal = io.StringIO()
    try:
        with contextlib.redirect_stderr(refusal):
            return tyro.cli(commands, prog="physexp", description=description, args=arguments)  # type: ignore[call-overload]
    except SystemExit:
        if refusal.getvalue():
            print(f"physexp: {_in_one_line(refusal.getvalue())}", file=sys.stderr)
        raise


def _in_one_line(box: str) -> str:
    """What tyro says within a frame, over several lines: what is wrong, what is there instead, and where to read."""
    inside = " ".join(line.strip("│ ") for line in box.splitlines() if line.startswith("│"))
    problem, *rest = re.split(" *─{3,} *", inside) if inside else [" ".join(box.split())]
    problem = re.sub(r"^Error parsing __tyro\S+: ", "", problem)  # Its name for no argument in particular.
    parts = [problem.rstrip(".")]
    if problem.startswith("Unrecognized") and len(rest) > 1:
        flags = dict.fromkeys(re.findall(r"--(?!help)\w[\w-]*", rest[0]))
        parts.append(f"perhaps {' or '.join(flags)}" if flags else rest[0].lower())
    where = re.search(r"physexp.* --help", rest[-1]) if rest else None
    return "; ".join([*parts, f"see {where[0] if where else 'physexp --help'}"])


def _follows(flag: str, value: str, arguments: list[str]) -> bool:
    return f"{flag}={value}" in arguments or (flag, value) in zip(arguments, arguments[1:], strict=False)


def _warn(line: str) -> None:
    print(line, file=sys.stderr, flush=True)


def _tell(line: str) -> None:
    print(line, flush=True)


def _show(figures: dict, as_json: bool) -> None:
    if as_json:
        print(json.dumps(figures, indent=1))
        return
    width = max(len(name) for name in figures)
    for name, value in figures.items():
        print(f"{name:{width}}  {_text(value)}")


def _show_rows(rows: list[dict], as_json: bool) -> None:
    if as_json:
        print(json.dumps(rows, indent=1))
        return
    widths = {name: max(len(name), *(len(_text(row[name])) for row in rows)) for name in rows[0]}
    for row in [{name: name for name in rows[0]}, *rows]:
        print("  ".join(f"{_text(row[name]):{width}}" for name, width in widths.items()).rstrip())


def _text(value) -> str:
    if isinstance(value, float):
        return f"{value:.4f}"
    if isinstance(value, dict):
        return "  ".join(f"{key}: {_text(item)}" for key, item in value.items())
    if isinstance(value, (list, tuple)):
        return " to ".join(_text(item) for item in value)
    return str(value)
