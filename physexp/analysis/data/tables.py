"""Parquet files, and limits for files that may come from strangers: downloaded agents, scores and replays."""

import io
from pathlib import Path
import stat
from typing import Any

import pyarrow
from pyarrow import compute, parquet

from physexp.agents import files

MAX_AGENT = 2**26
"""Bytes of an agent's file; the largest of ours has three million."""
MAX_TEXT = 2**20
"""Bytes of a JSON file."""
MAX_TABLE = 2**28
"""Bytes of a Parquet file; the largest of ours has two million."""
_MAX_VALUES = 80_000_000  # Of all columns: 10,000 episodes of every task in the log of a score.
_MAX_UNPACKED = 2**29  # Bytes of all pages.
_MAX_STRINGS = 2**28  # Bytes of all text, once every row has its own copy of a dictionary's.
_MAX_FOOTER_ENTRY = 2**20  # Bytes of a text, or entries of a list, in a Parquet file's description of itself.


def write(path: Path, table: pyarrow.Table, **options: Any) -> None:
    """Writes a table with checksums of its pages, whole or not at all; options as of `pyarrow.parquet.write_table`."""
    sink = io.BytesIO()
    parquet.write_table(table, sink, write_page_checksum=True, **options)
    files.write_atomically(path, sink.getvalue())


def read(path: Path, schema: pyarrow.Schema) -> pyarrow.Table:
    """Reads a Parquet file; refuses one that would unpack to more than any table of ours.

    Raises:
      OSError: if there is no such file.
      ValueError: if it is damaged, has other columns, or is too large.
    """
    check(path, MAX_TABLE)
    try:
        with parquet.ParquetFile(
            path,
            read_dictionary=[field.name for field in schema if field.type == pyarrow.string()],
            page_checksum_verification=True,
            pre_buffer=False,
            thrift_string_size_limit=_MAX_FOOTER_ENTRY,
            thrift_container_size_limit=_MAX_FOOTER_ENTRY,
        ) as file:
            _check_size(file)
            if file.schema_arrow.names != schema.names:
                raise ValueError(f"its columns are not {', '.join(schema.names)}")
            found = file.read(use_threads=False)
            _check_strings(found)
            return found.cast(schema.with_metadata(file.schema_arrow.metadata))
    except (ValueError, OSError, KeyError, pyarrow.ArrowException) as error:
        raise ValueError(f"{path} is damaged ({files.reason(error)}); put back what was written") from None


def check(path: Path, max_bytes: int) -> None:
    """Raises ValueError for a file that is not regular, such as a pipe, or has more bytes; OSError if there is none."""
    status = path.stat()
    if not stat.S_ISREG(status.st_mode):
        raise ValueError(f"{path} is no regular file; put one in its place")
    if status.st_size > max_bytes:
        raise ValueError(f"{path} has {status.st_size / 1e6:,.0f} MB; give a file of at most {max_bytes / 1e6:.0f} MB")


def _check_size(file: parquet.ParquetFile) -> None:
    metadata = file.metadata
    groups = [metadata.row_group(index) for index in range(metadata.num_row_groups)]
    num_rows = max(metadata.num_rows, sum(group.num_rows for group in groups))
    num_bytes = sum(group.total_byte_size for group in groups)
    _limit(num_rows * metadata.num_columns, num_bytes)
    file.scan_contents()  # Refuses a damaged description of a column, which would end the process in the next line.
    _limit(sum(group.column(index).num_values for group in groups for index in range(group.num_columns)), num_bytes)


def _limit(num_values: int, num_bytes: int) -> None:
    if not 0 <= num_values <= _MAX_VALUES or not 0 <= num_bytes <= _MAX_UNPACKED:
        raise ValueError(f"it unpacks to {num_values:,} values, {num_bytes / 1e6:,.0f} MB: more than any table of ours")


def _check_strings(found: pyarrow.Table) -> None:
    columns = [column for column in found.columns if pyarrow.types.is_dictionary(column.type)]
    chunks = [chunk for column in columns for chunk in column.chunks]
    longest = [compute.max(compute.binary_length(chunk.dictionary)).as_py() or 0 for chunk in chunks]
    if sum(length * len(chunk) for length, chunk in zip(longest, chunks, strict=True)) > _MAX_STRINGS:
        raise ValueError("it has more text than any table of ours")
