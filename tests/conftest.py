"""Fixtures of all tests."""

import os
import signal

import commands
import pytest
import trainers

from physexp.agents.a3c import config as a3c
from physexp.analysis.training import config as config_lib
from physexp.analysis.training import run as run_lib

# Who starts the tests in the background may have them ignore what ends a process, and processes that they start ignore
# it too, as after `nohup`; but those are to be ended.
for _number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
    if signal.getsignal(_number) is signal.SIG_IGN:
        signal.signal(_number, signal.default_int_handler if _number == signal.SIGINT else signal.SIG_DFL)


# Imports of torch and MuJoCo take seconds of each process that is spawned. What a real `physexp` spawns imports them
# as ever, in the tests that start one.
commands.spawn_quickly()


LONGEST = {
    "test_cluster",
    "test_determinism",
    "test_docs",
    "test_faults",
    "test_kills",
    "test_learning",
    "test_readme",
    "test_replay",
    "test_reproduce",
    "test_soak",
}
"""Files with tests that take long."""


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport(item, call):
    """Where PHYSEXP_PACKAGES_ARE_HERE is set, a test that misses a package fails instead of being skipped."""
    report = yield
    if report.skipped and "apt-get install" in str(report.longrepr) and os.environ.get("PHYSEXP_PACKAGES_ARE_HERE"):
        report.outcome, report.longrepr = "failed", str(report.longrepr)
    return report


def pytest_collection_modifyitems(items):
    """Has these begin first: what two processes take from each other in the end is short."""
    items.sort(key=lambda item: item.path.stem not in LONGEST)


@pytest.fixture
def untrained(tmp_path):
    """A run whose checkpoint holds a network as it is before training."""
    config = config_lib.TrainConfig(
        domain="which_is_heavier", task="features", task_kwargs={"difficulty": 10.0}, agent=a3c.A3CConfig(num_workers=1)
    )
    run = run_lib.Run(tmp_path / "run")
    run.create(config)
    trainers.save_first_checkpoint(run)
    return run
