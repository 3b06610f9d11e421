"""Evaluation: plays episodes with a trained agent and measures how well it answers."""

from collections.abc import Callable, Mapping, Sequence
import dataclasses
import functools
from pathlib import Path
from typing import Any

import numpy as np
import torch

from physexp import suite
from physexp.agents import acting, devices, networks, pretrained
from physexp.agents import agent as agent_lib
from physexp.analysis.data import estimates
from physexp.analysis.training import config as config_lib
from physexp.analysis.training import run as run_lib
from physexp.analysis.training import trainer

SEED = 1_000_003  # Of the evaluation's environments, apart from those of training.
INTERACTIONS = ("learned", "random")
_BATCH = 256


@dataclasses.dataclass(frozen=True)
class Episodes:
    """What happened in many episodes.

    Attributes:
      seeds, numbers: seed of the environment and index of the episode, int64 [N] each: together they rebuild it.
      hidden: the hidden property, [N, ...].
      answers: the right labels, int64 [N].
      labels: the labels given, -1 where time ran out, int64 [N].
      rewards: final rewards, float64 [N].
      lengths: actions in each episode, int64 [N].
      interactions: interaction actions in each episode, int64 [N].
      actions: the actions of each episode, N arrays int64 [length].
    """

    seeds: np.ndarray
    numbers: np.ndarray
    hidden: np.ndarray
    answers: np.ndarray
    labels: np.ndarray
    rewards: np.ndarray
    lengths: np.ndarray
    interactions: np.ndarray
    actions: list[np.ndarray]

    @classmethod
    def of_round(cls, episodes: acting.Round, environment, number: int) -> "Episodes":
        """The episodes of a round that has just been played in the environments of a batch, all with this index."""
        columns = trainer.episode_columns(episodes, environment.task.num_interactions)
        return cls(
            seeds=environment.seeds,
            numbers=np.full(environment.num_environments, number),
            hidden=environment.hidden,
            answers=episodes.answers,
            labels=np.array(columns["label"]),
            rewards=episodes.rewards.sum(axis=0, dtype=np.float64),
            lengths=episodes.lengths,
            interactions=trainer.interaction_counts(episodes, environment.task.num_interactions),
            actions=[np.array(actions) for actions in columns["actions"]],
        )

    @classmethod
    def joined(cls, parts: "Sequence[Episodes]") -> "Episodes":
        """The episodes of all parts, one after the other."""
        columns: dict[str, Any] = {}
        for field in dataclasses.fields(cls):
            values: list[Any] = [getattr(part, field.name) for part in parts]
            columns[field.name] = sum(values, []) if field.name == "actions" else np.concatenate(values)
        return cls(**columns)

    def first(self, count: int) -> "Episodes":
        """The first episodes."""
        return Episodes(*(getattr(self, field.name)[:count] for field in dataclasses.fields(self)))

    def summary(self, discount: float) -> dict:
        """The figures of `physexp evaluate`; the interval is Wilson's, at 95 %."""
        right = int((self.rewards > 0).sum())
        return {
            "episodes": len(self.rewards),
            "success_rate": right / len(self.rewards),
            "success_interval": list(estimates.wilson_interval(right, len(self.rewards))),
            "mean_return": float((self.rewards * discount ** (self.lengths - 1)).mean()),
            "mean_interactions": float(self.interactions.mean()),
            "median_interactions": float(np.median(self.interactions)),
            "timeouts": int((self.interactions == self.lengths).sum()),
        }


def load_network(run: run_lib.Run) -> networks.RecurrentActorCritic:
    """The network that a run has trained.

    Raises:
      ValueError: if there is none yet, or its files are damaged or do not fit; it names the file.
    """
    config = run.config
    environment = trainer.make_environment(config, 0, 1, 1)
    with torch.device("meta"):  # Nothing is made that the variables do not fit.
        like = agent_lib.make_network(environment, config.agent).state_dict()
    variables = run.variables(like)
    network = agent_lib.make_network(environment, config.agent)
    environment.close()
    network.load_state_dict(variables)
    return network.eval()


def find_agent(
    target: str, task_kwargs: Mapping[str, Any] | None = None
) -> tuple[networks.RecurrentActorCritic, config_lib.TrainConfig]:
    """Returns a trained agent's network, and what it plays.

    Args:
      target: the folder of a run, or an agent that comes with the package: `domain/task`, or the name of its files.
      task_kwargs: options that the agent is to be trained with; the others are those of the folder or name, or else
        the task's.

    Raises:
      ValueError: if there is no such agent, or none with these options; it lists those that come with the package.
    """
    wanted = task_kwargs or {}
    if Path(target).exists():
        run = run_lib.Run(Path(target))
        _check_options(target, run.config, wanted)
        return load_network(run), run.config
    domain, _, task = target.partition("/")
    if (domain, task) in suite.ALL_TASKS:
        return shipped_agent(domain, task, wanted)
    if target in pretrained.names():
        agent = pretrained.load_named(target)
        _check_options(target, config_of(agent), wanted)
        return _with_config(agent)
    raise ValueError(
        f"{target} holds no run (no config.json); give the folder of a run or a trained agent: "
        f"{', '.join(pretrained.names())}"
    )


