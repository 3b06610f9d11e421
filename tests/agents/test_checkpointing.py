"""Checkpoints are whole or not there, few, and readable without running anything that is in them."""

import json
import math
import struct
import subprocess
import sys
import textwrap

import bits
from dm_env import specs
import numpy as np
import pytest
import torch

from physexp.agents import checkpointing, learning, networks


def tensors(frames):
    return {"frames": torch.tensor(frames), "network/w": torch.arange(6.0).reshape(2, 3) + frames}


def test_a_checkpoint_comes_back_bit_for_bit_with_its_facts(tmp_path):
    checkpointer = checkpointing.Checkpointer(tmp_path / "checkpoints")
    assert checkpointer.latest() is None
    checkpointer.save(tensors(7), {"episodes": 3})
    loaded, facts = checkpointer.latest()
    assert facts == {"episodes": 3}
    assert set(loaded) == {"frames", "network/w"}
    for name, value in tensors(7).items():
        assert torch.equal(loaded[name], value) and loaded[name].dtype == value.dtype


def test_only_the_latest_two_are_kept_and_the_newest_is_read(tmp_path):
    checkpointer = checkpointing.Checkpointer(tmp_path)
    for frames in (5, 90, 100, 2_000):  # As text, 5 and 90 would sort behind 100.
        checkpointer.save(tensors(frames), {"frames": frames})
    assert [int(path.stem) for path in checkpointer.paths()] == [100, 2_000]
    assert sorted(path.suffix for path in tmp_path.iterdir()) == [".json", ".json", ".safetensors", ".safetensors"]
    assert checkpointer.latest()[1] == {"frames": 2_000}


def test_a_checkpoint_is_plain_data_not_a_pickle(tmp_path):
    content = checkpointing.Checkpointer(tmp_path).save(tensors(1), {}).read_bytes()
    # A safetensors file: the header's length (8 bytes, little endian), the header as JSON, then the raw numbers.
    (length,) = struct.unpack("<Q", content[:8])
    header = json.loads(content[8 : 8 + length])
    assert set(header) - {"__metadata__"} == {"frames", "network/w"}
    # One int64 and six float32: 8 + 24 bytes, and nothing else in the file.
    assert len(content) == 8 + length + 8 + 24


def test_a_shared_tensor_that_is_not_contiguous_is_saved_as_it_looks(tmp_path):
    checkpointer = checkpointing.Checkpointer(tmp_path)
    turned = torch.arange(6.0).reshape(2, 3).T
    checkpointer.save({"frames": torch.tensor(1), "turned": turned}, {})
    assert torch.equal(checkpointer.latest()[0]["turned"], turned)


WRITE_TOO_MUCH = """
    import pathlib, resource, sys
    from physexp.agents import files

    path = pathlib.Path(sys.argv[1])
    resource.setrlimit(resource.RLIMIT_FSIZE, (1000, 1000))  # The kernel refuses what goes beyond.
    try:
        files.write_atomically(path, b"new" * 1000)
    except OSError as error:
        print(type(error).__name__, error)
    else:
        print("written")
    files.write_atomically(path.with_name("small"), b"fits")
"""


def test_a_write_that_fails_leaves_the_old_file_and_no_litter(tmp_path):
    path = tmp_path / "file"
    path.write_bytes(b"old")
    script = textwrap.dedent(WRITE_TOO_MUCH)
    done = subprocess.run([sys.executable, "-c", script, path], capture_output=True, text=True, check=True)
    assert done.stdout.startswith("OSError"), done.stdout + done.stderr
    assert path.read_bytes() == b"old"
    assert sorted(item.name for item in tmp_path.iterdir()) == ["file", "small"]
    assert (tmp_path / "small").read_bytes() == b"fits"


WRITE_FOR_EVER = """
    import itertools, pathlib, sys
    from physexp.agents import files

    path = pathlib.Path(sys.argv[1])
    for number in itertools.count():
        files.write_atomically(path, bytes([number % 256]) * 1_000_000)
"""


def test_a_writer_killed_at_any_moment_leaves_a_whole_file(tmp_path):
    path = tmp_path / "file"
    for _ in range(2):
        path.write_bytes(b"\0" * 1_000_000)
        writer = subprocess.Popen([sys.executable, "-c", textwrap.dedent(WRITE_FOR_EVER), path])
        try:
            while path.read_bytes()[:1] == b"\0":  # Until it is at it.
                assert writer.poll() is None
        finally:
            writer.kill()
            writer.wait()
        content = path.read_bytes()
        assert len(content) == 1_000_000 and set(content) == {content[0]}


