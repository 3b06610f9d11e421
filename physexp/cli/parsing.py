"""The command line. Heavy libraries are imported by the command that needs them, so that `--help` is quick."""

from collections.abc import Callable
import contextlib
import dataclasses
import difflib
import io
import json
import os
from pathlib import Path
import shlex
import sys
from typing import TYPE_CHECKING, Annotated, Any, Generic, Literal, NoReturn, TypeVar, Union

import tyro
from tyro import _errors as tyro_errors  # Its hook on what it refuses; not public as yet, so setup.cfg bounds tyro.
from tyro.conf import OmitArgPrefixes, Positional

from physexp import __version__, extras
from physexp.agents import config as agent_config
from physexp.analysis import bench
from physexp.analysis.training import config as config_lib
from physexp.analysis.training import stopping

Config = TypeVar("Config", bound=agent_config.AgentConfig)
if TYPE_CHECKING:
    BenchSection = str
else:
    BenchSection = Literal[tuple(bench.SECTIONS)]

# Names for the values of arguments in help; an optional value's text says what happens without it.
Domain = Annotated[Positional[str], tyro.conf.arg(metavar="DOMAIN")]
Task = Annotated[Positional[str], tyro.conf.arg(metavar="TASK")]
Agent = Annotated[Positional[str], tyro.conf.arg(metavar="AGENT")]
OptionalFloat = Annotated[float | None, tyro.conf.arg(metavar="FLOAT", help_behavior_hint="")]
OptionalInt = Annotated[int | None, tyro.conf.arg(metavar="INT", help_behavior_hint="")]
OptionalPath = Annotated[Path | None, tyro.conf.arg(metavar="PATH", help_behavior_hint="")]
OptionalTask = Annotated[str | None, tyro.conf.arg(metavar="TASK", help_behavior_hint="")]
OptionalAgent = Annotated[str | None, tyro.conf.arg(metavar="AGENT", help_behavior_hint="")]
OptionalAddress = Annotated[str | None, tyro.conf.arg(metavar="HOST:PORT", help_behavior_hint="")]
Switch = tyro.conf.FlagCreatePairsOff[bool]


@dataclasses.dataclass
class Tasks:
    """List the tasks: what each asks, what it shows, and how many actions there are.

    Attributes:
      json: print JSON.
    """

    json: Switch = False

    def run(self) -> None:
        from physexp import suite

        rows = []
        for domain, name in suite.ALL_TASKS:
            task = suite.load_task(domain, name)
            observations = {
                key: {"shape": list(blank.shape[1:]), "dtype": str(blank.dtype)}
                for key, blank in task.blank_observations(1).items()
            }
            rows.append(
                {
                    "domain": domain,
                    "task": name,
                    "interactions": task.num_interactions,
                    "labels": task.num_labels,
                    "step_limit": task.rules.step_limit,
                    "observations": observations,
                    "question": task.question,
                }
            )
        if self.json:
            _show_rows(rows, as_json=True)
            return
        for domain in suite.TASKS_BY_DOMAIN:
            of_domain = [row for row in rows if row["domain"] == domain]
            print(f"{domain}: {of_domain[0]['question']}")
            shown = ("task", "interactions", "labels", "step_limit")
            _show_rows(
                [
                    {
                        **{name: row[name] for name in shown},
                        "observations": ", ".join(
                            f"{key} {array['dtype']} {array['shape']}" for key, array in row["observations"].items()
                        ),
                    }
                    for row in of_domain
                ],
                as_json=False,
            )
            print()


