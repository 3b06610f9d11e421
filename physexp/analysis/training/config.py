"""What a training run is: the task, the agent's configuration, and the presets that were found to work.

Imports nothing heavy, since the command line is made from it.
"""

from collections.abc import Mapping
import dataclasses

from physexp.agents import config as agent_config
from physexp.agents.a3c import config as a3c
from physexp.agents.ppo import config as ppo

REPLAY_EVERY = 1_000_000
"""Environment steps between the replays that `physexp train` writes."""

ALGORITHMS: dict[str, type[agent_config.AgentConfig]] = {
    config.algorithm: config for config in (a3c.A3CConfig, ppo.PPOConfig)
}
"""The configurations of the agents that there are, by name."""

DISCOUNT = {"which_is_heavier": 0.95, "towers": 0.98}
"""The agents' gamma in each domain."""

_HEAVIER = a3c.A3CConfig(discount=DISCOUNT["which_is_heavier"], envs_per_worker=128, trace=0.98, observation_scale=80.0)
# Simulation is what a tower costs, not learning: smaller updates and more of them. Blocks move by their own size.
_TOWERS = a3c.A3CConfig(
    discount=DISCOUNT["towers"],
    envs_per_worker=32,
    learning_rate=3e-3,
    trace=0.5,
    entropy_cost=0.01,
    final_entropy_cost=0.001,
    observation_scale=10.0,
)
# Every frame passes the convolutions, which is what pixels cost: small updates, and no frame more than is needed.
_HEAVIER_PIXELS = a3c.A3CConfig(
    discount=DISCOUNT["which_is_heavier"],
    frames=500_000,
    envs_per_worker=64,
    learning_rate=1e-3,
    trace=0.9,
    observation_scale=8.0,
)
_TOWERS_PIXELS = a3c.A3CConfig(
    discount=DISCOUNT["towers"],
    envs_per_worker=32,
    learning_rate=1e-3,
    trace=0.5,
    entropy_cost=0.01,
    final_entropy_cost=0.001,
    observation_scale=16.0,
)


def _prior(num_interactions: int, label: float) -> tuple[float, ...]:
    """Interactions first: an episode that ends before the tower is touched teaches nothing but luck."""
    return (0.0,) * num_interactions + (label,) * 5


# Only hits teach labels. A fist that moves at random hits the tower ten times in a thousand frames; one that prefers
# +x, where the tower is, forty times. Until labels are known, what moves seem worth is noise, which carries the fist
# off unless entropy relative to this preference holds it.
_FIST = (1.0, *_prior(3, -2.0))

A3C = {
    ("which_is_heavier", "features"): _HEAVIER,
    ("which_is_heavier", "pixels"): _HEAVIER_PIXELS,
    ("towers", "direct_features"): _TOWERS.replace(frames=1_000_000, action_prior=_prior(20, -1.0)),
    ("towers", "fist_features"): _TOWERS.replace(
        frames=400_000, action_prior=_FIST, entropy_cost=0.05, relative_entropy=True
    ),
    ("towers", "direct_pixels"): _TOWERS_PIXELS.replace(frames=400_000, action_prior=_prior(20, -1.0)),
    # Small steps, of the values' loss hardly any, keep 3136 inputs from saturating the LSTM before labels are known. A
    # trace of 0 keeps the luck of answers out of what moves seem worth.
    ("towers", "fist_pixels"): _TOWERS_PIXELS.replace(
        frames=600_000,
        action_prior=_FIST,
        learning_rate=3e-4,
        trace=0.0,
        baseline_cost=0.05,
        entropy_cost=0.1,
        relative_entropy=True,
    ),
}
"""The default configuration of each task's A3C; `docs/performance.md` says how they were found."""


def _ppo(preset: a3c.A3CConfig, **changes) -> ppo.PPOConfig:
    """Returns PPO's preset: the hyperparameters of the task's A3C that both have, with changes."""
    shared = {field.name: getattr(preset, field.name) for field in dataclasses.fields(agent_config.AgentConfig)}
    return ppo.PPOConfig(**{**shared, **changes})


