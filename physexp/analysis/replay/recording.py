"""Films of episodes: an observer of the environment loop, and re-enactment by seed and index."""

from collections.abc import Callable, Mapping, Sequence
import dataclasses
import re
from typing import Any

import mujoco
import numpy as np

from physexp import suite
from physexp.agents import acting, core, environment_loop, networks
from physexp.analysis.data import episodes, readings
from physexp.analysis.replay import observed
from physexp.analysis.training import config as config_lib
from physexp.suite.engine import contract, rendering

_KINDS = ("box", "sphere", "ellipsoid", "cylinder", "capsule")


@dataclasses.dataclass(frozen=True)
class Shapes:
    """The shapes in a scene, without its floor.

    Attributes:
      names: names of K shapes; a thing's first shape has the thing's name.
      kinds: `box`, `sphere`, `ellipsoid`, `cylinder` or `capsule`; other kinds are drawn as their bounding box.
      sizes: half sizes along the shape's axes, without the caps of a capsule, m, float64 [K, 3].
      colors: RGBA, float64 [K, 4].
      are_drawn: whether images show the shape, bool [K].
      are_moving: whether the shape moves in images, bool [K].
      are_placed: whether the shape is still, or the observations determine its position, bool [K].
      geoms: addresses in the compiled model, int64 [K].
    """

    names: tuple[str, ...]
    kinds: tuple[str, ...]
    sizes: np.ndarray
    colors: np.ndarray
    are_drawn: np.ndarray
    are_moving: np.ndarray
    are_placed: np.ndarray
    geoms: np.ndarray


@dataclasses.dataclass(frozen=True, kw_only=True)
class Film(episodes.Episode):
    """A played episode of T actions with the poses of K shapes at F physics steps.

    Attributes:
      domain, task: names of the environment.
      task_kwargs: options that differ from the defaults, without the seed.
      agent: name of the player.
      policies: probabilities of all actions before each action, float64 [T, A]; empty for an actor without a policy.
      values: expected return before each action, float64 [T], or empty.
      beliefs: probabilities of the labels before each action, float64 [T, L], or empty.
      declared: the task, for its declarations.
      shapes: shapes in the scene.
      control_timestep: the task's control step, s, also if `step_variation` hides the episode's own.
      times: times of the physics steps, those that play out the answer included, s, float64 [F]; stretched with
        `step_variation`, so that an action takes `control_timestep`.
      num_played: number of physics steps before the answer.
      positions, rotations: poses that follow from the observations, see `observed.poses`, and true poses while the
        answer is played out, float64 [F, K, 3] and [F, K, 3, 3].
      true_positions, true_rotations: poses in the simulation.
      sizes, true_sizes: half sizes that change, with those poses, m, float64 [F, 3] by address in the model.
      controls: actuator controls of the physics steps, float64 [F, nu].
    """

    domain: str
    task: str
    task_kwargs: dict[str, Any]
    agent: str
    policies: np.ndarray
    values: np.ndarray
    beliefs: np.ndarray
    declared: contract.Task
    shapes: Shapes
    control_timestep: float
    times: np.ndarray
    num_played: int
    positions: np.ndarray
    rotations: np.ndarray
    true_positions: np.ndarray
    true_rotations: np.ndarray
    sizes: observed.Sizes
    true_sizes: observed.Sizes
    controls: np.ndarray


