"""A score that does not follow from what was played is refused, and the line names what differs."""

from collections.abc import Callable
import json
from pathlib import Path
import shutil

import numpy as np
import pyarrow
import pytest

from physexp.agents import files
from physexp.analysis.score import log, protocol, scoring, targets, verifying

THRESHOLD, STRINGS = protocol.named(["threshold/features", "strings/features"])
COUNT = 4


@pytest.fixture(scope="module")
def played(tmp_path_factory):
    """A folder with a score of random actions on two tasks."""
    folder = tmp_path_factory.mktemp("played") / "score"
    scoring.score(targets.find("random"), [THRESHOLD, STRINGS], COUNT, folder)
    return folder


@pytest.fixture
def folder(played, tmp_path):
    """A copy of it."""
    return shutil.copytree(played, tmp_path / "score")


def change_rows(folder: Path, change: Callable) -> None:
    """Writes the log again, with other rows: `change` takes and returns a DataFrame."""
    frame = change(log.read(folder).to_pandas())
    log.write(folder, pyarrow.Table.from_pandas(frame, log.SCHEMA, preserve_index=False))


def change_figures(folder: Path, change: Callable) -> None:
    """Writes the figures again, with others: `change` changes a dictionary."""
    figures = json.loads((folder / scoring.FILE).read_text())
    change(figures)
    files.write_atomically(folder / scoring.FILE, json.dumps(figures).encode())


def setting(column: str, row: int, value: Callable):
    """Returns a change of one value of a column."""

    def change(frame):
        values = frame[column].to_numpy().copy()
        values[row] = value(values[row])
        return frame.assign(**{column: values})

    return change


def test_what_was_played_is_verified(folder):
    calls = []
    change_rows(folder, lambda frame: frame)
    found = verifying.verify(folder, calls.append)
    assert found["episodes"] == 2 * COUNT and calls == [*range(1, 2 * COUNT + 1)]
    assert found["actions"] == len(log.read(folder)) and found["score"] == scoring.read(folder)["whole"]["score"]


# The last row is the answer in the last episode of Strings.
@pytest.mark.parametrize(
    ("column", "value", "said"),
    [
        ("action", lambda action: 6 + (action - 5) % 8, f"strings/features, episode {COUNT - 1}, step .*: "),
        ("reward", lambda reward: -reward, f"strings/features, episode {COUNT - 1}, step .*: reward is "),
        ("observation", lambda digest: digest ^ 1, "step .*: observation is "),
        ("seed", lambda seed: seed + 1, "step .*: seed is "),
        ("episode", lambda episode: episode + 1, "step .*: episode is "),
        ("value", lambda value: value + 1e-8, "step .*: value is "),
        ("worth", lambda worth: worth - 1e-8, "step .*: worth is "),
        ("answering", lambda worth: worth - 1e-8, "step .*: answering is "),
        ("tells", lambda tells: not tells, "step .*: tells is True, and False when it is played again"),
        ("bits", lambda bits: bits + 1e-8, "step .*: bits is "),
        ("regret", lambda regret: regret / 2 + 0.1, "step .*: regret is "),
        ("mistake", lambda kind: None if kind else "late", "step .*: mistake is "),
    ],
)
def test_a_value_that_was_changed_is_named(folder, column, value, said):
    change_rows(folder, setting(column, -1, value))
    with pytest.raises(ValueError, match=f"actions.parquet: .*{said}"):
        verifying.verify(folder)


def test_an_interaction_that_was_changed_is_seen_by_what_follows(folder):
    rows = log.read(folder).to_pandas()
    pushes = np.flatnonzero((rows.domain == THRESHOLD.domain) & (rows.action < 8))  # What is read tells their strength.
    change_rows(folder, setting("action", pushes[0], lambda action: (action + 1) % 8))
    with pytest.raises(ValueError, match="threshold/features, episode .*: observation is "):
        verifying.verify(folder)


def of_episode(frame, task, episode):
    return (frame.domain + "/" + frame.task == task.name) & (frame.episode == episode)


def swapped(frame, first, second):
    order = np.arange(len(frame))
    order[[first, second]] = order[[second, first]]
    return frame.iloc[order]


