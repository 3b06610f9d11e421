"""Which is Heavier: equal blocks, and the question which of them is heaviest (paper, Section 5)."""

import dataclasses
from typing import Any

import numpy as np

from physexp import checks
from physexp.checks import checked
from physexp.suite.engine import apparatus as apparatus_lib
from physexp.suite.engine import contract, declarations, priors
from physexp.suite.engine import options as options_lib
from physexp.suite.parts import arena, things

NUM_BLOCKS = 4  # By default, the paper's.
SPACING = 0.16  # m, between the centres of neighbours

PHYSICS_TIMESTEP = 0.025  # s; the paper's example: four simulation steps to a control step

# A block slides on a vertical rail, with no gravity: a spring and a damper bring it back. Both vanish exactly at
# rest, whatever the mass, and no contact solver joins one block to another, so nothing tells of a mass before its
# block is poked. Even the heaviest block is critically damped (damping >= 2 sqrt(stiffness * mass)), so no block
# ever sinks below its rest. One poke lifts the lightest block almost to the ceiling, where the rail ends.
LIGHTEST, HEAVIEST = 0.2, 1.0  # kg
STIFFNESS = 6.25  # N/m
DAMPING = 5.0  # N s/m
POKE_FORCE = 20.0  # N
FLOOR, CEILING = -0.01, 0.4  # m, displacements from rest at which the rail ends

FORCE_VARIATION, SPACING_VARIATION = 0.1, 0.1  # Shares of their values without variation.

# With more blocks the mat is longer and the camera farther away.
_MAT_SIZE, _CAMERA_POS = np.array([0.36, 0.12]), np.array([0, -2.6, 0.9])  # m
_VIEW = dict(camera_target=[0, 0, 0.28], fovy=14.5)
# The second six are paler than the first.
_COLORS = (*things.COLORS, *((*(0.5 + value / 2 for value in color[:3]), 1.0) for color in things.COLORS))


@dataclasses.dataclass(frozen=True, kw_only=True)
class Options(options_lib.Options):
    """The `task_kwargs` of this domain."""

    physics_timestep = PHYSICS_TIMESTEP

    time_limit: float = 10.0  # 100 control steps (Section 5.1)
    difficulty: float = checked(  # By default, the middle one of the paper's three.
        5.0, checks.at_least(1, "the paper's beta"), help="the paper's beta, >= 1; the larger, the easier"
    )
    num_blocks: int = checked(
        NUM_BLOCKS, checks.whole(2, len(_COLORS)), help="the number of blocks, 2 to 12; the more, the harder"
    )


