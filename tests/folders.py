"""The contents of a folder."""

import os
from pathlib import Path
import stat


def contents(folder: Path) -> dict[str, bytes | str | int]:
    """Returns by name the content of every file, the target of every link, and the mode of everything else."""
    found: dict[str, bytes | str | int] = {}
    for path in sorted(folder.rglob("*")):
        mode = path.lstat().st_mode
        name = str(path.relative_to(folder))
        found[name] = os.readlink(path) if stat.S_ISLNK(mode) else path.read_bytes() if stat.S_ISREG(mode) else mode
    return found
