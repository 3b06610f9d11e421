"""The mass gaps that the difficulties make (paper, Section 5.1; right of Figure 1)."""

import numpy as np

from physexp.analysis.data import estimates, plots
from physexp.analysis.experiments import base, claims, conditions
from physexp.suite.domains import which_is_heavier

_EPISODES = 200_000
_SMALL = 0.1  # A gap that is hard to tell from none.


def load(results: base.Results):
    """Mass gaps of the first episodes of seed 0, drawn as the task draws them."""
    import pandas

    seeds, episodes = np.zeros(_EPISODES, np.int64), np.arange(_EPISODES)
    frames = []
    for difficulty in conditions.DIFFICULTIES:
        masses = which_is_heavier.draw_masses(seeds, episodes, difficulty)
        frames.append(pandas.DataFrame({"difficulty": difficulty, "mass_gap": which_is_heavier.mass_gaps(masses)}))
    return pandas.concat(frames, ignore_index=True)


def find_claims(frame) -> list[claims.Claim]:
    """Gaps near zero grow rarer from each difficulty to the next."""
    found = []
    for harder, easier in zip(conditions.DIFFICULTIES, conditions.DIFFICULTIES[1:], strict=False):
        small = [frame.mass_gap[frame.difficulty == beta] < _SMALL for beta in (harder, easier)]
        found.append(
            claims.Claim(
                text="Lower values of beta make small mass gaps, hence hard instances, likelier",
                section="5.3",
                condition=f"beta {harder:g} against {easier:g}",
                statistic=f"difference of the shares of mass gaps below {_SMALL:g}",
                estimate=estimates.difference_of_shares(*small),
                above=0,
                is_sanity_check=True,
            )
        )
    return found


def draw(frame):
    """Densities of the mass gap."""
    figure, axes = plots.new()
    for number, difficulty in enumerate(conditions.DIFFICULTIES):
        gaps = frame.mass_gap[frame.difficulty == difficulty]
        density, edges = np.histogram(gaps, bins=np.linspace(0, 1, 51), density=True)
        axes.stairs(
            density,
            edges,
            color=plots.COLORS[number],
            linestyle=plots.DASHES[number],
            linewidth=1.4,
            label=f"β = {difficulty:g}",
        )
    axes.set(xlabel="mass gap (range of masses = 1)", ylabel="density", xlim=(0, 1), ylim=(0, None))
    axes.legend()
    return figure


EXPERIMENT = base.Experiment(
    name="mass_gap",
    title="Mass gaps",
    section="5.1, Figure 1 (right)",
    caption="By how much the heaviest block is heavier than the second, at three difficulties; "
    f"{_EPISODES:,} episodes each.",
    load=load,
    claims=find_claims,
    draw=draw,
)
