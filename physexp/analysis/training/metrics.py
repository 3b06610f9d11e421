"""The metrics of a run, `metrics.csv`: a row every few seconds of training."""

from collections.abc import Mapping
from pathlib import Path

from physexp.agents import files

METRICS = {
    "frames": "environment steps trained on",
    "updates": "updates made",
    "episodes": "episodes trained on",
    "seconds": "time spent training, s",
    "frames_per_second": "since the row before, or since training was started or resumed",
    "success_rate": "share of episodes with the right label",
    "episode_return": "mean discounted return",
    "interactions": "mean interaction actions in an episode",
    "timeouts": "share of episodes that ran out of time",
}
"""The first columns of `metrics.csv`, those of every run.

Those of its learner follow, `AgentConfig.metrics`: means over the updates since the row before.
"""


def append(path: Path, row: Mapping[str, float]) -> None:
    """Adds a row; the first one makes the file and its header."""
    cells = [f"{value:.6g}" if isinstance(value, float) else str(value) for value in row.values()]
    with path.open("a", encoding="utf-8") as file:
        lines = [cells] if file.tell() else [list(row), cells]
        file.write("".join(f"{','.join(line)}\n" for line in lines))


def read(path: Path) -> list[dict[str, float]]:
    """Returns the rows, without the last one if a crash has torn it; raises ValueError if the file is damaged."""
    return [row for _, row in _lines(path)[1]]


def rewind(path: Path, frames: int) -> None:
    """Removes the rows after a number of frames, and one that a crash has torn."""
    header, lines = _lines(path)
    kept = [line for line, row in lines if row["frames"] <= frames]
    if path.exists():
        files.write_atomically(path, "".join(f"{line}\n" for line in [header, *kept] if line).encode())


def _lines(path: Path) -> tuple[str, list[tuple[str, dict[str, float]]]]:
    """Returns the header, and each whole line below it with the row that it holds."""
    content = path.read_text(encoding="utf-8", errors="replace") if path.exists() else ""
    header, *lines = content[: content.rfind("\n") + 1].splitlines() or [""]
    names, found = header.split(","), []
    if header and names[0] != "frames":
        raise ValueError(f"{path} is damaged: its first line names no metrics; mend it, or move it away")
    for number, line in enumerate(lines, 2):
        try:
            found.append((line, dict(zip(names, map(float, line.split(",")), strict=True))))
        except ValueError:
            raise ValueError(
                f"{path} is damaged: line {number} is no row of {len(names)} numbers; mend it, or move it away"
            ) from None
    return header, found
