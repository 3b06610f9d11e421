"""Which is Bolted: one of three blocks is bolted to the floor, and only pulling tells which."""

import dataclasses

import numpy as np

from physexp.suite.engine import contract, declarations, options, seeding
from physexp.suite.parts import arena, things

NUM_BLOCKS = 3
SPACING = 0.16  # m
PULL_FORCE = 5.0  # N
ROOM = dict(mat_size=[0.3, 0.12], camera_pos=[0, -2.6, 0.9], camera_target=[0, 0, 0.2], fovy=14.5)


@dataclasses.dataclass(frozen=True, kw_only=True)
class Options(options.Options):
    """What a user may choose; `physics_timestep` and `time_limit` are the task's own."""

    physics_timestep = 0.025  # s

    time_limit: float = 2.0  # s


class WhichIsBolted(contract.Task):
    """Three blocks that rise when they are pulled, but for one."""

    question = "Which block is bolted to the floor?"
    largest_hidden = NUM_BLOCKS - 1

    def build(self):
        """Returns the scene, with what actions do and what is seen."""
        room = arena.Laboratory(**ROOM, contact=False, gravity=False)
        self._rails, heights = [], []
        for k in range(NUM_BLOCKS):
            cube = things.Block(rgba=things.COLORS[k], mass=1.0, name=f"block_{k}")
            place = [(k - (NUM_BLOCKS - 1) / 2) * SPACING, 0, things.HALF_SIZE]
            rail = room.put_on_rail(cube, place, [0, 0, 1], stiffness=20, damping=10)
            room.add_actuator(f"pull_{k}", rail)
            heights.append(room.mjcf_model.sensor.add("jointpos", name=f"height_{k}", joint=rail))
            self._rails.append(rail)
        return contract.Scene(
            arena=room,
            interactions=[
                declarations.Interaction(f"pull block {k}", control, f"block_{k}", (0.0, 0.0, PULL_FORCE))
                for k, control in enumerate(PULL_FORCE * np.eye(NUM_BLOCKS))
            ],
            readings={
                "heights": declarations.Reading(
                    heights, (NUM_BLOCKS,), "how far each block is above its rest", unit="m", noisy=True
                )
            },
            label_names=[f"block {k} is bolted" for k in range(NUM_BLOCKS)],
            num_structures=NUM_BLOCKS,  # The bolt is compiled in: one model for each answer.
        )

    # The hidden property: a pure function of seed and episode, for one environment and for thousands.

    def draw(self, seeds, episodes):
        return (NUM_BLOCKS * seeding.uniforms(seeds, episodes, 1)[:, 0]).astype(np.int64)

    def answers(self, hidden):
        return hidden

    def structures(self, hidden):
        return hidden

    def arrange(self, structure):
        for k, rail in enumerate(self._rails):
            rail.damping = 1e6 if k == structure else 10  # N s/m

    def reveal(self, hidden):
        return declarations.Revealed(marks={f"block_{int(hidden)}": "bolted"})


def features(random=None, **options):
    """The task with features: `heights`, float32 (3,), m."""
    return WhichIsBolted(Options(random=random, **options))


def pixels(random=None, **options):
    """The task with images: `pixels`, uint8 (84, 84, 3)."""
    return WhichIsBolted(Options(random=random, **options), pixels=True)
