"""The interface of networks, torsos, and the paper's recurrent actor-critic (Section 4)."""

import abc
from collections.abc import Mapping, Sequence
import dataclasses
from typing import Any

from dm_env import specs
import numpy as np
import torch
from torch import nn

from physexp.agents import config as config_lib
from physexp.agents import core, devices, lstm

LSTM_UNITS = 100
"""Hidden units of the actor-critic's LSTM (paper, Section 4)."""

Observation = Mapping[str, torch.Tensor]

State = tuple[torch.Tensor, ...]
"""The memory of N episodes, tensors [1, N, ...]."""


@dataclasses.dataclass(frozen=True)
class Output:
    """The output of a network at one time step of N episodes.

    Attributes:
      logits: of the policy, [N, A].
      values: estimates of the return, [N].
      action_values: estimates of the return of each action, [N, A]; None if the network has only a policy.
      beliefs: probabilities of the labels, [N, L]; None if the network has only a policy.
    """

    logits: torch.Tensor
    values: torch.Tensor
    action_values: torch.Tensor | None = None
    beliefs: torch.Tensor | None = None


class RecurrentNetwork(nn.Module, abc.ABC):
    """A recurrent policy: maps observations and a state to logits, values and the next state.

    Attributes:
      sees_images: whether it observes an image, or features.
      torso: the part that sees the observation.
    """

    torso: "PixelTorso | FeatureTorso"

    def __init__(self, observation_spec: Mapping[str, specs.Array], pixel_scale: float, feature_scale: float):
        """Builds the torso, with weights from torch's global seed, for features or one image; else ValueError."""
        super().__init__()
        self._observed = {name: tuple(array.shape) for name, array in observation_spec.items()}
        self.sees_images = any(spec.dtype == np.uint8 for spec in observation_spec.values())
        if not observation_spec or (self.sees_images and len(observation_spec) > 1):
            raise ValueError(
                f"the network takes features (float32) or one image (uint8), and the observation has "
                f"{', '.join(sorted(observation_spec)) or 'nothing'}; leave out all but features, or all but one image"
            )
        kind, scale = (PixelTorso, pixel_scale) if self.sees_images else (FeatureTorso, feature_scale)
        self.torso = kind(observation_spec, scale)

    def calibrate(self, first: Observation) -> None:
        """Makes an episode's first observation, arrays [N, ...], the reference of an image's torso."""
        if isinstance(self.torso, PixelTorso):
            self.torso.reference.copy_(_only(first)[0])

    def check(self, observation: Mapping[str, np.ndarray]) -> None:
        """Raises ValueError for an observation whose names or shapes are not those of the network's task."""
        given = {name: np.shape(value) for name, value in observation.items()}
        if given != self._observed:
            raise ValueError(
                f"observed is {_in_words(given)}, and the agent was trained with {_in_words(self._observed)}; "
                "give one that was trained in this task"
            )

    @staticmethod
    @abc.abstractmethod
    def hyperparameters(task: core.Specs, config: Any) -> dict[str, Any]:
        """Returns the further arguments of `__init__`, numbers and strings by name."""

    @property
    def device(self) -> torch.device:
        """Returns the device that the network computes on."""
        return next(self.parameters()).device

    @abc.abstractmethod
    def initial_state(self, batch_size: int) -> State:
        """Returns the state at the start of episodes."""

    def encode(self, observation: Observation) -> torch.Tensor:
        """Encodes observations, arrays [N, ...], for `step`, float32 [N, F].

        Equal images, as all first ones without variation, are encoded once.
        """
        places = None
        if self.sees_images:
            ((name, images),) = observation.items()
            numbers: dict[bytes, int] = {}
            found = [numbers.setdefault(image.tobytes(), len(numbers)) for image in images.numpy()]
            if len(numbers) < len(images):
                places = torch.tensor(found, device=self.device)
                observation = {name: images[np.unique(found, return_index=True)[1]]}
        with devices.autocast(self.device, self.sees_images):
            encoded = self.project(self.torso(observation).to(self.device)).float()
        return encoded if places is None else encoded[places]

    def project(self, inputs: torch.Tensor) -> torch.Tensor:
        """Returns the torso's outputs, [N, num_outputs], as `step` takes them, [N, F]; by default, unchanged."""
        return inputs

    @abc.abstractmethod
    def step(self, inputs: torch.Tensor, state: State) -> tuple[Output, State]:
        """Computes one time step of N episodes from encoded observations, [N, F]; returns the output and next state."""

    def observe_action(self, actions: torch.Tensor, state: State) -> State:
        """Returns the state updated with the actions taken, int64 [N]; by default, the state unchanged."""
        return state


def _only(observation: Observation) -> torch.Tensor:
    """Returns the image of an observation that has nothing else."""
    (image,) = observation.values()
    return image


def _in_words(shapes: Mapping[str, tuple[int, ...]]) -> str:
    return ", ".join(f"{name} {shape}" for name, shape in sorted(shapes.items())) or "nothing"