@dataclasses.dataclass
class Train(Generic[Config]):
    """Train an agent; `--agent ppo --help` shows PPO's options.

    Attributes:
      domain: which_is_heavier or towers.
      task: a task of the domain; `physexp tasks` lists them.
      difficulty: the paper's beta, for which_is_heavier: a number >= 1, the larger the easier; by default 5.
      control_timestep: time between actions, s; by default 0.1.
      replay_every: environment steps between replays, which go into the run's folder; 0 for none.
      agent: a3c, the paper's, or ppo.
      config: the agent's hyperparameters.
      run_dir: the run's folder; by default one named after the run, under runs/.
      tensorboard: write the metrics for TensorBoard too.
      resume: continue the run in that folder, with its own configuration.
      cluster: train on a cluster of Ray: HOST:PORT of its head; auto for the one that runs here, or else a local one.
    """

    domain: Domain
    task: Task
    config: OmitArgPrefixes[Config]
    agent: Literal["a3c", "ppo"] = "a3c"
    difficulty: OptionalFloat = None
    control_timestep: OptionalFloat = None
    replay_every: int = config_lib.REPLAY_EVERY
    run_dir: OptionalPath = None
    tensorboard: Switch = False
    resume: Switch = False
    cluster: OptionalAddress = None

    def run(self) -> None:
        _check_options(self.domain, self.task, difficulty=self.difficulty)
        needed = {"ray": self.cluster is not None, "tensorboard": self.tensorboard}
        extras.require(*(module for module, is_needed in needed.items() if is_needed))
        from physexp.analysis.training import progress, trainer, verdict
        from physexp.analysis.training import run as run_lib

        config = config_lib.TrainConfig(
            domain=self.domain,
            task=self.task,
            difficulty=self.difficulty,
            control_timestep=self.control_timestep,
            replay_every=self.replay_every,
            agent=self.config,
        )
        run = run_lib.Run(self.run_dir or Path("runs") / config.name)
        if self.resume:
            config = run.config
            if (config.domain, config.task) != (self.domain, self.task):
                raise ValueError(f"{run.path} holds a run of {config.domain}/{config.task}; name that task")
        trainer.check(config, self.cluster is not None)
        try:
            with contextlib.ExitStack() as stack:
                stack.enter_context(run.locked())
                run.check_resumable() if self.resume else run.check_new()
                if self.cluster is not None:
                    from physexp.analysis.reproduction import cluster

                    stack.enter_context(cluster.joined(self.cluster))
                logs: list[Callable[[dict], None]] = [stack.enter_context(progress.Progress(config))]
                if self.tensorboard:
                    from physexp.analysis.training import tensorboard

                    logs.append(stack.enter_context(tensorboard.TensorBoard(run)))

                def report(row: dict) -> None:
                    for log in logs:
                        log(row)

                on_checkpoint = None
                if config.replay_every:
                    from physexp.analysis.replay import training

                    on_checkpoint = training.Writer(run, config)
                start = None if self.resume else config
                trainer.train(run, report, self.cluster is not None, _warn, start, on_checkpoint)
        except KeyboardInterrupt:
            self._tell_how_to_go_on(run)
            raise
        if problem := verdict.of_run(run):
            _warn(f"{problem}\n{verdict.advice(config)}")
        print(run.path)

    def _tell_how_to_go_on(self, run) -> None:
        """Names the last checkpoint of a run that was interrupted, and the command that goes on from it."""
        paths = run.checkpointer.paths()
        if not paths:
            _warn(f"there is no checkpoint in {run.path} yet: the same command starts anew")
            return
        words = ["physexp", "train", self.domain, self.task, "--run-dir", str(run.path), "--resume"]
        words += ["--cluster", self.cluster] if self.cluster is not None else []
        words += ["--tensorboard"] if self.tensorboard else []
        _warn(f"the checkpoint after {int(paths[-1].stem):,} frames: {paths[-1]}\nto go on: {shlex.join(words)}")


@dataclasses.dataclass
class Evaluate:
    """Play episodes with a trained agent and measure how well it answers.

    Attributes:
      target: the folder of a run, or DOMAIN/TASK for the agent that comes with the package.
      difficulty: which of the agents that come with the package for which_is_heavier: 3, 5 or 10, the larger the
        easier; by default 5.
      episodes: how many to play.
      interaction: learned, or random: interaction actions are replaced by uniformly drawn ones (paper, Section 5.3).
      greedy: take the likeliest action instead of drawing one.
      device: where convolutions are computed: cpu, cuda, or auto for the GPU where there is one.
      seed: of the environments and the actions; by default one that training never uses.
      json: print JSON.
    """

    target: Agent
    difficulty: OptionalFloat = None
    episodes: int = 1000
    interaction: Literal["learned", "random"] = "learned"
    greedy: Switch = False
    device: agent_config.Device = "auto"
    seed: OptionalInt = None
    json: Switch = False

    def run(self) -> None:
        from physexp.analysis.evaluation import playing
        from physexp.analysis.training import progress

        network, config = playing.find_agent(self.target, self.difficulty)
        seed = playing.SEED if self.seed is None else self.seed
        with progress.bar("episodes", self.episodes) as show:
            played = playing.play(
                network, config, self.episodes, self.interaction, self.greedy, seed, device=self.device, show=show
            )
        _show(played.summary(config.agent.discount), self.json)


