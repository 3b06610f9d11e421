"""Commands that play episodes."""

import dataclasses
from pathlib import Path
from typing import Any, ClassVar, Literal

from physexp.agents import config as agent_config
from physexp.cli import arguments, printing
from physexp.cli.arguments import AGENT, TASK, option, word

_INTERACTION = "learned, or random: interaction actions are replaced by uniformly drawn ones (paper, Section 5.3)"
_SEED = "seed of the environments and actions; by default one that training never uses"


@dataclasses.dataclass
class Evaluate:
    """Play episodes with a trained agent and measure how well it answers, beside the ideal experimenter."""

    groups: ClassVar = staticmethod(arguments.agent_groups)

    target: str = word("AGENT", AGENT)
    episodes: int = option(1000, "number of episodes")
    interaction: Literal["learned", "random"] = option("learned", _INTERACTION)
    greedy: bool = option(False, "take the likeliest action instead of drawing one")
    device: agent_config.Device = option("auto", "where convolutions run; auto is the GPU if there is one")
    seed: int | None = option(None, _SEED)
    json: bool = option(False, "print JSON")
    task_kwargs: dict[str, Any] = dataclasses.field(default_factory=dict)

    def run(self) -> None:
        """Plays and prints the statistics."""
        from physexp.analysis.training import finding, playing, progress

        network, config, *_ = finding.find_agent(self.target, self.task_kwargs)
        seed = playing.SEED if self.seed is None else self.seed
        with progress.bar("episodes", self.episodes) as show:
            played = playing.play(
                network, config, self.episodes, self.interaction, self.greedy, seed, device=self.device, show=show
            )
        figures = played.summary(config.agent.discount)
        if not self.json:
            printing.show(figures)  # Before a search that may take minutes.
        with printing.waiting(f"searching for the ideal experimenter of {config.task_name}"):
            best = playing.ideal_return(config)
        share = {} if best is None else {"ideal_return": best, "share_of_ideal": figures["mean_return"] / best}
        if self.json:
            printing.show(figures | share, as_json=True)
        elif share:
            printing.show(share)


@dataclasses.dataclass
class Replay:
    """Write episodes of a trained agent for the rerun viewer: the scene, observations, beliefs and actions."""

    groups: ClassVar = staticmethod(arguments.agent_groups)

    target: str = word("AGENT", AGENT)
    compare: str | None = option(None, "a second agent, shown beside the first on the same instances", "AGENT")
    episodes: int = option(4, "number of episodes")
    output: Path = option(Path("replay.rrd"), "the file to write, in an existing folder")
    interaction: Literal["learned", "random"] = option("learned", _INTERACTION)
    select: Literal["any", "wrong", "right", "longest", "hardest"] = option("any", "the episodes to write")
    seed: int | None = option(None, _SEED)
    view: bool = option(False, "open the viewer afterwards")
    web: bool = option(False, "open the viewer in a browser afterwards")
    task_kwargs: dict[str, Any] = dataclasses.field(default_factory=dict)

    def run(self) -> None:
        """Plays, writes the file and opens the viewer if asked."""
        from physexp.analysis import replay
        from physexp.analysis.training import playing

        if self.view:
            replay.check_display()
        seed = playing.SEED if self.seed is None else self.seed
        targets = [self.target, *([] if self.compare is None else [self.compare])]
        path = replay.replay(
            targets, self.episodes, self.output, self.interaction, self.select, seed, printing.tell, self.task_kwargs
        )
        printing.tell(str(path))
        if self.view or self.web:
            replay.view(path, self.web, printing.tell)


@dataclasses.dataclass
class Play:
    """Play yourself, in the terminal, beside the ideal experimenter and a trained agent.

    Tasks with features need no OpenGL.
    """

    groups: ClassVar = staticmethod(arguments.task_groups)

    words: tuple[str, ...] = word("DOMAIN TASK", TASK, "+")
    seed: int | None = option(None, "seed of the environment; by default one from the operating system")
    view: bool = option(False, "show the scene in rerun's viewer as well; this needs a display")
    web: bool = option(False, "play in the browser instead, on a page that is served to this machine alone")
    records: Path | None = option(None, "a file to which your moves are appended, for `physexp score --records`")
    task_kwargs: dict[str, Any] = dataclasses.field(default_factory=dict)

    def run(self) -> None:
        """Plays until the player stops."""
        domain, task = arguments.task_of(self.words)
        if not self.web:
            from physexp.analysis.play import game

            game.play(domain, task, self.task_kwargs, self.seed, self.view, self.records)
            return
        from physexp.analysis.play import page
        from physexp.analysis.score import protocol
        from physexp.suite.engine import seeding

        asked = protocol.question(domain, task, self.task_kwargs)
        with printing.waiting(f"preparing {asked.name}"):
            tasks = page.prepare([asked], seed=seeding.seed_from(self.seed))
        page.serve(tasks, self.records, printing.tell)


@dataclasses.dataclass
class Page:
    """Write the page on which people play in a browser, for any host of files; --single-file needs no host."""

    folder: Path = word("FOLDER", "the folder to write, or the file with --single-file")
    tasks: tuple[str, ...] = option((), "the tasks, DOMAIN/TASK[,OPTION=VALUE...]; by default all with features")
    instances: int = option(20, "instances of each task")
    seed: int | None = option(None, "seed of the instances; by default that of `physexp score`")
    single_file: bool = option(False, "write one HTML file that a browser opens without a server")
    study: bool = option(False, "write a study: consent, practice, quiz, the instances, and debriefing")
    orders: int = option(1, "with --study, orders of the instances; the number of a participant chooses one")

    def run(self) -> None:
        """Prepares the tasks and writes the page."""
        from physexp import checks, suite
        from physexp.analysis.play import page, study
        from physexp.analysis.score import protocol

        if self.study and self.single_file:
            raise ValueError("a study needs a server, which --single-file does without; give one of the two")
        count = checks.integer("instances", self.instances, 1, page.MOST_INSTANCES)
        orders = checks.integer("orders", self.orders, 1, count)
        seed = protocol.ENVIRONMENT_SEED if self.seed is None else self.seed
        names = self.tasks or [f"{domain}/{task}" for domain, task in suite.tagged("features")]
        practice = study.PRACTICE if self.study else 0
        tasks = page.prepare(protocol.named(names), range(practice + count), seed, printing.tell)
        if self.study:
            path = study.write(self.folder, tasks, orders)
        else:
            path = (page.write_single if self.single_file else page.write)(self.folder, tasks)
        printing.tell(f"wrote {path}")


@dataclasses.dataclass
class Publish:
    """Save a run's agent, in half precision with a model card, for `physexp.agents.load_pretrained`."""

    run_dir: Path = word("RUN", "the folder of a run")
    output_dir: Path = option(Path("agents"), "the folder for the agent and its model card")
    episodes: int = option(10_000, "number of episodes for the evaluation on the card")
    replace: bool = option(False, "replace a published agent of the same name")

    def run(self) -> None:
        """Evaluates and writes the agent."""
        from physexp.analysis.training import publishing
        from physexp.analysis.training import run as run_lib

        card = publishing.publish(run_lib.Run(self.run_dir), self.output_dir, self.episodes, self.replace)
        printing.tell(str(card))
