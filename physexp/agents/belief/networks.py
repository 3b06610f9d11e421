"""The belief network: what the answer may be, and what each interaction is worth."""

from collections.abc import Mapping
from typing import Any

from dm_env import specs
import torch
from torch import nn
from torch.nn import functional

from physexp.agents import core, devices, networks
from physexp.agents.belief import config as config_lib
from physexp.agents.belief import losses

_NUM_HEADS = 4
_PIXEL_SCALE = 10.0  # What changes in an image is of the order of a tenth of its range.
_STILL = 0.01  # A step in which everything moves by less than this share of the unit shows no clear direction.
_TEMPERATURE = 0.001  # Of the policy: actions are as good as equal when their values differ by less.


class BeliefNetwork(networks.RecurrentNetwork):
    """Several members, each of which has a belief about the label and values the interactions.

    To answer is worth `S = 2 max(b) - 1`, the expected reward, with the mean `b` of the members' beliefs. What an
    interaction shows can be left out of account, and cannot tell more than the label (the value of perfect information:
    Howard, 1966), so `gamma S <= Q <= gamma`, and the members say where in between: `Q = gamma (S + (1 - S) x)` with
    the mean of their shares `x` in [0, 1]. The best action is the greatest of `S` and `Q`.

    What is seen, features or what convolutions make of an image, is taken relative to the start of the episode and to
    the step before, in units of how far it moves, which the learner measures. The direction of the last movement tells
    what moved along with what, however far.

    The convolutions stay as they were drawn: random ones keep what an image shows (Saxe et al., 2011), so that each
    image passes them once, when it is played. A projection, which all members share, learns what of it matters.

    Attributes:
      num_inputs: how many numbers `encode` makes of what is observed.
    """

    log_scale: torch.Tensor

    def __init__(
        self,
        observation_spec: Mapping[str, specs.Array],
        num_actions: int,
        *,
        num_interactions: int,
        num_members: int,
        units: int,
        memory: config_lib.Memory,
        most_interactions: int,
        discount: float,
    ):
        """Builds the network; its weights follow torch's global seed.

        Args:
          observation_spec: what is observed: features, or one image.
          num_actions: how many actions there are.
          num_interactions: how many of them are interactions; they come first, labels after them.
          num_members: how many members there are.
          units: of each head of a member's attention; a layer, or an LSTM, has as many as all of them.
          memory: what members remember an episode with, attention or lstm.
          most_interactions: after so many it prefers to answer.
          discount: gamma.

        Raises:
          ValueError: if what is observed is neither features nor one image, or for another memory.
        """
        super().__init__(observation_spec, num_actions)
        self.sees_images = networks.sees_images(observation_spec)
        self.num_interactions, self.most_interactions, self.discount = num_interactions, most_interactions, discount
        self.num_members = num_members
        self.torso: networks.PixelTorso | networks.FeatureTorso
        if self.sees_images:
            self.torso = networks.PixelTorso(observation_spec, _PIXEL_SCALE)
        else:
            self.torso = networks.FeatureTorso(observation_spec, 1.0)
        width = _NUM_HEADS * units
        self.torso.requires_grad_(False)
        self.num_inputs = self._num_seen = self.torso.num_outputs
        self.projection: nn.Module = nn.Identity()
        if self.sees_images:
            self._num_seen = width
            self.projection = Projection(self.num_inputs, width)
        num_looked_at = 3 * self._num_seen + num_interactions + 1
        self.members = Members(
            num_members, num_looked_at, num_actions - num_interactions, num_interactions, width, memory
        )
        self.register_buffer("log_scale", torch.zeros(()))

    @staticmethod
    def hyperparameters(environment: core.Batch, config: config_lib.BeliefConfig) -> dict[str, Any]:
        return {
            "num_interactions": environment.num_interactions,
            "num_members": config.num_members,
            "units": config.units,
            "memory": config.memory,
            "most_interactions": config.most_interactions,
            "discount": config.discount,
        }

    def initial_state(self, batch_size):
        """Returns the state at the start of episodes: all that was seen, and what was done before each of it."""
        shapes = (1, batch_size, 0, self._num_seen), (1, batch_size, 1, self.num_interactions)
        seen, done = (torch.zeros(shape, dtype=torch.float32, device=self.device) for shape in shapes)
        return seen, done

    def calibrate(self, first: networks.Observation) -> None:
        """Tells the torso what an episode's first observation looks like, arrays [N, ...]."""
        self.torso.calibrate(first)

    def encode(self, observation):
        with devices.autocast(self.device, self.sees_images):
            inputs, places = self.torso.distinct(observation)
        inputs = inputs.to(self.device).float()
        return inputs if places is None else inputs[places]

    def step(self, inputs, state):
        seen, done = state
        seen = torch.cat([seen, self.projection(inputs)[None, :, None]], dim=2)
        logits, shares = self._opinions(self._history(seen[0], done[0]))
        beliefs = logits[:, :, -1].softmax(-1).mean(0)
        values = self.values(beliefs, shares[:, :, -1].mean(0))
        if seen.shape[2] > self.most_interactions:
            values = torch.full_like(values, -1.0)
        worths = torch.cat([values, losses.worth_of_answers(beliefs)], dim=1)
        return worths / _TEMPERATURE, worths.max(1).values, (seen, done)

    def note(self, actions, state):
        seen, done = state
        return seen, torch.cat([done, self._one_hot(actions.to(self.device))[None, :, None]], dim=2)

    def worths(self, logits: torch.Tensor) -> torch.Tensor:
        """Returns what each action is worth, [N, A], of the logits of `step`."""
        return logits * _TEMPERATURE

    def beliefs(self, logits):
        return (self.worths(logits)[:, self.num_interactions :] + 1) / 2

    def values(self, beliefs: torch.Tensor, shares: torch.Tensor) -> torch.Tensor:
        """Returns the values Q of interactions, [..., I], of beliefs [..., L] and shares x, [..., I]."""
        answering = losses.worth_of_answers(beliefs.amax(-1, keepdim=True))
        return self.discount * (answering + (1 - answering) * shares)

    def unroll(
        self, inputs: torch.Tensor, actions: torch.Tensor, dropout: float = 0.0
    ) -> tuple[torch.Tensor, torch.Tensor]:
        """Computes the outputs of all members for whole episodes, padded to the longest.

        Args:
          inputs: what `encode` returned, [T, B, F].
          actions: what was done then, int64 [T, B].
          dropout: share of the outputs of the attention that the heads do without, drawn anew for each step.

        Returns:
          Logits of the beliefs of K members, [K, T, B, L], and the share x of each interaction, [K, T, B, I].
        """
        logits, shares = self._opinions(self._histories(inputs, actions), dropout)
        return logits.transpose(1, 2), shares.transpose(1, 2)

    def judge(self, inputs: torch.Tensor, actions: torch.Tensor) -> tuple[torch.Tensor, torch.Tensor]:
        """Computes, for each episode, the outputs of one member.

        Args:
          inputs, actions: as for `unroll`; the first member judges the first B / K episodes, and so on.

        Returns:
          Logits of the belief, [T, B, L], and the share x of each interaction, [T, B, I].
        """
        logits, shares = self.members(self._histories(inputs, actions).unflatten(0, (self.num_members, -1)))
        return logits.flatten(0, 1).transpose(0, 1), shares.flatten(0, 1).transpose(0, 1)

    def _opinions(self, history, dropout=0.0):
        """Returns the outputs of all members for the same histories, [B, T, H]."""
        return self.members(history.expand(self.num_members, *history.shape), dropout)

    def _histories(self, inputs, actions):
        """Returns what members look at, [B, T, H], in whole episodes."""
        done = functional.pad(self._one_hot(actions[:-1]), (0, 0, 0, 0, 1, 0))
        return self._history(self.projection(inputs).transpose(0, 1), done.transpose(0, 1))

    def _history(self, seen, done):
        """Returns what members look at, [B, T, H], of inputs [B, T, F] and of what was done before them, [B, T, I]."""
        first, unit = seen[:, :1], torch.exp(self.log_scale)
        change, moved = (seen - first) / unit, torch.diff(seen, dim=1, prepend=first) / unit
        direction = moved / (moved.norm(dim=-1, keepdim=True) + _STILL)
        times = torch.arange(seen.shape[1], dtype=seen.dtype, device=seen.device)[:, None] / self.most_interactions
        return torch.cat([change, moved, direction, done, times.expand(len(seen), -1, -1)], dim=-1)

    def _one_hot(self, actions):
        """Maps actions to one number for each interaction, all 0 for a label."""
        num_interactions = self.num_interactions
        return functional.one_hot(actions.clamp(max=num_interactions), num_interactions + 1)[..., :-1].float()