@dataclasses.dataclass
class Replay:
    """Write episodes of a trained agent for the rerun viewer: the scene, what the agent saw, believed and did.

    Attributes:
      target: the folder of a run, or DOMAIN/TASK for the agent that comes with the package.
      compare: another one, to be shown side by side on the same instances.
      difficulty: which of the agents that come with the package for which_is_heavier: 3, 5 or 10, the larger the
        easier; by default 5.
      episodes: how many.
      output: the file; by default replay.rrd.
      interaction: learned, or random: interaction actions are replaced by uniformly drawn ones (paper, Section 5.3).
      select: any, or those that are wrong or right, the longest, or the hardest.
      seed: of the environments and the actions; by default one that training never uses.
      view: open the viewer afterwards.
      web: open the viewer in a browser afterwards.
    """

    target: Agent
    compare: OptionalAgent = None
    difficulty: OptionalFloat = None
    episodes: int = 4
    output: Path = Path("replay.rrd")
    interaction: Literal["learned", "random"] = "learned"
    select: Literal["any", "wrong", "right", "longest", "hardest"] = "any"
    seed: OptionalInt = None
    view: Switch = False
    web: Switch = False

    def run(self) -> None:
        from physexp.analysis import replay
        from physexp.analysis.evaluation import playing

        if self.view:
            replay.check_display()
        seed = playing.SEED if self.seed is None else self.seed
        targets = [self.target] if self.compare is None else [self.target, self.compare]
        path = replay.replay(
            targets, self.episodes, self.output, self.interaction, self.select, seed, _tell, self.difficulty
        )
        print(path)
        if self.view or self.web:
            replay.view(path, self.web, _tell)


@dataclasses.dataclass
class Play:
    """Play yourself, in the terminal, beside the ideal experimenter and a trained agent.

    Attributes:
      domain: which_is_heavier or towers.
      task: a task of the domain; `physexp tasks` lists them. Features need no OpenGL.
      difficulty: the paper's beta, for which_is_heavier: a number >= 1, the larger the easier; by default 5.
      seed: of the environment; by default one from the operating system.
      view: show the scene in rerun's viewer as well, where there is a display.
    """

    domain: Domain
    task: Task
    difficulty: OptionalFloat = None
    seed: OptionalInt = None
    view: Switch = False

    def run(self) -> None:
        _check_options(self.domain, self.task, difficulty=self.difficulty)
        from physexp.analysis import play

        play.play(self.domain, self.task, self.difficulty, self.seed, self.view)


@dataclasses.dataclass
class Publish:
    """Save a run's agent, in half precision with a model card, as one that `physexp.agents.load_pretrained` returns.

    Attributes:
      run_dir: the folder of a run.
      output_dir: where the agent and its model card go; by default into the package.
      episodes: how many to play for the evaluation on the card.
    """

    run_dir: Annotated[Positional[Path], tyro.conf.arg(metavar="RUN")]
    output_dir: OptionalPath = None
    episodes: int = 10_000

    def run(self) -> None:
        from physexp.agents import pretrained
        from physexp.analysis.evaluation import publishing
        from physexp.analysis.training import run as run_lib

        print(publishing.publish(run_lib.Run(self.run_dir), self.output_dir or pretrained.FOLDER, self.episodes))


