"""The tables of stored results: folders of Parquet files that every reader of Parquet reads as one table.

A run appends its rows to the file of its condition, so that no other file changes. Rows are sorted by condition, trial
and training seed. In large files each trial of a condition is a row group: filters by these columns skip other groups.
"""

from collections.abc import Sequence
import functools
import io
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow
from pyarrow import compute, parquet

from physexp.agents import files

TABLES = "tables"
"""The folder of the tables within that of the results."""

_KEYS = ("condition", "trial", "training_seed")
_SMALL = 100_000  # Rows; more are split into groups.
_LARGEST = 2**26  # Bytes of a page and rows of a group: runs that repeat one another pack best together.

Filters = Sequence[tuple[str, str, Any]]
"""Conditions on columns, all of which hold, as `pyarrow.parquet.read_table` takes them: ("trial", "==", "learned")."""


def load(results: Path, table: str, columns: Sequence[str] | None = None, filters: Filters = ()) -> Any:
    """Returns rows of a table of the folder `results` as a pandas DataFrame, by default all rows and columns.

    The table is `runs`, `curves`, `evaluations` or `episodes`; raises FileNotFoundError if there is none, and
    ValueError for an unknown column and for a damaged file.
    """
    return read(results, table, columns, filters).to_pandas()


def read(results: Path, table: str, columns: Sequence[str] | None = None, filters: Filters = ()) -> pyarrow.Table:
    """Returns rows of a table, as `load` does, as a pyarrow table."""
    folder = results / TABLES / table
    if not any(folder.glob("*.parquet")):
        raise FileNotFoundError(f"{folder} holds no table; `physexp reproduce` or `physexp sweep` makes one")
    try:
        return parquet.read_table(
            folder,
            columns=None if columns is None else list(columns),
            filters=list(filters) or None,
            partitioning=None,
            page_checksum_verification=True,
        )
    except (pyarrow.ArrowException, OSError, ValueError) as error:
        raise ValueError(
            f"{folder} has a damaged file or lacks a column ({files.reason(error)}); put back the files as they were"
        ) from None


def append(results: Path, table: str, rows: pyarrow.Table) -> None:
    """Adds rows of one run to the file of its condition, in place of those of the same trial: all of them or none."""
    key = {name: rows[name][0].as_py() for name in _KEYS if name in rows.column_names}
    path = results / TABLES / table / f"{key['condition']}.parquet"
    path.parent.mkdir(parents=True, exist_ok=True)
    if path.exists():
        others = parquet.read_table(path, partitioning=None)
        is_same = functools.reduce(compute.and_, (compute.equal(others[name], value) for name, value in key.items()))
        rows = pyarrow.concat_tables([others.filter(compute.invert(is_same)), rows])
    files.write_atomically(path, packed(rows))


def packed(rows: pyarrow.Table) -> bytes:
    """Returns rows as a Parquet file: the same rows give the same bytes."""
    keys = [name for name in _KEYS if name in rows.column_names]
    rows = rows.sort_by([(name, "ascending") for name in keys])  # Stable: the episodes of a run keep their order.
    floats = [field.name for field in rows.schema if pyarrow.types.is_floating(field.type)]
    others = [_leaf(field) for field in rows.schema if field.name not in floats]
    sink = io.BytesIO()
    with parquet.ParquetWriter(
        sink,
        rows.schema,
        compression="zstd",
        compression_level=19,
        use_dictionary=others,
        column_encoding=dict.fromkeys(floats, "BYTE_STREAM_SPLIT"),
        write_statistics=keys,
        write_page_checksum=True,
        data_page_size=_LARGEST,
    ) as writer:
        for group in _groups(rows, [name for name in keys if name != "training_seed"]):
            writer.write_table(group, row_group_size=_LARGEST)
    return sink.getvalue()


def _leaf(field: pyarrow.Field) -> str:
    return f"{field.name}.list.element" if pyarrow.types.is_list(field.type) else field.name


def _groups(rows: pyarrow.Table, keys: Sequence[str]) -> list[pyarrow.Table]:
    """Returns parts of sorted rows in which the keys are the same."""
    if len(rows) <= _SMALL:
        return [rows]
    is_new = np.zeros(len(rows), bool)
    for name in keys:
        codes = rows[name].combine_chunks().dictionary_encode().indices.to_numpy()
        is_new[1:] |= codes[1:] != codes[:-1]
    starts = [0, *np.flatnonzero(is_new).tolist(), len(rows)]
    return [rows.slice(start, end - start) for start, end in zip(starts, starts[1:], strict=False)]
