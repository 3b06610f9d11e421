"""Tables in Parquet files with checksums of their pages."""

from collections.abc import Sequence
import io
from pathlib import Path
from typing import Any

import pyarrow
from pyarrow import parquet

from physexp.agents import files


def write(path: Path, table: pyarrow.Table, **options: Any) -> None:
    """Writes a table, whole or not at all.

    Args:
      path: the file.
      table: what goes into it.
      options: of `pyarrow.parquet.write_table`.

    Raises:
      OSError: if it cannot be written.
    """
    sink = io.BytesIO()
    parquet.write_table(table, sink, write_page_checksum=True, **options)
    files.write_atomically(path, sink.getvalue())


def read(path: Path, schema: pyarrow.Schema, columns: Sequence[str] | None = None) -> pyarrow.Table:
    """Reads the columns of a schema, or some of them.

    Raises:
      OSError: if there is no such file.
      ValueError: if it is damaged or has other columns.
    """
    wanted = schema if columns is None else pyarrow.schema([schema.field(name) for name in columns])
    with Path(path).open("rb") as content:
        try:
            file = parquet.ParquetFile(content, page_checksum_verification=True)
            if missing := [name for name in wanted.names if name not in file.schema_arrow.names]:
                raise ValueError(f"it has no column {missing[0]}")
            found = file.read(wanted.names, use_threads=False)
            return found.cast(wanted.with_metadata(file.schema_arrow.metadata))
        except (ValueError, OSError, KeyError, pyarrow.ArrowException) as error:
            raise ValueError(
                f"{path} is damaged ({files.reason(error)}); put back what was written, or remove it"
            ) from None
