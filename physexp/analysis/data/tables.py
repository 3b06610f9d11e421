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
from pyarrow import parquet

from physexp.agents import files

_MARK = b"physexp sha256 "
MOST_BYTES = 2**28  # Of a file; the largest of ours has less than a million.
_MOST_ROWS = 2**24
_MOST_UNPACKED = 2**30  # Bytes of all pages.
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
    end = len(content) - 8 - int.from_bytes(content[-8:-4], "little")  # Where the description starts.
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
            page_checksum_verification=True,
            pre_buffer=False,
            thrift_string_size_limit=_LONGEST,
            thrift_container_size_limit=_LONGEST,
        ) as file:
            _check_size(file.metadata)
            _check_schema(file.schema_arrow, schema)
            wanted = schema if columns is None else pyarrow.schema([schema.field(name) for name in columns])
            return file.read(wanted.names, use_threads=False).cast(wanted)
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
    if not 0 <= metadata.num_rows <= _MOST_ROWS or metadata.num_rows != sum(group.num_rows for group in groups):
        raise ValueError(f"it says that it has {metadata.num_rows} rows")
    if not 0 <= sum(group.total_byte_size for group in groups) <= _MOST_UNPACKED:
        raise ValueError("it says that it unpacks to more than any table of ours")


def _check_schema(found: pyarrow.Schema, schema: pyarrow.Schema) -> None:
    if found.names != schema.names:
        raise ValueError(f"its columns are {', '.join(found.names)[:80]} instead of {', '.join(schema.names)}")
    for name in schema.names:
        if not _fits(found.field(name).type, schema.field(name).type):
            raise ValueError(f"{name} is {found.field(name).type} instead of {schema.field(name).type}")


def _fits(found: pyarrow.DataType, wanted: pyarrow.DataType) -> bool:
    """Returns whether a type is the wanted one, or the same with narrower integers, as earlier versions wrote them."""
    if pyarrow.types.is_list(found) and pyarrow.types.is_list(wanted):
        return _fits(found.value_type, wanted.value_type)
    are_signed = pyarrow.types.is_signed_integer(found) and pyarrow.types.is_signed_integer(wanted)
    return found == wanted or (are_signed and found.bit_width < wanted.bit_width)
