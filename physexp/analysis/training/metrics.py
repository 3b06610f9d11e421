"""The metrics of a run: rows that say how training goes, in a table that survives crashes."""

from collections.abc import Mapping, Sequence
import itertools
import math
from pathlib import Path

from physexp.agents import files
from physexp.analysis.training import config

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
"""The columns of `metrics.csv` that every run has.

Those of its learner follow, `AgentConfig.metrics`: means over the updates since the row before.
"""

_KNOWN = {*METRICS, *itertools.chain.from_iterable(agent.metrics for agent in config.ALGORITHMS.values())}
_LARGEST = 2**28  # Bytes: rows of a hundred days.


class MetricsFile:
    """A run's `metrics.csv`."""

    def __init__(self, path: Path):
        """Names a file, which the first row makes."""
        self.path = path

    def append(self, row: Mapping[str, float]) -> None:
        """Adds a row, under the columns that the first row has made.

        A run that an earlier version has begun may have more columns than rows have now: those get `nan`.

        Raises:
          OSError, ValueError: as `files.open_plain`.
        """
        with files.open_plain(self.path, "a+b") as file:
            file.seek(0)
            header = file.readline().decode(errors="replace")
            names = header.strip().split(",") if header else list(row)
            values = [row.get(name, math.nan) for name in names]
            cells = [f"{value:.6g}" if isinstance(value, float) else str(value) for value in values]
            lines = [cells] if header else [names, cells]
            file.write("".join(f"{','.join(line)}\n" for line in lines).encode())

    def rows(self) -> list[dict[str, float]]:
        """Returns the rows, without one that a crash has torn.

        Raises:
          ValueError: if there is something else in the file.
        """
        return self._parse(*self._lines())

    def split(self, frames: int) -> tuple[list[str], list[str], list[str]]:
        """Returns the names of the columns, the lines up to a number of frames, and those after it.

        Raises:
          ValueError: as `rows`.
        """
        names, lines = self._lines()
        is_kept = [row["frames"] <= frames for row in self._parse(names, lines)]
        later = [line for line, keep in zip(lines, is_kept, strict=True) if not keep]
        return names, list(itertools.compress(lines, is_kept)), later

    def write(self, names: Sequence[str], lines: Sequence[str]) -> None:
        """Replaces the file by one with these columns and lines, as `split` returns them.

        Raises:
          OSError: if it cannot be written.
        """
        lines = [",".join(names), *lines] if names else []
        files.write_atomically(self.path, "".join(f"{line}\n" for line in lines).encode())

    def _parse(self, header: list[str], lines: list[str]) -> list[dict[str, float]]:
        rows = []
        for number, line in enumerate(lines, 2):
            try:
                rows.append(dict(zip(header, map(float, line.split(",")), strict=True)))
            except ValueError:
                raise ValueError(
                    f"{self.path} is damaged: line {number} is no row of {len(header)} numbers; mend it, or move it "
                    "away"
                ) from None
        return rows

    def _lines(self) -> tuple[list[str], list[str]]:
        """Returns the names of the columns, none if there are none yet, and the whole lines below them."""
        try:
            content = files.read_plain(self.path, _LARGEST).decode(errors="replace")
        except (FileNotFoundError, NotADirectoryError):
            content = ""
        if "\n" not in content:
            return [], []
        header, *lines = content[: content.rfind("\n") + 1].splitlines()
        names = header.split(",")
        if names[0] != "frames" or not set(names) <= _KNOWN:  # Earlier versions had fewer columns.
            raise ValueError(f"{self.path} is damaged: its first line names no metrics; mend it, or move it away")
        return names, lines
