"""Tables in Parquet files, with checksums: what is read is what was written, or it is refused in one line.

Pages have the checksums that Parquet has for them. The schema's metadata have one of each column's values and one of
the rest, so that damage to a file's own description of itself is found as well. Files without checksums are read, too.
"""

from collections.abc import Mapping, Sequence
import io
import json
from pathlib import Path
from typing import Any
import zlib

import numpy as np
import pyarrow
from pyarrow import parquet

from physexp.agents import checkpointing, files

_CHECKSUMS = b"crc32"
_MOST_BYTES = 2**28  # Of a file; the largest of ours has a few million.
_MOST_ROWS = 10_000_000
_MOST_VALUES = 2**29  # Of a column, when lists are laid end to end, and of bytes as they are in memory.
_LONGEST = 2**20  # Bytes of a text in a file's description of itself.


def write(path: Path, table: pyarrow.Table, **options: Any) -> None:
    """Writes a table, with checksums; there is the whole file or none.

    Args:
      path: the file.
      table: what goes into it; its schema's metadata stay.
      options: of `pyarrow.parquet.write_table`.

    Raises:
      OSError: if it cannot be written.
    """
    metadata = dict(table.schema.metadata or {})
    sums = {name: _checksum(table.column(name)) for name in table.column_names}
    table = table.replace_schema_metadata({**metadata, _CHECKSUMS: json.dumps([sums, _checksum_of_rest(metadata)])})
    content = io.BytesIO()
    parquet.write_table(table, content, write_page_checksum=True, **options)
    checkpointing.write_atomically(path, content.getvalue())


def read(path: Path, schema: pyarrow.Schema, columns: Sequence[str] | None = None) -> pyarrow.Table:
    """Reads a table.

    Args:
      path: the file.
      schema: names and types that its columns have.
      columns: which ones to read; all by default.

    Raises:
      OSError: if there is no such file or it cannot be opened.
      ValueError: if it is damaged, has other columns, or is larger than any table of ours.
    """
    content = files.read_plain(path, _MOST_BYTES)
    try:
        with parquet.ParquetFile(pyarrow.BufferReader(content), page_checksum_verification=True, pre_buffer=False,
                                 thrift_string_size_limit=_LONGEST,
                                 thrift_container_size_limit=_LONGEST) as file:  # fmt: skip
            _check_size(file.metadata)
            _check_schema(file.schema_arrow, schema)
            table = file.read(None if columns is None else list(columns), use_threads=False)
        _check_sums(table)
    except (ValueError, OSError, KeyError, TypeError, pyarrow.ArrowException) as error:
        reason = " ".join(str(error).split())[:200]
        raise ValueError(
            f"{path} is damaged ({reason}); put back what was written, or remove it and make it again"
        ) from None
    return table


def _check_size(metadata: parquet.FileMetaData) -> None:
    """Refuses a file that says it is larger than any of ours, before anything of it is unpacked."""
    groups = [metadata.row_group(index) for index in range(metadata.num_row_groups)]
    chunks = [group.column(index) for group in groups for index in range(metadata.num_columns)]
    values = [chunk.num_values for chunk in chunks]
    sizes = [chunk.total_uncompressed_size for chunk in chunks]
    if not 0 <= metadata.num_rows <= _MOST_ROWS or metadata.num_rows != sum(group.num_rows for group in groups):
        raise ValueError(f"it says that it has {metadata.num_rows} rows")
    if min([*values, *sizes], default=0) < 0 or sum(values) > _MOST_VALUES or sum(sizes) > _MOST_VALUES:
        raise ValueError(f"it says that it has {sum(values)} values in {sum(sizes)} bytes")


def _check_schema(found: pyarrow.Schema, wanted: pyarrow.Schema) -> None:
    if found.names != wanted.names:
        raise ValueError(f"its columns are {', '.join(found.names)[:100]} instead of {', '.join(wanted.names)}")
    for name in wanted.names:
        if found.field(name).type != wanted.field(name).type:
            raise ValueError(f"{name} is {found.field(name).type} instead of {wanted.field(name).type}")


def _check_sums(table: pyarrow.Table) -> None:
    metadata = dict(table.schema.metadata or {})
    text = metadata.pop(_CHECKSUMS, None)
    if text is None:
        return
    sums, rest = json.loads(text)
    if not isinstance(sums, Mapping) or rest != _checksum_of_rest(metadata):
        raise ValueError("the checksum of its metadata differs")
    for name in table.column_names:
        if sums.get(name) != _checksum(table.column(name)):
            raise ValueError(f"the checksum of {name} differs")


def _checksum_of_rest(metadata: Mapping[bytes, bytes]) -> int:
    return zlib.crc32(b"\n".join(key + b"=" + metadata[key] for key in sorted(metadata)))


def _checksum(column: pyarrow.ChunkedArray | pyarrow.Array) -> int:
    """CRC-32 of a column's values, whatever it is that Arrow keeps under those that are null."""
    array = column.combine_chunks() if isinstance(column, pyarrow.ChunkedArray) else column
    valid = np.ascontiguousarray(array.is_valid().to_numpy(zero_copy_only=False))
    found = zlib.crc32(f"{array.type} {len(array)}".encode())
    found = zlib.crc32(valid, found)
    array = array.drop_null()
    if pyarrow.types.is_list(array.type):
        lengths = array.value_lengths().to_numpy(zero_copy_only=False).astype("<i8")
        return zlib.crc32(str(_checksum(array.flatten())).encode(), zlib.crc32(lengths, found))
    if pyarrow.types.is_string(array.type):
        return zlib.crc32("\0".join(array.to_pylist()).encode(), found)
    return zlib.crc32(np.ascontiguousarray(array.to_numpy(zero_copy_only=False)), found)
