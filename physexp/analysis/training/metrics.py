"""The metrics of a run: rows that say how training goes, in a table that survives crashes."""

from collections.abc import Iterable, Mapping
import itertools
from pathlib import Path

from physexp.agents import files

METRICS = {
    "frames": "environment steps trained on",
    "updates": "updates made",
    "episodes": "episodes trained on",
    "seconds": "time spent training, s",
    "frames_per_second": "since the row before",
    "success_rate": "share of episodes with the right label",
    "episode_return": "mean discounted return",
    "interactions": "mean interaction actions in an episode",
    "timeouts": "share of episodes that ran out of time",
    "entropy": "mean entropy of the policy, nats",
    "policy_loss": "",
    "baseline_loss": "",
    "gradient_norm": "before clipping",
    "learning_rate": "",
    "entropy_cost": "",
    "staleness": "updates of others between taking the parameters and applying the gradient",
}
"""The columns of `metrics.csv`; losses and rates are means over the updates since the row before."""

LEARNER_METRICS = tuple(METRICS)[list(METRICS).index("entropy") :]
"""Those that the learner reports with each update; the recorder computes the others."""

_HEADER = ",".join(METRICS) + "\n"
_LARGEST = 2**28  # Bytes: rows of a hundred days.


class MetricsFile:
    """A run's `metrics.csv`."""

    def __init__(self, path: Path):
        """Names a file, which the first row makes."""
        self.path = path

    def append(self, row: Mapping[str, float]) -> None:
        """Adds a row.

        Raises:
          OSError, ValueError: as `files.open_plain`.
        """
        values = (f"{row[name]:.6g}" if isinstance(row[name], float) else str(row[name]) for name in METRICS)
        with files.open_plain(self.path, "ab") as file:
            header = b"" if file.tell() else _HEADER.encode()
            file.write(header + f"{','.join(values)}\n".encode())

    def rows(self) -> list[dict[str, float]]:
        """Returns the rows, without one that a crash has torn.

        Raises:
          ValueError: if there is something else in the file.
        """
        return self._parse(*self._lines())

    def split(self, frames: int) -> tuple[list[str], list[str]]:
        """Returns the lines up to a number of frames, and those after it, as `write` takes them.

        Raises:
          ValueError: as `rows`, or if they have the columns of an earlier version.
        """
        header, lines = self._lines()
        if header != list(METRICS):
            raise ValueError(f"{self.path} has the columns of an earlier version; resume it with that")
        is_kept = [row["frames"] <= frames for row in self._parse(header, lines)]
        later = [line for line, keep in zip(lines, is_kept, strict=True) if not keep]
        return list(itertools.compress(lines, is_kept)), later

    def write(self, lines: Iterable[str]) -> None:
        """Replaces the file by one with these lines below the header.

        Raises:
          OSError: if it cannot be written.
        """
        files.write_atomically(self.path, (_HEADER + "".join(f"{line}\n" for line in lines)).encode())

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
        """Returns the names of the columns, and the whole lines below them, without their ends."""
        try:
            content = files.read_plain(self.path, _LARGEST).decode(errors="replace")
        except (FileNotFoundError, NotADirectoryError):
            content = ""
        header, *lines = (content[: content.rfind("\n") + 1] or _HEADER).splitlines()
        names = header.split(",")
        if names[0] != "frames" or not set(names) <= set(METRICS):  # Earlier versions had fewer columns.
            raise ValueError(f"{self.path} is damaged: its first line names no metrics; mend it, or move it away")
        return names, lines