@dataclasses.dataclass
class Ideal:
    """Print what the ideal experimenter achieves: no agent's expected return is larger.

    Attributes:
      domain: which_is_heavier (one poke reveals a mass exactly) or towers (physics is known).
      difficulty: of which_is_heavier: the paper's beta, a number >= 1, the larger the easier; by default 5.
      blocks: of which_is_heavier: how many blocks; by default 4.
      task: of towers: the task; by default fist_features.
      resolution: of towers: the smallest difference that can be observed: in metres for features, in differing pixels
        for images; by default 0, where every bit counts.
      discount: the agent's gamma; by default 0.95 for which_is_heavier, 0.98 for towers.
      json: print JSON.
    """

    domain: Annotated[Positional[Literal["which_is_heavier", "towers"]], tyro.conf.arg(metavar="DOMAIN")]
    difficulty: OptionalFloat = None
    blocks: OptionalInt = None
    task: OptionalTask = None
    resolution: OptionalFloat = None
    discount: OptionalFloat = None
    json: Switch = False

    def run(self) -> None:
        if self.domain == "which_is_heavier":
            from physexp.analysis.ideal import which_is_heavier

            _refuse(f"ideal {self.domain}", task=self.task, resolution=self.resolution)
            options = _given(difficulty=self.difficulty, num_blocks=self.blocks, discount=self.discount)
            summary = which_is_heavier.solve(**options).summary()
        else:
            from physexp.analysis.ideal import towers

            _refuse(f"ideal {self.domain}", difficulty=self.difficulty, blocks=self.blocks)
            options = _given(task=self.task, resolution=self.resolution, discount=self.discount)
            summary = towers.solve(**options).summary()
        _show(summary, self.json)


@dataclasses.dataclass
class Reproduce:
    """Reproduce an experiment of the paper: train its agents, let them play, draw its figure, test its claims.

    What is done already is not done again; what was interrupted continues where it was.

    Attributes:
      experiment: mass_gap, learning_heavier, population, individual, random_heavier, learning_towers, waiting,
        random_towers, ideal_gap, learners, or all.
      seeds: agents in each condition; by default 10 from features and 3 from pixels.
      observations: train the agents that observe features, pixels, or all of them.
      results_dir: the folder of all results.
      jobs: agents trained at a time; by default one for each processor core.
      frames: environment steps of training, for a quick trial; by default each condition's own number.
      cluster: train on a cluster of Ray: HOST:PORT of its head; auto for the one that runs here, or else a local one.
    """

    experiment: Annotated[Positional[str], tyro.conf.arg(metavar="EXPERIMENT")]
    seeds: OptionalInt = None
    observations: Literal["features", "pixels", "all"] = "all"
    results_dir: Path = Path("results")
    jobs: OptionalInt = None
    frames: OptionalInt = None
    cluster: OptionalAddress = None

    def run(self) -> None:
        extras.require("matplotlib", "pandas", *(["ray"] if self.cluster is not None else []))
        from physexp.analysis.experiments import base, conditions
        from physexp.analysis.reproduction import reproduce

        experiments = reproduce.choose(self.experiment)
        with contextlib.ExitStack() as stack:
            submit = None
            if self.cluster is not None:
                from physexp.analysis.reproduction import cluster

                stack.enter_context(cluster.joined(self.cluster))
                submit = cluster.submit
            reproduce.run(
                experiments,
                base.Results(self.results_dir),
                observations=conditions.OBSERVATIONS if self.observations == "all" else (self.observations,),
                num_seeds=self.seeds,
                num_processes=self.jobs,
                frames=self.frames,
                submit=submit,
                tell=_tell,
            )


@dataclasses.dataclass
class Report:
    """Write report.md and report.html of the stored results: every figure, and every claim with its verdict.

    Attributes:
      results_dir: where the results are.
    """

    results_dir: Path = Path("results")

    def run(self) -> None:
        extras.require("matplotlib", "pandas")
        from physexp.analysis.experiments import base
        from physexp.analysis.reproduction import report

        print(report.write(base.Results(self.results_dir), _tell))


@dataclasses.dataclass
class Bench:
    """Measure speed and the trained agents, each figure beside what it is compared with.

    Attributes:
      sections: what to measure; all but learning by default, since learning takes hours.
      results_dir: where the results of the experiments are, or go, for the learning figures.
      json: print JSON.
    """

    sections: Annotated[Positional[tuple[BenchSection, ...]], tyro.conf.arg(metavar="[SECTION ...]")] = bench.BY_DEFAULT
    results_dir: Path = Path("results")
    json: Switch = False

    def run(self) -> None:
        extras.require(*bench.extras(self.sections))
        from physexp.analysis.bench import measuring

        rows = []
        for row in bench.run(self.sections, self.results_dir):
            rows.append(row)
            if not self.json:
                print(measuring.line(row), flush=True)
        if self.json:
            print(json.dumps(rows, indent=1))