class WhichIsHeavier(contract.Task):
    """Blocks in a line that move only vertically; their masses are hidden."""

    options: Options
    question = "Which block is heaviest?"

    def build(self) -> contract.Scene:
        count = self.options.num_blocks
        scale = count / NUM_BLOCKS
        room = arena.Laboratory(
            mat_size=_MAT_SIZE * [scale, 1], camera_pos=_CAMERA_POS * scale, **_VIEW, contact=False, gravity=False
        )
        spring = dict(stiffness=STIFFNESS, damping=DAMPING, limited=True, range=[FLOOR, CEILING])
        rails, heights = [], []
        for k in range(count):
            cube = things.Block(rgba=_COLORS[k], mass=HEAVIEST, name=f"block_{k}")
            place = [(k - (count - 1) / 2) * SPACING, 0, things.HALF_SIZE]
            rails.append(room.put_on_rail(cube, place, [0, 0, 1], **spring))
            room.mjcf_model.actuator.add("motor", name=f"poke_{k}", joint=rails[-1])
            heights.append(room.mjcf_model.sensor.add("jointpos", name=f"height_{k}", joint=rails[-1]))
        self._rails = tuple(rail.full_identifier for rail in rails)
        bounds = FLOOR, highest(POKE_FORCE * (1 + FORCE_VARIATION * self.options.variation))
        meaning = "how far each block is above its rest"
        return contract.Scene(
            arena=room,
            interactions=[
                declarations.Interaction(f"poke block {k}", control, f"block_{k}", (0.0, 0.0, POKE_FORCE))
                for k, control in enumerate(POKE_FORCE * np.eye(count))
            ],
            label_names=[f"block {k} is heaviest" for k in range(count)],
            readings={"heights": declarations.Reading(heights, (count,), meaning, "m", bounds=bounds, noisy=True)},
            num_nuisances=5,
        )

    @property
    def description(self) -> str:
        return (
            "Equal-looking blocks stand side by side, each on a vertical rail of its own, without gravity. A spring "
            f"brings each back to its rest. A poke pushes one block up with {POKE_FORCE:g} N for one step; the heavier "
            "the block, the less it rises. It sinks back during the next steps. Blocks do not touch one another. Their "
            f"masses are between {LIGHTEST:g} and {HEAVIEST:g} kg: one is probably heavy, the others are probably "
            "light, and each block is equally likely to be the heaviest."
        )

    largest_hidden = 1.0

    def draw(self, seeds: np.ndarray, episodes: np.ndarray) -> np.ndarray:
        """Returns masses on the paper's scale, float64 [N, K] in [0, 1]; to kilograms: `kilograms`."""
        return prior(self.options.difficulty, self.options.num_blocks).draw(seeds, episodes)

    def answers(self, hidden: np.ndarray) -> np.ndarray:
        return hidden.argmax(axis=1)

    def hidden_fields(self, apparatus: apparatus_lib.Apparatus, hidden: np.ndarray) -> declarations.Fields:
        return apparatus_lib.slide_masses(apparatus, self._rails, kilograms(hidden))

    def circumstances(self, apparatus: apparatus_lib.Apparatus, nuisances: np.ndarray) -> declarations.Circumstances:
        """Varies the force of pokes, and for images the space between the blocks and where the camera is."""
        strength = 1 + FORCE_VARIATION * nuisances[:, :1]
        if not self.pixels:
            return declarations.Circumstances(strength=strength)
        _, bodies = apparatus.dofs(self._rails)
        places = np.repeat(apparatus.model.body_pos[None, bodies], len(nuisances), axis=0)
        places[:, :, 0] *= 1 + SPACING_VARIATION * nuisances[:, 1:2]
        camera = contract.CAMERA_VARIATION * nuisances[:, 2:]
        return declarations.Circumstances({"body_pos": (bodies, places)}, strength=strength, camera=camera)

    def reveal(self, hidden: np.ndarray) -> declarations.Revealed:
        """Returns the blocks' masses."""
        return declarations.Revealed(marks={f"block_{k}": f"{mass:.2f} kg" for k, mass in enumerate(kilograms(hidden))})

    def hardness(self, hidden: np.ndarray) -> np.ndarray:
        """Returns how near the two heaviest blocks are: the smaller the mass gap, the harder."""
        return -mass_gaps(hidden)


def highest(force: float) -> float:
    """Returns the greatest height that a poke of a force, N, can reach, m.

    A block rises by at most force / damping in a second. So it passes the rail's end by one physics step at that speed
    before it feels it, and by less than another one before it is stopped.
    """
    return CEILING + 2 * force / DAMPING * PHYSICS_TIMESTEP


def kilograms(masses: Any) -> Any:
    """Maps the paper's masses in [0, 1] linearly to what the agent's strength can lift, kg."""
    return LIGHTEST + (HEAVIEST - LIGHTEST) * masses


def prior(difficulty: float, num_blocks: int = NUM_BLOCKS) -> priors.OddOneOut:
    """Returns the prior of the masses: Beta(difficulty, 1) for one block, Beta(1, difficulty) for the others."""
    return priors.OddOneOut(num_blocks, difficulty)


def draw_masses(seeds: np.ndarray, episodes: np.ndarray, difficulty: float) -> np.ndarray:
    """Returns the masses of some episodes (paper, Section 5.1), float64 [N, 4] in [0, 1]."""
    return prior(difficulty).draw(seeds, episodes)


def mass_gaps(masses: np.ndarray) -> np.ndarray:
    """Returns by how much the heaviest block is heavier than the second, [N], of masses [N, K] in [0, 1]."""
    return priors.gaps(masses)


SUITE = contract.features_and_pixels(WhichIsHeavier)
