"""The command line as a user runs it."""

import json
from pathlib import Path
import resource
import subprocess
import sys

import pytest

from physexp import suite

PHYSEXP = Path(sys.executable).with_name("physexp")


def physexp(*arguments, cwd=None):
    """Runs the command; returns the finished process."""
    return subprocess.run([PHYSEXP, *map(str, arguments)], capture_output=True, text=True, timeout=120, cwd=cwd)


def assert_refused(done, *words):
    """One line on standard error that says what is wrong, exit status 2, nothing else."""
    assert done.returncode == 2, done.stderr
    assert done.stdout == ""
    assert len(done.stderr.splitlines()) == 1, done.stderr
    for word in words:
        assert word in done.stderr


@pytest.mark.parametrize("arguments", [["--help"], ["train", "--help"], ["evaluate", "--help"]])
def test_help_answers_in_under_half_a_second(arguments):
    def seconds():
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        done = physexp(*arguments)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        assert done.returncode == 0 and "usage" in done.stdout.lower()
        return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime

    # Processor time, the best of five: it waits for nothing, so on an idle machine this is what the clock shows; the
    # clock itself would measure what else is running, here the other tests.
    assert min(seconds() for _ in range(5)) < 0.5


def test_help_lists_the_commands_and_train_help_the_configuration():
    text = physexp("--help").stdout
    for command in ("tasks", "train", "evaluate", "bench", "doctor"):
        assert command in text
    text = physexp("train", "--help").stdout
    for option in ("difficulty", "discount", "frames", "seed", "num-workers", "envs-per-worker", "run-dir", "resume"):
        assert f"--{option}" in text


def test_help_imports_nothing_heavy():
    script = (
        "import sys; sys.argv = ['physexp', '--help']\n"
        "from physexp import cli\n"
        "try: cli.main()\n"
        "except SystemExit: pass\n"
        "print([name for name in ('torch', 'mujoco', 'dm_control', 'scipy', 'pyarrow') if name in sys.modules])"
    )
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, timeout=60, check=True)
    assert done.stdout.splitlines()[-1] == "[]"


def test_tasks_lists_every_task_with_its_numbers():
    rows = json.loads(physexp("tasks", "--json").stdout)
    assert [(row["domain"], row["task"]) for row in rows] == [tuple(names) for names in suite.ALL_TASKS]
    numbers = {(row["domain"], row["task"]): (row["interactions"], row["labels"], row["step_limit"]) for row in rows}
    # DESIGN.md: 4 pokes and 4 labels, 100 steps; 20 (direct) or 4 (fist) actions and 5 labels, 2.6 s of 0.1 s steps.
    assert numbers["which_is_heavier", "features"] == (4, 4, 100)
    assert numbers["towers", "direct_features"] == (20, 5, 26)
    assert numbers["towers", "fist_features"] == (4, 5, 26)


def test_doctor_names_versions_renderer_threads_and_gpu():
    done = physexp("doctor", "--json")
    assert done.returncode == 0, done.stderr
    facts = json.loads(done.stdout)
    for name in ("python", "mujoco", "torch", "processors", "gpu", "gl_backend", "gl_renderer"):
        assert facts[name], name


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["train", "which_is_heaviest", "features"], ["which_is_heaviest", "which_is_heavier", "towers"]),
        (["train", "towers", "feet"], ["feet", "fist_features", "direct_features"]),
        (["train", "which_is_heavier", "features", "--difficulty", "0.5"], ["0.5", "difficulty"]),
        (["train", "towers", "fist_features", "--difficulty", "3"], ["difficulty"]),
        (["train", "towers", "fist_features", "--control-timestep", "0.0123"], ["0.0123"]),
        (["evaluate", "no/such/run"], ["no/such/run", "holds no run"]),
        (["train", "which_is_heavier", "features", "--resume", "--run-dir", "no/such/run"], ["holds no run"]),
    ],
)
def test_what_cannot_be_done_is_refused_in_one_line(arguments, words, tmp_path):
    assert_refused(physexp(*arguments, cwd=tmp_path), *words)
    assert not (tmp_path / "runs").exists(), "a refused run leaves no folder"


@pytest.mark.parametrize(("option", "value"), [("--discount", "2"), ("--num-workers", "0"), ("--learning-rate", "nan")])
def test_a_bad_value_of_the_agents_is_refused_without_a_traceback(option, value, tmp_path):
    done = physexp("train", "which_is_heavier", "features", option, value, cwd=tmp_path)
    assert done.returncode == 2
    assert "Traceback" not in done.stderr
    assert value in done.stderr + done.stdout


def test_an_unknown_option_is_refused_by_name(tmp_path):
    done = physexp("train", "towers", "fist_features", "--speed", "3", cwd=tmp_path)
    assert done.returncode == 2 and "--speed" in done.stderr and "Traceback" not in done.stderr


def test_a_folder_that_holds_a_run_is_not_overwritten(untrained):
    before = (untrained.path / "config.json").read_bytes()
    done = physexp("train", "which_is_heavier", "features", "--run-dir", untrained.path)
    assert_refused(done, str(untrained.path), "--resume")
    assert (untrained.path / "config.json").read_bytes() == before


def test_a_run_is_not_resumed_as_another_task(untrained):
    done = physexp("train", "towers", "fist_features", "--run-dir", untrained.path, "--resume")
    assert_refused(done, "which_is_heavier/features")


def test_a_second_trainer_in_the_same_folder_is_refused(untrained):
    with untrained.locked():  # As a trainer does: this process is the first one.
        done = physexp("train", "which_is_heavier", "features", "--run-dir", untrained.path, "--resume")
    assert_refused(done, str(untrained.path), "another process is training")


def test_evaluate_prints_exactly_its_figures_as_json(untrained):
    outputs = []
    for extra in ([], [], ["--interaction", "random"], ["--greedy"]):
        done = physexp("evaluate", untrained.path, "--episodes", 40, "--json", *extra)
        assert done.returncode == 0, done.stderr
        figures = json.loads(done.stdout)
        assert set(figures) == {"episodes", "success_rate", "success_interval", "mean_return", "mean_interactions",
                                "median_interactions", "timeouts"}  # fmt: skip
        assert figures["episodes"] == 40
        low, high = figures["success_interval"]
        assert 0 <= low <= figures["success_rate"] <= high <= 1
        outputs.append(figures)
    assert outputs[0] == outputs[1], "the default seed makes it repeatable"
    assert outputs[0] != outputs[2], "randomized interaction is something else"


def test_evaluate_without_json_prints_the_same_names(untrained):
    lines = physexp("evaluate", untrained.path, "--episodes", 20).stdout.splitlines()
    assert [line.split()[0] for line in lines] == [
        "episodes", "success_rate", "success_interval", "mean_return", "mean_interactions", "median_interactions",
        "timeouts",
    ]  # fmt: skip


@pytest.mark.parametrize("arguments", [["--help"], ["tasks"]])
def test_a_reader_that_has_seen_enough_is_no_error_of_ours(arguments):
    with subprocess.Popen([PHYSEXP, *arguments], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
        process.stdout.close()  # As `head` does.
        process.stdout = None
        _, errors = process.communicate(timeout=60)
    assert errors == "" and process.returncode == 1