class Projection(nn.Module):
    """A linear map of very many inputs, whose outputs change as much in a step of Adam however many there are."""

    def __init__(self, num_inputs: int, num_outputs: int):
        """Draws weights."""
        super().__init__()
        self.weight = nn.Parameter(torch.empty(num_outputs, num_inputs).uniform_(-1, 1))
        self._scale = num_inputs**-0.5

    def forward(self, inputs: torch.Tensor) -> torch.Tensor:
        """Maps inputs [..., num_inputs] to outputs [..., num_outputs]."""
        return functional.linear(self._scale * inputs, self.weight)


class Members(nn.Module):
    """K members, computed side by side, that share no weights: a memory of the episode, and two heads on it."""

    def __init__(
        self,
        num_members: int,
        num_inputs: int,
        num_labels: int,
        num_interactions: int,
        width: int,
        memory: config_lib.Memory,
    ):
        """Builds layers of a width for each member."""
        super().__init__()
        kinds: dict[str, type[nn.Module]] = {"attention": Attention, "lstm": LSTM}
        if memory not in kinds:
            raise ValueError(f"memory is {memory!r}; choose from {', '.join(kinds)}")
        self.embedding = Linear(num_members, num_inputs, width)
        self.memory = kinds[memory](num_members, width)
        self.hidden = Linear(num_members, width, 2 * width)  # Of both heads, a half each.
        self.belief, self.shares = (Linear(num_members, width, size) for size in (num_labels, num_interactions))

    def forward(self, history: torch.Tensor, dropout: float = 0.0) -> tuple[torch.Tensor, torch.Tensor]:
        """Maps histories, [K, B, T, H], to logits of beliefs, [K, B, T, L], and shares of interactions, [.., I]."""
        embedded = functional.relu(self.embedding(history))
        outputs = functional.relu(embedded + self.memory(embedded))
        believing, valuing = functional.relu(self.hidden(functional.dropout(outputs, dropout))).chunk(2, dim=-1)
        return self.belief(believing), self.shares(valuing).sigmoid()


