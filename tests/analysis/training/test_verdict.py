"""An agent that has learned nothing is told of at the end of its training, in plain words."""

import dataclasses

import pytest

from physexp.agents.a3c import config as a3c
from physexp.analysis.training import config as config_lib
from physexp.analysis.training import verdict

GOOD, BAD = (0.95, 0.0), (0.1, 0.9)
SILENT = "the agent fell silent: {} of its last {} episodes ended without an answer, {} with the right one"
CHANCE = "the agent is no better than chance: {} of its last {} episodes were answered right"


def rows(*parts):
    """Rows of metrics from (episodes since the row before, share of right answers, share without an answer)."""
    made, episodes = [], 0
    for count, right, unanswered in parts:
        episodes += count
        made.append({"episodes": float(episodes), "success_rate": right, "timeouts": unanswered})
    return made


@pytest.mark.parametrize(
    ("parts", "expected"),
    [
        ([], None),
        ([(1000, 0.2, 0.0)], CHANCE.format("20.0%", "1,000")),
        # The 95 % interval of a share of 1000 at 0.25 is 1.96 sqrt(0.25 * 0.75 / 1000) = 0.027 to each side.
        ([(1000, 0.27, 0.0)], CHANCE.format("27.0%", "1,000")),
        ([(1000, 0.29, 0.0)], None),
        # 36 of 100 right: 0.36 - 1.96 sqrt(0.36 * 0.64 / 100) = 0.27 > 0.25; 30 of 100: 0.22; of 10,000: 0.29.
        ([(100, 0.36, 0.0)], None),
        ([(100, 0.30, 0.0)], CHANCE.format("30.0%", "100")),
        ([(10_000, 0.30, 0.0)], None),
        ([(1000, 0.45, 0.5)], None),
        ([(1000, 0.32, 0.68)], SILENT.format("68.0%", "1,000", "32.0%")),
        # Only the last rows count that make a thousand episodes.
        ([(100_000, *BAD), (1000, *GOOD)], None),
        ([(100_000, *GOOD), (1000, *BAD)], SILENT.format("90.0%", "1,000", "10.0%")),
        # (600 * 0.5 + 600 * 0.25) / 1200 = 37.5 % right, (600 * 0.9 + 600 * 0.3) / 1200 = 60 % unanswered.
        ([(100_000, *GOOD), (600, 0.5, 0.3), (600, 0.25, 0.9)], SILENT.format("60.0%", "1,200", "37.5%")),
    ],
)
def test_the_verdict_is_on_silence_and_chance_in_the_last_episodes(parts, expected):
    assert verdict.verdict(rows(*parts), num_labels=4) == (expected and f"{expected} (chance is 25.0%)")


def test_chance_is_the_inverse_of_the_number_of_labels():
    assert verdict.verdict(rows((1000, 0.25, 0.0)), num_labels=5) is None
    assert "chance is 20.0%" in verdict.verdict(rows((1000, 0.2, 0.0)), num_labels=5)


def test_the_advice_names_options_and_a_better_learner():
    agent = a3c.A3CConfig(frames=20_000_000)
    config = config_lib.TrainConfig(domain="which_is_heavier", task="features", agent=agent)
    line = verdict.advice(config)
    assert "--frames 40000000 or more" in line and "--entropy-cost than 0.15" in line and "--agent belief" in line
    best = dataclasses.replace(config, agent=config_lib.preset("which_is_heavier", "features"))
    assert "--agent" not in verdict.advice(best)
    usual = config_lib.preset("which_is_heavier", "features", algorithm="a3c").frames
    tiny = dataclasses.replace(config, agent=a3c.A3CConfig(frames=5000))
    assert usual > 10_000 and f"--frames {usual} or more" in verdict.advice(tiny)