@pytest.fixture
def small():
    """Variables of a small network that has learned a little, and what it was made of."""
    observations = {"features": specs.Array((3,), np.float32, "features")}
    made = learning.Variables(networks.RecurrentActorCritic(observations, 4, lstm_units=2, observation_scale=1.0), 2)
    made.frames += 10
    made.updates += 2
    made.rounds += 1
    return made


def changed(tensors, name, value):
    return {**tensors, name: value} if value is not None else {key: tensors[key] for key in tensors if key != name}


WEIGHT, ADAM = "network/policy.weight", "optimizer/policy.bias/exp_avg_sq"
CRAFTED = {
    "weights that are no numbers": (WEIGHT, torch.full((4, 2), math.nan), "not finite in network/policy.weight"),
    "infinite weights": (WEIGHT, torch.full((4, 2), math.inf), "not finite in network/policy.weight"),
    "infinite statistics": (ADAM, torch.full((4,), math.inf), "not finite in optimizer"),
    "negative squares": (ADAM, torch.full((4,), -1.0), "negative numbers in optimizer/policy.bias/exp_avg_sq"),
    "half precision": (
        WEIGHT,
        torch.zeros(4, 2).half(),
        r"policy.weight is float16 \[4, 2\] instead of float32 \[4, 2\]",
    ),
    "another shape": (WEIGHT, torch.zeros(2, 4), r"policy.weight is float32 \[2, 4\] instead of float32 \[4, 2\]"),
    "a missing name": (WEIGHT, None, "only one of them has network/policy.weight"),
    "a name too many": ("more\nlines", torch.zeros(1), r"only one of them has 'more\\nlines'"),
    "frames that are no number": ("frames", torch.tensor(math.nan), "frames is float32"),
    "negative updates": ("updates", torch.tensor(-1), "counts -1 updates"),
    "negative rounds": ("rounds", torch.tensor([3, -1]), "counts 2 updates of 10 frames in 2 rounds"),
    "more updates than rounds": ("updates", torch.tensor(3), "counts 3 updates of 10 frames in 2 rounds"),
    "more updates than frames": ("frames", torch.tensor(1), "counts 2 updates of 1 frames"),
}


@pytest.mark.parametrize("case", CRAFTED)
def test_nothing_but_what_was_saved_is_restored(case, small):
    before = small.save()
    name, value, message = CRAFTED[case]
    with pytest.raises(ValueError, match=message) as refused:
        small.restore(changed(before, name, value))
    assert "\n" not in str(refused.value)
    assert all(torch.equal(value, before[name]) for name, value in small.save().items())
    small.restore(before)


def test_a_checkpoint_that_does_not_fit_is_refused_by_its_file_and_not_passed_over(small, tmp_path):
    checkpointer = checkpointing.Checkpointer(tmp_path)
    checkpointer.save(small.save(), {})
    path = checkpointer.save(changed(small.save(), "frames", torch.tensor(11)) | {WEIGHT: torch.zeros(1)}, {})
    with pytest.raises(ValueError, match=f"^{path}: the checkpoint does not fit the configuration"):
        checkpointer.latest(accept=lambda tensors, facts: small.restore(tensors))


def test_every_bit_of_the_facts_counts(small, tmp_path):
    checkpointer = checkpointing.Checkpointer(tmp_path)
    facts = {"task": "towers/fist_features", "episodes": 7, "seconds": 12.5}
    card = checkpointer.save(small.save(), facts).with_suffix(".json")
    content = card.read_bytes()
    for bit in range(8 * len(content)):
        card.write_bytes(bits.flipped(content, bit))
        try:
            assert checkpointer.latest()[1] == facts
        except ValueError as error:
            assert str(tmp_path) in str(error) and "\n" not in str(error)


@pytest.mark.parametrize(
    "content",
    [
        "[" * 100_000,
        '{"format": 1, "sha256": 1, "facts": ' + "9" * 5000 + "}",
        "[]",
        '{"format": 1, "sha256": "", "facts": []}',
        "NaN",
        "",
    ],
)
def test_facts_that_are_none_are_one_line(content, tmp_path):
    checkpointer = checkpointing.Checkpointer(tmp_path)
    checkpointer.save(tensors(3), {}).with_suffix(".json").write_text(content)
    with pytest.raises(ValueError, match="no checkpoint in .* is whole") as refused:
        checkpointer.latest()
    assert "\n" not in str(refused.value) and len(str(refused.value)) < 500


def test_a_checkpoint_under_another_name_is_damaged(tmp_path):
    checkpointer = checkpointing.Checkpointer(tmp_path)
    path = checkpointer.save(tensors(3), {})
    for suffix in (".json", ".safetensors"):
        path.with_suffix(suffix).rename(tmp_path / f"{9:015d}{suffix}")
    with pytest.raises(ValueError, match="its frames are not those in its name"):
        checkpointer.latest()


