"""Tables come back as they were written; those of strangers are refused before they take much memory."""

import io
import os
import random

import bits
import pandas as pd
import pyarrow
from pyarrow import parquet
import pytest

from physexp.analysis.data import tables
from physexp.analysis.training import run as run_lib

SCHEMA = run_lib.EPISODES
TABLE = pyarrow.table(
    {
        "frames": [5, 5, 9],
        "seed": [1, 2, 3],
        "episode": [0, 0, 1],
        "answer": [1, 2, 3],
        "label": [1, -1, 3],
        "reward": [1.0, -1.0, 1.0],
        "length": [3, 2, 1],
        "actions": [[0, 1, 5], [2, 3], [4]],
    },
    SCHEMA,
)


def test_a_table_comes_back_and_other_readers_read_it_too(tmp_path):
    path = tmp_path / "part-1.parquet"
    tables.write(path, TABLE, compression="zstd")
    assert tables.read(path, SCHEMA).equals(TABLE)
    pd.testing.assert_frame_equal(pd.read_parquet(path), TABLE.to_pandas())
    with pytest.raises(FileNotFoundError, match="nothing"):
        tables.read(tmp_path / "nothing", SCHEMA)


def content(table, **options):
    sink = io.BytesIO()
    parquet.write_table(table, sink, **options)
    return sink.getvalue()


TEXT = pyarrow.schema([("text", pyarrow.string())])
MANY, LARGE = 100_000, 2**24
FAULTY = {
    "nothing": b"",
    "noise": random.Random(0).randbytes(1000),
    "half a file": content(TABLE)[:1000],
    "a description without end": content(TABLE)[:-8] + b"\xff\xff\xff\x7fPAR1",
    "other columns": content(TABLE.rename_columns([*TABLE.column_names[:-1], "a\nb"])),
    "other types": content(TABLE.set_column(0, "frames", pyarrow.array(["x"] * 3))),
}
BOMBS = {
    "many rows": (content(pyarrow.table({"a": pyarrow.nulls(MANY)})), "more than any table of ours"),
    "many zeros": (
        content(pyarrow.table({"a": pyarrow.array([b"\0" * LARGE])}), compression="zstd", use_dictionary=False),
        "more than any table of ours",
    ),
    "a list of many": (
        content(TABLE.set_column(7, "actions", [[[0] * MANY, [], []]])),
        "more than any table of ours",
    ),
    "long text": (content(pyarrow.table({"text": ["a" * 1000] * (MANY // 2)})), "more text than any table of ours"),
}


@pytest.mark.parametrize("case", FAULTY)
def test_a_faulty_table_is_refused_in_one_line(case, tmp_path):
    (tmp_path / "table").write_bytes(FAULTY[case])
    with pytest.raises(ValueError, match=f"^{tmp_path / 'table'} is damaged .*; put back what was written") as refused:
        tables.read(tmp_path / "table", SCHEMA)
    assert "\n" not in str(refused.value)


def test_a_table_is_read_or_refused_if_a_bit_of_its_footer_is_flipped(tmp_path):
    path, schema = tmp_path / "table", pyarrow.schema([("actions", pyarrow.list_(pyarrow.int32()))])
    tables.write(path, pyarrow.table([[[1], [2, 3]]], schema=schema))
    written = path.read_bytes()
    footer = int.from_bytes(written[-8:-4], "little")  # Its length stands before the last four bytes.
    num_refused = 0
    for bit in range(8 * (len(written) - 8 - footer), 8 * (len(written) - 8)):
        path.write_bytes(bits.flipped(written, bit))
        try:
            assert tables.read(path, schema).schema == schema
        except ValueError as error:
            num_refused += str(error).startswith(f"{path} is damaged")
    assert num_refused > footer  # An eighth of the bits, at least.


@pytest.mark.parametrize("case", BOMBS)
def test_a_small_file_that_unpacks_to_much_is_refused(case, tmp_path, monkeypatch):
    monkeypatch.setattr(tables, "_MAX_VALUES", MANY - 1)
    monkeypatch.setattr(tables, "_MAX_STRINGS", LARGE - 1)
    monkeypatch.setattr(tables, "_MAX_UNPACKED", LARGE - 1)
    bomb, message = BOMBS[case]
    assert len(bomb) < 10_000
    (tmp_path / "table").write_bytes(bomb)
    with pytest.raises(ValueError, match=message):
        tables.read(tmp_path / "table", TEXT if case == "long text" else SCHEMA)


def test_a_strangers_file_is_a_regular_one_of_limited_size(tmp_path):
    os.mkfifo(tmp_path / "pipe")
    with pytest.raises(ValueError, match="pipe is no regular file; put one in its place"):
        tables.check(tmp_path / "pipe", 100)
    with (tmp_path / "huge").open("wb") as file:
        file.truncate(2**40)  # It takes no room on the disk.
    with pytest.raises(ValueError, match="huge has 1,099,512 MB; give a file of at most 1 MB"):
        tables.check(tmp_path / "huge", 10**6)
