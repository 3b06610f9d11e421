"""Strategies that the ideal experimenter implies, and that agents who come near its return may miss. Ours."""

from collections.abc import Callable
import dataclasses

from matplotlib import axes as axes_lib
import numpy as np
import pandas

from physexp.analysis.data import estimates, plots
from physexp.analysis.experiments import base, conditions
from physexp.analysis.experiments import claims as claims_lib
from physexp.analysis.training import config as config_lib
from physexp.analysis.training import records

LEAST_SHARE = 0.95  # Of the ideal's return, that agents are to earn.
_COLUMNS = ("reward", "length", "interactions")


@dataclasses.dataclass(frozen=True, kw_only=True)
class Strategy:
    """What agents of one condition do.

    Attributes:
      condition: what they are trained on.
      columns: of episodes, that are needed to see what is done.
      seen: adds to episodes what is done in them.
      claims: returns the claims about it.
      optimum: the claim that agents come near the optimum, in words.
      draw: draws what is done.
    """

    condition: config_lib.TrainConfig
    columns: tuple[str, ...]
    seen: Callable[[pandas.DataFrame], pandas.DataFrame]
    claims: Callable[[pandas.DataFrame], list[claims_lib.Claim]]
    optimum: str
    draw: Callable[[axes_lib.Axes, pandas.DataFrame], None]

    def load(self, results: base.Results) -> pandas.DataFrame:
        """Returns episodes, with what is `seen` and the `share` of the ideal's value that each returned."""
        frame = results.episodes([base.EVALUATION], [self.condition], [*_COLUMNS, *self.columns])
        share = records.discounted_return(frame) / conditions.ideal(self.condition).value
        return self.seen(frame.assign(share=share))

    def find_claims(self, frame: pandas.DataFrame) -> list[claims_lib.Claim]:
        """Agents do what the ideal does, and come near its return."""
        return [
            *self.claims(frame),
            claims_lib.Claim(
                text=self.optimum,
                condition=self.condition.label,
                statistic="share of the ideal's return, median of agents",
                estimate=estimates.median(frame.groupby("training_seed").share.mean()),
                above=LEAST_SHARE,
            ),
        ]

    def figure(self, frame: pandas.DataFrame):
        """Interactions before the answer beside the ideal's, and what is done."""
        figure, (left, right) = plots.new(columns=2, width=3.0, height=2.3)
        best = conditions.ideal(self.condition).figures()["histogram"]
        longest = max(len(best), int(frame.interactions.max()) + 1)
        shares = np.bincount(frame.interactions, minlength=longest) / len(frame)
        left.bar(np.arange(longest), shares, color=plots.COLORS[1], width=0.8, alpha=0.75, label="agents")
        ideal = [best.get(number, 0.0) for number in range(longest)]
        left.stairs(ideal, np.arange(longest + 1) - 0.5, color=plots.GREY, linewidth=1.3, label="ideal")
        left.set(xlabel="interactions before the answer", ylabel="share of episodes")
        left.legend(loc="lower right", bbox_to_anchor=(1, 1), ncols=2)
        self.draw(right, frame)
        figure.suptitle(plots.seeds(frame), fontsize=7, x=0.99, ha="right")
        return figure

    def experiment(self, name: str, title: str, caption: str) -> base.Experiment:
        """Returns the experiment."""
        return base.Experiment(
            name=name,
            title=title,
            section=claims_lib.OURS,
            caption=f"{caption}, gamma {self.condition.agent.discount:g}; actions drawn. Left: interactions before the "
            "answer; outlined: the ideal experimenter.",
            conditions=(self.condition,),
            trials=(base.EVALUATION,),
            load=self.load,
            claims=self.find_claims,
            draw=self.figure,
        )