@dataclasses.dataclass
class Doctor:
    """Check versions, GPU and OpenGL, and say what to do about what is missing.

    The exit status is 1 if the environments themselves do not work, else 0.

    Attributes:
      json: print JSON.
    """

    json: Switch = False

    def run(self) -> None:
        from physexp.analysis import doctor

        found = doctor.examine()
        if self.json:
            _show(found, as_json=True)
        else:
            _show_rows(found["checks"], as_json=False)
        if any(check["verdict"] == doctor.BROKEN for check in found["checks"]):
            sys.exit(1)


@dataclasses.dataclass
class Demo:
    """Train an agent on Which is Heavier for a minute or two, and compare it with randomized interaction.

    Attributes:
      run_dir: the folder of the run; what it held before is replaced.
    """

    run_dir: Path = Path("runs/demo")

    def run(self) -> None:
        extras.require("matplotlib")
        from physexp.analysis import demo

        demo.run(self.run_dir)


def main() -> None:
    """The entry point: runs a command.

    An error of the user's is one line and exit status 2; Ctrl-C, SIGTERM and SIGHUP are 128 and the signal's number.
    """
    try:
        try:
            with stopping.raised():
                _run(sys.argv[1:])
        finally:
            sys.stdout.flush()
    except KeyboardInterrupt as error:
        print("physexp: interrupted", file=sys.stderr)
        sys.exit(stopping.exit_status(error))
    except BrokenPipeError:  # Who read the output, `head` for one, has seen enough.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        sys.exit(1)


def _run(arguments: list[str]) -> None:
    if arguments == ["--version"]:
        print("physexp", __version__)
        return
    try:
        _parse(arguments).run()
    except BrokenPipeError:
        raise
    except (ValueError, OSError, extras.MissingExtraError) as error:
        print(f"physexp: {error}", file=sys.stderr)
        sys.exit(2)
    except RuntimeError as error:
        print(f"physexp: {error}", file=sys.stderr)
        sys.exit(1)


_COMMANDS = {
    "tasks": Tasks,
    "train": Train,
    "evaluate": Evaluate,
    "replay": Replay,
    "play": Play,
    "publish": Publish,
    "ideal": Ideal,
    "reproduce": Reproduce,
    "report": Report,
    "bench": Bench,
    "doctor": Doctor,
    "demo": Demo,
}


def _parse(arguments: list[str]):
    """The command that the arguments describe; the defaults of `train` are those of its task and of its agent."""
    algorithm: Literal["a3c", "ppo"] = "ppo" if _follows("--agent", "ppo", arguments) else "a3c"
    preset = config_lib.preset(*(arguments[1:3] if arguments[:1] == ["train"] else ()), algorithm=algorithm)
    train: Train = Train(domain=tyro.MISSING, task=tyro.MISSING, config=preset, agent=algorithm)
    train_type = Train[config_lib.ALGORITHMS[algorithm]]  # type: ignore[valid-type]
    kinds = [
        Annotated[train_type, tyro.conf.subcommand(name, default=train)]
        if kind is Train
        else Annotated[kind, tyro.conf.subcommand(name)]
        for name, kind in _COMMANDS.items()
    ]
    description = (
        "Environments in which an agent must experiment, and agents that learn to. --version prints the version."
    )

    def refuse(event: tyro_errors.ParseErrorEvent) -> NoReturn:
        command = arguments[0] if arguments[:1] and arguments[0] in _COMMANDS else ""
        raise ValueError(
            f"{_problem(event, command, arguments)}; see {' '.join(filter(None, ['physexp', command, '--help']))}"
        )

    with tyro_errors.on_parse_error(refuse):
        return tyro.cli(Union[tuple(kinds)], prog="physexp", description=description, args=arguments)  # type: ignore[call-overload] # noqa: UP007


