"""Files that are damaged, or come from somebody who means harm, are harmless or refused in one line."""

import functools
import io
import json
import os
import pickle
import shutil
import signal
import struct

import attacks
import bits
import pyarrow
from pyarrow import parquet
import pytest
import reading

pytestmark = pytest.mark.long

MEMORY = 2 << 30  # Bytes beyond those of the imports.
SECONDS = 60  # Of processor time, for one of them; a few hundredths are needed.


def table(columns, **kwargs):
    content = io.BytesIO()
    parquet.write_table(pyarrow.table(columns), content, **kwargs)
    return content.getvalue()


def safetensors(header, data=b"", length=None):
    """Returns a safetensors file with this header, a dict or bytes."""
    content = header if isinstance(header, bytes) else json.dumps(header).encode()
    return struct.pack("<Q", len(content) if length is None else length) + content + data


def tensor(shape, offsets, dtype="F32"):
    return {"frames": {"dtype": dtype, "shape": shape, "data_offsets": offsets}}


HOSTILE = {
    "nothing": b"",
    "one byte": b"{",
    "noise": bytes(range(256)) * 20,
    "a pickle": pickle.dumps(print),
    "deep lists": b"[" * 200_000,
    "deep objects": b'{"format":' * 100_000,
    "a number of a million digits": b'{"format": ' + b"9" * 1_000_000 + b"}",
    "null": b"null",
    "a list": b"[1, 2, 3]",
    "nulls": b'{"format": 1, "version": "v1", "train": null, "agent": null}',
    "a header of 4 EB": safetensors(b"{}", length=2**62),
    "a shape that overflows": safetensors(tensor([2**33, 2**33], [0, 8]), bytes(8)),
    "offsets beyond the end": safetensors(tensor([2**40], [0, 2**42]), bytes(8)),
    "a type that torch lacks": safetensors(tensor([1], [0, 1], "F8_E8M0"), bytes(1)),
    "deep metadata": safetensors(b'{"__metadata__":' + b'{"a":' * 100_000),
    "no tensors": safetensors({}),
    "another schema": table({"a": [1, 2, 3]}),
    "millions of rows in a few bytes": table({"step": pyarrow.array([0]).take(pyarrow.array([0] * 2_000_000))}),
    "a footer of 4 GB": b"PAR1" + bytes(100) + struct.pack("<I", 2**32 - 1) + b"PAR1",
    "one long line": b"9" * 20_000_000,
}


def damaged(content, generator, num_flips):
    """Yields the content with a flipped bit or without its end, and hostile contents."""
    for bit in generator.sample(range(8 * len(content)), min(num_flips, 8 * len(content))):
        yield f"bit {bit}", bits.flipped(content, bit)
    for length in (len(content) - 1, len(content) // 2):
        yield f"{length} bytes", content[:length]
    yield from HOSTILE.items()


def read_damaged(name, made, folder, seed, num_flips):
    """Reads damaged files one after the other; leaves the outcome of each as JSON."""
    shutil.copytree(made, folder)
    file, outcomes = reading.FILES[name], []
    path = file.find(folder)
    content, expected = path.read_bytes(), file.read(folder)
    for kind, other in damaged(content, attacks.random.Random(seed), num_flips):
        print(kind, flush=True)
        path.write_bytes(other)
        signal.setitimer(signal.ITIMER_PROF, SECONDS)
        try:
            outcomes.append((kind, file.outcome(folder, expected)))
        except Exception as error:  # Of any kind: it is reported, and the others are tried.
            outcomes.append((kind, f"{type(error).__name__}: {error}"))
    (folder / "outcomes").write_text(json.dumps(outcomes))


@pytest.mark.parametrize("name", reading.FILES)
def test_a_damaged_file_is_harmless_or_refused_in_one_line(name, made, tmp_path):
    seed, folder = attacks.generator().getrandbits(32), tmp_path / "made"
    arguments = (name, made, folder, seed, attacks.repetitions(25, share=5))
    end = attacks.run(read_damaged, *arguments, first=functools.partial(attacks.limit_memory, MEMORY))
    assert end.code == 0, end.said[-2000:]
    harmless = {"the same", "refused"} | (set() if reading.FILES[name].has_checksum else {"another value"})
    with attacks.Tally(f"damaged, {name}") as tally:
        bad = [(kind, outcome[:300]) for kind, outcome in json.loads((folder / "outcomes").read_text())]
        tally.update(outcome if outcome in harmless else "BAD" for _, outcome in bad)
    bad = [(kind, outcome) for kind, outcome in bad if outcome not in harmless]
    assert not bad, "\n".join(f"{kind}: {outcome}" for kind, outcome in bad)


@pytest.mark.parametrize("name", ["published agent", "log of a score", "score"])
def test_a_pipe_or_a_huge_file_of_a_stranger_is_refused_at_once(name, made, tmp_path):
    folder = tmp_path / "made"
    shutil.copytree(made, folder)
    file = reading.FILES[name]
    path = file.find(folder)
    with path.open("wb") as huge:
        huge.truncate(2**40)  # It takes no room on the disk.
    assert file.outcome(folder, None) == "refused"
    path.unlink()
    os.mkfifo(path)
    with pytest.raises(ValueError):
        file.read(folder)
