"""Learners of other projects on our tasks, to measure against."""

import time

import gymnasium
import numpy as np

from physexp import suite

_NUM_ENVIRONMENTS = 8


class _Adapter(gymnasium.Env):
    """A dm_env environment with features as a Gymnasium environment with one flat observation."""

    def __init__(self, domain: str, task: str, seed: int):
        self._environment = suite.load(domain, task, task_kwargs={"random": seed})
        self.action_space = gymnasium.spaces.Discrete(self._environment.action_spec().num_values)
        size = sum(int(np.prod(spec.shape)) for spec in self._environment.observation_spec().values())
        self.observation_space = gymnasium.spaces.Box(-np.inf, np.inf, (size,), np.float32)

    def reset(self, *, seed=None, options=None):
        return self._flat(self._environment.reset()), {}

    def step(self, action):
        timestep = self._environment.step(np.int32(action))
        return self._flat(timestep), timestep.reward, timestep.last(), False, {}

    @staticmethod
    def _flat(timestep) -> np.ndarray:
        return np.concatenate([value.ravel() for value in timestep.observation.values()])


def recurrent_ppo_rate(domain: str, task: str, seconds: float) -> float:
    """Frames per second that sb3-contrib's RecurrentPPO trains on, with an LSTM of 100 units and its own defaults."""
    from sb3_contrib import RecurrentPPO
    from stable_baselines3.common import callbacks, vec_env

    class Stop(callbacks.BaseCallback):
        def _on_step(self) -> bool:
            return time.perf_counter() - start < seconds

    def make(seed: int):
        return lambda: _Adapter(domain, task, seed)

    environments = vec_env.DummyVecEnv([make(seed) for seed in range(_NUM_ENVIRONMENTS)])
    learner = RecurrentPPO("MlpLstmPolicy", environments, policy_kwargs={"lstm_hidden_size": 100}, seed=0)
    learner.learn(_NUM_ENVIRONMENTS * learner.n_steps)  # Warms up: one rollout and its training.
    before, start = learner.num_timesteps, time.perf_counter()
    learner.learn(10**9, callback=Stop(), reset_num_timesteps=False)
    return (learner.num_timesteps - before) / (time.perf_counter() - start)