# Never to answer a tower is worth as much as to answer at random. Several steps on one round get there before anything
# has been learned, unless the entropy holds them back: more of it for the fist, whose hits are rare at first. It counts
# beside advantages that are standardized, which A3C's are not. From pixels, steps of 3e-4 taught nothing.
PPO = {
    ("which_is_heavier", "features"): _ppo(_HEAVIER, frames=1_500_000, learning_rate=3e-3),
    ("which_is_heavier", "pixels"): _ppo(_HEAVIER_PIXELS, learning_rate=5e-4, num_environments=64),
    **{
        ("towers", task): _ppo(
            A3C["towers", task],
            learning_rate=learning_rate,
            entropy_cost=entropy_cost,
            num_environments=32,
            num_minibatches=2,
        )
        for task, learning_rate, entropy_cost in (
            ("direct_features", 1e-3, 0.05),
            ("direct_pixels", 1e-4, 0.05),
            ("fist_features", 1e-3, 0.1),
            ("fist_pixels", 5e-5, 1.0),
        )
    },
}
"""The default configuration of each task's PPO."""

_PRESETS: Mapping[str, Mapping[tuple[str, str], agent_config.AgentConfig]] = {"a3c": A3C, "ppo": PPO}


def preset(domain: str = "", task: str = "", *, algorithm: str = "a3c") -> agent_config.AgentConfig:
    """The default configuration of a task's agent; the algorithm's own for a task without a preset."""
    return _PRESETS[algorithm].get((domain, task)) or ALGORITHMS[algorithm]()


@dataclasses.dataclass(frozen=True, kw_only=True)
class TrainConfig:
    """A training run.

    Attributes:
      domain: the domain's name.
      task: the task's name.
      difficulty: the paper's beta, for Which is Heavier only; None for the task's default.
      control_timestep: time between actions, s; None for the task's default.
      replay_every: environment steps between replays that training writes; 0 for none.
      agent: the agent's configuration.

    Raises:
      ValueError: if `replay_every` is no integer >= 0.
    """

    domain: str
    task: str
    difficulty: float | None = None
    control_timestep: float | None = None
    replay_every: int = 0
    agent: agent_config.AgentConfig

    def __post_init__(self):
        if not isinstance(self.replay_every, int) or isinstance(self.replay_every, bool) or self.replay_every < 0:
            raise ValueError(f"replay_every is {self.replay_every!r}; give an integer >= 0")

    @property
    def task_kwargs(self) -> dict:
        """The `task_kwargs` of `suite.load` that were chosen, without the seed."""
        chosen = {"difficulty": self.difficulty, "control_timestep": self.control_timestep}
        return {name: value for name, value in chosen.items() if value is not None}

    @property
    def task_name(self) -> str:
        """Domain and task, as in `towers/fist_features`."""
        return f"{self.domain}/{self.task}"

    @property
    def name(self) -> str:
        """A name for the run's folder."""
        difficulty = "" if self.difficulty is None else f"-difficulty{self.difficulty:g}"
        algorithm = "" if isinstance(self.agent, a3c.A3CConfig) else f"-{self.agent.algorithm}"
        discount = f"-discount{self.agent.discount:g}"
        return f"{self.domain}-{self.task}{difficulty}{algorithm}{discount}-seed{self.agent.seed}"

    def to_json(self) -> dict:
        fields = dataclasses.asdict(self)
        return {**fields, "agent": {"algorithm": self.agent.algorithm, **fields["agent"]}}

    @classmethod
    def from_json(cls, fields: dict) -> "TrainConfig":
        agent = {**fields["agent"], "action_prior": tuple(fields["agent"].get("action_prior", ()))}  # JSON has lists.
        algorithm = ALGORITHMS[agent.pop("algorithm", "a3c")]
        return cls(**{**fields, "agent": algorithm(**agent)})
