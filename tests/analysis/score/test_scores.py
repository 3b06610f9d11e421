"""Scores are shares: 1 for the ideal, 0 for the best answer without an experiment."""

import ideals
import numpy as np
import pytest

from physexp import suite
from physexp.analysis.data import episodes
from physexp.analysis.score import judging, log, protocol, scores, targets

FEATURES = [protocol.question(*names, ideals.QUICK.get(names[0])) for names in suite.tagged("features")]
COUNT = 6


def play(target, asked, count=COUNT):
    """The score of a target on a task, played in this process."""
    make, environment = targets.find(target).make, protocol.load(asked)
    played = [episodes.play(environment, make(asked, index), index) for index in range(count)]
    environment.close()
    judged = judging.judge({asked: [(one.hidden, one.actions) for one in played]})[asked]
    rows = [
        {**log.played(asked, one), **log.judged(asked, one.actions, actions)}
        for one, actions in zip(played, judged.actions, strict=True)
    ]
    (found,) = scores.of_log(log.table(log.SCHEMA, rows), {asked: judged.ideal})
    return found


@pytest.mark.parametrize("asked", FEATURES, ids=lambda asked: asked.name)
def test_the_ideal_scores_1_in_every_episode(asked):
    found = play("ideal", asked)
    # Its returns are interpolated, to a few parts in ten thousand, in the one domain whose states are no finite set.
    np.testing.assert_allclose(found.scores, 1, atol=1e-3)
    metrics = found.metrics
    assert metrics["mean_interactions"] == pytest.approx(metrics["ideal_interactions"])
    assert metrics["bits_per_interaction"] == pytest.approx(metrics["ideal_bits_per_interaction"])
    assert metrics["gains"] == pytest.approx(metrics["ideal_gains"], abs=1e-12)
    assert sum(metrics["gains"]) == pytest.approx(metrics["bits_per_interaction"] * metrics["mean_interactions"])


@pytest.mark.parametrize("asked", FEATURES, ids=lambda asked: asked.name)
def test_the_floor_is_the_better_of_the_likeliest_answer_and_of_no_answer(asked):
    at_once, silent = play("at_once", asked, 2), play("silent", asked, 2)
    floor, answer, ideal = (at_once.metrics[name] for name in ("floor", "at_once", "ideal"))
    never = -(asked.discount ** (asked.step_limit - 1))
    assert floor == silent.metrics["floor"] == max(answer, never)
    assert silent.metrics["raw_score"] == pytest.approx((never - floor) / (ideal - floor))
    # An answer at once is worth what the likeliest label is, whatever turns out to be right.
    np.testing.assert_allclose(at_once.scores, (answer - floor) / (ideal - floor))


@pytest.mark.parametrize("task", ["direct_features", "fist_features"])
def test_a_rule_that_reads_every_bit_of_a_tower_scores_1(task):
    found = play("rule", protocol.question("towers", task), 8)
    np.testing.assert_allclose([*found.scores, found.metrics["raw_score"]], 1, atol=0.01)


def test_the_scores_of_guesses_are_those_of_their_chances():
    (threshold,) = protocol.named(["threshold/features"])
    found = play("at_once", threshold)
    # One of eight levels is right: an answer is worth 2/8 - 1; none in 15 steps, -0.95^14; and the ideal pushes thrice.
    ideal, floor = 0.95**3, -(0.95**14)
    np.testing.assert_allclose(found.scores, (-0.75 - floor) / (ideal - floor))
    assert found.metrics["mistakes"]["early"] == pytest.approx((ideal + 0.75) / (ideal - floor))


@pytest.mark.parametrize("asked", FEATURES, ids=lambda asked: asked.name)
def test_score_and_mistakes_sum_to_1_and_score_and_luck_to_the_raw_score(asked):
    metrics = play("random", asked, 4).metrics
    assert metrics["score"] + sum(metrics["mistakes"].values()) == pytest.approx(1, abs=1e-9)
    assert metrics["score"] + metrics["luck"] == pytest.approx(metrics["raw_score"], abs=1e-9)
    assert min(metrics["mistakes"].values()) > -1e-9 and metrics["score"] < 1


@pytest.mark.parametrize("domain", ["threshold", "strings", "balance"])
def test_the_score_without_luck_has_the_narrower_interval(domain):
    metrics = play("random", protocol.question(domain, "features"), 40).metrics
    width, raw_width = (np.ptp(metrics[name]) for name in ("interval", "raw_interval"))
    assert metrics["interval"][0] <= metrics["score"] <= metrics["interval"][1]
    assert 0 < width < raw_width


def test_every_task_has_an_ideal_and_the_protocol_its_own_instances():
    everything = [protocol.question(*names) for names in suite.ALL_TASKS]
    newer = {asked.domain for asked in everything} - {asked.domain for asked in protocol.observing("all")}
    assert newer == {"crush", "lump"}, "a domain that joins the protocol changes all scores over domains"
    assert all(protocol.ideal(asked) is protocol.ideal(asked) for asked in everything)
    for asked in FEATURES:
        environment = protocol.load(asked)
        environment.task.next_episode = 3
        environment.reset()
        np.testing.assert_array_equal(environment.task.hidden, protocol.drawn(asked, 4)[3])
        environment.close()
