"""An agent that has learned nothing is told of at the end of its training, in plain words."""

import dataclasses

import pytest

from physexp.agents.a3c import config as a3c
from physexp.agents.ppo import config as ppo
from physexp.analysis.training import config as config_lib
from physexp.analysis.training import verdict


def rows(*parts):
    """Rows of metrics from (episodes since the row before, share of right answers, share without an answer)."""
    made, episodes = [], 0
    for count, right, unanswered in parts:
        episodes += count
        made.append({"episodes": float(episodes), "success_rate": right, "timeouts": unanswered})
    return made


@pytest.mark.parametrize(
    ("right", "told"),
    [
        (0.2, True),
        (0.25, True),
        # The 95 % interval of a share of 1000 at 0.25 is 1.96 sqrt(0.25 * 0.75 / 1000) = 0.027 to each side.
        (0.27, True),
        (0.29, False),
        (0.99, False),
    ],
)
def test_an_agent_is_no_better_than_chance_where_chance_lies_within_the_interval_of_its_share(right, told):
    found = verdict.verdict(rows((1000, right, 0.0)), num_labels=4)
    assert (found is not None) == told
    if told:
        assert found == (
            f"the agent is no better than chance: {right:.1%} of its last 1,000 episodes were answered right "
            "(chance is 25.0%)"
        )


def test_few_episodes_prove_little_and_many_prove_more():
    # 36 of 100 right: 0.36 - 1.96 sqrt(0.36 * 0.64 / 100) = 0.27 > 0.25; 30 of 100: 0.22.
    assert verdict.verdict(rows((100, 0.36, 0.0)), 4) is None
    assert "no better than chance" in verdict.verdict(rows((100, 0.30, 0.0)), 4)
    assert verdict.verdict(rows((10_000, 0.30, 0.0)), 4) is None


def test_chance_is_one_label_in_so_many():
    assert verdict.verdict(rows((1000, 0.25, 0.0)), num_labels=5) is None
    assert "chance is 20.0%" in verdict.verdict(rows((1000, 0.2, 0.0)), num_labels=5)


def test_an_agent_that_leaves_most_episodes_without_an_answer_has_fallen_silent_whatever_its_share():
    assert verdict.verdict(rows((1000, 0.45, 0.5)), 4) is None
    found = verdict.verdict(rows((1000, 0.32, 0.68)), 4)
    assert found == (
        "the agent fell silent: 68.0% of its last 1,000 episodes ended without an answer, 32.0% with the right one "
        "(chance is 25.0%)"
    )


def test_what_counts_is_the_end_and_as_many_rows_as_make_a_thousand_episodes():
    good, bad = (0.95, 0.0), (0.1, 0.9)
    assert verdict.verdict(rows((100_000, *bad), (1000, *good)), 4) is None
    assert "fell silent: 90.0%" in verdict.verdict(rows((100_000, *good), (1000, *bad)), 4)
    # 600 + 600 make a thousand: (600 * 0.5 + 600 * 0.25) / 1200 = 37.5 % right, (600 * 0.9 + 600 * 0.3) / 1200 = 60 %.
    mixed = rows((100_000, *good), (600, 0.5, 0.3), (600, 0.25, 0.9))
    assert "60.0% of its last 1,200 episodes ended without an answer, 37.5% with" in verdict.verdict(mixed, 4)


def test_of_no_rows_nothing_is_said():
    assert verdict.verdict([], 4) is None


@pytest.mark.parametrize("agent", [a3c.A3CConfig(frames=20_000_000), ppo.PPOConfig(frames=20_000_000)])
def test_the_advice_names_the_options_of_the_learner_and_a_better_one(agent):
    config = config_lib.TrainConfig(domain="which_is_heavier", task="features", agent=agent)
    line = verdict.advice(config)
    assert (
        "\n" not in line
        and f"--frames {2 * agent.frames}" in line
        and f"--entropy-cost than {agent.entropy_cost:g}" in line
    )
    assert "--agent belief" in line
    best = dataclasses.replace(config, agent=config_lib.preset("which_is_heavier", "features"))
    assert "--agent" not in verdict.advice(best)


def test_after_a_trial_run_the_usual_number_of_frames_is_advised():
    tiny = config_lib.TrainConfig(domain="which_is_heavier", task="features", agent=a3c.A3CConfig(frames=5000))
    usual = config_lib.preset("which_is_heavier", "features", algorithm="a3c").frames
    assert usual > 10_000 and f"--frames {usual} or more" in verdict.advice(tiny)
