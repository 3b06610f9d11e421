"""Any input gives a result or one readable line, and a refused input changes nothing."""

import contextlib
import io
import json
import sys

import dm_env
import hypothesis
from hypothesis import strategies as st
import numpy as np
import pytest

from physexp import cli, suite
from physexp.analysis.training import config as config_lib
from physexp.analysis.training import run as run_lib
from physexp.cli import parsing, printing

FEATURES = suite.tagged("features")
QUICKLY = hypothesis.settings(
    max_examples=100, deadline=None, suppress_health_check=list(hypothesis.HealthCheck), print_blob=True
)

anything = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=5) | st.binary(max_size=5),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=3), inner, max_size=3),
    max_leaves=5,
)
numbers = st.integers(-(2**70), 2**70) | st.floats() | st.sampled_from([0, 1, -1, 0.1, 0.025, 1e-9, 1e9, 1e308])
names = st.sampled_from(["random", "difficulty", "control_timestep", "time_limit", "visualize_reward", "Random"])
task_kwargs = st.dictionaries(names, anything | numbers, max_size=3)
tasks = st.sampled_from(FEATURES) | st.tuples(anything, anything)


def in_one_line(error: Exception) -> bool:
    """Whether a message is one line that says something, and not a page."""
    return bool(str(error).strip()) and "\n" not in str(error) and len(str(error)) < 500


@QUICKLY
@hypothesis.given(
    tasks, st.just("one") | anything | st.integers(-2, 4), task_kwargs | anything, anything | st.integers(-2, 3)
)
def test_load_and_load_batch_take_anything(task, num_environments, kwargs, num_threads):
    hypothesis.assume(not isinstance(num_environments, int) or num_environments < 1000)
    hypothesis.assume(not isinstance(num_threads, int) or num_threads < 10)
    try:
        if num_environments == "one":
            environment = suite.load(*task, task_kwargs=kwargs)
            assert environment.reset().first() and environment.step(0).step_type in dm_env.StepType
        else:
            environment = suite.load_batch(*task, num_environments, kwargs, num_threads)
            assert environment.reset().first().all()
    except ValueError as error:
        assert in_one_line(error)
        return
    environment.close()


@pytest.fixture(scope="module")
def loaded():
    return suite.load(*FEATURES[0], {"random": 0}), suite.load_batch(*FEATURES[0], 3, {"random": 0})


actions = anything | numbers | st.lists(st.integers(-2, 9), max_size=4) | st.integers(-2, 9)


@QUICKLY
@hypothesis.given(actions)
def test_step_takes_anything_and_a_refused_action_changes_nothing(loaded, action):
    environment, _ = loaded
    environment.task.next_episode = 0
    environment.reset()
    before = environment.physics.get_state().copy()
    try:
        timestep = environment.step(action)
    except ValueError as error:
        assert in_one_line(error)
        np.testing.assert_array_equal(environment.physics.get_state(), before)
        return
    assert 0 <= int(np.asarray(action)) < 8 and timestep.reward in (-1, 0, 1)


@QUICKLY
@hypothesis.given(actions, st.none() | st.lists(st.integers(-1, 4), max_size=4) | anything)
def test_a_batch_steps_with_anything_and_a_refused_action_changes_nothing(loaded, action, environments):
    _, batch = loaded
    batch.reset(episode=0)
    try:
        timestep = batch.step(action, environments)
    except ValueError as error:
        assert in_one_line(error)
        assert (batch.episodes == 0).all()
        return
    assert len(timestep.reward) == (3 if environments is None else len(environments))


CONFIG = config_lib.TrainConfig(
    domain="which_is_heavier", task="features", agent=config_lib.preset("which_is_heavier", "features", algorithm="a3c")
).to_json()


def changed(fields: dict, path: list[str], value) -> dict:
    """A copy in which the entry at a path has another value."""
    if not path:
        return value
    head, *rest = path
    return {**fields, head: changed(fields[head], rest, value)} if head in fields else {**fields, head: value}


IN_TRAIN = [[], ["domain"], ["task_kwargs"], ["difficulty"], ["agent"], ["extra"], ["agent", "extra"]]
IN_TRAIN += [["agent", name] for name in CONFIG["agent"]]
paths = st.sampled_from([["format"], *(["train", *path] for path in IN_TRAIN)])


def _written(path: list[str], value) -> bytes:
    """A config file with another value at a path."""
    try:
        return json.dumps(changed({"format": run_lib.FORMAT, "train": CONFIG}, path, value)).encode()
    except TypeError:  # Bytes: no JSON.
        return repr(value).encode("utf-8", "replace")


@QUICKLY
@hypothesis.given(st.builds(_written, paths, anything) | st.binary())
def test_a_config_file_may_hold_anything(tmp_path_factory, content):
    run = run_lib.Run(tmp_path_factory.mktemp("run"))
    (run.path / "config.json").write_bytes(content)
    try:
        config = run.config
    except ValueError as error:
        assert in_one_line(error)
        return
    assert isinstance(config, config_lib.TrainConfig)


KNOWN = """tasks evaluate ideal replay report train towers which_is_heavier features fist_features --json --help
--episodes --difficulty --discount --seed --resume --agent ppo belief a3c --num-workers --run-dir
--control-timestep --frames"""
words = st.lists(st.sampled_from(KNOWN.split()) | st.text(max_size=6) | numbers.map(str), max_size=5)


@QUICKLY
@hypothesis.given(words)
def test_the_command_line_takes_anything(tmp_path_factory, arguments):
    # Good arguments could start a long run, so they are only parsed.
    folder = tmp_path_factory.mktemp("here")
    out, err = io.StringIO(), io.StringIO()
    with contextlib.chdir(folder), contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        try:
            command = parsing.parse(arguments)
        except SystemExit as exit_:  # Of --help.
            assert exit_.code == 0, (arguments, out.getvalue(), err.getvalue())
            assert err.getvalue() == ""
        except ValueError as refusal:  # Which `main` prints.
            assert len(str(refusal).splitlines()) == 1, (arguments, str(refusal))
        else:
            assert hasattr(command, "run")
    assert not list(folder.iterdir())


NONSENSE = """
train which_is_heavier features --frames 0
train which_is_heavier features --agent a3c --num-workers 1000000
train which_is_heavier features --seed 99999999999999999999
train which_is_heavier features --difficulty nan
train towers fist_features --control-timestep 1e300
evaluate towers/fist_features --episodes 0
replay towers/fist_features --select best
publish nowhere
ideal towers --resolution nan
reproduce everything
reproduce mass_gap --seeds 0
report --results-dir nowhere
bench nothing
""".strip().splitlines()


@pytest.mark.parametrize("line", NONSENSE)
def test_a_bad_command_gives_one_readable_line_and_makes_nothing(line, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(sys, "argv", ["physexp", *line.split()])
    monkeypatch.setattr(printing, "_PATIENCE", 0)  # Refused before any work that is announced.
    with pytest.raises(SystemExit) as exit_:
        cli.main()
    out, err = capsys.readouterr()
    assert exit_.value.code == 2, err
    assert out == "" and err.startswith("physexp: ") and err.count("\n") == 1
    assert len(err) > len("physexp: \n") and "Traceback" not in err and "╭" not in err
    assert not list(tmp_path.iterdir())
