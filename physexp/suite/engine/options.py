"""The options that every task has."""

import ast
import dataclasses
import math
from typing import Any, ClassVar

import numpy as np

from physexp import checks
from physexp.checks import checked
from physexp.suite.engine import seeding

_ROUNDING = 1e-6  # A control step is as good as a multiple that it differs from by less: float32 keeps 7 digits.


def parsed(text: str) -> dict[str, Any]:
    """Returns the options of a text, `name=value,name=value`, whose names and values are not checked.

    Raises ValueError for a part without a value.
    """
    found = {}
    for part in text.split(",") if text else []:
        name, equals, value = part.partition("=")
        if not equals:
            raise ValueError(f"{part!r} is no option of a task; give NAME=VALUE")
        try:
            found[name] = ast.literal_eval(value)
        except (ValueError, SyntaxError):  # A word.
            found[name] = value
    return found


def _seed(name: str, value: Any) -> int:
    return seeding.seed_from(value)


@dataclasses.dataclass(frozen=True, kw_only=True)
class Options:
    """The options that every task has: the `task_kwargs` of `suite.load`. A domain's own class adds others.

    Raises:
      ValueError: if a value has the wrong type or is out of range.
    """

    physics_timestep: ClassVar[float]

    random: Any = checked(
        None, _seed, help="an integer seed, a numpy.random.RandomState, or None for a seed from the operating system"
    )
    control_timestep: float = checked(
        0.1,
        checks.within(0, 60, "s", without=0),
        help="time between actions, a multiple of the physics step, at most a minute, s",
    )
    time_limit: float = checked(
        check=checks.within(0, 1e6, "s", without=0),
        help="time after which an unanswered episode ends, rounded up to whole control steps, s",
    )
    variation: float = checked(
        0.0,
        checks.within(0, 1),
        help="strength of the random variation between episodes (positions, masses, camera), 0 to 1",
    )
    step_variation: float = checked(
        0.0,
        checks.within(0, 0.9),
        help="random variation of the control step between episodes, as a share of control_timestep, 0 to 0.9; the "
        "number of control steps in an episode stays the same",
    )
    noise: float = checked(
        0.0,
        checks.within(0, 100, "m"),
        help="standard deviation of the noise added to every position at every control step, at most 100 m",
    )
    reveal: bool = checked(
        False,
        checks.flag,
        help="observe the right answer from the first step on, as `answer`: 1 for the right label, 0 for the others; "
        "an agent that fails even then has not learned to answer",
    )
    visualize_reward: bool = checked(False, checks.flag, help="colour the floor by the outcome of an episode")

    def __init_subclass__(cls) -> None:
        """Lists the options in the docstring of a domain's class, for `help`."""
        declared = {name: value for name, value in vars(cls).items() if isinstance(value, dataclasses.Field)}
        own = {name: field.metadata.get("help", "") for name, field in declared.items()}
        lines = [f"  {name}: {text}" for name, text in {**checks.help_of(cls), **own}.items()]
        cls.__doc__ = "\n".join([cls.__doc__ or "The options.", "", "Attributes:", *lines])

    def __post_init__(self) -> None:
        checks.check_fields(self)
        exact = self.substeps * self.physics_timestep
        if self.substeps < 1 or abs(exact - self.control_timestep) > _ROUNDING * exact:
            raise ValueError(
                f"control_timestep is {self.control_timestep} s; "
                f"give a multiple of the physics step, {self.physics_timestep} s"
            )
        object.__setattr__(self, "control_timestep", round(exact, 9))
        if self.step_variation and self._substeps_range[0] == self.substeps:
            least = math.ceil(1000 / self.substeps) / 1000
            instead = f"0, or at least {least:g}" if least < 1 else "0"
            raise ValueError(
                f"step_variation is {self.step_variation:g} of a control step of {self.control_timestep:g} s, which is "
                f"less than a physics step, {self.physics_timestep:g} s; give {instead}"
            )

    def check_step(self, shortest: float, meanwhile: str) -> None:
        """Raises ValueError for a control step shorter than a limit, s, in which something happens, in words."""
        needed = f"at least {shortest} s, in which {meanwhile}"
        if self.control_timestep < shortest:
            raise ValueError(f"control_timestep is {self.control_timestep} s; give {needed}")
        least = self._substeps_range[0] * self.physics_timestep
        if least < shortest - 1e-9:
            short = f"with which control steps are as short as {least:g} s"
            raise ValueError(f"step_variation is {self.step_variation:g}, {short}; give less, for {needed}")

    @property
    def substeps(self) -> int:
        """Physics steps in a control step."""
        return round(self.control_timestep / self.physics_timestep)

    @property
    def _substeps_range(self) -> tuple[int, int]:
        """The fewest and the most physics steps that an episode's control steps may have."""
        widest = math.floor(self.step_variation * self.substeps + 1e-9)
        return self.substeps - widest, self.substeps + widest

    def draw_substeps(self, seeds: np.ndarray, episodes: np.ndarray) -> np.ndarray:
        """Returns the physics steps in a control step of some episodes, int64 [N]."""
        fewest, most = self._substeps_range
        if fewest == most:
            return np.full(len(seeds), self.substeps)
        return fewest + np.floor(seeding.timings(seeds, episodes) * (most - fewest + 1)).astype(np.int64)

    @property
    def longest_play(self) -> float:
        """How long interactions may last before the last action, where control steps are longest, s."""
        return (self.step_limit - 1) * self._substeps_range[1] * self.physics_timestep

    @property
    def step_limit(self) -> int:
        """Control steps in an unanswered episode."""
        return max(1, math.ceil(self.time_limit / self.control_timestep - 1e-6))
