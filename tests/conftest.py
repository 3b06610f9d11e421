"""Fixtures of all tests."""

import gc
import os
import signal

import commands
import pytest
import trainers

# Tests that run in the background, after `nohup` for example, ignore the signals that end a process, and so would the
# processes that they start; but tests end those by signals.
for _number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
    if signal.getsignal(_number) is signal.SIG_IGN:
        signal.signal(_number, signal.default_int_handler if _number == signal.SIGINT else signal.SIG_DFL)


# Imports of torch and MuJoCo take seconds of each spawned process. Tests that start a real `physexp` pay for them.
commands.spawn_quickly()


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport(item, call):
    """Fails a test that misses a Debian package if PHYSEXP_PACKAGES_ARE_HERE is set; otherwise it is skipped."""
    report = yield
    if report.skipped and "apt-get install" in str(report.longrepr) and os.environ.get("PHYSEXP_PACKAGES_ARE_HERE"):
        report.outcome, report.longrepr = "failed", str(report.longrepr)
    return report


def pytest_collection_modifyitems(items):
    """Puts long tests first, so that at the end no process waits for another."""
    items.sort(key=lambda item: item.get_closest_marker("long") is None)


@pytest.fixture(autouse=True, scope="module")
def frozen():
    """Hides all that a module leaves, such as environments that tests share, from collections of garbage.

    A collection among millions of objects takes more than a second.
    """
    yield
    gc.collect()
    gc.freeze()


@pytest.fixture
def untrained(tmp_path):
    """A run whose checkpoint holds an untrained network."""
    run = trainers.create(tmp_path / "run")
    trainers.save_first_checkpoint(run)
    return run
