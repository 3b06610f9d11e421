"""Replaces files as a whole, and reads JSON."""

import json
import os
from pathlib import Path
import secrets
from typing import Any


def write_atomically(path: Path, content: bytes) -> None:
    """Replaces a file: after a crash or on a full disk (OSError) there is the old file or the new one, never a part."""
    path = Path(path)
    temporary = path.with_name(f".{secrets.token_hex(8)}.tmp")
    try:
        with temporary.open("xb") as file:
            file.write(content)
            file.flush()
            os.fsync(file.fileno())
        temporary.replace(path)
    except OSError as error:
        raise type(error)(error.errno, error.strerror, str(path)) from None
    finally:
        temporary.unlink(missing_ok=True)


def remove_litter(folder: Path) -> None:
    """Removes the temporary files that killed writers have left in a folder to which nobody else writes."""
    for path in folder.glob(f".{'[0-9a-f]' * 16}.tmp"):
        path.unlink(missing_ok=True)


def read_json(path: Path) -> Any:
    """Returns the content of a JSON file; raises OSError if it cannot be read, and ValueError if it is not JSON."""
    try:
        return json.loads(Path(path).read_bytes())
    except (ValueError, RecursionError) as error:
        raise ValueError(f"{path} is no JSON: {reason(error)}; put back what was written") from None


def reason(error: Exception) -> str:
    """Returns an error's message as one line of at most 200 ASCII characters."""
    return ascii(" ".join(str(error).split()))[1:-1][:200]