class Attention(nn.Module):
    """One layer of causal attention for each of K members (Vaswani et al., 2017)."""

    def __init__(self, num_members: int, width: int):
        """Builds heads that together are as wide as the inputs."""
        super().__init__()
        self.heads = Linear(num_members, width, 3 * width)

    def forward(self, inputs: torch.Tensor) -> torch.Tensor:
        """Maps inputs [K, B, T, W] to what is recalled of the steps until then, [K, B, T, W]."""
        heads = self.heads(inputs).unflatten(-1, (3 * _NUM_HEADS, -1)).transpose(2, 3)
        queries, keys, values = heads.chunk(3, dim=2)
        recalled = functional.scaled_dot_product_attention(queries, keys, values, is_causal=True)
        return recalled.transpose(2, 3).flatten(3)


class LSTM(nn.Module):
    """An LSTM for each of K members (Hochreiter & Schmidhuber, 1997)."""

    def __init__(self, num_members: int, width: int):
        """Builds LSTMs as wide as their inputs."""
        super().__init__()
        self.members = nn.ModuleList(nn.LSTM(width, width, batch_first=True) for _ in range(num_members))

    def forward(self, inputs: torch.Tensor) -> torch.Tensor:
        """Maps inputs [K, B, T, W] to the outputs after each step, [K, B, T, W]."""
        return torch.stack([member(each)[0] for member, each in zip(self.members, inputs, strict=True)])


class Linear(nn.Module):
    """A linear layer for each of K members."""

    def __init__(self, num_members: int, num_inputs: int, num_outputs: int):
        """Draws weights as `torch.nn.Linear` does."""
        super().__init__()
        bound = num_inputs**-0.5
        self.weight = nn.Parameter(torch.empty(num_members, num_inputs, num_outputs).uniform_(-bound, bound))
        self.bias = nn.Parameter(torch.empty(num_members, 1, num_outputs).uniform_(-bound, bound))

    def forward(self, inputs: torch.Tensor) -> torch.Tensor:
        """Maps [K, ..., num_inputs] to [K, ..., num_outputs]."""
        return torch.baddbmm(self.bias, inputs.flatten(1, -2), self.weight).unflatten(1, inputs.shape[1:-1])
