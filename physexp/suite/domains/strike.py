"""Strike: a puck that may be poked in a bay, and the question with which strike it stops in the goal."""

from collections.abc import Iterator
import dataclasses
import itertools
from typing import Any

import numpy as np

from physexp import checks
from physexp.checks import checked
from physexp.suite.engine import apparatus as apparatus_lib
from physexp.suite.engine import contract, declarations, seeding
from physexp.suite.engine import options as options_lib
from physexp.suite.parts import arena, material, measures, things

PHYSICS_TIMESTEP = 0.01  # s

# A puck with dry friction lies at the end of a covered bay, behind a barrier. Pokes last one control step, and only the
# last light gate that the puck has passed can be read: read to a millimetre, a single poke would tell nearly all.
STRIKE_SECONDS = 0.1  # How long a strike pushes.
POKES = (1.0, 3.0, 9.0)  # N
RATIO = 1.5  # Between the forces of neighbouring strikes, and from the goal's middle to either of its ends.
STRIKES = tuple(8.0 * RATIO ** (k - 3) for k in range(7))  # N
BAY = 0.3  # m, from the puck to the barrier
GATES = {1: 5, 2: 10, 3: 15}  # By difficulty.

_GRAVITY = 9.81  # m/s^2
_FRICTIONS = np.geomspace(0.1, 0.4, 5)  # Coefficients.
_PLACES = np.geomspace(RATIO**-0.75, RATIO**0.75, 4)  # Reach of the right strike, in goal distances.
PUCKS = tuple(itertools.product(range(len(STRIKES)), _FRICTIONS, _PLACES))
"""All possible pucks, by the right strike, the friction, and the reach of that strike."""
PRIOR = np.full(len(PUCKS), 1 / len(PUCKS))

_FRICTION, _BARRIER = material.dry_friction(PHYSICS_TIMESTEP), material.stop(PHYSICS_TIMESTEP)

_START = -0.55  # m, where the puck lies along x
_LANE = 1.2  # m, from there to the end of the lane
_ROOM = dict(mat_size=[0.72, 0.32], camera_pos=[0, -2.8, 1.7], camera_target=[0, 0, 0.1], fovy=25.0)
# m. Those that are poked hardest pass the barrier by 0.054 m before it stops them.
_COVER_X, _COVER_HALF_SIZE = _START + 0.175, (0.225, 0.06, 0.04)
_GOAL_RGBA = (0.60, 0.78, 0.62, 1.0)
_POKE_Y, _POKE_TRAVEL = -0.22, (0.8, 0, 0)  # m, of the board that shows how strong the last poke was
_GATE_Y, _GATE_TRAVEL = 0.3, 1.0  # m, of the board that shows the last gate
_MARKS = (0.0, 0.2, 0.4, 0.6, 0.8, 1.0)  # m, from where the puck lies: those of the lane that people see
_MARK_Y, _MARK_HALF_SIZE, _MARK_RGBA = -0.13, (0.001, 0.02, 0.001), (0.55, 0.52, 0.47, 1.0)  # m
_PLAYED_OUT = 2.5  # s, in which every strike comes to its end


@dataclasses.dataclass(frozen=True, kw_only=True)
class Options(options_lib.Options):
    """The `task_kwargs` of this domain."""

    physics_timestep = PHYSICS_TIMESTEP

    time_limit: float = 0.9  # the longer, the less it costs never to answer
    difficulty: float = checked(
        2.0,
        checks.among(*GATES),
        help="1, 2 or 3: how finely pokes are read, by 5, 10 or 15 light gates; the larger, the easier",
    )
    goal_distance: float = checked(
        0.7, checks.within(0.6, 0.75, "m"), help="distance from the puck to the middle of the goal, 0.6 to 0.75 m"
    )


def properties(pucks: np.ndarray, goal_distance: float) -> tuple[np.ndarray, np.ndarray]:
    """Returns masses, kg, and forces of friction, N, float64 [N] each, of pucks: indices of `PUCKS`, int [N].

    A force F that pushes for a time T takes a puck of mass m by `s = mu g T^2 p (p - 1) / 2`, with p = F / (m mu g). So
    the mass follows from the distance that the right strike must take it.
    """
    strikes, frictions, places = np.array(PUCKS)[pucks].T
    forces = np.array(STRIKES)[strikes.astype(int)]
    decelerations = frictions * _GRAVITY
    ratios = (1 + np.sqrt(1 + 8 * places * goal_distance / (decelerations * STRIKE_SECONDS**2))) / 2
    return forces / (ratios * decelerations), forces / ratios


