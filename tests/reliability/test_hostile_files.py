"""Files of somebody who means harm are refused in one line, in bounded time and memory."""

import hashlib
import io
import json
import os
import pickle
import shutil
import signal
import struct

import attacks
import commands
import folders
import pyarrow
from pyarrow import parquet
import pytest
import reading
import subjects

from physexp.agents import pretrained
from physexp.analysis.training import run as run_lib

pytestmark = pytest.mark.long

MEMORY = 1 << 30  # Bytes beyond those of the imports.
SECONDS = 60  # Of processor time, for one of them; a few hundredths are needed.


def safetensors(header, data=b"", length=None):
    """A safetensors file with this header, a dict or bytes."""
    content = header if isinstance(header, bytes) else json.dumps(header).encode()
    return struct.pack("<Q", len(content) if length is None else length) + content + data


def tensor(shape, offsets, dtype="F32"):
    return {"dtype": dtype, "shape": shape, "data_offsets": offsets}


def table(columns, **kwargs):
    content = io.BytesIO()
    parquet.write_table(pyarrow.table(columns), content, **kwargs)
    return content.getvalue()


TENSORS = {
    "header of 4 EB": safetensors(b"{}", length=2**62),
    "header as long as the address space": safetensors(b"{}", length=2**64 - 1),
    "overlapping offsets": safetensors({"frames": tensor([2], [0, 8]), "b": tensor([2], [4, 12])}, bytes(12)),
    "offsets backwards": safetensors({"frames": tensor([2], [8, 0])}, bytes(8)),
    "offsets beyond the end": safetensors({"frames": tensor([2**40], [0, 2**42])}, bytes(8)),
    "a shape that overflows": safetensors({"frames": tensor([2**33, 2**33], [0, 8])}, bytes(8)),
    "a shape of no elements": safetensors({"frames": tensor([2**40, 0], [0, 0])}),
    "a negative shape": safetensors({"frames": tensor([-1], [0, 4])}, bytes(4)),
    "an unknown type": safetensors({"frames": tensor([1], [0, 1], "F3")}, bytes(1)),
    "a type that torch lacks": safetensors({"frames": tensor([1], [0, 1], "F8_E8M0")}, bytes(1)),
    "frames of half precision": safetensors({"frames": tensor([], [0, 2], "F16")}, bytes(2)),
    "deep header": safetensors(b"[" * 200_000),
    "deep metadata": safetensors(b'{"__metadata__":' + b'{"a":' * 100_000),
    "many tensors": safetensors({f"{number}": tensor([0], [0, 0]) for number in range(100_000)}),
    "names with line ends": safetensors({"a\nb\x1b[31m": tensor([1], [0, 4])}, bytes(4)),
    "no tensors": safetensors({}),
}

DOCUMENTS = {
    "deep lists": b"[" * 200_000,
    "deep objects": b'{"format":' * 100_000,
    "a number of a million digits": b'{"format": ' + b"9" * 1_000_000 + b"}",
    "NaN": b'{"format": NaN, "facts": NaN, "train": NaN, "sha256": NaN}',
    "Infinity": b'{"format": 1, "facts": {"episodes": Infinity}, "train": Infinity, "sha256": ""}',
    "a list": b"[1, 2, 3]",
    "null": b"null",
    "surrogates": b'"\\ud800"',
    "everything is null": b'{"format": 1, "train": null, "facts": null, "sha256": null, "network": null}',
    "a huge network": pretrained.sealed(
        {
            "format": 1,
            "domain": "which_is_heavier",
            "task": "features",
            "task_kwargs": {"difficulty": 10.0},
            "agent": {},
            "network": {
                "kind": "RecurrentActorCritic",
                "observations": {"a": [[10**9, 10**9], "float64"]},
                "num_actions": 10**12,
                "hyperparameters": {"lstm_units": 10**9, "observation_scale": 1.0},
            },
        }
    ),
}

ROWS = {
    "no header": b"1,2,3\n" * 10,
    "one long line": b"9" * 50_000_000,
    "a million commas": b"," * 1_000_000 + b"\n",
    "NUL bytes": bytes(100_000),
    "numbers that are words": b"frames,updates\nmany,few\n",
    "another encoding": "frames,ä\n1,2\n".encode("utf-16"),
    "open quotes": b'frames,updates\n"1,2\n' * 3,
}

TABLES = {
    "another schema": table({"a": [1, 2, 3]}),
    "columns of another type": table({"seed": ["x"], "episode": [[1.0]], "frames": ["y"], "actions": [0]}),
    "a billion rows in a few bytes": table({"seed": pyarrow.array([0]).take(pyarrow.array([0] * 2_000_000))}),
    "no columns": table({}),
    "a footer of 2 GB": b"PAR1" + bytes(100) + struct.pack("<I", 2**31) + b"PAR1",
    "a footer of 4 GB": b"PAR1" + bytes(100) + struct.pack("<I", 2**32 - 1) + b"PAR1",
    "only the magic": b"PAR1PAR1",
}

ANYTHING = {
    "empty": b"",
    "one byte": b"{",
    "noise": bytes(range(256)) * 20,
    "pickle": pickle.dumps(print),
}