class EpisodeRecorder(episodes.Recorder):
    """Records each episode of an environment, for a replay.

    The recorder keeps timesteps and actions. Poses are computed on demand by playing the episode again from its seed,
    index and actions.
    """

    def __init__(
        self,
        domain: str,
        task: str,
        task_kwargs: Mapping[str, Any] | None = None,
        actor: core.Actor | None = None,
        agent: str = "",
        make_task: Callable[..., contract.Task] | None = None,
    ):
        """Prepares to record.

        Args:
          domain, task, task_kwargs: arguments that the environment was loaded with.
          actor: player, whose `policy`, `value` and `belief` are recorded if it has them.
          agent: name of the player.
          make_task: makes the task from its options, if `suite.load` does not know it.
        """
        self._actor = actor
        self._make_task = make_task or (lambda **options: suite.load_task(domain, task, options))
        chosen = {name: value for name, value in (task_kwargs or {}).items() if name != "random"}
        self._facts: dict[str, Any] = {"domain": domain, "task": task, "agent": agent, "task_kwargs": chosen}
        self._rebuilder: _Rebuilder | None = None

    def observe_first(self, environment, timestep) -> None:
        super().observe_first(environment, timestep)
        self._policies: list[np.ndarray] = []
        self._values: list[float] = []
        self._beliefs: list[np.ndarray] = []

    def observe(self, environment, timestep, action) -> None:
        super().observe(environment, timestep, action)
        policy = getattr(self._actor, "policy", None)
        if policy is not None:
            self._policies.append(policy)
            self._values.append(getattr(self._actor, "value", np.nan))
        belief = getattr(self._actor, "belief", None)
        if belief is not None:
            self._beliefs.append(belief)

    def close(self) -> None:
        """Frees the simulation that computes poses."""
        if self._rebuilder is not None:
            self._rebuilder.environment.close()
            self._rebuilder = None

    @property
    def episode(self) -> Film:
        """The episode so far, with its poses; raises RuntimeError if playing it again leads to other observations."""
        if self._rebuilder is None:
            self._rebuilder = _Rebuilder(self._make_task(**self._facts["task_kwargs"]))
        played = super().episode
        return Film(
            **vars(played),
            **self._facts,
            policies=np.array(self._policies),
            values=np.array(self._values),
            beliefs=np.array(self._beliefs),
            **self._rebuilder.rebuild(played),
        )


class _Rebuilder:
    """Plays episodes again and records all poses."""

    def __init__(self, task: contract.Task):
        self.environment = suite.Environment(task)
        self.environment.add_extra_hook("after_substep", lambda physics, random_state: self._note_poses(physics))

    def rebuild(self, episode: episodes.Episode) -> dict[str, Any]:
        """Returns the fields of `Film` that need the simulation."""
        task, actions = self.environment.task, episode.actions.tolist()
        task.reseed(episode.seed)
        task.next_episode = episode.index
        seen = [self.environment.reset().observation]
        self._poses: list[tuple] = []
        self._note_poses(self.environment.physics)
        ends = [0]
        for action in actions:
            seen.append(self.environment.step(action).observation)
            ends.append(len(self._poses) - 1)
        for name, values in episode.observations.items():
            if not (name in seen[0] and np.array_equal(values, [each[name] for each in seen])):
                raise RuntimeError(
                    f"episode {episode.index} of seed {episode.seed} is not what was seen: {name} differs; record the "
                    "environment with the task_kwargs that it was loaded with"
                )
        if task.answered:
            for _ in task.play_out(self.environment.physics, actions[-1] - task.num_interactions):
                self._note_poses(self.environment.physics)
        model, room = task.apparatus.model, task.root_entity
        geoms = _geoms(model, [model.geom(geom.full_identifier).id for geom in (room.floor, room.mat)])
        *poses, all_sizes = zip(*self._poses, strict=True)
        times, positions, rotations, controls = map(np.array, poses)
        positions, rotations = positions[:, geoms], rotations[:, geoms]
        seen_poses, seen_sizes = observed.poses(task, geoms, episode.observations, ends)
        seen_positions, seen_rotations, are_placed = seen_poses
        sizes = {geom: np.concatenate([each[geom] for each in all_sizes]) for geom in all_sizes[0]}
        after = ends[-1] + 1
        return {
            "declared": task,
            "shapes": _shapes(model, geoms, np.isin(geoms, task.apparatus.moving_geoms), are_placed),
            "control_timestep": task.options.control_timestep,
            "times": times * (task.options.control_timestep / task.control_timestep),
            "num_played": ends[-1],
            "positions": np.concatenate([seen_positions, positions[after:]]),
            "rotations": np.concatenate([seen_rotations, rotations[after:]]),
            "true_positions": positions,
            "true_rotations": rotations,
            "sizes": {geom: np.concatenate([told, sizes[geom][after:]]) for geom, told in seen_sizes.items()},
            "true_sizes": sizes,
            "controls": controls,
        }

    def _note_poses(self, physics) -> None:
        data, model = physics.data, physics.model
        positions = data.geom_xpos.copy()
        apparatus, sensordata = self.environment.task.apparatus, self.environment.task.sensed(data.sensordata)
        apparatus.indicate(positions[None], sensordata)
        is_simulated = model.body_weldid[model.geom_bodyid] != 0
        positions[is_simulated] = data.geom_xpos[is_simulated]  # Even if images show them where a reading places them.
        rotations, sizes = data.geom_xmat.reshape(-1, 3, 3).copy(), apparatus.sizes(sensordata)
        self._poses.append((data.time, positions, rotations, data.ctrl.copy(), sizes))


