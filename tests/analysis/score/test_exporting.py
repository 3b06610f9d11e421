"""Exported trajectories are whole, and equal to the play, in tables and in data sets of Minari alike."""

import contextlib
from pathlib import Path
import sys

import commands
import minari
import numpy as np
from pyarrow import parquet
import pytest

from physexp import suite
from physexp.analysis.data import tables
from physexp.analysis.score import exporting, log, protocol, steps, targets

pytestmark = pytest.mark.usefixtures("here")

THRESHOLD = protocol.named(["threshold/features"])
BOTH = protocol.named(["threshold/features", "strings/features"])
ALL = (*BOTH, *protocol.named(["threshold/pixels"]))


def export(target, questions=THRESHOLD, count=4, folder="exported", **options):
    return exporting.export(targets.find(target), questions, count, Path(folder), **options)


def table_of(asked, folder="exported"):
    return parquet.read_table(Path(folder) / asked.file_name / exporting.TABLE)


def columns_of(asked, folder="exported"):
    table = table_of(asked, folder)
    return {name: np.array(table[name].to_pylist()) for name in table.column_names}


def test_each_row_is_what_the_environment_returns_for_the_action():
    export("random", ALL, count=3)
    for asked in ALL:
        episodes = list(log.split(columns_of(asked)))
        assert len(episodes) == 3
        for number, played in enumerate(episodes):
            assert set(played["episode"]) == {number}
            environment = suite.load(asked.domain, asked.task, {"random": int(played["seed"][0])})
            environment.task.next_episode = number
            timestep = environment.reset()
            for step, action in enumerate(played["action"]):
                for name, seen in timestep.observation.items():
                    np.testing.assert_array_equal(played[f"observation_{name}"][step], seen.ravel())
                timestep = environment.step(int(action))
                for name, seen in timestep.observation.items():
                    np.testing.assert_array_equal(played[f"next_observation_{name}"][step], seen.ravel())
                assert played["step"][step] == step and played["reward"][step] == timestep.reward
                assert played["terminated"][step] == timestep.last() and not played["truncated"][step]
                assert played["answer"][step] == environment.task.correct_answer
                np.testing.assert_array_equal(played["hidden"][step], environment.task.hidden)
            assert timestep.last()


@pytest.mark.parametrize("asked", BOTH, ids=lambda asked: asked.name)
def test_the_actions_of_the_ideal_have_the_highest_values(asked):
    export("ideal", [asked])
    columns = columns_of(asked)
    actions, values = columns["action"], columns["values"]
    np.testing.assert_allclose(values[np.arange(len(actions)), actions], values.max(axis=1), atol=1e-9)
    assert values.max(axis=1)[0] == protocol.ideal(asked).value
    # An answer is worth +1 where it is right and -1 where it is not.
    np.testing.assert_allclose(values[:, asked.num_interactions :], 2 * columns["belief"] - 1, atol=1e-12)
    within = ~columns["terminated"][:-1]
    np.testing.assert_array_equal(columns["next_belief"][:-1][within], columns["belief"][1:][within])
    right = columns["answer"][columns["terminated"]]
    last = columns["next_belief"][columns["terminated"]]
    assert (last[np.arange(len(right)), right] > 0).all(), "what is right is never impossible"


def test_a_data_set_of_minari_equals_the_table(monkeypatch):
    written = export("random", ALL, count=3, as_minari=True)
    assert all(task["judged"] for task in written["tasks"].values())
    monkeypatch.setenv("MINARI_DATASETS_PATH", str(Path("exported/minari").resolve()))
    names = [f"physexp/{asked.file_name}/random-v0" for asked in ALL]
    assert sorted(minari.list_local_datasets()) == sorted(names)
    for asked, name in zip(ALL, names, strict=True):
        data_set, table = minari.load_dataset(name), columns_of(asked)
        assert data_set.total_steps == len(table["step"]) and data_set.total_episodes == 3
        facts = data_set.storage.get_episode_metadata(range(3))
        for loaded, played, fact in zip(data_set, log.split(table), facts, strict=True):
            for seen, spec in asked.observation_spec.items():
                array = loaded.observations[seen]
                assert array.dtype == spec.dtype and array.shape == (len(loaded) + 1, *spec.shape)
                flat = array.reshape(len(array), -1)
                np.testing.assert_array_equal(flat[:-1], played[f"observation_{seen}"])
                np.testing.assert_array_equal(flat[1:], played[f"next_observation_{seen}"])
            np.testing.assert_array_equal(loaded.actions, played["action"])
            np.testing.assert_array_equal(loaded.rewards, played["reward"])
            np.testing.assert_array_equal(loaded.terminations, played["terminated"])
            np.testing.assert_array_equal(loaded.truncations, played["truncated"])
            np.testing.assert_array_equal(loaded.infos["belief"][:-1], played["belief"])
            np.testing.assert_array_equal(loaded.infos["belief"][1:], played["next_belief"])
            np.testing.assert_array_equal(loaded.infos["values"][:-1], played["values"])
            assert fact["answers"] == played["answer"][0]
            np.testing.assert_array_equal(fact["hidden"], played["hidden"][0])