# What is put in the place of a file, by something that makes it.


def _folder(path):
    path.mkdir()


def _pipe(path):
    os.mkfifo(path)


def _link(target):
    return lambda path: path.symlink_to(target)


def _sparse(path):
    with open(path, "wb") as file:
        file.truncate(1 << 30)


PLACES = {
    "a folder": _folder,
    "a pipe": _pipe,
    "a link to /dev/zero": _link("/dev/zero"),
    "a link to /dev/null": _link("/dev/null"),
    "a link to nowhere": _link("nowhere"),
    "a link to itself": lambda path: path.symlink_to(path.name),
    "a link to /proc/self/mem": _link("/proc/self/mem"),
    "a gigabyte of zeros": _sparse,
}

CONTENTS = {
    "config.json": DOCUMENTS,
    "metrics.csv": ROWS,
    "checkpoint, tensors": TENSORS,
    "checkpoint, JSON": DOCUMENTS,
    "agent.safetensors": TENSORS,
    "published weights": TENSORS,
    "published card": DOCUMENTS,
    "records": TABLES,
}
NO_ROWS = ("empty", "one byte", "one long line", "NUL bytes", "pickle", "truncated")
ACCEPTED = {("metrics.csv", kind) for kind in NO_ROWS}
"""What ends no line reads as no rows, and a row that is torn as none."""


def put(name, kind, folder):
    """Puts something hostile in the place of a file, with its checksum where that is kept beside; returns the path."""
    path = reading.FILES[name].find(folder)
    content = path.read_bytes()
    path.unlink()
    if kind in PLACES:
        PLACES[kind](path)
        return path
    content = content[:-100] if kind == "truncated" else {**CONTENTS[name], **ANYTHING}[kind]
    path.write_bytes(content)
    beside = path.with_suffix(".json")
    if name in ("checkpoint, tensors", "published weights"):
        card = json.loads(beside.read_text()) | {"sha256": hashlib.sha256(content).hexdigest()}
        beside.write_bytes(pretrained.sealed(card) if "card_sha256" in card else json.dumps(card).encode())
    return path


def read(name, kinds, made, scratch):
    """Reads hostile files of these kinds, one after the other; prints what came of each."""
    for kind in kinds:
        folder = scratch / str(len(list(scratch.iterdir())))
        shutil.copytree(made, folder)
        path = put(name, kind, folder)
        print(f"{kind}: ", end="", flush=True)
        signal.setitimer(signal.ITIMER_PROF, SECONDS)
        print(reading.outcome(reading.FILES[name], path, folder, None), flush=True)


@pytest.mark.parametrize("name", CONTENTS)
def test_a_hostile_file_is_refused_in_one_line(name, made, tmp_path):
    kinds = some_of([*CONTENTS[name], *ANYTHING, "truncated", *PLACES], share=5)
    bad = []
    with attacks.Tally(f"hostile, {name}") as tally:
        while kinds:  # In one child, or what remains of them in another when one has ended it.
            end = attacks.run(read, name, kinds, made, tmp_path, first=attacks.Memory(MEMORY))
            assert f"{kinds[0]}: " in end.said, end.said[-700:]
            for kind in list(kinds):
                if f"{kind}: " not in end.said:
                    break
                kinds.remove(kind)
                outcomes = ("refused", "another value") if (name, kind) in ACCEPTED else ("refused",)
                fine = any(f"{kind}: {outcome}\n" in end.said for outcome in outcomes)
                tally["as it should be" if fine else "BAD"] += 1
                bad += [] if fine else [f"{kind} ({end.code}): {end.said.partition(f'{kind}: ')[2][-700:]}"]
    assert not bad, "\n".join(bad)


@pytest.mark.parametrize("name", [name for name in CONTENTS if name.startswith(("config", "metrics", "checkpoint"))])
def test_training_does_not_go_on_from_a_hostile_file_and_changes_nothing(name, made, tmp_path):
    """Where the newest checkpoint is damaged, the one before it is used."""
    bad = []
    with attacks.Tally(f"hostile, {name}, --resume") as tally:
        for kind in some_of([*CONTENTS[name], *ANYTHING, "truncated", *PLACES], default=1, share=0.05):
            folder = tmp_path / "made"
            shutil.copytree(made, folder)
            put(name, kind, folder)
            run = run_lib.Run(folder / "run")
            before = folders.contents(run.path)
            end = attacks.run(commands.physexp, *subjects.words(run), first=attacks.Memory(MEMORY))
            try:
                if end.code or not (name.startswith("checkpoint") or (name, kind) in ACCEPTED):
                    end.assert_refused()
                    assert folders.contents(run.path) == before, "something has changed"
                tally["refused" if end.code else "went on"] += 1
            except AssertionError as error:
                bad.append(f"{kind}: {str(error)[-700:]}")
                tally["BAD"] += 1
            shutil.rmtree(folder)
    assert not bad, "\n".join(bad)


def some_of(kinds, default=3, share=1.0):
    """Some of them at random; all of them where many attacks are asked for."""
    return attacks.generator().sample(kinds, min(len(kinds), attacks.repetitions(default, share)))
