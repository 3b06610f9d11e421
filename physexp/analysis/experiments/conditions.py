"""The conditions that agents are trained in: all of the paper's, each for as long as it takes to level off."""

from collections.abc import Mapping, Sequence
import dataclasses
import re
from typing import Any

from physexp import suite
from physexp.agents.a3c import config as a3c
from physexp.analysis import domains
from physexp.analysis.domains import which_is_heavier
from physexp.analysis.training import config as config_lib

DIFFICULTIES = (3.0, 5.0, 10.0)
OBSERVATIONS = ("features", "pixels")
ACTUATORS = ("direct", "fist")
PATIENT_DISCOUNT = 0.99  # Under which waiting costs little.
SEEDS = {"features": 10, "pixels": 5}  # How many agents are trained in each condition.

# Environment steps: the easier, the sooner the curve is flat.
_PATIENT_FRAMES = {3.0: 4_000_000, 5.0: 3_000_000, 10.0: 2_000_000}
_FRAMES = {
    ("features", 3.0): 6_000_000,
    ("features", 5.0): 4_000_000,
    ("features", 10.0): 2_000_000,
    ("pixels", 3.0): 700_000,
    ("pixels", 5.0): 500_000,
    ("pixels", 10.0): 250_000,
}
# Of the belief learner, set before any agent that is reported was trained.
_BELIEF_FRAMES = {
    "3-F": 250_000,
    "5-F": 60_000,
    "10-F": 30_000,
    "D-F": 60_000,
    "F-F": 50_000,
    "3-P": 200_000,
    "5-P": 100_000,
    "10-P": 40_000,
    "D-P": 60_000,
    "F-P": 80_000,
    "threshold features": 60_000,
    "balance features": 150_000,
    "strings features": 150_000,
    "sealed_box features": 200_000,
    "strike features": 300_000,
}
_PAPERS_FRAMES = {"10-F": 2_000_000}  # The same, of the paper's own learner.
_NOISY_FRAMES = {"5-F": 120_000}  # The same, with noise.
_TIMED_FRAMES = {"F-F": 200_000}  # The same, with control steps of many lengths.
_VARIED_FRAMES = {"D-F": 150_000, "F-F": 150_000, "D-P": 400_000, "F-P": 1_000_000}  # The same, with variation.
# Environment steps for each step of Adam where images vary: agents who learn more from each learn them by heart.
_VARIED_FRAMES_PER_STEP = 16


def heavier(
    difficulty: float, observations: str, frames: int, discount: float = which_is_heavier.DOMAIN.discount
) -> config_lib.TrainConfig:
    """Returns Which is Heavier at a difficulty, for so many environment steps, the agent's gamma being `discount`."""
    agent = config_lib.preset("which_is_heavier", observations, algorithm="a3c")
    return config_lib.TrainConfig(
        domain="which_is_heavier",
        task=observations,
        task_kwargs={"difficulty": difficulty},
        agent=agent.replace(discount=discount, frames=frames, num_workers=1),
    )


def towers(actuator: str, observations: str = "features") -> config_lib.TrainConfig:
    """Returns Towers with an actuator."""
    task = f"{actuator}_{observations}"
    agent = config_lib.preset("towers", task, algorithm="a3c").replace(num_workers=1)
    return config_lib.TrainConfig(domain="towers", task=task, agent=agent)


HEAVIER = tuple(heavier(beta, kind, _FRAMES[kind, beta]) for kind in OBSERVATIONS for beta in DIFFICULTIES)
"""At the paper's gamma of 0.95."""

PATIENT = tuple(heavier(beta, "features", _PATIENT_FRAMES[beta], discount=PATIENT_DISCOUNT) for beta in DIFFICULTIES)
"""At the paper's gamma of 0.99."""

TOWERS = tuple(towers(actuator, kind) for actuator in ACTUATORS for kind in OBSERVATIONS)

BY_LABEL = {config.label: config for config in (*HEAVIER, *TOWERS)}
"""The paper's tasks by the names of their conditions, as 10-F and D-P; see `label`."""

THRESHOLD, BALANCE, STRINGS, SEALED_BOX, STRIKE = (
    config_lib.TrainConfig(
        domain=domain,
        task="features",
        agent=config_lib.preset(domain, "features", algorithm="a3c").replace(num_workers=1),
    )
    for domain in ("threshold", "balance", "strings", "sealed_box", "strike")
)


def with_ppo(config: config_lib.TrainConfig) -> config_lib.TrainConfig:
    """Returns a condition with PPO as the learner."""
    agent = config_lib.preset(config.domain, config.task, algorithm="ppo")
    return dataclasses.replace(config, agent=agent.replace(discount=config.agent.discount, num_threads=1))