class FeatureTorso(nn.Module):
    """Concatenates and scales features, as in the paper."""

    def __init__(self, observation_spec: Mapping[str, specs.Array], scale: float):
        """Builds the torso for arrays of features; `scale` is a factor on them."""
        super().__init__()
        self._names, self._scale = sorted(observation_spec), scale
        self.num_outputs = sum(int(np.prod(observation_spec[name].shape)) for name in self._names)

    def forward(self, observation: Observation) -> torch.Tensor:
        """Maps arrays [N, ...] to inputs of the LSTM, [N, num_outputs]."""
        return self._scale * torch.cat([observation[name].flatten(1) for name in self._names], dim=1)


class PixelTorso(nn.Module):
    """The paper's convolutions (Section 4): 32@8x8/4, 64@4x4/2 and 64@3x3/1 with ReLU.

    Attributes:
      reference: the image that pixels are relative to, uint8 [height, width, 3]; black, as in the paper, until another
        takes its place.
    """

    reference: torch.Tensor

    def __init__(self, observation_spec: Mapping[str, specs.Array], scale: float):
        """Builds the torso for one image; `scale` is a factor on pixels in [0, 1]."""
        super().__init__()
        (spec,) = observation_spec.values()
        height, width, channels = spec.shape
        self._scale = scale / 255
        layers = nn.Sequential(
            *(nn.Conv2d(channels, 32, 8, 4), nn.ReLU()),
            *(nn.Conv2d(32, 64, 4, 2), nn.ReLU()),
            *(nn.Conv2d(64, 64, 3), nn.ReLU()),
        )
        self.convolutions = layers.to(memory_format=torch.channels_last)  # type: ignore[call-overload]
        self.register_buffer("reference", torch.zeros(height, width, channels, dtype=torch.uint8))
        with torch.no_grad():
            self.num_outputs = layers(torch.zeros(1, channels, height, width)).numel()

    def forward(self, observation: Observation) -> torch.Tensor:
        """Maps images, uint8 [N, height, width, 3], to inputs of the LSTM, [N, num_outputs]."""
        images = _only(observation).to(self.reference.device)
        pixels = (images.float() - self.reference.float()).mul_(self._scale)
        # [N, height, width, 3] read as [N, 3, height, width] is what torch calls channels last.
        outputs: torch.Tensor = self.convolutions(pixels.permute(0, 3, 1, 2)).flatten(1)
        return outputs


class RecurrentActorCritic(RecurrentNetwork):
    """Torso, LSTM, and two linear heads: the policy's logits and the value."""

    def __init__(self, observation_spec: Mapping[str, specs.Array], num_actions: int, *, observation_scale: float):
        """Builds the network, with weights from torch's global seed; for the scale see `ActorCriticConfig`."""
        super().__init__(observation_spec, observation_scale, observation_scale)
        self.lstm = lstm.LSTM(self.torso.num_outputs, LSTM_UNITS)
        self.policy = nn.Linear(LSTM_UNITS, num_actions)
        self.value = nn.Linear(LSTM_UNITS, 1)

    @staticmethod
    def hyperparameters(task: core.Specs, config: config_lib.ActorCriticConfig) -> dict[str, Any]:
        """Returns the further arguments of `__init__`."""
        return {"observation_scale": config.observation_scale}

    def initial_state(self, batch_size: int) -> lstm.State:
        """Returns the state at an episode's start: zeros."""
        shape = (1, batch_size, self.lstm.hidden_size)
        hidden, cell = (torch.zeros(shape, dtype=torch.float32, device=self.device) for _ in range(2))
        return hidden, cell

    def initialize_policy(self, logits: Sequence[float]) -> None:
        """Adds logits, one for each action or none, to the policy's biases; raises ValueError for another number."""
        if logits and len(logits) != self.policy.out_features:
            raise ValueError(f"initial_logits has {len(logits)} logits; give {self.policy.out_features}, or none")
        if logits:
            self.policy.bias.data += torch.tensor(logits)

    def project(self, inputs: torch.Tensor) -> torch.Tensor:
        """Returns the inputs of the LSTM's gates; see `RecurrentNetwork`."""
        return self.lstm.project(inputs)

    def step(self, inputs: torch.Tensor, state: State) -> tuple[Output, State]:
        """Computes one time step; see `RecurrentNetwork`."""
        hidden, cell = state
        outputs, state = self.lstm.step(inputs, (hidden, cell))
        return Output(*self._heads(outputs)), state

    def unroll(self, inputs: torch.Tensor, batch_sizes: torch.Tensor) -> tuple[torch.Tensor, torch.Tensor]:
        """Returns logits [N, A] and values [N] of encoded episodes, packed as `lstm.LSTM.unroll` takes them."""
        return self._heads(self.lstm.unroll(inputs, batch_sizes))

    def _heads(self, outputs: torch.Tensor) -> tuple[torch.Tensor, torch.Tensor]:
        return self.policy(outputs), self.value(outputs).squeeze(-1)
