"""A simulation is for one thread at a time: another one is refused, and what the first does goes on as if alone."""

import copy
import pickle
import threading

import interpreters
import numpy as np
import pytest

from physexp import suite
from physexp.suite import gymnasium, stable_baselines
from physexp.suite.engine import episodes

TASK = ("towers", "fist_features")


class Busy:
    """Keeps an environment or a batch busy in another thread: from within a step, until it is left."""

    def __init__(self, environment, monkeypatch, action):
        stepping, done = threading.Event(), threading.Event()
        judge = episodes.Ledger.judge

        def waiting(*args):
            stepping.set()
            done.wait()
            return judge(*args)

        monkeypatch.setattr(episodes.Ledger, "judge", waiting)
        self._done, self.timestep = done, None
        self._thread = threading.Thread(target=self._play, args=(environment, action))
        self._thread.start()
        stepping.wait()

    def _play(self, environment, action):
        self.timestep = environment.step(action)

    def finish(self):
        self._done.set()
        self._thread.join()
        return self.timestep


def _environments():
    single = suite.load(*TASK, {"random": 0})
    batch = suite.load_batch(*TASK, 2, {"random": 0})
    return [(single, 0), (batch, np.zeros(2, int))]


@pytest.mark.parametrize("which", [0, 1], ids=["environment", "batch"])
def test_a_second_thread_is_refused_in_one_line_and_the_first_goes_on(which, monkeypatch):
    environment, action = _environments()[which]
    twin, _ = _environments()[which]
    environment.reset(), twin.reset()
    with monkeypatch.context() as patch:
        busy = Busy(environment, patch, action)
        uses = [environment.reset, lambda: environment.step(action), environment.render, environment.close]
        uses += [lambda: environment.reseed(1)] if which else []
        for use in uses:
            with pytest.raises(RuntimeError, match=r"^another thread is using this .*load_batch.*$") as refused:
                use()
            assert "\n" not in str(refused.value)
        timestep = busy.finish()
    expected = twin.step(action)
    for _ in range(3):
        for name, value in expected.observation.items():
            np.testing.assert_array_equal(timestep.observation[name], value)
        timestep, expected = environment.step(action), twin.step(action)


@pytest.mark.parametrize("which", [0, 1], ids=["environment", "batch"])
def test_a_copy_is_refused_with_what_to_do_instead(which):
    environment, _ = _environments()[which]
    make = (gymnasium.Environment, stable_baselines.VecEnv)[which]
    for each in (environment, make(*TASK, **({"num_envs": 2} if which else {}))):
        for duplicate in (copy.copy, copy.deepcopy, pickle.dumps):
            with pytest.raises(TypeError, match="neither copied nor pickled; load another"):
                duplicate(each)


FORK = """
import os, signal
import numpy as np
from physexp import suite

batch = suite.load_batch("which_is_heavier", "features", 64, {"random": 7}, num_threads=NUM_THREADS)
batch.reset()
batch.step(np.zeros(64, int))
reader, writer = os.pipe()
child = os.fork()
if not child:
    signal.alarm(60)  # It ends, even if the batch waits for threads that there are not.
    try:
        said = f"{batch.step(np.ones(64, int)).observation['heights'].sum():.6f}"
    except RuntimeError as error:
        said = str(error)
    os.write(writer, said.encode())
    os._exit(0)
os.close(writer)
found["in the fork"] = os.fdopen(reader).read()
found["ended"] = os.waitpid(child, 0)[1]
found["here"] = f"{batch.step(np.ones(64, int)).observation['heights'].sum():.6f}"
found["process"] = os.getpid()
"""


@pytest.mark.parametrize("num_threads", [1, 2])
def test_a_fork_steps_a_batch_of_one_thread_and_no_other(num_threads):
    found, _ = interpreters.run(FORK.replace("NUM_THREADS", str(num_threads)))
    refusal = f"this batch was loaded in process {found['process']}, and this is a fork; load another"
    assert found["ended"] == 0
    assert found["in the fork"] == (found["here"] if num_threads == 1 else refusal)
