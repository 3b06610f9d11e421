"""Commands that train an agent."""

from collections.abc import Sequence
import contextlib
import dataclasses
import functools
from pathlib import Path
import shlex
from typing import Any, Literal

from physexp import extras
from physexp.agents import config as agent_config
from physexp.analysis.training import callbacks
from physexp.analysis.training import config as config_lib
from physexp.cli import arguments, printing
from physexp.cli.arguments import TASK, Group, option, word


@dataclasses.dataclass
class Train:
    """Train an agent. `--agent AGENT --help` lists the options of another learner."""

    words: tuple[str, ...] = word("DOMAIN TASK", TASK, "+")
    agent: Literal[tuple(config_lib.ALGORITHMS)] = option(  # type: ignore[valid-type]
        config_lib.DEFAULT_ALGORITHM, "the learner; belief needs the fewest frames, a3c is the paper's"
    )
    replay_every: int = option(config_lib.REPLAY_EVERY, "environment steps between replays, 0 for no replays")
    also: tuple[str, ...] = option(
        (), "further settings of the task that training takes turns in, each as OPTION=VALUE,OPTION=VALUE", "SETTING"
    )
    run_dir: Path | None = option(None, "the folder of the run; by default one named after the run, under runs/")
    tensorboard: bool = option(False, "write the metrics for TensorBoard too")
    resume: bool = option(False, "continue the run in --run-dir with its own configuration")
    task_kwargs: dict[str, Any] = dataclasses.field(default_factory=dict)
    hyperparameters: dict[str, Any] = dataclasses.field(default_factory=dict)

    @classmethod
    def groups(cls, words: Sequence[str], agent: str | None) -> list[Group]:
        """Returns the options of the domain and of the learner; without a learner, of all learners."""
        of_domain = arguments.of_task(words)
        if agent is None:
            return [of_domain, Group("hyperparameters", "learners", list(config_lib.ALGORITHMS.values()))]
        is_known = arguments.domains_of(words) == list(arguments.task_of(words)[:1])
        preset = config_lib.preset(*(arguments.task_of(words) if is_known else ()), algorithm=agent)
        return [of_domain, Group("hyperparameters", f"--agent {agent}", [preset])]

    @property
    def domain(self) -> str:
        """The domain's name."""
        return arguments.task_of(self.words)[0]

    @property
    def task(self) -> str:
        """The task's name."""
        return arguments.task_of(self.words)[1]

    @property
    def config(self) -> agent_config.AgentConfig:
        """The configuration of the learner."""
        preset = config_lib.preset(self.domain, self.task, algorithm=self.agent)
        return preset.replace(**self.hyperparameters)

    def run(self) -> None:
        """Trains into a new folder or goes on with a run."""
        extras.require(*(["tensorboard"] if self.tensorboard else []))
        from physexp import suite
        from physexp.analysis.training import publishing, trainer, verdict
        from physexp.analysis.training import run as run_lib
        from physexp.suite.engine import options

        suite.load_task(self.domain, self.task, self.task_kwargs)
        config = config_lib.TrainConfig(
            domain=self.domain,
            task=self.task,
            task_kwargs=self.task_kwargs,
            also=tuple(map(options.parsed, self.also)),
            replay_every=self.replay_every,
            agent=self.config,
        )
        run = run_lib.Run(self.run_dir or Path("runs") / config.name)
        if self.resume:
            config = run.config
            self._refuse_others(config, run.path)
        trainer.check(config)
        try:
            self._train(run, config)
        except KeyboardInterrupt:
            self._tell_how_to_go_on(run)
            raise
        if problem := verdict.of_run(run):
            printing.warn(problem, verdict.advice(config))
        printing.tell(str(run.path))
        commands = ["evaluate {}", *(["score {}"] if publishing.is_default(config) else []), "replay {} --view"]
        lines = [f"physexp {command.format(shlex.quote(str(run.path)))}" for command in commands]
        printing.warn(f"the agent is in that folder; next: {'; '.join(lines)}")

    def _train(self, run, config: config_lib.TrainConfig) -> None:
        from physexp.analysis.training import progress, trainer

        with contextlib.ExitStack() as stack:
            stack.enter_context(run.locked())
            run.check_resumable() if self.resume else run.check_new()
            was_finished = self.resume and run.is_finished
            display = stack.enter_context(progress.Progress(config))
            reports = [callbacks.expendable(display, printing.warn, "the progress")]
            if self.tensorboard:
                board = progress.TensorBoard(run)
                reports.append(callbacks.expendable(board, printing.warn, "TensorBoard"))
                stack.callback(callbacks.expendable(board.close, printing.warn, "TensorBoard"))
            on_checkpoint = None
            if config.replay_every:
                from physexp.analysis.replay import training

                on_checkpoint = functools.partial(training.write, run, config)
            start = None if self.resume else config

            def report(row: dict[str, Any]) -> None:
                for call in reports:
                    call(row)

            trainer.train(run, report, tell=printing.warn, start=start, on_checkpoint=on_checkpoint)
            if was_finished:
                frames = config.agent.frames
                printing.warn(f"{run.path} has had its {frames:,} frames; to train longer, train anew with more")

    def _refuse_others(self, config: config_lib.TrainConfig, path: Path) -> None:
        """Refuses given options that differ from those of the run that is resumed."""
        if (config.domain, config.task) != (self.domain, self.task):
            raise ValueError(f"{path} holds a run of {config.domain}/{config.task}; name that task")
        usual = {"agent": config_lib.DEFAULT_ALGORITHM, "replay_every": config_lib.REPLAY_EVERY}
        given = {name: getattr(self, name) for name, default in usual.items() if getattr(self, name) != default}
        stored = {"agent": config.agent.algorithm, "replay_every": config.replay_every, **config.task_kwargs}
        stored |= dataclasses.asdict(config.agent)
        for name, value in {**given, **self.task_kwargs, **self.hyperparameters}.items():
            if stored.get(name) != value:
                there = agent_config.shown(stored[name]) if name in stored else "not chosen"
                raise ValueError(
                    f"{name} is {agent_config.shown(value)}, and in {path} it is {there}; leave it out to go on with "
                    "that, or train anew in another --run-dir"
                )

    def _tell_how_to_go_on(self, run) -> None:
        """Names the last checkpoint of an interrupted run, and the command that resumes it."""
        paths = run.checkpointer.paths()
        if not paths:
            printing.warn(f"there is no checkpoint in {run.path} yet: the same command starts anew")
            return
        words = ["physexp", "train", self.domain, self.task, "--run-dir", str(run.path), "--resume"]
        words += ["--tensorboard"] if self.tensorboard else []
        printing.warn(
            f"the checkpoint after {int(paths[-1].stem):,} frames: {paths[-1]}", f"to go on: {shlex.join(words)}"
        )
