"""Of two trainers that are started together on one folder, one trains and the other is refused."""

import time

import attacks
import commands
import pytest
import subjects

from physexp.analysis.training import run as run_lib

pytestmark = pytest.mark.long


def start(go, delay, *words):
    """A command, as soon as both are ready, or a moment after that."""
    go.wait()
    time.sleep(delay)
    commands.physexp(*words)


def race(generator, *starts):
    go = attacks.barrier(len(starts))
    children = [
        attacks.Child(start, go, generator.choice([0.0, generator.uniform(0, 0.5)]), *words) for words in starts
    ]
    return [child.end() for child in children]


def new(path, seed):
    return ["train", "which_is_heavier", "features", "--run-dir", path, "--seed", seed, *subjects.OPTIONS]


@pytest.fixture(scope="module")
def undisturbed(tmp_path_factory):
    """The contents of each of the two runs without a race."""
    found = []
    for seed in (1, 2):
        path = tmp_path_factory.mktemp("undisturbed") / "run"
        end = attacks.run(commands.physexp, *new(path, seed))
        assert end.code == 0, end.said
        found.append(subjects.contents(run_lib.Run(path)))
    return found


def learned(contents):
    """The contents that do not depend on the times of rows: the tensors, and the number of episodes."""
    return contents[2:]


def test_of_two_new_runs_in_one_folder_one_trains_undisturbed(undisturbed, tmp_path):
    generator = attacks.generator()
    with attacks.Tally("race, train") as tally:
        for attack in range(attacks.repetitions(2, share=0.25)):
            run = run_lib.Run(tmp_path / str(attack))
            ends = race(generator, new(run.path, 1), new(run.path, 2))
            assert sorted(end.code for end in ends) == [0, 2], ends
            loser = next(end for end in ends if end.code)
            loser.assert_refused(str(run.path))
            winner = ends.index(next(end for end in ends if not end.code))
            assert run.config.agent.seed == winner + 1, ends
            assert learned(subjects.contents(run)) == learned(undisturbed[winner])
            seeds = {row["seed"] for row in subjects.contents(run)[1]}
            assert seeds == {row["seed"] for row in undisturbed[winner][1]}
            tally[f"the {'first' if winner == 0 else 'second'} won"] += 1