def in_the_middle(frame):
    """The first row of an episode that has another one after it."""
    return int(np.flatnonzero(frame.step == 1)[0]) - 1


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (lambda frame: frame.iloc[:-1], "strings/features"),
        (lambda frame: frame.drop(index=in_the_middle(frame)), "threshold/features|strings/features"),
        (lambda frame: frame.drop(index=in_the_middle(frame) + 1), "threshold/features|strings/features"),
        (lambda frame: frame[~of_episode(frame, THRESHOLD, 1)], "threshold/features has 3 episodes instead of 4"),
        (lambda frame: frame[~of_episode(frame, STRINGS, 3)], "strings/features has 3 episodes instead of 4"),
        (lambda frame: frame[frame.domain == "strings"], "row 0 is of strings/features, where threshold/features is"),
        (lambda frame: frame[frame.domain == "threshold"], "strings/features has 0 episodes instead of 4"),
        (lambda frame: frame.iloc[[0, *range(len(frame))]], "threshold/features"),
        (lambda frame: frame.iloc[[*range(len(frame)), -1]], "strings/features"),
        (lambda frame: frame.iloc[::-1], "row 0 is of strings/features"),
        (lambda frame: swapped(frame, in_the_middle(frame), in_the_middle(frame) + 1), "features"),
        (lambda frame: frame.assign(task="pixels"), "row 0 is of threshold/pixels"),
        (lambda frame: frame.iloc[:0], "threshold/features has 0 episodes instead of 4"),
    ],
)
def test_rows_that_are_missing_doubled_or_out_of_order_are_refused(folder, change, said):
    change_rows(folder, change)
    with pytest.raises(ValueError, match=f"actions.parquet: .*({said})"):
        verifying.verify(folder)


@pytest.mark.parametrize("name", ["greedy", "complete", "problem", "seconds", "commit", "versions", "whole", "tasks"])
def test_a_score_that_lacks_a_field_is_refused(folder, name):
    facts = json.loads((folder / scoring.FILE).read_text())
    del facts[name]
    (folder / scoring.FILE).write_text(json.dumps(facts))
    with pytest.raises(ValueError, match=f"is not what was written: {name} is None; score again"):
        scoring.read(folder)


def test_episodes_out_of_order_are_refused(folder):
    def change(frame):
        first, second = of_episode(frame, THRESHOLD, 0), of_episode(frame, THRESHOLD, 1)
        rest = frame[~first & ~second]
        return type(frame)(np.concatenate([frame[second], frame[first], rest]), columns=frame.columns)

    change_rows(folder, change)
    with pytest.raises(
        ValueError, match="threshold/features, episode 0, step 0: episode is 1, and 0 when it is played"
    ):
        verifying.verify(folder)


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (lambda found: found["whole"].update(score=1.0), "whole, score is 1.0, and -?0"),
        (lambda found: found["domains"]["strings"].update(interval=[0.9, 1]), "domains, strings, interval is"),
        (
            lambda found: found["tasks"]["strings/features"].update(episodes=1000),
            "tasks, strings/features, episodes is",
        ),
        (lambda found: found["tasks"]["strings/features"]["mistakes"].update(early=0.0), "mistakes, early is 0.0, and"),
        (lambda found: found["tasks"]["strings/features"].pop("luck"), "tasks, strings/features, luck is None"),
        (lambda found: found["tasks"].update(more={}), "tasks, has other metrics than threshold/features, strings"),
        (lambda found: found["protocol"].update(seed=1), "seed is 1 instead of 2000003"),
        (lambda found: found["protocol"].update(tasks=["threshold/features"]), "row .* is of strings/features"),
        (lambda found: found["protocol"].update(episodes=5), "has 4 episodes instead of 5"),
        (lambda found: found["protocol"].update(tasks=[["x"]]), "is not what was written: tasks is"),
        (lambda found: found.update(version="v0"), "is of protocol 'v0'; this version of physexp plays v1"),
        (lambda found: found.update(whole=None), "is not what was written: whole is None"),
    ],
)
def test_figures_that_do_not_follow_are_refused(folder, change, said):
    change_figures(folder, change)
    with pytest.raises(ValueError, match=said):
        verifying.verify(folder)


def test_a_damaged_or_missing_file_is_named(folder):
    path = folder / log.FILE
    content = bytearray(path.read_bytes())
    content[len(content) // 2] ^= 1
    path.write_bytes(content)
    with pytest.raises(ValueError, match=f"{path} is damaged"):
        verifying.verify(folder)
    path.unlink()
    with pytest.raises(FileNotFoundError):
        verifying.verify(folder)


def test_what_was_ended_early_must_be_whole_until_its_end(folder):
    change_figures(folder, lambda found: found.update(complete=False))
    change_rows(folder, lambda frame: frame[~of_episode(frame, THRESHOLD, 3)])
    with pytest.raises(ValueError, match="threshold/features has 3 episodes instead of 4"):
        verifying.verify(folder)
