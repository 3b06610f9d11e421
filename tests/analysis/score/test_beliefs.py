"""Stated beliefs are judged against the best ones at the same readings, whatever their player claims."""

import json
import math

import numpy as np
import pyarrow
import pytest
from seeds import fresh_seed

from physexp.analysis.data import episodes, tables
from physexp.analysis.score import beliefs, protocol, records, scoring, transcripts, verifying
from physexp.suite import words

LEAST = math.log2(words.LEAST_BELIEF)
EQUAL = [0.125] * 8


def halved(told):
    """The best belief after a push with 16 N, which tells in which half of the eight forces the smallest is."""
    return [0.25] * 4 + [0] * 4 if "slid = [1]" in told else [0] * 4 + [0.25] * 4


# Before the push, after it, the log score that follows, and the bits lost.
PLAYERS = {
    "best": (EQUAL, halved, -2, 0),
    "equal": (None, lambda told: EQUAL, -3, 1),
    "stale": (EQUAL, None, -3, 1),
    "opposite": (None, lambda told: halved(told)[::-1], LEAST, -2 - LEAST),
    "silent": (None, None, None, None),
}


def played(path, before, after, rarely=False):
    """Plays two episodes with one push each; returns the file of their records."""
    with transcripts.run(path, model="p", harness="h", tools="none", budget="none") as run:
        for episode in run.episodes("threshold/features", 2):
            if before:
                episode.believe(before)
            told = episode.experiment(3)
            if after and not (rarely and episode.index):
                episode.believe(after(told))
            episode.answer(0)
    return path / transcripts.RECORDS


@pytest.mark.parametrize("name", PLAYERS)
def test_an_answer_is_judged_with_the_last_belief_about_it(name, tmp_path):
    before, after, log_score, lost = PLAYERS[name]
    path = played(tmp_path / "run", before, after)
    lines = [{**json.loads(line), "log_scores": [0.0]} for line in path.read_text().splitlines()]  # A claim.
    path.write_text("".join(json.dumps(line) + "\n" for line in lines))
    ((score,),) = records.score(records.read(path)[0]).values()
    if log_score is None:
        assert "beliefs" not in score.metrics
    else:
        expected = {"stated": 1, "log_score": log_score, "ideal_log_score": -2, "bits_lost": lost}
        assert score.metrics["beliefs"] == pytest.approx(expected)


def test_an_answer_without_a_belief_counts_as_one_of_equal_probabilities(tmp_path):
    """So no belief can be left out for nothing."""
    ((score,),) = records.score(records.read(played(tmp_path / "run", None, halved, rarely=True))[0]).values()
    expected = {"stated": 0.5, "log_score": (-2 - 3) / 2, "ideal_log_score": -2, "bits_lost": (0 + 1) / 2}
    assert score.metrics["beliefs"] == pytest.approx(expected)


def test_beliefs_are_about_the_question_that_is_asked():
    (question,) = protocol.named(["strings/features,questions=all,num_questions=3"])
    seed, found = fresh_seed(), []
    generator, environment = np.random.default_rng(seed), protocol.load(question, seed)
    everything = [3, 1, 3, 4, 0, 4, 5, 0]  # Clamps each puck in turn, and pulls another: so each band is seen.
    for index in range(5):
        answers = question.num_interactions + generator.integers(2, size=3)
        actor = episodes.environment_loop.Repeat([*everything, *answers.tolist()])
        episode = episodes.play(environment, actor, index)
        best = protocol.ideal(question).beliefs(episode.hidden, episode.actions)
        found.append(beliefs.judged(question, episode, dict(enumerate(best.tolist()))))
        belief = {8: generator.dirichlet([1, 1]), 10: generator.dirichlet([1, 1])}
        right = [belief[8][episode.answers[0]], 0.5, belief[10][episode.answers[2]]]
        np.testing.assert_allclose(beliefs.judged(question, episode, belief)[:, 1], np.log2(right))
    assert beliefs.metrics(np.concatenate(found)) == pytest.approx(
        {"stated": 1, "log_score": 0, "ideal_log_score": 0, "bits_lost": 0}
    )


def test_a_folder_whose_beliefs_do_not_earn_what_it_says_is_refused(tmp_path):
    folder, (question,) = tmp_path / "score", protocol.named(["threshold/features"])
    target = records.target(played(tmp_path / "run", EQUAL, halved), protocol.PUBLIC, 2)
    found = scoring.score(target, [question], 2, folder)
    assert found["tasks"][question.name]["beliefs"]["bits_lost"] == pytest.approx(0)
    verifying.verify(folder)
    rows = tables.read(folder / beliefs.FILE, beliefs.SCHEMA).to_pylist()
    assert [row["step"] for row in rows] == [0, 1, 0, 1]
    for changed, told in (
        ({"probabilities": EQUAL}, "score.json: .*, beliefs, log_score is -2.0, and -2.5 by the log"),
        ({"probabilities": [0.25] * 8}, "beliefs.parquet, row 3: the sum of the probabilities is 2"),
        ({"episode": -1}, "beliefs.parquet, row 3 is of episode -1 of threshold/features, which is not in the score"),
    ):
        tables.write(
            folder / beliefs.FILE, pyarrow.Table.from_pylist([*rows[:3], {**rows[3], **changed}], beliefs.SCHEMA)
        )
        with pytest.raises(ValueError, match=f"^[^\n]*{told}[^\n]*$"):
            verifying.verify(folder)
    (folder / beliefs.FILE).unlink()
    with pytest.raises(ValueError, match="tasks, threshold/features, beliefs is {'stated': 1.0"):
        verifying.verify(folder)
