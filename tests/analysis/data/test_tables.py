"""Tables are read as they were written, or refused in one line that names the file."""

import io
import os
from pathlib import Path
import random

import bits
import pandas as pd
import pyarrow
from pyarrow import parquet
import pytest
from seeds import fresh_seed

from physexp.analysis.data import tables
from physexp.analysis.experiments import base, ideal_towers
from physexp.analysis.training import records
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
STORED = Path(__file__).parents[3] / "results" / "episodes" / "learned"


def as_before(table=TABLE, **options):
    """A file as they were before they had checksums, and as others write them."""
    content = io.BytesIO()
    parquet.write_table(table, content, **options)
    return content.getvalue()


def test_a_table_comes_back_and_other_readers_read_it_too(tmp_path):
    path = tmp_path / "part-1.parquet"
    tables.write(path, TABLE, compression="zstd")
    assert tables.read(path, SCHEMA).equals(TABLE)
    assert tables.read(path, SCHEMA, ["reward", "frames"]).equals(TABLE.select(["reward", "frames"]))
    assert parquet.read_table(path, page_checksum_verification=True).equals(TABLE)
    pd.testing.assert_frame_equal(pd.read_parquet(path), TABLE.to_pandas())


def test_a_file_with_narrower_integers_is_read(tmp_path):
    narrow = {"answer": pyarrow.int8(), "length": pyarrow.int16(), "actions": pyarrow.list_(pyarrow.int8())}
    fields = [field.with_type(narrow.get(field.name, field.type)) for field in SCHEMA]
    tables.write(tmp_path / "old", TABLE.cast(pyarrow.schema(fields)))
    assert tables.read(tmp_path / "old", SCHEMA).equals(TABLE)
    tables.write(tmp_path / "other", TABLE.set_column(3, "answer", [[1.0, 2.0, 3.0]]))
    with pytest.raises(ValueError, match="answer is double instead of int32"):
        tables.read(tmp_path / "other", SCHEMA)


def test_a_file_without_a_checksum_is_read(tmp_path):
    (tmp_path / "old").write_bytes(as_before())
    assert tables.read(tmp_path / "old", SCHEMA).equals(TABLE)


def test_any_bit_of_a_table_counts(tmp_path):
    path, generator = tmp_path / "table", random.Random(fresh_seed())
    tables.write(path, TABLE, compression="zstd")
    content = path.read_bytes()
    for bit in generator.sample(range(8 * len(content)), 1500):
        path.write_bytes(bits.flipped(content, bit))
        try:
            assert tables.read(path, SCHEMA).equals(TABLE)
        except ValueError as error:
            assert str(path) in str(error) and "\n" not in str(error)


TEXT = pyarrow.schema([("text", pyarrow.string())])
MANY, LARGE = 100_000, 2**24
OLD = as_before()
HOSTILE = {
    "nothing": (b"", "is damaged"),
    "noise": (random.Random(0).randbytes(1000), "is damaged"),
    "half a file": (OLD[: len(OLD) // 2], "is damaged"),
    "a description without end": (OLD[:-8] + b"\xff\xff\xff\x7fPAR1", "is damaged"),
    "other columns": (as_before(TABLE.rename_columns([*TABLE.column_names[:-1], "a\nb"])), "its columns are frames"),
    "other types": (as_before(TABLE.set_column(0, "frames", pyarrow.array(["5"] * 3))), "frames is string instead"),
    "many rows": (as_before(pyarrow.table({"a": pyarrow.nulls(MANY)})), f"it has {MANY:,} rows, more than any table"),
    "many zeros": (
        as_before(pyarrow.table({"a": pyarrow.array([b"\0" * LARGE])}), compression="zstd", use_dictionary=False),
        "it says that it unpacks to more",
    ),
    "a list of many": (as_before(TABLE.set_column(7, "actions", [[[0] * MANY, [], []]])), "it has 3 rows, more than"),
    "long text": (as_before(pyarrow.table({"text": ["a" * 1000] * (MANY // 2)})), "it has more text than"),
}


@pytest.mark.parametrize("case", HOSTILE)
def test_what_is_no_table_of_ours_is_one_line(case, tmp_path, monkeypatch):
    monkeypatch.setattr(tables, "_MOST_VALUES", MANY - 1)
    monkeypatch.setattr(tables, "_MOST_TEXT", LARGE - 1)
    monkeypatch.setattr(tables, "_MOST_UNPACKED", LARGE - 1)
    content, message = HOSTILE[case]
    assert len(content) < 10_000  # Little to look at, whatever it would unpack to.
    (tmp_path / "table").write_bytes(content)
    with pytest.raises(ValueError, match=f"^{tmp_path / 'table'} is damaged .*; put back what was written") as refused:
        tables.read(tmp_path / "table", TEXT if case == "long text" else SCHEMA)
    assert message in str(refused.value) and "\n" not in str(refused.value)


def test_what_is_no_file_is_refused_without_waiting(tmp_path):
    os.mkfifo(tmp_path / "table")
    with pytest.raises(ValueError, match="table is a pipe"):
        records.read([tmp_path / "table"])
    with pytest.raises(FileNotFoundError, match="nothing"):
        records.read([tmp_path / "nothing"])


def test_results_that_are_stored_are_read():
    paths = sorted(STORED.iterdir())
    frame = records.read(paths[:: len(paths) // 3], ["reward", "length"])
    assert len(frame) > 1000 and set(frame.reward) <= {-1.0, 1.0}


@pytest.mark.parametrize("content", ["", "[" * 100_000, "[]", "[1]", '[{"objective": "return"}]', "[NaN]"])
def test_an_ideal_experimenter_that_is_none_is_one_line(content, tmp_path):
    (tmp_path / "ideal").mkdir()
    for task in ("direct_features", "fist_features", "direct_pixels", "fist_pixels"):
        (tmp_path / "ideal" / f"towers-{task}.json").write_text(content)
    with pytest.raises(ValueError, match=f"^{tmp_path}/ideal/towers-.*json is ") as refused:
        ideal_towers.read(base.Results(tmp_path))
    assert "\n" not in str(refused.value)
