"""The conditions that agents are trained in: the paper's, and ours, each with the environment steps that it needs."""

from collections.abc import Sequence
import dataclasses
from typing import Any

from physexp import suite
from physexp.agents import config as agent_config
from physexp.agents.a3c import config as a3c
from physexp.agents.belief import config as belief
from physexp.analysis import domains
from physexp.analysis.domains import which_is_heavier
from physexp.analysis.training import config as config_lib
from physexp.analysis.training import records

DIFFICULTIES = (3.0, 5.0, 10.0)
OBSERVATIONS = ("features", "pixels")
PATIENT_DISCOUNT = 0.99  # Waiting costs little.
SEEDS = {"features": 10, "pixels": 5}  # Agents trained in each condition.


@dataclasses.dataclass(frozen=True, kw_only=True)
class Condition(config_lib.TrainConfig):
    """Agents that are trained alike but for their seeds: the configuration of the first run, with the seed 0.

    Attributes:
      player: the name of these agents in an experiment; by default the title of their learner.
    """

    player: str = ""

    def __post_init__(self):
        super().__post_init__()
        object.__setattr__(self, "player", self.player or self.agent.title)

    @property
    def id(self) -> str:
        """The name of the runs without their seeds; stored rows carry it."""
        return records.condition_id(self)

    @property
    def observations(self) -> str:
        """The kind of observations, `features` or `pixels`."""
        (kind,) = suite.tags(self.domain, self.task) & set(OBSERVATIONS)
        return kind

    @property
    def chance(self) -> float:
        """The share of right answers of an agent that answers at random."""
        return 1 / self.load_task().num_labels

    def ideal(self) -> Any:
        """Returns the ideal experimenter, a `Solution`; with noise or variation, a policy that knows of them."""
        find = domains.find(self.domain).ideal
        assert find is not None
        return find(self.task, self.task_kwargs, self.agent.discount)

    def run(self, seed: int, frames: int | None = None) -> config_lib.TrainConfig:
        """Returns the configuration of one run; `frames` replaces the budget in a rehearsal."""
        agent = self.agent.replace(seed=seed, frames=frames or self.agent.frames)
        return config_lib.TrainConfig(domain=self.domain, task=self.task, task_kwargs=self.task_kwargs, agent=agent)

    def changed(
        self, agent: agent_config.AgentConfig | None = None, player: str = "", **task_kwargs: Any
    ) -> "Condition":
        """Returns a condition of the same task with another learner or name, or with further options of the task."""
        task_kwargs = {**self.task_kwargs, **task_kwargs}
        return dataclasses.replace(self, agent=agent or self.agent, player=player, task_kwargs=task_kwargs)


@dataclasses.dataclass(frozen=True)
class _Budget:
    """A task's name in words, and the environment steps of its learners, set before their reported agents were trained.

    Attributes:
      words: the task in words.
      belief: of the belief learner.
      varied: of the belief learner, with variation.
      foresight: of the belief learner with foresight from the reward alone, where they differ.
      a3c, patient: of A3C where they differ from the preset's: at the task's gamma, and at `PATIENT_DISCOUNT`.
    """

    words: str
    belief: int
    varied: int = 0
    foresight: int = 0
    a3c: int = 0
    patient: int = 0


_BUDGETS = {  # The easier the task, the sooner its curve is flat.
    "3-F": _Budget("difficulty 3, features", belief=250_000, a3c=6_000_000, patient=4_000_000),
    "5-F": _Budget("difficulty 5, features", belief=60_000, a3c=4_000_000, patient=3_000_000),
    "10-F": _Budget("difficulty 10, features", belief=30_000, a3c=2_000_000, patient=2_000_000),
    "3-P": _Budget("difficulty 3, pixels", belief=200_000, a3c=700_000),
    "5-P": _Budget("difficulty 5, pixels", belief=100_000, a3c=500_000),
    "10-P": _Budget("difficulty 10, pixels", belief=40_000, a3c=250_000),
    "D-F": _Budget("direct, features", belief=60_000, varied=150_000),
    "D-P": _Budget("direct, pixels", belief=60_000, varied=400_000),
    "F-F": _Budget("fist, features", belief=50_000, varied=150_000),
    "F-P": _Budget("fist, pixels", belief=80_000, varied=1_000_000),
    "threshold features": _Budget("threshold features", belief=60_000),
    "balance features": _Budget("balance features", belief=150_000, foresight=600_000),
    "strings features": _Budget("strings features", belief=150_000),
    "sealed_box features": _Budget("sealed_box features", belief=200_000),
    "strike features": _Budget("strike features", belief=300_000),
    "crush features": _Budget("crush features", belief=60_000, a3c=1_000_000),
    "lump features": _Budget("lump features", belief=40_000, a3c=1_000_000),
}
# Of the belief learner at difficulty 5 from features with noise, without foresight and with it.
_NOISY_FRAMES, _FORESEEING_FRAMES = 120_000, 300_000
_TIMED_FRAMES = 200_000  # Of the belief learner with the fist from features, with control steps of many lengths.
# Environment steps for each update where images vary: agents that learn more from each memorize them.
_VARIED_FRAMES_PER_UPDATE = 16


def heavier(
    difficulty: float, observations: str, frames: int, discount: float = which_is_heavier.DOMAIN.discount
) -> Condition:
    """Returns A3C on Which is Heavier with a difficulty, a number of environment steps, and a gamma."""
    agent = config_lib.preset("which_is_heavier", observations, algorithm="a3c")
    agent = agent.replace(discount=discount, frames=frames)
    task_kwargs = {"difficulty": difficulty}
    return Condition(domain="which_is_heavier", task=observations, task_kwargs=task_kwargs, agent=agent)


