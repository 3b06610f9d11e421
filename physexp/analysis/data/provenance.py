"""The provenance of results: the commit and the versions of the source."""

import importlib.metadata
from pathlib import Path
import platform
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
    try:
        is_ours = _git("ls-files", "--error-unmatch", Path(physexp.__file__).name).returncode == 0
        found, changed = _git("rev-parse", "HEAD"), _git("diff", "--quiet", "HEAD", "--", ".")
    except (FileNotFoundError, subprocess.TimeoutExpired):  # No git, or a slow network file system.
        return "unknown"
    if not is_ours or found.returncode:
        return "unknown"
    return found.stdout.strip() + ("+" if changed.returncode else "")


def _git(*words: str) -> subprocess.CompletedProcess[str]:
    folder = Path(physexp.__file__).parent
    return subprocess.run(["git", "-C", folder, *words], capture_output=True, encoding="utf-8", timeout=_GIT_SECONDS)


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
