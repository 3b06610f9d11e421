"""A worker that is stopped, wherever it is stopped, is told of, and hangs nobody for ever."""

import contextlib
import dataclasses
import functools
import math
import os
from pathlib import Path
import re
import signal
import threading
import time
import types

import pytest
import trainers
from waiting import wait_until

from physexp.agents import core
from physexp.agents.a3c import agent as a3c
from physexp.analysis.training import trainer


def make_agent(tmp_path, num_workers, report):
    """An agent, and its patience, that lasts for ever until a test changes it."""
    config = trainers.create(tmp_path / "run", frames=10**9, num_workers=num_workers, envs_per_worker=2).config
    patience = types.SimpleNamespace(**dict.fromkeys(dataclasses.asdict(a3c.Patience()), math.inf))
    environments = functools.partial(trainer.make_environment, config)
    return a3c.A3C(environments, config.agent, report, patience), patience


@contextlib.contextmanager
def training_of(agent):
    """The updates of an agent, that ends with the test."""
    updates = agent.updates(poll_seconds=0.05)
    try:
        yield updates
    finally:
        updates.close()


def state(pid):
    return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0]


def stop(pid):
    """Stops a process, and returns when it is."""
    os.kill(pid, signal.SIGSTOP)
    wait_until(lambda: state(pid) == "T", "a stopped process")


def iterate_until(updates, condition):
    for update in updates:
        if condition(update):
            return
    pytest.fail("training has ended")


def test_an_agent_that_has_ended_trains_again_from_what_it_is_given(tmp_path):
    config = trainers.create(tmp_path / "run", frames=400, num_workers=1, envs_per_worker=2).config
    agent = a3c.A3C(functools.partial(trainer.make_environment, config), config.agent, print)
    before = agent.save()
    for _ in range(2):
        agent.restore(before)
        for _ in agent.updates(poll_seconds=0.05):
            pass
        assert agent.frames >= 400


def test_training_goes_on_without_a_stopped_worker_and_ends_without_it(tmp_path):
    lines = []
    agent, patience = make_agent(tmp_path, 2, lines.append)
    with training_of(agent) as updates:
        iterate_until(updates, lambda _: bool((agent.shared.variables.rounds > 0).all()))
        victim = agent._workers[0].process.pid
        with agent.shared.lock:  # So that it does not have it.
            stop(victim)
        patience.silent = 0.3
        rounds = agent.shared.variables.rounds
        iterate_until(updates, lambda _: any("worker 0" in line for line in lines))
        # The other one may be slow, too: how slow is the machine's affair.
        (line, *_) = (line for line in lines if "worker 0" in line)
        assert re.fullmatch(
            rf"worker 0 \(process {victim}\) has been silent since [0-9:]{{8}}; training "
            "(goes on with the others|waits)",
            line,
        )
        before = rounds.tolist()
        iterate_until(updates, lambda _: rounds[1] > before[1] + 2)
        assert rounds[0] == before[0]
        tensors = agent.save()
        os.kill(victim, signal.SIGCONT)
        iterate_until(updates, lambda _: f"worker 0 (process {victim}) is back" in lines)
        with agent.shared.lock:
            stop(victim)
        patience.stop = 0.6
        agent.stop()
        list(updates)
        assert f"worker 0 (process {victim}) did not end its round within 1 s, and was killed" in lines
        assert not Path(f"/proc/{victim}").exists()
        assert int(agent.save()["updates"]) > int(tensors["updates"])


def stop_while_it_holds_the_lock(agent):
    pid = agent._workers[0].process.pid
    while True:
        stop(pid)
        if int(agent.shared.holder) == 0:
            return pid
        os.kill(pid, signal.SIGCONT)
        time.sleep(0.001)


@pytest.mark.long
@pytest.mark.parametrize("waiting, is_killed", [("for updates", False), ("to save", False), ("to save", True)])
def test_a_worker_that_dies_or_is_stopped_with_the_shared_variables_ends_training(waiting, is_killed, tmp_path):
    agent, patience = make_agent(tmp_path, 1, pytest.fail)
    with training_of(agent) as updates:
        iterate_until(updates, lambda _: agent.frames > 0)
        victim = stop_while_it_holds_the_lock(agent)
        if is_killed:
            os.kill(victim, signal.SIGKILL)
            message = r"worker 0 died without a word \(exit code -9\)"
        else:
            patience.locked = 0.3
            message = rf"worker 0 \(process {victim}\) has kept the others from the shared variables"
        with pytest.raises(core.WorkerError, match=message):
            agent.save() if waiting == "to save" else list(updates)
    assert not Path(f"/proc/{victim}").exists()
    with pytest.raises(core.WorkerError, match="killed in the middle of an update"):
        agent.save()


def test_updates_and_records_agree_wherever_a_worker_was_stopped(tmp_path):
    before = threading.enumerate()
    agent, patience = make_agent(tmp_path, 1, lambda line: None)
    recorded = 0
    with training_of(agent) as updates:
        for update in updates:
            recorded += update is not None
            if update is not None and recorded == 20:
                with agent.shared.lock:
                    stop(agent._workers[0].process.pid)
                patience.stop = 0.0
                agent.stop()
    tensors = agent.save()
    assert int(tensors["updates"]) == int(tensors["rounds"][0]) == recorded
    assert set(threading.enumerate()) <= set(before)
