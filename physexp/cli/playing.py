"""Commands that play episodes."""

import dataclasses
from pathlib import Path
from typing import Annotated, ClassVar, Generic, Literal

import tyro
from tyro.conf import OmitArgPrefixes, Positional

from physexp.agents import config as agent_config
from physexp.cli import options as options_lib
from physexp.cli import printing
from physexp.cli.arguments import Agent, Domain, OptionalAgent, OptionalInt, Switch, Task


@dataclasses.dataclass
class Evaluate(Generic[options_lib.Options]):
    """Play episodes with a trained agent and measure how well it answers, beside the ideal experimenter.

    Attributes:
      options: what the agent is to have been trained with.
      episodes: how many to play.
      interaction: learned, or random: interaction actions are replaced by uniformly drawn ones (paper, Section 5.3).
      greedy: take the likeliest action instead of drawing one.
      device: where convolutions are computed: cpu, cuda, or auto for the GPU where there is one.
      seed: of the environments and the actions; by default one that training never uses.
      json: print JSON.
    """

    domains_of: ClassVar = staticmethod(options_lib.of_agent)

    target: Agent
    options: OmitArgPrefixes[options_lib.Options]
    episodes: int = 1000
    interaction: Literal["learned", "random"] = "learned"
    greedy: Switch = False
    device: agent_config.Device = "auto"
    seed: OptionalInt = None
    json: Switch = False

    def run(self) -> None:
        from physexp.analysis.training import finding, playing, progress

        network, config = finding.find_agent(self.target, options_lib.chosen(self.options))
        seed = playing.SEED if self.seed is None else self.seed
        with progress.bar("episodes", self.episodes) as show:
            played = playing.play(
                network, config, self.episodes, self.interaction, self.greedy, seed, device=self.device, show=show
            )
        figures = played.summary(config.agent.discount)
        if not self.json:
            printing.show(figures, as_json=False)  # Before a search that may take minutes.
        with printing.warned_if_slow(f"searching for the ideal experimenter of {config.task_name}"):
            best = playing.ideal_return(config)
        share = {} if best is None else {"ideal_return": best, "share_of_ideal": figures["mean_return"] / best}
        if self.json:
            printing.show(figures | share, as_json=True)
        elif share:
            printing.show(share, as_json=False)


@dataclasses.dataclass
class Replay(Generic[options_lib.Options]):
    """Write episodes of a trained agent for the rerun viewer: the scene, what the agent saw, believed and did.

    Attributes:
      compare: another one, to be shown side by side on the same instances.
      options: what the agent is to have been trained with.
      episodes: how many.
      output: the file, in a folder that exists; by default replay.rrd.
      interaction: learned, or random: interaction actions are replaced by uniformly drawn ones (paper, Section 5.3).
      select: any, or those that are wrong or right, the longest, or the hardest.
      seed: of the environments and the actions; by default one that training never uses.
      view: open the viewer afterwards.
      web: open the viewer in a browser afterwards.
    """

    domains_of: ClassVar = staticmethod(options_lib.of_agent)

    target: Agent
    options: OmitArgPrefixes[options_lib.Options]
    compare: OptionalAgent = None
    episodes: int = 4
    output: Path = Path("replay.rrd")
    interaction: Literal["learned", "random"] = "learned"
    select: Literal["any", "wrong", "right", "longest", "hardest"] = "any"
    seed: OptionalInt = None
    view: Switch = False
    web: Switch = False

    def run(self) -> None:
        from physexp.analysis import replay
        from physexp.analysis.training import playing

        if self.view:
            replay.check_display()
        seed = playing.SEED if self.seed is None else self.seed
        targets = [self.target] if self.compare is None else [self.target, self.compare]
        chosen = options_lib.chosen(self.options)
        path = replay.replay(
            targets, self.episodes, self.output, self.interaction, self.select, seed, printing.tell, chosen
        )
        printing.tell(str(path))
        if self.view or self.web:
            replay.view(path, self.web, printing.tell)


@dataclasses.dataclass
class Play(Generic[options_lib.Options]):
    """Play yourself, in the terminal (features need no OpenGL), beside the ideal experimenter and a trained agent.

    Attributes:
      options: what the domain lets choose.
      seed: of the environment; by default one from the operating system.
      view: show the scene in rerun's viewer as well, where there is a display.
    """

    domains_of: ClassVar = staticmethod(options_lib.of_domain)

    domain: Domain
    task: Task
    options: OmitArgPrefixes[options_lib.Options]
    seed: OptionalInt = None
    view: Switch = False

    def run(self) -> None:
        from physexp.analysis.play import game

        game.play(self.domain, self.task, options_lib.chosen(self.options), self.seed, self.view)


@dataclasses.dataclass
class Publish:
    """Save a run's agent, in half precision with a model card, as one that `physexp.agents.load_pretrained` returns.

    Attributes:
      run_dir: the folder of a run.
      output_dir: the folder for the agent and its model card.
      episodes: how many to play for the evaluation on the card.
      replace: put the agent in the place of the one that may be there.
    """

    run_dir: Annotated[Positional[Path], tyro.conf.arg(metavar="RUN")]
    output_dir: Path = Path("agents")
    episodes: int = 10_000
    replace: Switch = False

    def run(self) -> None:
        from physexp.analysis.training import publishing
        from physexp.analysis.training import run as run_lib

        card = publishing.publish(run_lib.Run(self.run_dir), self.output_dir, self.episodes, self.replace)
        printing.tell(str(card))
