"""Which is Loose: four covered blocks, of which friction holds all but one, and flags that tell which has moved."""

import dataclasses

import numpy as np

from physexp import checks
from physexp.suite.engine import apparatus, contract, declarations, options, rendering, seeding
from physexp.suite.parts import arena, material, measures, things

PHYSICS_TIMESTEP = 0.01  # s
NUM_BLOCKS = 4
SPACING = 0.16  # m
PULL = 8.0  # N: takes the loose block several centimetres from home, and friction holds the others
FRICTION = 20.0  # N
AWAY = 0.005  # m, the distance from home that is read
ROOM = dict(mat_size=[0.4, 0.2], camera_pos=[0, -2.6, 0.9], camera_target=[0, 0, 0.1], fovy=17)
PRIOR = np.full(NUM_BLOCKS, 1 / NUM_BLOCKS)


@dataclasses.dataclass(frozen=True, kw_only=True)
class Options(options.Options):
    """The `task_kwargs` of this domain."""

    physics_timestep = PHYSICS_TIMESTEP

    time_limit: float = 1.5
    rail_stiffness: float = checks.checked(60.0, checks.within(20, 100, "N/m"), help="of each block's spring, N/m")


def _is_away(positions):
    """Returns 1 for each block that is away from home and 0 for the others, from positions, m [N, NUM_BLOCKS]."""
    return (np.abs(positions) > AWAY).astype(float)


class WhichIsLoose(contract.Task):
    """Four covered blocks on rails with dry friction."""

    question = "Which block is loose?"
    largest_hidden = NUM_BLOCKS - 1

    def build(self):
        """Returns the scene."""
        room = arena.Laboratory(**ROOM, contact=False)
        room.add_cover((0.36, 0.1, 0.06))
        spring = dict(stiffness=self.options.rail_stiffness, damping=2.0, **material.dry_friction(PHYSICS_TIMESTEP))
        rails, positions, flags = [], [], []
        for k in range(NUM_BLOCKS):
            x = (k - (NUM_BLOCKS - 1) / 2) * SPACING
            cube = things.Block(things.COLORS[k], mass=0.02, name=f"block_{k}")
            cube.geom.group = rendering.UNDRAWN_GROUP
            rails.append(room.put_on_rail(cube, [x, 0, things.HALF_SIZE], [0, 1, 0], **spring))
            room.add_actuator(f"pull_{k}", rails[-1])
            positions.append(room.mjcf_model.sensor.add("jointpos", name=f"position_{k}", joint=rails[-1]))
            flags.append(things.stand_flag(room, f"flag_{k}", things.COLORS[k], (x, 0.15), "away", (0, 0, 0.2), k))
        self._rails = tuple(rail.full_identifier for rail in rails)
        meaning = "1 for each block that is away from home, 0 for the others"
        return contract.Scene(
            arena=room,
            interactions=[
                declarations.Interaction(f"pull block {k}", control, f"block_{k}", (0.0, PULL, 0.0))
                for k, control in enumerate(PULL * np.eye(NUM_BLOCKS))
            ],
            label_names=[f"block {k} is loose" for k in range(NUM_BLOCKS)],
            readings={"away": measures.coarse(positions, meaning, _is_away, size=NUM_BLOCKS)},
            indicators=flags,
        )

    def draw(self, seeds, episodes):
        """Returns the index of the loose block, int64 [N]."""
        return (NUM_BLOCKS * seeding.uniforms(seeds, episodes, 1)[:, 0]).astype(np.int64)

    def answers(self, hidden):
        return hidden

    def hidden_fields(self, apparatus_, hidden):
        newtons = np.where(np.arange(NUM_BLOCKS) == hidden[:, None], 0.0, FRICTION)
        return apparatus.frictions(apparatus_, self._rails, newtons)

    def reveal(self, hidden):
        return declarations.Revealed(marks={f"block_{int(hidden)}": "loose"})


SUITE = contract.features_and_pixels(WhichIsLoose)
