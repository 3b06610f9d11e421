"""Commands that train an agent."""

import contextlib
import dataclasses
from pathlib import Path
import shlex
from typing import ClassVar, Generic, Literal, TypeVar

from tyro.conf import OmitArgPrefixes

from physexp import extras
from physexp.agents import config as agent_config
from physexp.analysis.training import callbacks
from physexp.analysis.training import config as config_lib
from physexp.cli import options as options_lib
from physexp.cli import printing
from physexp.cli.arguments import Domain, OptionalPath, Switch, Task

Config = TypeVar("Config", bound=agent_config.AgentConfig)


@dataclasses.dataclass
class Train(Generic[Config, options_lib.Options]):
    """Train an agent; `--agent AGENT --help` shows the options of another one.

    Attributes:
      options: what the domain lets choose.
      replay_every: environment steps between replays, which go into the run's folder; 0 for none.
      agent: the learner; belief needs the fewest frames, and a3c is the paper's.
      config: the agent's hyperparameters.
      run_dir: the run's folder; by default one named after the run, under runs/.
      tensorboard: write the metrics for TensorBoard too.
      resume: continue the run in that folder, with its own configuration.
    """

    domains_of: ClassVar = staticmethod(options_lib.of_domain)

    domain: Domain
    task: Task
    options: OmitArgPrefixes[options_lib.Options]
    config: OmitArgPrefixes[Config]
    agent: Literal[tuple(config_lib.ALGORITHMS)] = config_lib.DEFAULT_ALGORITHM  # type: ignore[valid-type]
    replay_every: int = config_lib.REPLAY_EVERY
    run_dir: OptionalPath = None
    tensorboard: Switch = False
    resume: Switch = False

    def run(self) -> None:
        extras.require(*(["tensorboard"] if self.tensorboard else []))
        from physexp.analysis.training import publishing, trainer, verdict
        from physexp.analysis.training import run as run_lib

        config = config_lib.TrainConfig(
            domain=self.domain,
            task=self.task,
            task_kwargs=options_lib.chosen(self.options),
            replay_every=self.replay_every,
            agent=self.config,
        )
        run = run_lib.Run(self.run_dir or Path("runs") / config.name)
        if self.resume:
            wanted, config = config, run.config
            if (config.domain, config.task) != (self.domain, self.task):
                raise ValueError(f"{run.path} holds a run of {config.domain}/{config.task}; name that task")
            self._refuse_others(wanted, config, run.path)
        trainer.check(config)
        try:
            with contextlib.ExitStack() as stack:
                stack.enter_context(run.locked())
                run.check_resumable() if self.resume else run.check_new()
                is_finished = self.resume and run.is_finished
                report = self._reports(stack, run, config)
                on_checkpoint = None
                if config.replay_every:
                    from physexp.analysis.replay import training

                    on_checkpoint = training.Writer(run, config)
                start = None if self.resume else config
                trainer.train(run, report, printing.warn, start, on_checkpoint)
                if is_finished:
                    frames = config.agent.frames
                    printing.warn(f"{run.path} has had its {frames:,} frames; to train longer, train anew with more")
        except KeyboardInterrupt:
            self._tell_how_to_go_on(run)
            raise
        if problem := verdict.of_run(run):
            printing.warn(problem, verdict.advice(config))
        printing.tell(str(run.path))
        commands = ["evaluate {}", *(["score {}"] if publishing.is_default(config) else []), "replay {} --view"]
        words = [f"physexp {command.format(shlex.quote(str(run.path)))}" for command in commands]
        printing.warn(f"the agent is in that folder; next: {'; '.join(words)}")

    def _reports(self, stack: contextlib.ExitStack, run, config: config_lib.TrainConfig) -> callbacks.Report:
        """Returns a call that passes rows of metrics on to all that show them; a failure of one leaves the others."""
        from physexp.analysis.training import progress

        logs = [callbacks.expendable(stack.enter_context(progress.Progress(config)), printing.warn, "the progress")]
        if self.tensorboard:
            from physexp.analysis.training import tensorboard

            board = tensorboard.TensorBoard(run)
            logs.append(callbacks.expendable(board, printing.warn, "TensorBoard"))
            stack.callback(callbacks.expendable(board.close, printing.warn, "TensorBoard"))

        def report(row: dict) -> None:
            for log in logs:
                log(row)

        return report

    def _refuse_others(self, wanted: config_lib.TrainConfig, config: config_lib.TrainConfig, path: Path) -> None:
        """Refuses options that are chosen and differ from those that a run goes on with: raises ValueError."""
        usual = dataclasses.asdict(config_lib.preset(self.domain, self.task, algorithm=self.agent))
        named = {"agent": config_lib.DEFAULT_ALGORITHM, "replay_every": config_lib.REPLAY_EVERY}
        own = {name: getattr(self, name) for name, default in named.items() if getattr(self, name) != default}
        chosen = {name: value for name, value in dataclasses.asdict(wanted.agent).items() if value != usual[name]}
        begun = {"agent": config.agent.algorithm, "replay_every": config.replay_every, **config.task_kwargs}
        begun |= dataclasses.asdict(config.agent)
        for name, value in {**own, **wanted.task_kwargs, **chosen}.items():
            if begun.get(name) != value:
                there = agent_config.shown(begun[name]) if name in begun else "not chosen"
                raise ValueError(
                    f"{name} is {agent_config.shown(value)}, and in {path} it is {there}; leave it out to go on with "
                    "that, or train anew in another --run-dir"
                )

    def _tell_how_to_go_on(self, run) -> None:
        """Names the last checkpoint of a run that was interrupted, and the command that goes on from it."""
        paths = run.checkpointer.paths()
        if not paths:
            printing.warn(f"there is no checkpoint in {run.path} yet: the same command starts anew")
            return
        words = ["physexp", "train", self.domain, self.task, "--run-dir", str(run.path), "--resume"]
        words += ["--tensorboard"] if self.tensorboard else []
        printing.warn(
            f"the checkpoint after {int(paths[-1].stem):,} frames: {paths[-1]}", f"to go on: {shlex.join(words)}"
        )


@dataclasses.dataclass
class Demo:
    """Train an agent for a minute or two, and compare it with randomized interaction.

    Attributes:
      run_dir: the folder of the run; another demonstration in it is moved aside.
    """

    run_dir: Path = Path("runs/demo")

    def run(self) -> None:
        extras.require("matplotlib")
        from physexp.cli import demo

        demo.run(self.run_dir)
