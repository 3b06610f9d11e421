"""What hypotheses show, found out once and kept with the package, for questions whose physics takes long to simulate.

What is kept holds for one state of the suite's code, other domains aside, one MuJoCo and one question; for any other it
is simulated.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
import functools
import hashlib
import io
from pathlib import Path
from typing import Any

import mujoco
import numpy as np

from physexp import suite
from physexp.agents import files
from physexp.analysis.ideal import hypotheses as hypotheses_lib
from physexp.analysis.ideal import situations as situations_lib

FOLDER = Path(__file__).with_name("kept_situations")
_NOBODY = 255  # Who was not followed any more: the label was known.


class Hypotheses(hypotheses_lib.Hypotheses):
    """Hypotheses of which it may be known already which of them look alike. Every bit of what they show counts."""

    def __init__(self, domain_name: str, task_name: str, *args: Any, read_as: str | None = None, **kwargs: Any):
        """Prepares the simulations; for the arguments see `hypotheses.Hypotheses`."""
        super().__init__(domain_name, task_name, *args, read_as=read_as, **kwargs)
        self.path = FOLDER / f"{domain_name}-{read_as or task_name}.npz"
        self._domain_name = domain_name

    @functools.cached_property
    def looks(self) -> Mapping[bytes, np.ndarray]:
        """A number for each hypothesis, uint8 [H], by sequence of actions; who looks alike has the same number."""
        if not self.path.exists():
            return {}
        with np.load(self.path) as file:
            if str(file["digest"]) != self.digest:
                return {}
            ends = np.cumsum(file["lengths"])
            actions, looks = file["actions"].tobytes(), file["looks"]
        return {
            actions[end - length : end]: row
            for end, length, row in zip(ends.tolist(), np.diff(ends, prepend=0).tolist(), looks, strict=True)
        }

    @functools.cached_property
    def digest(self) -> str:
        """What tells this question, simulated by this code, from others."""
        found = hashlib.sha256(f"{mujoco.__version__} {self._domain_name} {self._read.options}".encode())
        for values in (self.hidden, self.prior, self._nuisances):
            found.update(b"" if values is None else np.ascontiguousarray(values).tobytes())
        root = Path(suite.__file__).parent
        domains = root / "domains"
        others = {*domains.glob("*.py")} - {domains / f"{self._domain_name}.py"}
        for path in sorted({*root.rglob("*.py")} - others):
            found.update(path.relative_to(root).as_posix().encode() + path.read_bytes())
        return found.hexdigest()

    @functools.cached_property
    def start(self) -> "_Place":  # type: ignore[override]
        return _Place(b"", lambda: self._moment(range(len(self.hidden))))

    def step(self, moment: "_Place", members: Sequence[int], actions: Sequence[int]):  # type: ignore[override]
        found = {action: self._known(moment, members, action) for action in actions}
        unknown = [action for action in actions if found[action] is None]
        if unknown:
            simulated = super().step(moment.moment, members, unknown)
            for action, (apart, reached) in zip(unknown, simulated, strict=True):
                found[action] = apart, _reached(moment.path + bytes([action]), reached)
        return [found[action] for action in actions]

    def _known(self, moment: "_Place", members: Sequence[int], action: int) -> "tuple[np.ndarray, _Place] | None":
        """Returns what `step` does for one action, without a simulation, or None where nothing is kept."""
        path, simulate = moment.path + bytes([action]), super().step
        looks = self.looks[path][list(members)] if path in self.looks else np.array([_NOBODY])
        if (looks == _NOBODY).any():
            return None
        following = _Place(path, lambda: simulate(moment.moment, members, [action])[0][1])
        return np.where(looks[:, None] == looks, 0.0, np.inf), following

    def observe(self, moment: "_Place", members: Sequence[int], action: int):  # type: ignore[override]
        return super().observe(moment.moment, members, action)


class _Place:
    """Where hypotheses stand after a sequence of actions, simulated when that is first asked for."""

    def __init__(self, path: bytes, simulate: Callable[[], Any]):
        self.path, self._simulate = path, simulate

    @functools.cached_property
    def moment(self) -> Any:
        """The states of the simulations, a `batch.Moment`."""
        return self._simulate()

    @property
    def coordinates(self) -> Any:
        """Where things are then, as `batch.Moment` has it."""
        return self.moment.coordinates


def _reached(path: bytes, moment: Any) -> _Place:
    """Returns a place whose moment has been simulated."""
    return _Place(path, lambda: moment)


def check(solution: Any) -> Hypotheses:
    """Returns the hypotheses of a solution of which something is kept.

    Raises:
      ValueError: if nothing is.
    """
    hypotheses = getattr(solution, "hypotheses", None)
    if not isinstance(hypotheses, Hypotheses):
        raise ValueError("nothing is kept of this ideal experimenter; leave --keep out")
    return hypotheses


def keep(solution: Any) -> None:
    """Writes what can be told apart after every sequence of actions of an episode.

    Args:
      solution: a `search.Solution`.

    Raises:
      ValueError: as `check`.
    """
    hypotheses = check(solution)
    situations, most = solution.situations, hypotheses.task.rules.step_limit - 1
    found = dict(_looks(situations, situations.start, b"", most))
    paths = sorted(found, key=lambda path: (len(path), path))
    hypotheses.path.parent.mkdir(exist_ok=True)
    content = io.BytesIO()
    np.savez_compressed(
        content,
        digest=np.array(hypotheses.digest),
        lengths=np.array([len(path) for path in paths]),
        actions=np.frombuffer(b"".join(paths), np.uint8),
        looks=np.array([found[path] for path in paths]),
    )
    files.write_atomically(hypotheses.path, content.getvalue())


def _looks(
    situations: situations_lib.Situations, situation: situations_lib.Situation, path: bytes, most: int
) -> Iterator[tuple[bytes, np.ndarray]]:
    """Yields all sequences of so many actions at most that go on from one, and who looks like whom after each."""
    if not situation.groups or len(path) == most:
        return
    situations.expand(situation)
    for action, (found, following) in situation.after.items():
        looks = np.full(len(situations.hypotheses.prior), _NOBODY, np.uint8)
        for number, part in enumerate(part for of_group in found.values() for _, part in of_group):
            looks[list(part)] = number
        further = path + bytes([action])
        yield further, looks
        yield from _looks(situations, following, further, most)
