"""The networks: a torso for each kind of observation, and the paper's recurrent actor-critic on top (Section 4)."""

from collections.abc import Mapping

from dm_env import specs
import numpy as np
import torch
from torch import nn

from physexp.agents import lstm

Observation = Mapping[str, torch.Tensor]


class FeatureTorso(nn.Module):
    """Concatenates and scales features; the LSTM takes them directly, as in the paper."""

    def __init__(self, observation_spec: Mapping[str, specs.Array], scale: float):
        """Builds the torso for arrays of features; `scale` is a factor on them."""
        super().__init__()
        self._names = sorted(observation_spec)
        self._scale = scale
        self.num_outputs = sum(int(np.prod(observation_spec[name].shape)) for name in self._names)

    def forward(self, observation: Observation) -> torch.Tensor:
        """Maps arrays [N, ...] to inputs of the LSTM, [N, num_outputs]."""
        return self._scale * torch.cat([observation[name].flatten(1) for name in self._names], dim=1)


class RecurrentActorCritic(nn.Module):
    """Torso, LSTM, and two linear heads: the policy's logits and the value."""

    def __init__(self, observation_spec: Mapping[str, specs.Array], num_actions: int, *, lstm_units: int,
                 observation_scale: float):  # fmt: skip
        """Builds the network; its weights follow torch's global seed.

        Args:
          observation_spec: what is observed.
          num_actions: how many actions there are.
          lstm_units, observation_scale: see `A3CConfig`.
        """
        super().__init__()
        self.torso = FeatureTorso(observation_spec, observation_scale)
        self.lstm = lstm.LSTM(self.torso.num_outputs, lstm_units)
        self.policy = nn.Linear(lstm_units, num_actions)
        self.value = nn.Linear(lstm_units, 1)

    def initial_state(self, batch_size: int) -> lstm.State:
        """The state at an episode's start: zeros, hidden and cell each [1, batch_size, units]."""
        shape = (1, batch_size, self.lstm.hidden_size)
        return torch.zeros(shape), torch.zeros(shape)

    def step(self, observation: Observation, state: lstm.State) -> tuple[torch.Tensor, torch.Tensor, lstm.State]:
        """One time step of many episodes.

        Args:
          observation: arrays [N, ...].
          state: hidden and cell state, each [1, N, units].

        Returns:
          Logits [N, A], values [N] and the next state.
        """
        outputs, state = self.lstm.step(self.torso(observation), state)
        return *self._heads(outputs), state

    def unroll(self, observation: Observation, batch_sizes: torch.Tensor) -> tuple[torch.Tensor, torch.Tensor]:
        """Whole episodes from their first steps, packed: sorted from the longest to the shortest, no padding.

        Args:
          observation: arrays [N, ...]: all first steps, then all second steps, and so on.
          batch_sizes: how many episodes have a t-th step, int64 [T]; they sum to N.

        Returns:
          Logits [N, A] and values [N].
        """
        return self._heads(self.lstm.unroll(self.torso(observation), batch_sizes))

    def _heads(self, outputs):
        return self.policy(outputs), self.value(outputs).squeeze(-1)
