"""Tables in Parquet files with a checksum: a file that has changed since it was written is refused in one line.

A Parquet file ends with its description of itself, which says where everything is. Just before it is our mark
with the SHA-256 of all bytes but the mark's own; other readers pass over it. Files without a mark are read, too.
"""

from collections.abc import Sequence
import hashlib
import io
from pathlib import Path
from typing import Any

import pyarrow
from pyarrow import compute, parquet

from physexp.agents import files

_MARK = b"physexp sha256 "
MOST_BYTES = 2**28  # Of a file; the largest of ours has two million.
_MOST_VALUES = 80_000_000  # Of all columns: 10,000 episodes of every task in the log of a score.
_MOST_UNPACKED = 2**29  # Bytes of all pages.
_MOST_TEXT = 2**28  # Bytes.
_LONGEST = 2**20  # Bytes of a text, or entries of a list, in a file's description of itself.


def write(path: Path, table: pyarrow.Table, **options: Any) -> None:
    """Writes a table: the whole file, or nothing.

    Args:
      path: the file.
      table: what goes into it.
      options: of `pyarrow.parquet.write_table`.

    Raises:
      OSError: if it cannot be written.
    """
    sink = io.BytesIO()
    parquet.write_table(table, sink, write_page_checksum=True, **options)
    content = sink.getvalue()
    end = len(content) - 8 - int.from_bytes(content[-8:-4], "little")  # The start of the description.
    mark = _MARK + hashlib.sha256(content).hexdigest().encode()
    files.write_atomically(path, content[:end] + mark + content[end:])


def read(path: Path, schema: pyarrow.Schema, columns: Sequence[str] | None = None) -> pyarrow.Table:
    """Reads a table.

    Args:
      path: the file.
      schema: names and types that its columns have.
      columns: which ones to read; all by default.

    Raises:
      OSError: if there is no such file or it cannot be opened.
      ValueError: if it is damaged, has other columns, or is larger than any table of ours. Integers may be narrower.
    """
    content = files.read_plain(path, MOST_BYTES)
    try:
        _check_sum(content)
        with parquet.ParquetFile(
            pyarrow.BufferReader(content),
            read_dictionary=[field.name for field in schema if field.type == pyarrow.string()],
            page_checksum_verification=True,
            pre_buffer=False,
            thrift_string_size_limit=_LONGEST,
            thrift_container_size_limit=_LONGEST,
        ) as file:
            _check_size(file.metadata)
            _check_schema(file.schema_arrow, schema)
            wanted = schema if columns is None else pyarrow.schema([schema.field(name) for name in columns])
            found = file.read(wanted.names, use_threads=False)
            _check_text(found)
            return found.cast(wanted.with_metadata(file.schema_arrow.metadata))
    except (ValueError, OSError, KeyError, pyarrow.ArrowException) as error:
        raise ValueError(
            f"{path} is damaged ({files.reason(error)}); put back what was written, or remove it"
        ) from None


def _check_sum(content: bytes) -> None:
    start = content.rfind(_MARK)
    if start < 0:
        return
    end = start + len(_MARK) + 2 * hashlib.sha256().digest_size
    rest = content[:start] + content[end:]
    if _MARK + hashlib.sha256(rest).hexdigest().encode() != content[start:end]:
        raise ValueError("its checksum differs")


def _check_size(metadata: parquet.FileMetaData) -> None:
    """Refuses a file that says it is larger than any of ours, before anything of it is unpacked."""
    groups = [metadata.row_group(index) for index in range(metadata.num_row_groups)]
    if metadata.num_rows < 0 or metadata.num_rows != sum(group.num_rows for group in groups):
        raise ValueError(f"it says that it has {metadata.num_rows} rows")
    num_values = sum(group.column(index).num_values for group in groups for index in range(group.num_columns))
    if max(num_values, metadata.num_rows) > _MOST_VALUES:
        raise ValueError(f"it has {metadata.num_rows:,} rows, more than any table of ours")
    if not 0 <= sum(group.total_byte_size for group in groups) <= _MOST_UNPACKED:
        raise ValueError("it says that it unpacks to more than any table of ours")


def _check_text(found: pyarrow.Table) -> None:
    """Refuses text that would be long once every row had its own copy of the dictionary's."""
    columns = [column for column in found.columns if pyarrow.types.is_dictionary(column.type)]
    chunks = [chunk for column in columns for chunk in column.chunks]
    longest = [compute.max(compute.binary_length(chunk.dictionary)).as_py() or 0 for chunk in chunks]
    if sum(length * len(chunk) for length, chunk in zip(longest, chunks, strict=True)) > _MOST_TEXT:
        raise ValueError("it has more text than any table of ours")


def _check_schema(found: pyarrow.Schema, schema: pyarrow.Schema) -> None:
    if found.names != schema.names:
        raise ValueError(f"its columns are {', '.join(found.names)[:80]} instead of {', '.join(schema.names)}")
    for name in schema.names:
        if not _fits(found.field(name).type, schema.field(name).type):
            raise ValueError(f"{name} is {found.field(name).type} instead of {schema.field(name).type}")


def _fits(found: pyarrow.DataType, wanted: pyarrow.DataType) -> bool:
    """Returns whether a type is the wanted one, its dictionary, or has narrower integers, as earlier files have."""
    if pyarrow.types.is_dictionary(found) and not pyarrow.types.is_dictionary(wanted):
        return found.value_type == wanted
    if pyarrow.types.is_list(found) and pyarrow.types.is_list(wanted):
        return _fits(found.value_type, wanted.value_type)
    are_signed = pyarrow.types.is_signed_integer(found) and pyarrow.types.is_signed_integer(wanted)
    return found == wanted or (are_signed and found.bit_width < wanted.bit_width)