def _geoms(model: mujoco.MjModel, floor: Sequence[int]) -> np.ndarray:
    """Returns the addresses of all geoms that move or are drawn, without the floor."""
    are_drawn = model.geom_group != rendering.UNDRAWN_GROUP
    geoms = np.setdiff1d(np.flatnonzero(are_drawn | (model.body_weldid[model.geom_bodyid] != 0)), floor)
    return geoms[np.argsort(~are_drawn[geoms], kind="stable")]  # A visible shape takes the thing's name.


def _shapes(model: mujoco.MjModel, geoms: np.ndarray, are_moving: np.ndarray, are_placed: np.ndarray) -> Shapes:
    """Returns the shapes of some geoms."""
    kinds = [mujoco.mjtGeom(kind).name.removeprefix("mjGEOM_").lower() for kind in model.geom_type[geoms]]
    kinds = [kind if kind in _KINDS else "box" for kind in kinds]
    return Shapes(
        names=_names([model.geom(geom).name for geom in geoms]),
        kinds=tuple(kinds),
        sizes=np.array([_half_sizes(kind, size) for kind, size in zip(kinds, model.geom_size[geoms], strict=True)]),
        colors=model.geom_rgba[geoms].copy(),
        are_drawn=model.geom_group[geoms] != rendering.UNDRAWN_GROUP,
        are_moving=are_moving,
        are_placed=are_placed,
        geoms=geoms,
    )


def _names(identifiers: Sequence[str]) -> tuple[str, ...]:
    """Returns unique names: an entity's first geom has the entity's name."""
    names: list[str] = []
    for identifier in identifiers:
        name = readings.owner(identifier)
        names.append(re.sub(r"\W+", "_", identifier) if name in names else name)
    return tuple(names)


def _half_sizes(kind: str, size: np.ndarray) -> np.ndarray:
    """Returns the half sizes of a geom along its axes, (3,), from MuJoCo's `geom_size`."""
    if kind == "sphere":
        return size[[0, 0, 0]]
    if kind in ("cylinder", "capsule"):
        return size[[0, 0, 1]]
    return size.copy()


class _Beside(environment_loop.Repeat):
    """Repeats actions, and lets another actor choose and observe beside them."""

    def __init__(self, actor: core.Actor, actions: Sequence[int]):
        super().__init__(actions)
        self._actor = actor

    def observe_first(self, timestep):
        super().observe_first(timestep)
        self._actor.observe_first(timestep)

    def select_action(self, observation):
        self._actor.select_action(observation)
        return super().select_action(observation)

    def observe(self, action, next_timestep):
        super().observe(action, next_timestep)
        self._actor.observe(action, next_timestep)


def reenact(
    network: networks.RecurrentNetwork,
    config: config_lib.TrainConfig,
    seed: int,
    index: int,
    actions: Sequence[int] | None,
    agent: str = "",
) -> Film:
    """Plays an episode in the composer environment and records it; `actions` are None for the agent's own."""
    environment = suite.load(config.domain, config.task, task_kwargs={**config.task_kwargs, "random": seed})
    environment.task.next_episode = index
    actor = acting.RecurrentActor(network)
    recorder = EpisodeRecorder(config.domain, config.task, config.task_kwargs, actor, agent)
    player = actor if actions is None else _Beside(actor, actions)
    environment_loop.EnvironmentLoop(environment, player, [recorder]).run_episode()
    recorded = recorder.episode
    recorder.close()
    environment.close()
    return recorded