class Strike(contract.Task):
    """A covered puck on a lane, a barrier, light gates before it, and a goal behind it."""

    options: Options
    question = "With which strike does the puck stop in the goal?"

    def build(self) -> contract.Scene:
        self._num_gates = GATES[int(self.options.difficulty)]
        room = arena.Laboratory(**_ROOM, contact=False, gravity=False)
        near, far = self.options.goal_distance / RATIO, self.options.goal_distance * RATIO
        room.add_cover(_COVER_HALF_SIZE, _COVER_X)
        room.add_scenery("goal", [(far - near) / 2, 0.1, 0.001], [_START + (near + far) / 2, 0, 0.002], _GOAL_RGBA)
        marks = [
            declarations.Staged(
                room.add_scenery(
                    f"mark_{k}", _MARK_HALF_SIZE, [_START + place, _MARK_Y, 0], _MARK_RGBA, is_drawn=False
                ),
                text=f"{place:g} m",
            )
            for k, place in enumerate(_MARKS)
        ]
        struck = things.puck(things.COLORS[0], mass=1.0)
        limits = dict(limited=True, range=[0, BAY], **_FRICTION, **_BARRIER)
        rail = room.put_on_rail(struck, [_START, 0, 0.01 + things.PUCK_HALF_HEIGHT], [1, 0, 0], **limits)
        self._rails = (rail.full_identifier,)
        position = room.mjcf_model.sensor.add("jointpos", name="position", joint=rail)
        force = room.add_actuator("poke", rail)
        gate_travel = (_GATE_TRAVEL / self._num_gates, 0, 0)
        gate_meaning = "the last light gate that the puck has passed, counted from 1; 0 for none"
        return contract.Scene(
            arena=room,
            interactions=[
                declarations.Interaction(f"poke with {newtons:g} N", np.array([newtons]), "puck", (newtons, 0.0, 0.0))
                for newtons in POKES
            ],
            label_names=[f"{newtons:.1f} N" for newtons in STRIKES],
            readings={
                "strength": measures.strength(force, "poke", max(POKES)),
                "gate": measures.coarse([position], gate_meaning, self._gate, (0, self._num_gates)),
            },
            indicators=[
                things.stand_flag(room, "strength", things.COLORS[2], (_START, _POKE_Y), "strength", _POKE_TRAVEL),
                things.stand_flag(room, "gate", things.COLORS[3], (_START, _GATE_Y), "gate", gate_travel),
            ],
            staged=marks,
        )

    @property
    def description(self) -> str:
        distance = self.options.goal_distance
        return (
            f"A puck with dry friction lies at the end of a covered bay, {BAY:g} m from a barrier. A poke pushes it "
            "towards the barrier for one step; it slides on until friction or the barrier stops it, and is not put "
            f"back. {self._num_gates} light gates are evenly spaced, up to the barrier. For the answer the "
            "puck is put back, the barrier is opened, and the puck is struck with that force for "
            f"{STRIKE_SECONDS:g} s: the goal begins {distance / RATIO:.3g} m from where it lies, and ends at "
            f"{distance * RATIO:.3g} m. Mass and friction are hidden; the coefficient of friction is "
            f"{_FRICTIONS[0]:g} to {_FRICTIONS[-1]:g}. All strikes are equally likely."
        )

    def _gate(self, positions: np.ndarray) -> np.ndarray:
        """Returns the last light gate that the puck has passed, from its position, m [N, 1]; 0 for none."""
        return np.clip(np.floor(positions / (BAY / self._num_gates)), 0, self._num_gates)

    largest_hidden = len(PUCKS) - 1

    def draw(self, seeds: np.ndarray, episodes: np.ndarray) -> np.ndarray:
        """Returns the pucks of some episodes: indices of `PUCKS`, int64 [N]."""
        return (len(PUCKS) * seeding.uniforms(seeds, episodes, 1)[:, 0]).astype(np.int64)

    def answers(self, hidden: np.ndarray) -> np.ndarray:
        return np.array([strike for strike, *_ in PUCKS])[hidden]

    def hidden_fields(self, apparatus: apparatus_lib.Apparatus, hidden: np.ndarray) -> declarations.Fields:
        masses, frictions = (values[:, None] for values in properties(hidden, self.options.goal_distance))
        return {
            **apparatus_lib.slide_masses(apparatus, self._rails, masses),
            **apparatus_lib.frictions(apparatus, self._rails, frictions),
        }

    def reveal(self, hidden: np.ndarray) -> declarations.Revealed:
        ((mass,), (friction,)) = properties(np.array([hidden]), self.options.goal_distance)
        return declarations.Revealed(marks={"puck": f"{mass:.2f} kg, friction {friction:.1f} N"})

    def play_out(self, physics: Any, label: int) -> Iterator[None]:
        """Puts the puck back, opens the barrier, and strikes; the end of the lane catches the puck."""
        joint = physics.model.name2id(self._rails[0], "joint")
        barrier = physics.model.jnt_range[joint].copy()
        try:
            physics.model.jnt_range[joint] = 0, np.inf
            physics.data.qpos[:], physics.data.qvel[:] = 0, 0
            for step in range(round(_PLAYED_OUT / PHYSICS_TIMESTEP)):
                physics.data.ctrl[:] = STRIKES[label] if step < round(STRIKE_SECONDS / PHYSICS_TIMESTEP) else 0
                physics.step()
                yield
                if physics.data.qpos[0] >= _LANE:
                    return
        finally:
            physics.model.jnt_range[joint] = barrier


SUITE = contract.features_and_pixels(Strike)
