"""Checkpoints are whole or not there, few, and readable without running anything that is in them."""

import json
import struct
import subprocess
import sys
import textwrap

import torch

from physexp.agents import checkpointing


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
    from physexp.agents import checkpointing

    path = pathlib.Path(sys.argv[1])
    resource.setrlimit(resource.RLIMIT_FSIZE, (1000, 1000))  # The kernel refuses what goes beyond.
    try:
        checkpointing.write_atomically(path, b"new" * 1000)
    except OSError as error:
        print(type(error).__name__, error)
    else:
        print("written")
    checkpointing.write_atomically(path.with_name("small"), b"fits")
"""


def test_a_write_that_fails_leaves_the_old_file_and_no_litter(tmp_path):
    path = tmp_path / "file"
    path.write_bytes(b"old")
    script = textwrap.dedent(WRITE_TOO_MUCH)
    done = subprocess.run([sys.executable, "-c", script, path], capture_output=True, text=True, check=True, timeout=60)
    assert done.stdout.startswith("OSError"), done.stdout + done.stderr
    assert path.read_bytes() == b"old"
    assert sorted(item.name for item in tmp_path.iterdir()) == ["file", "small"]
    assert (tmp_path / "small").read_bytes() == b"fits"


WRITE_FOR_EVER = """
    import itertools, pathlib, sys
    from physexp.agents import checkpointing

    path = pathlib.Path(sys.argv[1])
    for number in itertools.count():
        checkpointing.write_atomically(path, bytes([number % 256]) * 1_000_000)
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