def test_checkpoints_behind_a_link_are_neither_read_nor_written(tmp_path):
    elsewhere = checkpointing.Checkpointer(tmp_path / "elsewhere")
    for frames in (1, 2):
        elsewhere.save(tensors(frames), {})
    (tmp_path / "checkpoints").symlink_to(tmp_path / "elsewhere")
    checkpointer = checkpointing.Checkpointer(tmp_path / "checkpoints")
    for use in (checkpointer.latest, lambda: checkpointer.save(tensors(3), {})):
        with pytest.raises(ValueError, match="checkpoints is a symbolic link"):
            use()
    assert [int(path.stem) for path in elsewhere.paths()] == [1, 2]


# What is kept of an agent.


def test_an_agent_comes_back_in_half_precision(small, tmp_path):
    weights = small.network.state_dict()
    checkpointing.write_agent(tmp_path / "agent", weights)
    found = checkpointing.read_agent(tmp_path / "agent", weights)
    assert {name: value.dtype for name, value in found.items()} == dict.fromkeys(weights, torch.half)
    assert all(torch.equal(value, weights[name].half()) for name, value in found.items())


@pytest.mark.parametrize(
    "worst", [math.nan, math.inf, 65_520.0]
)  # Half precision ends at 65 504; 65 520 rounds to inf.
def test_weights_that_cannot_be_kept_are_not_written(worst, small, tmp_path):
    small.network.policy.bias.data[1] = worst
    with pytest.raises(ValueError, match=r"not finite in half precision \(policy.bias\)"):
        checkpointing.write_agent(tmp_path / "agent", small.network.state_dict())
    assert not list(tmp_path.iterdir())


def test_every_bit_of_an_agent_counts(tmp_path):
    weights = {"weight": torch.tensor([0.5, -3.0]), "image": torch.tensor([7], dtype=torch.uint8)}
    path = tmp_path / "agent"
    checkpointing.write_agent(path, weights)
    content = path.read_bytes()
    for bit in range(8 * len(content)):
        path.write_bytes(bits.flipped(content, bit))
        try:
            found = checkpointing.read_agent(path, weights)
        except ValueError as error:
            assert str(path) in str(error) and "\n" not in str(error)
        else:
            assert all(torch.equal(value.float(), weights[name].float()) for name, value in found.items())


def safetensors_file(header, body=b""):
    text = header if isinstance(header, bytes) else json.dumps(header).encode()
    return struct.pack("<Q", len(text)) + text + body


def halves(shape, *offsets):
    return {"dtype": "F16", "shape": shape, "data_offsets": offsets}


HOSTILE = {
    "nothing": b"",
    "a header without end": struct.pack("<Q", 2**63) + b"{}",
    "a header of brackets": safetensors_file(b"[" * 100_000),
    "tensors that overlap": safetensors_file({"a": halves([2], 0, 4), "b": halves([2], 2, 6)}, b"\0" * 6),
    "a tensor beyond the end": safetensors_file({"a": halves([2], 0, 2**40)}, b"\0" * 4),
    "a shape without end": safetensors_file({"a": halves([2**32, 2**32], 0, 4)}, b"\0" * 4),
    "a type that is none": safetensors_file({"a": {**halves([2], 0, 4), "dtype": "Q"}}, b"\0" * 4),
    "a type that torch has not": safetensors_file({"a": {**halves([2], 0, 1), "dtype": "F4"}}, b"\0"),
    "one name twice": safetensors_file(
        b'{"a":{"dtype":"U8","shape":[1],"data_offsets":[0,1]},"a":{"dtype":"U8","shape":[1],"data_offsets":[1,2]}}',
        b"\0\0",
    ),
    "metadata that are none": safetensors_file({"__metadata__": {"sha256": 3}}),
    "another network's": safetensors_file({"a\nb": halves([2], 0, 4)}, b"\0" * 4),
}


@pytest.mark.parametrize("case", HOSTILE)
def test_hostile_weights_are_one_line_that_names_the_file(case, small, tmp_path):
    (tmp_path / "agent").write_bytes(HOSTILE[case])
    with pytest.raises(ValueError, match=f"^{tmp_path / 'agent'} .*; put back the agent's own$"):
        checkpointing.read_agent(tmp_path / "agent", small.network.state_dict())


def test_weights_without_end_are_not_read(small, tmp_path):
    with open(tmp_path / "agent", "wb") as file:
        file.truncate(2**40)  # It takes no space on the disk.
    with pytest.raises(ValueError, match="agent is larger than"):
        checkpointing.read_agent(tmp_path / "agent", small.network.state_dict())
