"""Recording episodes: an observer of the environment loop, and the re-enactment of episodes known by numbers."""

from collections.abc import Mapping, Sequence
import dataclasses
from typing import Any

import mujoco
import numpy as np

from physexp import suite
from physexp.agents import acting, core, environment_loop, networks
from physexp.analysis.training import config as config_lib


@dataclasses.dataclass(frozen=True)
class Things:
    """What moves in a scene, as shapes.

    Attributes:
      names: of K things.
      kinds: `box` or `sphere`.
      sizes: half edges or radii, m, float64 [K, 3].
      colors: float64 [K, 4].
      bodies: which rigid body each belongs to, int64 [K].
    """

    names: tuple[str, ...]
    kinds: tuple[str, ...]
    sizes: np.ndarray
    colors: np.ndarray
    bodies: np.ndarray


@dataclasses.dataclass(frozen=True)
class Episode:
    """One episode of T actions, as it went.

    Attributes:
      domain, task: what was played.
      task_kwargs: that differ from the defaults, without the seed.
      seed, episode: seed of the environment and index of the episode; they rebuild it.
      agent: who played, in words.
      hidden: the hidden property.
      answer: the right label.
      observations: for each name, what was seen before each action and at the end, [T + 1, ...].
      actions: int64 [T].
      rewards: float64 [T].
      policies: probabilities of all actions before each, float64 [T, A]; of no length where the actor has none.
      values: what the actor expected before each action, float64 [T], or of no length.
      things: the shapes in the scene.
      times: when they were where, s, float64 [F].
      positions, rotations: their true poses at every physics step, float64 [F, K, 3] and [F, K, 3, 3].
    """

    domain: str
    task: str
    task_kwargs: dict[str, Any]
    seed: int
    episode: int
    agent: str
    hidden: np.ndarray
    answer: int
    observations: dict[str, np.ndarray]
    actions: np.ndarray
    rewards: np.ndarray
    policies: np.ndarray
    values: np.ndarray
    things: Things
    times: np.ndarray
    positions: np.ndarray
    rotations: np.ndarray


class EpisodeRecorder(environment_loop.Observer):
    """Watches an environment and records each episode.

    While it watches it only keeps what it is shown. The poses of everything at every physics step are found when they
    are asked for: an episode follows from its seed, its index and its actions, so it can be had again.
    """

    def __init__(
        self,
        environment: suite.Environment,
        domain: str,
        task: str,
        task_kwargs: Mapping[str, Any] | None = None,
        actor: core.Actor | None = None,
        agent: str = "",
    ):
        """Prepares to watch.

        Args:
          environment: the environment that is going to be played.
          domain, task, task_kwargs: what it was loaded with.
          actor: who plays it; its `policy` and `value` are recorded where it has them.
          agent: who plays, in words.
        """
        self._environment, self._actor = environment, actor
        chosen = {name: value for name, value in (task_kwargs or {}).items() if name != "random"}
        self._facts: dict[str, Any] = {"domain": domain, "task": task, "agent": agent, "task_kwargs": chosen}
        self._rebuilder: _Rebuilder | None = None

    def observe_first(self, environment, timestep) -> None:
        self._identity = environment.task.options.random, environment.task.episode
        self._seen = [timestep.observation]
        self._actions: list[int] = []
        self._rewards: list[float] = []
        self._policies: list[np.ndarray] = []
        self._values: list[float] = []

    def observe(self, environment, timestep, action) -> None:
        policy = getattr(self._actor, "policy", None)
        if policy is not None:
            self._policies.append(policy)
            self._values.append(getattr(self._actor, "value", np.nan))
        self._seen.append(timestep.observation)
        self._actions.append(int(action))
        self._rewards.append(float(timestep.reward))

    def get_metrics(self) -> dict[str, Any]:
        """Nothing: what was recorded is in `episode`."""
        return {}

    def close(self) -> None:
        """Frees the simulation in which poses are found. Closing twice does nothing."""
        if self._rebuilder is not None:
            self._rebuilder.close()
            self._rebuilder = None

    @property
    def episode(self) -> Episode:
        """The episode so far.

        Raises:
          RuntimeError: if the same seed, index and actions do not show again what was seen.
        """
        if self._rebuilder is None:
            self._rebuilder = _Rebuilder(self._facts["domain"], self._facts["task"], self._facts["task_kwargs"])
        observations = {name: np.stack([seen[name] for seen in self._seen]) for name in self._seen[0]}
        seen_again, rebuilt = self._rebuilder.rebuild(*self._identity, self._actions)
        for name, values in observations.items():
            if not np.array_equal(values, seen_again[name]):
                seed, index = self._identity
                raise RuntimeError(
                    f"episode {index} of seed {seed} is not what was seen: {name} differs; record the "
                    "environment with the task_kwargs that it was loaded with"
                )
        seed, index = self._identity
        return Episode(
            **self._facts,
            seed=seed,
            episode=index,
            observations=observations,
            actions=np.array(self._actions, np.int64),
            rewards=np.array(self._rewards),
            policies=np.array(self._policies),
            values=np.array(self._values),
            **rebuilt,
        )