def with_one_worker(condition: Condition) -> Condition:
    """Returns a condition of the same name with A3C of one worker, whose gradients are never stale."""
    assert isinstance(condition.agent, a3c.A3CConfig)
    return condition.changed(condition.agent.replace(num_workers=1), condition.player)


def towers(actuator: str, observations: str = "features") -> Condition:
    """Returns A3C on Towers with an actuator."""
    return _with_preset("towers", f"{actuator}_{observations}")


def _with_preset(domain: str, task: str) -> Condition:
    """Returns A3C on a task as it is in the score's protocol."""
    agent = config_lib.preset(domain, task, algorithm="a3c")
    task_kwargs = domains.find(domain).usual_options
    condition = Condition(domain=domain, task=task, task_kwargs=task_kwargs, agent=agent)
    return condition.changed(agent.replace(frames=_BUDGETS[condition.label].a3c or agent.frames))


FEATURES = tuple(heavier(beta, "features", _BUDGETS[f"{beta:g}-F"].a3c) for beta in DIFFICULTIES)

HEAVIER = (*FEATURES, *(heavier(beta, "pixels", _BUDGETS[f"{beta:g}-P"].a3c) for beta in DIFFICULTIES))
"""A3C at the paper's gamma of 0.95."""

PATIENT = tuple(
    heavier(beta, "features", _BUDGETS[f"{beta:g}-F"].patient, discount=PATIENT_DISCOUNT) for beta in DIFFICULTIES
)
"""A3C at the paper's gamma of 0.99."""

TOWERS = tuple(towers(actuator, kind) for actuator in ("direct", "fist") for kind in OBSERVATIONS)


def by_actuator(observations: str) -> list[str]:
    """Returns the labels of Towers with the fist and with direct actuation."""
    return [towers(actuator, observations).label for actuator in ("fist", "direct")]


BY_LABEL = {condition.label: condition for condition in (*HEAVIER, *TOWERS)}
"""A3C on the paper's tasks, by their labels."""

PAPERS_OWN = BY_LABEL["10-F"].changed(
    a3c.A3CConfig(
        discount=which_is_heavier.DOMAIN.discount,
        frames=2_000_000,
        learning_rate=0.01,
        entropy_cost=1.0,
        envs_per_worker=1,
        observation_scale=1.0,
        relative_pixels=False,
    )
)
"""A3C as in the paper, with one episode an update, raw observations, and no hint, where answers are learned soonest."""

OTHERS = THRESHOLD, BALANCE, STRINGS, SEALED_BOX, STRIKE, CRUSH, LUMP = tuple(
    with_one_worker(_with_preset(domain, "features"))
    for domain in ("threshold", "balance", "strings", "sealed_box", "strike", "crush", "lump")
)
"""A3C in the domains that are not the paper's."""


def with_ppo(condition: Condition) -> Condition:
    """Returns a condition with PPO as the learner."""
    agent = config_lib.preset(condition.domain, condition.task, algorithm="ppo")
    return condition.changed(agent.replace(discount=condition.agent.discount, num_threads=1))


def with_belief(condition: Condition, **changes: Any) -> Condition:
    """Returns a condition with the belief learner: one configuration, but for `changes`, and each task's own budget."""
    agent = config_lib.preset(condition.domain, condition.task, algorithm="belief")
    frames = _BUDGETS[condition.label].belief
    return condition.changed(agent.replace(discount=condition.agent.discount, frames=frames, **changes))


def with_foresight(condition: Condition) -> tuple[Condition, Condition]:
    """Returns conditions with the belief learner that adds up evidence and foresees observations, in both tracks."""
    alone, revealed = (with_belief(condition, foresight=True, answers_revealed=track) for track in (False, True))
    frames = _BUDGETS[condition.label].foresight or alone.agent.frames
    return alone.changed(alone.agent.replace(frames=frames)), revealed


def with_each_learner(tasks: Sequence[Condition]) -> tuple[Condition, ...]:
    """Returns conditions with A3C, with PPO, and with the belief learner in both tracks, one task after the other."""
    return tuple(
        condition
        for task in tasks
        for condition in (task, with_ppo(task), with_belief(task), with_belief(task, answers_revealed=True))
    )


def with_variation(condition: Condition, player: str) -> Condition:
    """Returns a condition of Towers with full variation, a name, and the belief learner's budget for that."""
    agent = condition.agent.replace(frames=_BUDGETS[condition.label].varied)
    if condition.observations == "pixels":
        agent = agent.replace(frames_per_update=_VARIED_FRAMES_PER_UPDATE)
    return condition.changed(agent, player, variation=1.0)


def with_step_variation(condition: Condition, player: str) -> Condition:
    """Returns a condition of Towers with control steps from half to one and a half times as long as usual."""
    return condition.changed(condition.agent.replace(frames=_TIMED_FRAMES), player, step_variation=0.5)


def with_noise(condition: Condition, player: str, noise: float) -> Condition:
    """Returns a condition with noise of a standard deviation, m, and the belief learner's budget for that."""
    assert isinstance(condition.agent, belief.BeliefConfig)
    frames = _FORESEEING_FRAMES if condition.agent.foresight else _NOISY_FRAMES
    return condition.changed(condition.agent.replace(frames=frames), player, noise=noise)


def spelled_out(text: str) -> str:
    """Returns a text with labels in words, since their F is both the fist and features.

    `10-F` becomes `difficulty 10, features`, and `F-F` becomes `fist, features`.
    """
    for name in sorted(_BUDGETS, key=len, reverse=True):  # 10-F before 0-F.
        text = text.replace(name, _BUDGETS[name].words)
    return text


def tick(name: str) -> str:
    """Returns a condition in words that are short enough for an axis."""
    return spelled_out(name).replace("difficulty", "β =")
