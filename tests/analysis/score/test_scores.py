"""Scores are shares: 1 for the ideal, 0 for the best policy that does not look."""

import json
from pathlib import Path

import ideals
import numpy as np
import pytest

from physexp import suite
from physexp.analysis.data import episodes
from physexp.analysis.score import judging, log, protocol, scores, scoring, targets

ROOT = Path(__file__).parents[3]
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
def test_the_floor_is_the_best_return_without_looking(asked):
    at_once, silent = play("at_once", asked, 2), play("silent", asked, 2)
    floor, answer, ideal = (at_once.metrics[name] for name in ("floor", "at_once", "ideal"))
    never = -(asked.discount ** (asked.step_limit - 1))
    blind = [never, *(answer * asked.discount**step for step in range(asked.step_limit))]
    assert floor == silent.metrics["floor"] == pytest.approx(max(blind))
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
    # One of eight levels is right: an answer is worth 2/8 - 1, also in the last of 15 steps; the ideal pushes thrice.
    ideal, floor = 0.95**3, -0.75 * 0.95**14
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
    newer = {asked.domain for asked in everything} - {asked.domain for asked in protocol.in_tracks(["exact", "pixels"])}
    assert newer == {"crush", "lump"}, "a domain that joins a track changes all scores over its domains"
    assert all(protocol.ideal(asked) is protocol.ideal(asked) for asked in everything)
    for asked in FEATURES:
        environment = protocol.load(asked)
        environment.task.next_episode = 3
        environment.reset()
        np.testing.assert_array_equal(environment.task.hidden, protocol.drawn(asked, 4)[3])
        environment.close()


def test_scores_of_the_first_version_follow_from_its_logs():
    rows = [path.parent for path in sorted((ROOT / "results" / "scores").glob("*/score.json"))]
    row, written = next((row, its) for row in rows if (its := scoring.read(row))["version"] == "v1")
    asked = protocol.named(written["tasks"])
    metrics = scores.summary(scores.of_log(log.read(row), dict.fromkeys(asked), "v1"), "v1")
    for name in ("domains", "whole"):
        assert json.dumps(written[name]) == json.dumps(metrics[name]), row
    of_task = metrics["tasks"][asked[-1].name]
    never = -(asked[-1].discount ** (asked[-1].step_limit - 1))
    assert of_task["floor"] == max(of_task["at_once"], never) == written["tasks"][asked[-1].name]["floor"]


def test_a_track_counts_all_its_domains_alike_and_an_unplayed_one_as_0():
    exact = protocol.in_tracks(["exact"])
    played = [play("at_once", one, 2) for one in exact if one.domain in ("threshold", "balance")]
    (track,) = (found := scores.summary(played)["tracks"])
    its = found[track]
    each = {one.question.domain: one.metrics["score"] for one in played}
    assert track == "exact" and (its["played"], its["of"]) == (2, len({one.domain for one in exact}))
    assert its["score"] == pytest.approx(sum(each.values()) / its["of"])
    assert its["worst"] == {"balance": pytest.approx(min(each.values()))} and min(each.values()) < 0
    assert not scores.summary(played[:1])["tracks"], "one task of several is no track"