def shipped_agent(
    domain: str, task: str, task_kwargs: Mapping[str, Any]
) -> tuple[networks.RecurrentActorCritic, config_lib.TrainConfig]:
    """Returns the network of the agent that comes with the package for a task with these options, and what it plays.

    Raises:
      ValueError: if there is none; it lists those that there are.
    """
    agent = pretrained.load(domain, task, task_kwargs.get("difficulty"))  # Which names the files.
    _check_options(f"{domain}/{task}", config_of(agent), task_kwargs)
    return _with_config(agent)


def _check_options(target: str, config: config_lib.TrainConfig, wanted: Mapping[str, Any]) -> None:
    """Refuses an agent that was trained with other options than are wanted."""
    if not wanted:
        return
    options = suite.load_task(config.domain, config.task, config.task_kwargs).options
    for name, value in wanted.items():
        trained_at = getattr(options, name, None)  # The task's own, where the configuration has none.
        if value != trained_at:
            what = f"has no {name}" if trained_at is None else f"was trained at {name} {config_lib.shown(trained_at)}"
            raise ValueError(f"{target} {what}, and {name} is {value}; leave that out, or name another agent")


def _with_config(agent: pretrained.Pretrained) -> tuple[networks.RecurrentActorCritic, config_lib.TrainConfig]:
    config = config_of(agent)
    if agent.card["network"] != network_facts(config):
        raise ValueError(
            f"the card of the agent of {config.task_name} has a network that cannot play it; publish it again"
        )
    return agent.network, config


def network_facts(config: config_lib.TrainConfig) -> dict[str, Any]:
    """What a network is made from, as it is on an agent's card: specs of the environment, and hyperparameters."""
    environment = trainer.make_environment(config, 0, 1, 1)
    observations = {
        name: [list(spec.shape), np.dtype(spec.dtype).name] for name, spec in environment.observation_spec().items()
    }
    num_actions = environment.action_spec().num_values
    environment.close()
    return {
        "observations": observations,
        "num_actions": num_actions,
        "hyperparameters": agent_lib.hyperparameters(config.agent),
    }


def config_of(agent: pretrained.Pretrained) -> config_lib.TrainConfig:
    """What an agent that comes with the package plays, and how it was trained.

    Raises:
      ValueError: if its card does not say so.
    """
    try:
        facts = {name: agent.card[name] for name in ("domain", "task", "difficulty", "agent")}
        return config_lib.TrainConfig.from_json({**facts, "task_kwargs": agent.card.get("task_kwargs", {})})
    except (KeyError, TypeError, AttributeError) as error:
        raise ValueError(f"an agent's card is not what was written: {error!r}; publish the agent again") from None


def evaluate(
    run: run_lib.Run,
    num_episodes: int,
    interaction: str = "learned",
    greedy: bool = False,
    seed: int = SEED,
    num_threads: int = 2,
    device: str = "auto",
) -> Episodes:
    """Plays episodes with the agent of a run that has a checkpoint; otherwise as `play`."""
    return play(load_network(run), run.config, num_episodes, interaction, greedy, seed, num_threads, device)


def play(
    network: networks.RecurrentActorCritic,
    config: config_lib.TrainConfig,
    num_episodes: int,
    interaction: str = "learned",
    greedy: bool = False,
    seed: int = SEED,
    num_threads: int = 2,
    device: str = "auto",
    num_steps: int = 0,
    report: Callable[[int], None] | None = None,
) -> Episodes:
    """Plays episodes with a network.

    Args:
      network: the agent's network.
      config: says what it plays.
      num_episodes: how many, at least.
      interaction: `learned`, or `random` for the paper's randomized interaction (Section 5.3): labeling actions pass,
        an interaction action is replaced by one drawn uniformly.
      greedy: take the likeliest action instead of drawing one.
      seed: of the environments and the actions.
      num_threads: threads that simulate.
      device: where convolutions are computed, as in `A3CConfig`.
      num_steps: go on, in rounds of whole episodes, until there are so many environment steps.
      report: called after each round with how many of the episodes are played.

    Raises:
      ValueError: for an unknown interaction or a number of episodes below one.
    """
    if interaction not in INTERACTIONS:
        raise ValueError(f"interaction is {interaction!r}; choose from {', '.join(INTERACTIONS)}")
    if num_episodes < 1:
        raise ValueError(f"episodes is {num_episodes}; give a number >= 1")
    torch.set_num_threads(1)
    network.to(devices.choose(device, network.sees_images))
    environment = trainer.make_environment(
        config, seed, _BATCH if num_steps else min(num_episodes, _BATCH), num_threads
    )
    num_interactions = environment.task.num_interactions
    action_override = functools.partial(randomize, num_interactions) if interaction == "random" else None
    rounds: list[Episodes] = []
    episodes_left, steps_left = num_episodes, num_steps
    while episodes_left > 0 or steps_left > 0:
        number = len(rounds)
        generator = np.random.default_rng([seed, number])
        episodes = acting.play_round(network, environment, number, generator, greedy, action_override)
        rounds.append(Episodes.of_round(episodes, environment, number))
        episodes_left, steps_left = episodes_left - len(episodes.lengths), steps_left - episodes.num_frames
        if report is not None:
            report(num_episodes - max(0, episodes_left))
    environment.close()
    joined = Episodes.joined(rounds)
    return joined if num_steps else joined.first(num_episodes)


def randomize(num_interactions: int, actions: np.ndarray, generator: np.random.Generator) -> np.ndarray:
    """Replaces interaction actions by uniformly drawn ones; labeling actions pass (paper, Section 5.3)."""
    drawn = generator.integers(num_interactions, size=len(actions))
    return np.where(actions < num_interactions, drawn, actions)