def test_the_seed_and_options_of_minari_s_episodes_rebuild_them():
    export("random", as_minari=True)
    data_set = minari.MinariDataset("exported/minari/physexp/threshold-features/random-v0/data")
    environment = data_set.recover_environment()
    assert environment.observation_space == data_set.observation_space
    assert environment.action_space == data_set.action_space
    for loaded, told in zip(data_set, data_set.storage.get_episode_metadata(range(4)), strict=True):
        seen = [environment.reset(seed=told["seed"], options=told["options"])[0]]
        seen += [environment.step(action)[0] for action in loaded.actions]
        assert environment.unwrapped.dm_env.task.correct_answer == told["answers"]
        for name, values in loaded.observations.items():
            np.testing.assert_array_equal(values, [observation[name] for observation in seen])
    environment.close()


def test_parts_have_whole_episodes_and_equal_a_single_part(monkeypatch):
    export("random", count=12, folder="at_once", as_minari=True)
    monkeypatch.setattr(exporting, "_ROWS", 8)
    export("random", count=12, folder="in_parts", as_minari=True)
    (asked,) = THRESHOLD
    parts = sorted((Path("in_parts") / "threshold-features" / exporting.TABLE).iterdir())
    assert len(parts) > 1
    schema = steps.schema(asked)
    for part in parts:
        table = tables.read(part, schema)
        assert table["step"][0].as_py() == 0 and table["terminated"][-1].as_py()
    assert table_of(asked, "in_parts").equals(table_of(asked, "at_once"))
    once, in_parts = (
        minari.MinariDataset(Path(folder) / "minari/physexp/threshold-features/random-v0/data")
        for folder in ("at_once", "in_parts")
    )
    assert len(once) == len(in_parts) == 12
    for one, other in zip(once, in_parts, strict=True):
        np.testing.assert_array_equal(one.actions, other.actions)


def test_exported_instances_are_never_those_of_the_score():
    (asked,) = BOTH[1:]
    export("silent", [asked], count=20)
    exported = columns_of(asked)
    hidden, scored = exported["hidden"][exported["step"] == 0], protocol.drawn(asked, 20)
    tied = hidden[hidden.any(axis=1)]  # Instances without bands are alike.
    assert len(tied) and not np.isclose(tied[:, None], scored).all(axis=-1).any()
    export("silent", [asked], count=20, folder="other", seed=7)
    other = columns_of(asked, "other")["hidden"]
    assert not (other[:, None] == hidden[hidden.any(axis=1)]).all(axis=-1).any()
    with pytest.raises(ValueError, match=f"seed is {protocol.SEED}, whose episodes are scored; give another one"):
        export("silent", folder="third", seed=protocol.SEED)
    assert not Path("third").exists()


def test_without_an_ideal_the_table_has_no_beliefs():
    (noisy,) = protocol.named(["which_is_heavier/features,noise=0.001"])
    assert not export("random", [noisy], as_minari=True)["tasks"][noisy.name]["judged"]
    names = table_of(noisy).column_names
    assert names[-2:] == ["hidden", "answer"] and "belief" not in names
    data_set = minari.MinariDataset(f"exported/minari/physexp/{noisy.file_name}/random-v0/data")
    assert len(data_set) == 4
    with contextlib.closing(data_set.recover_environment()) as environment:
        assert environment.unwrapped.dm_env.task.options.noise == 0.001


def test_an_export_writes_the_files_of_a_failed_one_anew(monkeypatch):
    """A disk that is full when the second part is written."""
    monkeypatch.setattr(exporting, "_ROWS", 8)  # Episodes of four steps: two make a part.
    write, fails = tables.write, [False, True]

    def write_or_fail(*args, **kwargs):
        if fails and fails.pop(0):
            raise OSError("no space left")
        write(*args, **kwargs)

    monkeypatch.setattr(tables, "write", write_or_fail)
    with pytest.raises(OSError, match="no space left"):
        export("halving:policy", count=9, as_minari=True)
    assert export("halving:policy", count=9, as_minari=True)["complete"]
    export("halving:policy", count=9, folder="whole")
    assert table_of(*THRESHOLD).equals(table_of(*THRESHOLD, "whole"))
    assert len(minari.MinariDataset("exported/minari/physexp/threshold-features/halving_policy-v0/data")) == 9


def test_the_command_exports(here):
    words = ["export", "halving:policy", "--tasks", "threshold/features", "--episodes", "3", "--minari"]
    done = commands.run(*words, cwd=here)
    assert done.returncode == 0, done.stderr
    head, line, folder = done.stdout.splitlines()
    # Three pushes find one of eight levels, and then comes the answer.
    assert head.split() == ["task", "episodes", "steps", "right", "return"]
    assert line.split() == ["threshold/features", "3", "12", "1.0000", f"{0.95**3:.4f}"]
    assert folder == "exports/halving_policy" and (here / folder / "minari").is_dir()


def test_without_minari_the_extra_is_named_before_anything_is_played(monkeypatch):
    from physexp import extras
    from physexp.cli import parsing

    monkeypatch.setitem(sys.modules, "minari", None)  # Cannot be imported, nor found.
    with pytest.raises(extras.MissingExtraError, match=r"minari is not installed; pip install 'physexp\[minari\]'"):
        parsing.parse(["export", "halving:policy", "--episodes", "1", "--minari"]).run()
    assert not Path("exports").exists()
