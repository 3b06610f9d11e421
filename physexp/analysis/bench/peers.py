"""Speed of other projects' learners on these tasks."""

from collections.abc import Iterator
import time

from sb3_contrib import RecurrentPPO
from stable_baselines3.common import callbacks, vec_env

from physexp.analysis.bench import measuring
from physexp.suite import gymnasium

_NUM_ENVIRONMENTS = 8


def training() -> Iterator[dict]:
    """Measures frames per second of A3C's training, against sb3-contrib's RecurrentPPO."""
    peer = recurrent_ppo_rate(*measuring.REFERENCE, seconds=30.0)
    ours = measuring.training_rate(measuring.REFERENCE, 20.0)
    yield measuring.ratio("training / sb3-contrib RecurrentPPO: heavier", 50, training=ours, peer=peer)


def recurrent_ppo_rate(domain: str, task: str, seconds: float) -> float:
    """Returns frames per second of sb3-contrib's RecurrentPPO, with an LSTM of 100 units and its own defaults."""

    class Stop(callbacks.BaseCallback):
        def _on_step(self) -> bool:
            return time.perf_counter() - start < seconds

    def make(seed: int):
        return lambda: gymnasium.Environment(domain, task, random=seed)

    environments = vec_env.DummyVecEnv([make(seed) for seed in range(_NUM_ENVIRONMENTS)])
    learner = RecurrentPPO("MultiInputLstmPolicy", environments, policy_kwargs={"lstm_hidden_size": 100}, seed=0)
    learner.learn(_NUM_ENVIRONMENTS * learner.n_steps)  # Warms up: one rollout and its training.
    before, start = learner.num_timesteps, time.perf_counter()
    learner.learn(10**9, callback=Stop(), reset_num_timesteps=False)
    return (learner.num_timesteps - before) / (time.perf_counter() - start)