def _problem(event: tyro_errors.ParseErrorEvent, command: str, arguments: list[str]) -> str:
    """What is wrong with the arguments of a command, and what they may be."""
    match event:
        case tyro_errors.UnrecognizedArgs(tokens=tokens) if not command:
            return f"{tokens[0]!r} is no command; choose from {', '.join(_COMMANDS)}"
        case tyro_errors.UnrecognizedArgs(tokens=tokens):
            options = [token for token in tokens if token.startswith("-")]
            if not options:
                return f"{command} does not take {tokens[0]!r}"
            close = difflib.get_close_matches(options[0].strip("-").partition("=")[0], _options(command), n=2)
            perhaps = f"; perhaps {' or '.join(f'--{name}' for name in close)}" if close else ""
            return f"{options[0]} is not an option of {command}{perhaps}"
        case tyro_errors.MissingSubcommand():
            return f"give a command: {', '.join(_COMMANDS)}"
        case tyro_errors.MissingArgs(missing_arguments=missing):
            return f"{command} needs {' '.join(_name(found.arg) for found in missing)}"
        case tyro_errors.InvalidChoice(argument=argument, value=value, choices=choices):
            return f"{_name(argument)} is {value!r}; choose from {', '.join(choices)}"
        case tyro_errors.BadValue(argument=argument):
            return f"{_name(argument)} needs a value: {argument.lowered.metavar}"
        case tyro_errors.InstantiationFailure(argument=argument, message=message):
            if argument is None:
                return message
            return f"{_name(argument)} is {_value(_name(argument), arguments)!r}; give {argument.lowered.metavar}"
        case _:
            return f"these arguments do not go together ({type(event).__name__})"


def _name(argument) -> str:
    """An argument as it is typed, or as help calls it where it has no name."""
    return argument.lowered.metavar if argument.is_positional() else argument.display_name()


def _options(command: str) -> list[str]:
    """The options of a command, without their dashes."""
    names = [field.name for field in dataclasses.fields(_COMMANDS[command])]
    if command == "train":
        names += {field.name: None for kind in config_lib.ALGORITHMS.values() for field in dataclasses.fields(kind)}
    return [name.replace("_", "-") for name in names]


def _value(flag: str, arguments: list[str]) -> str:
    """What a flag was given on the command line."""
    words = [
        word for argument in arguments for word in (argument.split("=", 1) if argument[:2] == "--" else [argument])
    ]
    return next(
        (value for name, value in zip(words, words[1:], strict=False) if name.replace("_", "-") == flag), "nothing"
    )


def _follows(flag: str, value: str, arguments: list[str]) -> bool:
    return f"{flag}={value}" in arguments or (flag, value) in zip(arguments, arguments[1:], strict=False)


def _check_options(domain: str, task: str, **options: Any) -> None:
    """Refuses options that a domain does not have."""
    from physexp import suite

    known = {field.name for field in dataclasses.fields(suite.load_task(domain, task).options)}
    _refuse(domain, **{name: value for name, value in options.items() if name not in known})


def _refuse(owner: str, **options: Any) -> None:
    """Refuses options that were given and that something does not have."""
    for name in _given(**options):
        raise ValueError(f"--{name.replace('_', '-')} is not an option of {owner}; leave it out")


def _given(**options: Any) -> dict[str, Any]:
    """The options that were given: the others are None."""
    return {name: value for name, value in options.items() if value is not None}


def _warn(line: str) -> None:
    print(line, file=sys.stderr, flush=True)


def _tell(line: str) -> None:
    print(line, flush=True)


def _show(figures: dict, as_json: bool) -> None:
    if as_json:
        print(json.dumps(figures, indent=1))
    else:
        _print_table([{"": name, " ": value} for name, value in figures.items()], show_header=False)


def _show_rows(rows: list[dict], as_json: bool) -> None:
    if as_json:
        print(json.dumps(rows, indent=1))
    else:
        _print_table(rows, show_header=True)


def _print_table(rows: list[dict], show_header: bool) -> None:
    """Prints rows as a table; elsewhere than on a terminal, a row is a line however long it is."""
    from rich import console, table

    grid = table.Table(box=None, show_header=show_header, header_style="bold", pad_edge=False, padding=(0, 2, 0, 0))
    for name in rows[0]:
        grid.add_column(name, overflow="fold")
    for row in rows:
        grid.add_row(*map(_text, row.values()))
    terminal = console.Console(markup=False, highlight=False)
    if terminal.is_terminal:
        terminal.print(grid)
        return
    endless = console.Console(markup=False, highlight=False, width=1_000_000, file=io.StringIO())
    with endless.capture() as captured:
        endless.print(grid)
    print("\n".join(line.rstrip() for line in captured.get().splitlines()))


def _text(value) -> str:
    if isinstance(value, float):
        return f"{value:.4f}"
    if isinstance(value, dict):
        return "  ".join(f"{key}: {_text(item)}" for key, item in value.items())
    if isinstance(value, (list, tuple)):
        return " to ".join(_text(item) for item in value)
    return str(value)
