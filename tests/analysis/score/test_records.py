"""Records of play: any order, any seed, several players; each is played again, and judged as a target is."""

import json
import math

import commands
import pytest

from physexp.analysis.data import episodes
from physexp.analysis.score import judging, log, protocol, records, scores, targets

TASKS = ["threshold/features", "strings/features"]


def line(**changes):
    record = {"player": "p1", "task": "threshold/features", "seed": 7, "episode": 0, "actions": [3, 9], "times": [8, 9]}
    return json.dumps({**record, **changes}) + "\n"


def written(path, *lines):
    path.write_text("".join(lines))
    return path


def test_players_in_any_order_get_the_scores_of_targets_that_play_so(tmp_path):
    expected, lines = {}, []
    for question in protocol.named(TASKS):
        for player in ("ideal", "random"):
            make, environment = targets.find(player).make, protocol.load(question)
            played = [episodes.play(environment, make(question, index), index) for index in range(6)]
            environment.close()
            judged = judging.judge({question: [(one.hidden, one.actions) for one in played]})[question]
            rows = [
                {**log.played(question, one), **log.judged(question, one.actions, found)}
                for one, found in zip(played, judged.actions, strict=True)
            ]
            (score,) = scores.of_log(log.table(log.SCHEMA, rows), {question: None})
            expected[player, question.name] = score.metrics
            for one in played:
                actions = one.actions.tolist()
                fields = {"seed": one.seed, "episode": one.index, "actions": actions, "times": actions, "free": 1}
                lines.append(line(player=player, task=question.name, **fields))
    # Records of other seeds are judged, too; the means of a player's episodes do not depend on their order.
    read, num_left_out = records.read(written(tmp_path / "records.jsonl", *lines[::-1], lines[0]))
    assert (len(read), num_left_out) == (24, 1)
    found = records.score(read)
    for (player, task), metrics in expected.items():
        (score,) = (one for one in found[player] if one.question.name == task)
        for name in ("score", "raw_score", "success_rate", "mean_interactions", "floor", "ideal"):
            assert score.metrics[name] == pytest.approx(metrics[name], abs=1e-12)
        assert score.metrics["mistakes"] == pytest.approx(metrics["mistakes"], abs=1e-12)
    assert all(score.metrics["score"] == pytest.approx(1) for score in found["ideal"])


@pytest.mark.parametrize(
    ("bad", "message"),
    [
        ('{"player": "p1", "ta', "is no object of JSON; was the file cut off?"),
        ("[" * 100_000, "is no object of JSON"),
        (line(actions=[3, 9, 9], times=[1, 2, 3]), "the episode ends after 2 of its 3 actions"),
        (line(actions=[3], times=[1]), "the episode goes on after its 1 actions; some are missing"),
        (line(actions=[3, 99]), "an action is 99; give an integer >= 0 and <= 15"),
        (line(actions=[3, True]), "an action is True"),
        (line(times=[1]), "times is [1]; give a list of 2, one for each action"),
        (line(task="threshold/nothing"), "task is 'threshold/nothing'; choose from"),
        (line(seed=-1), "seed is -1"),
        (line(beliefs=[None]), "beliefs is [None]; give a list of 2, one for each action"),
        (line(beliefs=[None, [0.5] + [0] * 7]), "the sum of the probabilities is 0.5; give numbers whose sum is 1"),
        (
            line(beliefs=[None, [2, -1] + [0] * 6]),
            "probabilities is [2, -1, 0, 0, 0, 0, 0, 0]; give a list of 8",
        ),
        (line(beliefs=[[math.nan] * 8, None]), "probabilities is [nan, nan"),
        (line(player=3), "player is 3; give a str"),
    ],
)
def test_the_first_line_that_is_no_record_is_named(bad, message, tmp_path):
    path = written(tmp_path / "records.jsonl", line(player="p0"), "\n", bad)
    with pytest.raises(ValueError, match="^[^\n]*line 3[^\n]*$") as caught:
        records.score(records.read(path)[0])
    assert message in str(caught.value)


def test_records_of_several_players_or_of_too_few_episodes_are_no_target(tmp_path):
    own = {"seed": protocol.ENVIRONMENT_SEED, "actions": [8], "times": [1]}
    lines = [line(**own), line(**own, episode=1)]
    found = records.target(written(tmp_path / "one", *lines), protocol.PUBLIC, 2)
    assert (found.name, [one.name for one in found.questions]) == ("p1", ["threshold/features"])
    for others, count, message in (
        ([line(**own, episode=2, harness="another")], 2, "one, line 3 is of another player, or of other facts"),
        ([line(**{**own, "seed": 7}, episode=2)], 3, "no record of episode 2 of threshold/features"),
        ([line(**{**own, "actions": [0]}, episode=2)], 3, "line 3: the episode goes on after its 1 actions"),
        ([line(**own, episode=2, told={"cost": "x"})], 3, "line 3: told cost is 'x'; give a finite number >= 0"),
    ):
        with pytest.raises(ValueError, match=message):
            records.target(written(tmp_path / "one", *lines, *others), protocol.PUBLIC, count)


def test_the_command_prints_a_line_for_each_player(tmp_path):
    path = written(tmp_path / "records.jsonl", line(), line(player="p2", seed=8), line())
    done = commands.run("score", "--records", path)
    assert done.returncode == 0
    rows = [row.split() for row in done.stdout.splitlines()]
    assert [row[:3] for row in rows[-2:]] == [["p1", "threshold/features", "1"], ["p2", "threshold/features", "1"]]
    assert "1 records are of instances" in done.stderr
