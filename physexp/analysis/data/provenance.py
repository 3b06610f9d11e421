"""The provenance of results: the commit and the versions of the source."""

import importlib.metadata
from pathlib import Path
import platform
import shutil
import subprocess
import time
from typing import Any

import physexp

_DISTRIBUTIONS = ("mujoco", "dm-control", "torch", "numpy")
_GIT_SECONDS = 60.0
_DIGITS = 40  # Of a commit.


def commit() -> str:
    """Returns the commit of the running source, with `+` if files differ from it.

    `unknown` outside a checkout of this project, and if git does not answer.
    """
    if shutil.which("git") is None:
        return "unknown"
    source = Path(physexp.__file__)
    git = ["git", "-C", str(source.parent)]
    try:
        ours = subprocess.run(
            [*git, "ls-files", "--error-unmatch", source.name], capture_output=True, timeout=_GIT_SECONDS
        )
        if ours.returncode:
            return "unknown"
        found = subprocess.run([*git, "rev-parse", "HEAD"], capture_output=True, encoding="utf-8", timeout=_GIT_SECONDS)
        if found.returncode:
            return "unknown"
        changed = subprocess.run([*git, "diff", "--quiet", "HEAD", "--", "."], timeout=_GIT_SECONDS).returncode
    except subprocess.TimeoutExpired:  # On a slow network file system.
        return "unknown"
    return found.stdout.strip() + ("+" if changed else "")


def shortened(commit: str) -> str:
    """Returns ten digits of a commit, and its `+`; other words, such as `unknown`, stay whole."""
    digits, plus, _ = commit.partition("+")
    return (digits[:10] if len(digits) == _DIGITS else digits) + plus


def made_since(begun: float) -> dict[str, Any]:
    """Returns `seconds` since a time of `time.monotonic`, `commit` and `versions`."""
    return {"seconds": round(time.monotonic() - begun, 1), "commit": commit(), "versions": versions()}


def versions() -> dict[str, str]:
    """Returns the versions that determine the results of a run; a source tree on the path is `not installed`."""
    found = {name: _version(name) for name in _DISTRIBUTIONS}
    return {"python": platform.python_version(), "physexp": physexp.__version__, **found}


def _version(distribution: str) -> str:
    try:
        return importlib.metadata.version(distribution)
    except importlib.metadata.PackageNotFoundError:
        return "not installed"
