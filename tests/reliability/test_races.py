"""Of two trainers that are started together on one folder, one trains and the other is refused."""

import time

import attacks
import commands
import pytest
import subjects

from physexp import suite
from physexp.agents import starting
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


def test_of_two_new_runs_in_one_folder_one_trains_and_one_is_refused(tmp_path):
    generator = attacks.generator()
    for attack in range(attacks.repetitions(2, share=0.25)):
        run = run_lib.Run(tmp_path / str(attack))
        ends = race(generator, new(run.path, 1), new(run.path, 2))
        assert sorted(end.code for end in ends) == [0, 2], ends
        winner = [end.code for end in ends].index(0)
        ends[1 - winner].assert_refused(str(run.path))
        assert run.config.agent.seed == winner + 1 and run.is_finished
        rows, episodes, _, num_episodes = subjects.contents(run)
        assert num_episodes == rows[-1]["episodes"] and len({row["frames"] for row in rows}) == len(rows)
        seed = starting.worker_seed(run.config.agent.seed, 0)
        assert {row["seed"] for row in episodes} == {suite.environment_seed(seed, index) for index in range(4)}
