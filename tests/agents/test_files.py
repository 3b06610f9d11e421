"""Files are replaced as a whole, and files of tensors come back to the bit or are refused."""

import math
import random
import struct
import subprocess
import sys

import bits
import pytest
from seeds import fresh_seed
import torch

from physexp.agents import core, files, tensors

TENSORS = {"frames": torch.tensor(7), "turned": torch.arange(6.0).reshape(2, 3).T, "image": torch.ones(2).byte()}
FACTS = {"task": "towers/fist_features", "seconds": 12.5}


WRITE_TOO_MUCH = """
import pathlib, resource, sys
from physexp.agents import files

path = pathlib.Path(sys.argv[1])
resource.setrlimit(resource.RLIMIT_FSIZE, (1000, 1000))  # The kernel refuses all bytes beyond.
try:
    files.write_atomically(path, b"new" * 1000)
except OSError as error:
    print(type(error).__name__, error.filename)
files.write_atomically(path.with_name("small"), b"fits")
"""


def test_a_failed_write_leaves_the_old_file_and_nothing_else(tmp_path):
    path = tmp_path / "file"
    path.write_bytes(b"old")
    command = [sys.executable, "-c", WRITE_TOO_MUCH, path]
    assert subprocess.run(command, capture_output=True, text=True, check=True).stdout == f"OSError {path}\n"
    assert path.read_bytes() == b"old" and (tmp_path / "small").read_bytes() == b"fits"
    assert sorted(item.name for item in tmp_path.iterdir()) == ["file", "small"]


# Tensors with facts.


def test_tensors_and_facts_come_back_bit_for_bit(tmp_path):
    tensors.write(tmp_path / "file", TENSORS, FACTS)
    found, facts = tensors.read(tmp_path / "file")
    assert facts == tensors.read_facts(tmp_path / "file") == FACTS
    assert set(found) == set(TENSORS)
    for name, value in TENSORS.items():
        assert torch.equal(found[name], value) and found[name].dtype == value.dtype


def test_every_bit_of_a_file_of_tensors_counts(tmp_path):
    path = tmp_path / "file"
    tensors.write(path, TENSORS, FACTS)
    content = path.read_bytes()
    for bit in random.Random(fresh_seed()).sample(range(8 * len(content)), 1000):
        path.write_bytes(bits.flipped(content, bit))
        try:
            found, facts = tensors.read(path)
        except core.DamagedError as error:
            assert str(path) in str(error) and "\n" not in str(error)
        else:
            assert facts == FACTS and all(torch.equal(found[name], TENSORS[name]) for name in TENSORS)


@pytest.mark.parametrize("content", [b"", b"{", bytes(range(256)) * 20, struct.pack("<Q", 2**63) + b"{}"])
def test_other_content_is_refused_in_one_line(content, tmp_path):
    (tmp_path / "file").write_bytes(content)
    for read in (tensors.read, tensors.read_facts):
        with pytest.raises(core.DamagedError, match=f"^{tmp_path / 'file'} is damaged: .*; put back what was written$"):
            read(tmp_path / "file")


@pytest.mark.parametrize("worst", [math.nan, math.inf, 65_520.0])  # Half precision ends at 65,504.
def test_weights_beyond_half_precision_are_refused(worst):
    assert tensors.halved(TENSORS)["turned"].dtype == torch.half
    with pytest.raises(ValueError, match=r"not finite in half precision \(bias\)"):
        tensors.halved({"bias": torch.tensor([0.0, worst])})


def test_json_that_is_none_is_refused_in_one_line(tmp_path):
    for content in ("", "[" * 100_000, "{'a': 1}"):
        (tmp_path / "file").write_text(content)
        with pytest.raises(ValueError, match=f"^{tmp_path / 'file'} is no JSON: .*; put back what was written$"):
            files.read_json(tmp_path / "file")