class _Rebuilder:
    """Plays episodes again and looks closely."""

    def __init__(self, domain: str, task: str, task_kwargs: Mapping[str, Any]):
        self._environment = suite.load(domain, task, task_kwargs=dict(task_kwargs))
        self._environment.add_extra_hook("after_substep", lambda physics, random_state: self._note_poses(physics))

    def close(self) -> None:
        self._environment.close()

    def rebuild(self, seed: int, episode: int, actions: Sequence[int]) -> tuple[dict[str, np.ndarray], dict[str, Any]]:
        """What is seen, by name, and the fields of `Episode` that only the simulation knows."""
        task = self._environment.task
        task.reseed(seed)
        task.next_episode = episode
        timestep = self._environment.reset()
        model = self._environment.physics.model.ptr
        self._geoms = [geom for geom in range(model.ngeom) if model.body_weldid[model.geom_bodyid[geom]] != 0]
        self._poses: list[tuple] = []
        self._note_poses(self._environment.physics)
        seen = [timestep.observation, *(self._environment.step(action).observation for action in actions)]
        times, positions, rotations = (np.array(values) for values in zip(*self._poses, strict=True))
        return {name: np.stack([each[name] for each in seen]) for name in seen[0]}, {
            "hidden": np.array(task.hidden),
            "answer": task.correct_answer,
            "things": _things(model, self._geoms),
            "times": times,
            "positions": positions,
            "rotations": rotations,
        }

    def _note_poses(self, physics) -> None:
        data = physics.data
        self._poses.append((data.time, data.geom_xpos[self._geoms], data.geom_xmat[self._geoms].reshape(-1, 3, 3)))


def _things(model: mujoco.MjModel, geoms: Sequence[int]) -> Things:
    """The shapes of some geoms, named after the entities they belong to."""
    kinds = {int(mujoco.mjtGeom.mjGEOM_BOX): "box", int(mujoco.mjtGeom.mjGEOM_SPHERE): "sphere"}
    sizes = model.geom_size[geoms].copy()
    spheres = model.geom_type[geoms] == mujoco.mjtGeom.mjGEOM_SPHERE
    sizes[spheres] = sizes[spheres, :1]
    return Things(
        names=tuple(model.geom(geom).name.split("/")[-2] for geom in geoms),
        kinds=tuple(kinds[int(model.geom_type[geom])] for geom in geoms),
        sizes=sizes,
        colors=model.geom_rgba[geoms].copy(),
        bodies=model.body_weldid[model.geom_bodyid[geoms]].astype(np.int64),
    )


class Reenactor(core.Actor):
    """Does what was done before, while another actor says what it would think of it."""

    def __init__(self, actor: core.Actor, actions: Sequence[int]):
        """Takes these actions in its first episode, with the beliefs of `actor`."""
        self._actor, self._actions = actor, [int(action) for action in actions]

    def __getattr__(self, name: str):
        """What the other actor tells of itself: `policy`, `value`."""
        return getattr(self._actor, name)

    def observe_first(self, timestep):
        self._left = list(self._actions)
        self._actor.observe_first(timestep)

    def select_action(self, observation) -> int:
        self._actor.select_action(observation)
        return self._left.pop(0)

    def observe(self, action, next_timestep):
        self._actor.observe(action, next_timestep)

    def update(self):
        self._actor.update()


def reenact(
    network: networks.RecurrentActorCritic,
    config: config_lib.TrainConfig,
    seed: int,
    episode: int,
    actions: Sequence[int] | None,
    agent: str = "",
) -> Episode:
    """Plays an episode in the composer environment and records it.

    Args:
      network: of the agent that played it, for its beliefs.
      config: what it plays.
      seed, episode: seed of the environment and index of the episode, as `data.episodes.Episodes` has them.
      actions: what was done in it; None to let the agent do what it likes.
      agent: who played, in words.
    """
    environment = suite.load(config.domain, config.task, task_kwargs={**config.task_kwargs, "random": int(seed)})
    environment.task.next_episode = int(episode)
    actor: core.Actor = acting.RecurrentActor(network)
    if actions is not None:
        actor = Reenactor(actor, actions)
    recorder = EpisodeRecorder(environment, config.domain, config.task, config.task_kwargs, actor, agent)
    environment_loop.EnvironmentLoop(environment, actor, [recorder]).run_episode()
    recorded = recorder.episode
    recorder.close()
    environment.close()
    return recorded
