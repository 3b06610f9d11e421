"""Commands do their work when standard streams are closed, and find the home folder where shells leave `~`."""

import os
import subprocess

import pytest
import trainers

from physexp.analysis.training import run as run_lib

SMALL = "which_is_heavier features --agent ppo --num-threads 1 --num-environments 32 --frames 300 --replay-every 0"


def shell(command, home):
    environment = {**os.environ, "HOME": str(home)}
    return subprocess.run(["bash", "-c", command], env=environment, capture_output=True, text=True, cwd=home)


def test_training_with_closed_streams_ends_well_in_the_home_folder(tmp_path):
    done = shell(f"{trainers.PHYSEXP} train {SMALL} --run-dir=~/run >&- 2>&- <&-", tmp_path)
    assert done.returncode == 0 and "Traceback" not in done.stderr
    assert os.listdir(tmp_path) == ["run"] and run_lib.Run(tmp_path / "run").is_finished
    assert done.stdout == ""


@pytest.mark.parametrize("closed", [">&-", "2>&-"])
def test_an_error_with_closed_streams_is_one_line_or_none(closed, tmp_path):
    done = shell(f"{trainers.PHYSEXP} nonsense {closed}", tmp_path)
    assert done.returncode == 2 and done.stdout == ""
    assert done.stderr.count("\n") == (closed == ">&-")


def test_python_finds_the_home_folder_too(tmp_path, monkeypatch):
    monkeypatch.setenv("HOME", str(tmp_path))
    assert run_lib.Run("~/run").path == tmp_path / "run"
