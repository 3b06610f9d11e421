"""A score that does not follow from its actions is refused in a line that names the difference."""

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


def change_facts(folder: Path, change: Callable) -> None:
    """Writes `score.json` again: `change` changes the dictionary."""
    facts = json.loads((folder / scoring.FILE).read_text())
    change(facts)
    files.write_atomically(folder / scoring.FILE, json.dumps(facts).encode())


def setting(column: str, row: int, value: Callable):
    """Returns a change of one value of a column."""

    def change(frame):
        values = frame[column].to_numpy().copy()
        values[row] = value(values[row])
        return frame.assign(**{column: values})

    return change


def test_a_score_is_verified(folder):
    calls = []
    found = verifying.verify(folder, calls.append)
    assert found["episodes"] == 2 * COUNT and calls == [*range(1, 2 * COUNT + 1)]
    assert found["actions"] == len(log.read(folder))
    assert found["scores"] == {"exact": scoring.read(folder)["tracks"]["exact"]["score"]}


# The last row is the answer in the last episode of Strings.
@pytest.mark.parametrize(
    ("column", "value"),
    [
        ("reward", lambda reward: -reward),
        ("observation", lambda digest: digest ^ 1),
        ("episode", lambda episode: episode + 1),
        ("value", lambda value: value + 1e-8),
        ("tells", lambda tells: not tells),
        ("mistake", lambda kind: None if kind else "late"),
    ],
)
def test_a_changed_value_is_named(folder, column, value):
    change_rows(folder, setting(column, -1, value))
    with pytest.raises(ValueError, match=f"actions.parquet: strings/features, episode 3, step .*: {column} is "):
        verifying.verify(folder)


def test_a_changed_interaction_shows_in_the_observation_after_it(folder):
    rows = log.read(folder).to_pandas()
    pushes = np.flatnonzero((rows.domain == THRESHOLD.domain) & (rows.action < 8))  # Each has its own observation.
    change_rows(folder, setting("action", pushes[0], lambda action: (action + 1) % 8))
    with pytest.raises(ValueError, match="threshold/features, episode .*: observation is "):
        verifying.verify(folder)


def of_episode(frame, task, episode):
    return (frame.domain + "/" + frame.task == task.name) & (frame.episode == episode)


def in_the_middle(frame):
    """The first row of an episode that has another one after it."""
    return int(np.flatnonzero(frame.step == 1)[0]) - 1


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (lambda frame: frame.iloc[:-1], "has 7 episodes instead of 8"),  # The only row of the last episode.
        (lambda frame: frame.drop(index=in_the_middle(frame) + 1), "features, episode"),
        (lambda frame: frame[~of_episode(frame, THRESHOLD, 1)], "has 7 episodes instead of 8"),
        (lambda frame: frame[frame.domain == "strings"], "has 4 episodes instead of 8"),
        (lambda frame: frame.iloc[[0, *range(len(frame))]], "has 9 episodes instead of 8"),
        (lambda frame: frame.loc[frame.index.repeat(1 + (frame.step == 1))], "features, episode"),
        (lambda frame: frame.sort_values(["domain", "episode", "step"]), "threshold/features, episode 0"),
        (lambda frame: frame.iloc[:0], "has 0 episodes instead of 8"),
    ],
)
def test_missing_doubled_or_disordered_rows_are_refused(folder, change, said):
    change_rows(folder, change)
    with pytest.raises(ValueError, match=f"actions.parquet.*{said}"):
        verifying.verify(folder)


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (lambda found: found["tracks"]["exact"].update(score=1.0), "tracks, exact, score is 1.0, and -?0"),
        (lambda found: found["tracks"]["exact"].update(worst={"towers": 0}), "exact, worst, strings is None, and -?0"),
        (lambda found: found["tasks"]["strings/features"].pop("luck"), "tasks, strings/features, luck is None"),
        (lambda found: found["tasks"].update(more={}), "tasks, more is {}, and None by the log"),
        (lambda found: found["protocol"].update(seed=1), "seed is 1 instead of 2000003"),
        (lambda found: found["protocol"].update(tasks=["threshold/features"]), "has 8 episodes instead of 4"),
        (lambda found: found["protocol"].update(tasks=[["x"]]), "is faulty: tasks is"),
        (lambda found: found.update(version="v0"), "is of protocol 'v0'; this version of physexp reads v1 and v2"),
        (lambda found: found.update(version="v1"), "is faulty: domains is None; score again"),
        (lambda found: found.update(tracks=None), "is faulty: tracks is None; score again"),
        (lambda found: found.pop("commit"), "is faulty: commit is None; score again"),
    ],
)
def test_facts_and_metrics_that_do_not_follow_are_refused(folder, change, said):
    change_facts(folder, change)
    with pytest.raises(ValueError, match=said):
        verifying.verify(folder)


def test_a_damaged_or_missing_log_is_named(folder):
    path = folder / log.FILE
    content = bytearray(path.read_bytes())
    content[len(content) // 2] ^= 1
    path.write_bytes(content)
    with pytest.raises(ValueError, match=f"{path} is damaged"):
        verifying.verify(folder)
    path.unlink()
    with pytest.raises(FileNotFoundError):
        verifying.verify(folder)


def test_a_score_that_ended_early_may_lack_its_last_episodes_alone(folder):
    change_facts(folder, lambda found: found.update(complete=False))
    change_rows(folder, lambda frame: frame[~of_episode(frame, THRESHOLD, 3)])
    with pytest.raises(ValueError, match="threshold/features, episode 3"):
        verifying.verify(folder)