def with_papers_learner(config: config_lib.TrainConfig) -> config_lib.TrainConfig:
    """Returns a condition with A3C as the paper has it: one episode an update, raw observations, and no hint."""
    agent = a3c.A3CConfig(
        discount=config.agent.discount,
        frames=_PAPERS_FRAMES[config.label],
        learning_rate=0.01,
        entropy_cost=1.0,
        num_workers=1,
        envs_per_worker=1,
        observation_scale=1.0,
        relative_pixels=False,
    )
    return dataclasses.replace(config, agent=agent)


def with_belief(config: config_lib.TrainConfig, **changes: Any) -> config_lib.TrainConfig:
    """Returns a condition with the belief learner: one configuration, but for `changes`, and each task's own budget."""
    agent = config_lib.preset(config.domain, config.task, algorithm="belief")
    agent = agent.replace(discount=config.agent.discount, frames=_BELIEF_FRAMES[config.label], **changes)
    return dataclasses.replace(config, agent=agent)


def with_each_learner(configs: Sequence[config_lib.TrainConfig]) -> tuple[config_lib.TrainConfig, ...]:
    """Returns conditions with A3C, with PPO, and with the belief learner in both tracks, one task after the other."""
    return tuple(
        config
        for task in configs
        for config in (task, with_ppo(task), with_belief(task), with_belief(task, answers_revealed=True))
    )


def with_task_kwargs(config: config_lib.TrainConfig, **task_kwargs: Any) -> config_lib.TrainConfig:
    """Returns a condition with further options of the task."""
    return dataclasses.replace(config, task_kwargs={**config.task_kwargs, **task_kwargs})


def with_variation(config: config_lib.TrainConfig) -> config_lib.TrainConfig:
    """Returns a condition of Towers with full variation, and the belief learner's budget for that."""
    varied = with_task_kwargs(_trained_for(config, _VARIED_FRAMES), variation=1.0)
    if observations(config) == "features":
        return varied
    return dataclasses.replace(varied, agent=varied.agent.replace(frames_per_step=_VARIED_FRAMES_PER_STEP))


def with_step_variation(config: config_lib.TrainConfig) -> config_lib.TrainConfig:
    """Returns a condition of Towers with control steps from half to one and a half times as long as usual."""
    return with_task_kwargs(_trained_for(config, _TIMED_FRAMES), step_variation=0.5)


def with_noise(config: config_lib.TrainConfig, noise: float) -> config_lib.TrainConfig:
    """Returns a condition with noise of a standard deviation, m, and the belief learner's budget for that."""
    return with_task_kwargs(_trained_for(config, _NOISY_FRAMES), noise=noise)


def _trained_for(config: config_lib.TrainConfig, frames: Mapping[str, int]) -> config_lib.TrainConfig:
    return dataclasses.replace(config, agent=config.agent.replace(frames=frames[config.label]))


def observations(config: config_lib.TrainConfig) -> str:
    """Returns what agents of a condition observe, `features` or `pixels`."""
    (kind,) = suite.tags(config.domain, config.task) & set(OBSERVATIONS)
    return kind


def ideal(config: config_lib.TrainConfig):
    """Returns the ideal experimenter of a condition: the `Solution` that no agent trained so can beat.

    Raises:
      ValueError: if none is known.
    """
    find = domains.find(config.domain).ideal_with(config.task_kwargs)
    if find is None:
        raise ValueError(f"no ideal experimenter of {config.name} is known")
    return find(config.task, config.task_kwargs, config.agent.discount)


def heavier_ideal(difficulty: float, discount: float = which_is_heavier.DOMAIN.discount):
    """Returns the ideal experimenter of Which is Heavier at a difficulty and a discount, a `Solution`."""
    return ideal(heavier(difficulty, "features", 1, discount))


def label(domain: str, task: str, **task_kwargs: Any) -> str:
    """Returns the paper's name of a condition: 10-F is difficulty 10 from features, D-P direct actuation from pixels.

    Where a domain has no such names, it is domain and task.
    """
    return domains.find(domain).label(task, task_kwargs)


def chance(domain: str, task: str) -> float:
    """Returns the share of right answers of one who answers at random."""
    return 1 / suite.load_task(domain, task).num_labels


_WORDS = {"F": "features", "P": "pixels"}


def spelled_out(text: str) -> str:
    """Returns a text with the paper's names of conditions in words, since its F is both the fist and features.

    `10-F` becomes `difficulty 10, features`, and `F-F` becomes `fist, features`.
    """
    text = re.sub(r"\b([\d.]+)-([FP])\b", lambda found: f"difficulty {found[1]}, {_WORDS[found[2]]}", text)
    actuators = {name[0].upper(): name for name in ACTUATORS}
    return re.sub(r"\b([DF])-([FP])\b", lambda found: f"{actuators[found[1]]}, {_WORDS[found[2]]}", text)


def tick(name: str) -> str:
    """Returns a condition in words that are short enough for an axis."""
    return spelled_out(name).replace("difficulty", "β =")
