"""The belief network: probabilities of the labels, and values of the interactions."""

from collections.abc import Mapping
import dataclasses
from typing import Any

from dm_env import specs
import torch
from torch import nn
from torch.nn import functional

from physexp.agents import core, networks
from physexp.agents.belief import config as config_lib
from physexp.agents.belief import losses

ENSEMBLE_SIZE = 4
"""Members; each learns from the environments of the others, and is the held-out member of its own."""

_NUM_HEADS = 4
_WIDTH = 64  # Units of a layer, or of all heads together.
_PIXEL_SCALE = 10.0  # Changes in an image are of the order of a tenth of its range.
_FIRST_SHARE = -3.0  # Bias of the shares of a new network with foresight, whose logit it is: x is about 0.05.
_LEAST_LOG = -6.0  # Of a probability that the values are told; less likely labels do not matter to them.
_STILL = 0.01  # A step in which everything moves by less than this share of the unit shows no clear direction.
_TEMPERATURE = 0.001  # Of the policy: actions are as good as equal when their values differ by less.


class BeliefNetwork(networks.RecurrentNetwork):
    """An ensemble of members, each of which has a belief about the label and values the interactions.

    An answer is worth `S = 2 max(b) - 1`, the expected reward, with the mean `b` of the members' beliefs. An
    interaction costs nothing but its delay, and cannot tell more than the label (the value of perfect information:
    Howard, 1966). So `gamma S <= Q <= gamma`, and the members estimate the position in between:
    `Q = gamma (S + (1 - S) x)` with the mean of their shares `x` in [0, 1]. The best action has the greatest of `S` and
    all `Q`.

    Observations, features or the convolutions of an image, are taken relative to the start of the episode and to the
    step before, in units of their mean change, which the learner measures. The direction of the last change tells which
    things moved together, however far. A question that is told is in the first observation itself.

    With `foresight` the belief is proportional to a product of evidence, a factor for each step, as Bayes' rule has it:
    its logits are sums over the steps. The values are told the belief. Members learn to foresee the change of the
    observation by an interaction, for which no label is needed. And in a new network `x` is small, so that an
    interaction is worth little more than an answer until it is seen to be worth more.

    The convolutions keep their random weights, which preserve the content of an image (Saxe et al., 2011), so that each
    image passes them once, when it is played. A projection, shared by all members, learns the part that matters.

    Attributes:
      num_inputs: the length F of an encoded observation.
    """

    log_scale: torch.Tensor

    def __init__(
        self,
        observation_spec: Mapping[str, specs.Array],
        num_actions: int,
        *,
        num_interactions: int,
        memory: config_lib.Memory,
        max_interactions: int,
        discount: float,
        sees_start: bool = False,
        foresight: bool = False,
    ):
        """Builds the network, with weights from torch's global seed; for the hyperparameters see `BeliefConfig`."""
        super().__init__(observation_spec, _PIXEL_SCALE, 1.0)
        self.num_interactions, self.max_interactions, self.discount = num_interactions, max_interactions, discount
        self.torso.requires_grad_(False)
        self.num_inputs = self._num_seen = self.torso.num_outputs
        self.projection: nn.Module = nn.Identity()
        if self.sees_images:
            self._num_seen = _WIDTH
            self.projection = Projection(self.num_inputs, _WIDTH)
        self._sees_start = sees_start
        history_size = (3 + sees_start) * self._num_seen + num_interactions + 1
        sizes = history_size, num_actions - num_interactions, num_interactions
        self.members = Members(*sizes, memory, self._num_seen if foresight else 0)
        self.register_buffer("log_scale", torch.zeros(()))

    @staticmethod
    def hyperparameters(task: core.Specs, config: config_lib.BeliefConfig) -> dict[str, Any]:
        """Returns the further arguments of `__init__`."""
        return {
            "num_interactions": task.num_interactions,
            "memory": config.memory,
            "max_interactions": config.longest(task.action_spec().num_values - task.num_interactions, task.step_limit),
            "discount": config.discount,
            **({"sees_start": True} if task.is_told else {}),
            **({"foresight": True} if config.foresight else {}),
        }

    def initial_state(self, batch_size: int) -> networks.State:
        """Returns the state at the start of episodes: all observations, and the actions before each of them."""
        shapes = (1, batch_size, 0, self._num_seen), (1, batch_size, 1, self.num_interactions)
        seen, done = (torch.zeros(shape, dtype=torch.float32, device=self.device) for shape in shapes)
        return seen, done

    def step(self, inputs: torch.Tensor, state: networks.State) -> tuple[networks.Output, networks.State]:
        """Computes one time step; see `RecurrentNetwork`. The policy prefers the action of the highest value."""
        seen, done = state
        seen = torch.cat([seen, self.projection(inputs)[None, :, None]], dim=2)
        logits, shares = self.members(_for_all(self._history(seen[0], done[0])))
        beliefs = logits[:, :, -1].softmax(-1).mean(0)
        values = self.values(beliefs, shares[:, :, -1].mean(0))
        if seen.shape[2] > self.max_interactions:
            values = torch.full_like(values, -1.0)
        action_values = torch.cat([values, losses.answer_values(beliefs)], dim=1)
        policy = action_values / _TEMPERATURE
        rounded = policy * _TEMPERATURE  # So that greedy choices by values and by logits agree.
        beliefs = (rounded[:, self.num_interactions :] + 1) / 2
        return networks.Output(policy, action_values.max(1).values, rounded, beliefs), (seen, done)

    def observe_action(self, actions: torch.Tensor, state: networks.State) -> networks.State:
        """Returns the state with the actions taken added."""
        seen, done = state
        return seen, torch.cat([done, self._one_hot(actions.to(self.device))[None, :, None]], dim=2)

    def values(self, beliefs: torch.Tensor, shares: torch.Tensor) -> torch.Tensor:
        """Returns the values Q of interactions, [..., I], of beliefs [..., L] and shares x, [..., I]."""
        answering = losses.answer_values(beliefs.amax(-1, keepdim=True))
        return self.discount * (answering + (1 - answering) * shares)

    def unroll(self, inputs: torch.Tensor, actions: torch.Tensor, dropout: float = 0.0) -> "Unrolled":
        """Computes the outputs of all members for encoded observations, [T, B, F], and actions taken, int64 [T, B]."""
        history = self._histories(inputs, actions)
        outputs = self.members.remember(_for_all(history), dropout)
        logits, shares = (part.transpose(1, 2) for part in self.members.judge(outputs))
        if not self.members.foresees:
            return Unrolled(logits, shares)
        expected = self.members.foresee(outputs[:, :, :-1], _for_all(self._one_hot(actions[:-1]).transpose(0, 1)))
        moved = history[:, 1:, self._num_seen : 2 * self._num_seen].detach()
        return Unrolled(logits, shares, (expected.transpose(1, 2), moved.transpose(0, 1)))

    def held_out(self, inputs: torch.Tensor, actions: torch.Tensor) -> tuple[torch.Tensor, torch.Tensor]:
        """Returns the logits and shares of the held-out member of each episode, [T, B, L] and [T, B, I].

        The first member is held out from the first B / K episodes, and so on.
        """
        logits, shares = self.members(torch.stack(self._histories(inputs, actions).chunk(ENSEMBLE_SIZE)))
        return logits.flatten(0, 1).transpose(0, 1), shares.flatten(0, 1).transpose(0, 1)

    def _histories(self, inputs: torch.Tensor, actions: torch.Tensor) -> torch.Tensor:
        """Returns the members' inputs for whole episodes, [B, T, H]."""
        done = functional.pad(self._one_hot(actions[:-1]), (0, 0, 0, 0, 1, 0))
        return self._history(self.projection(inputs).transpose(0, 1), done.transpose(0, 1))

    def _history(self, seen: torch.Tensor, done: torch.Tensor) -> torch.Tensor:
        """Returns the members' inputs, [B, T, H], from observations [B, T, F] and actions before them, [B, T, I]."""
        first, unit = seen[:, :1], torch.exp(self.log_scale)
        change, moved = (seen - first) / unit, torch.diff(seen, dim=1, prepend=first) / unit
        direction = moved / (moved.norm(dim=-1, keepdim=True) + _STILL)
        times = torch.arange(seen.shape[1], dtype=seen.dtype, device=seen.device)[:, None] / self.max_interactions
        parts = [change, moved, direction, done, times.expand(len(seen), -1, -1)]
        return torch.cat(parts + [(first / unit).expand_as(change)] * self._sees_start, dim=-1)

    def _one_hot(self, actions: torch.Tensor) -> torch.Tensor:
        """Maps actions to one number for each interaction, all 0 for a label."""
        num_interactions = self.num_interactions
        return functional.one_hot(actions.clamp(max=num_interactions), num_interactions + 1)[..., :-1].float()


def _for_all(history: torch.Tensor) -> torch.Tensor:
    """Returns a tensor once for each member."""
    return history.expand(ENSEMBLE_SIZE, *history.shape)


@dataclasses.dataclass(frozen=True)
class Unrolled:
    """Outputs of K members for whole episodes.

    Attributes:
      logits: of beliefs, [K, T, B, L].
      shares: the share x of each interaction, [K, T, B, I].
      foreseen: changes of the observation from each step to the next, as members expect them, [K, T - 1, B, F], and as
        they are, [T - 1, B, F]; None without foresight.
    """

    logits: torch.Tensor
    shares: torch.Tensor
    foreseen: tuple[torch.Tensor, torch.Tensor] | None = None


class Projection(nn.Module):
    """A linear map of very many inputs, whose outputs change as much in a step of Adam however many there are."""

    def __init__(self, num_inputs: int, num_outputs: int):
        """Draws weights uniformly from -1 to 1."""
        super().__init__()
        self.weight = nn.Parameter(torch.empty(num_outputs, num_inputs).uniform_(-1, 1))
        self._scale = num_inputs**-0.5

    def forward(self, inputs: torch.Tensor) -> torch.Tensor:
        """Maps inputs [..., num_inputs] to outputs [..., num_outputs]."""
        return functional.linear(self._scale * inputs, self.weight)


class Members(nn.Module):
    """K members, computed side by side, that share no weights: a memory of the episode, and two heads on it."""

    def __init__(
        self, num_inputs: int, num_labels: int, num_interactions: int, memory: config_lib.Memory, num_foreseen: int = 0
    ):
        """Builds the layers of each member; with 0 numbers to foresee, none of the network's foresight."""
        super().__init__()
        kinds: dict[str, type[nn.Module]] = {"attention": Attention, "lstm": LSTM}
        self.embedding = Linear(num_inputs, _WIDTH)
        self.memory = kinds[memory]()
        self.hidden = Linear(_WIDTH, 2 * _WIDTH)  # Of both heads, a half each.
        self.foresees = num_foreseen > 0
        num_told = num_labels if self.foresees else 0
        self.belief, self.shares = Linear(_WIDTH, num_labels), Linear(_WIDTH + num_told, num_interactions)
        if self.foresees:
            nn.init.constant_(self.shares.bias, _FIRST_SHARE)
            self.expecting, self.expected = Linear(_WIDTH + num_interactions, _WIDTH), Linear(_WIDTH, num_foreseen)

    def forward(self, history: torch.Tensor) -> tuple[torch.Tensor, torch.Tensor]:
        """Maps histories, [K, B, T, H], to logits of beliefs, [K, B, T, L], and shares of interactions, [.., I]."""
        return self.judge(self.remember(history))

    def remember(self, history: torch.Tensor, dropout: float = 0.0) -> torch.Tensor:
        """Maps histories, [K, B, T, H], to memories, [K, B, T, W]."""
        embedded = functional.relu(self.embedding(history))
        outputs = functional.relu(embedded + self.memory(embedded))
        return functional.dropout(outputs, dropout)

    def judge(self, outputs: torch.Tensor) -> tuple[torch.Tensor, torch.Tensor]:
        """Maps memories to logits and shares; see `forward`."""
        believing, valuing = functional.relu(self.hidden(outputs)).chunk(2, dim=-1)
        logits = self.belief(believing)
        if self.foresees:
            logits = logits.cumsum(2)
            told = logits.detach().log_softmax(-1).clamp(min=_LEAST_LOG)
            valuing = torch.cat([valuing, told], dim=-1)
        return logits, self.shares(valuing).sigmoid()

    def foresee(self, outputs: torch.Tensor, actions: torch.Tensor) -> torch.Tensor:
        """Maps memories, [K, B, T, W], and interactions, one-hot [K, B, T, I], to changes that they expect, [.., F]."""
        changes: torch.Tensor = self.expected(functional.relu(self.expecting(torch.cat([outputs, actions], dim=-1))))
        return changes


class Attention(nn.Module):
    """One layer of causal attention for each of K members (Vaswani et al., 2017)."""

    def __init__(self) -> None:
        """Builds heads that together are as wide as the inputs."""
        super().__init__()
        self.heads = Linear(_WIDTH, 3 * _WIDTH)

    def forward(self, inputs: torch.Tensor) -> torch.Tensor:
        """Maps inputs [K, B, T, W] to memories of the steps until then, [K, B, T, W]."""
        heads = self.heads(inputs).unflatten(-1, (3 * _NUM_HEADS, -1)).transpose(2, 3)
        queries, keys, values = heads.chunk(3, dim=2)
        recalled = functional.scaled_dot_product_attention(queries, keys, values, is_causal=True)
        return recalled.transpose(2, 3).flatten(3)


class LSTM(nn.Module):
    """An LSTM for each of K members (Hochreiter & Schmidhuber, 1997)."""

    def __init__(self) -> None:
        """Builds LSTMs as wide as their inputs."""
        super().__init__()
        self.members = nn.ModuleList(nn.LSTM(_WIDTH, _WIDTH, batch_first=True) for _ in range(ENSEMBLE_SIZE))

    def forward(self, inputs: torch.Tensor) -> torch.Tensor:
        """Maps inputs [K, B, T, W] to the outputs after each step, [K, B, T, W]."""
        return torch.stack([member(each)[0] for member, each in zip(self.members, inputs, strict=True)])


class Linear(nn.Module):
    """A linear layer for each of K members."""

    def __init__(self, num_inputs: int, num_outputs: int):
        """Draws weights as `torch.nn.Linear` does."""
        super().__init__()
        bound = num_inputs**-0.5
        self.weight = nn.Parameter(torch.empty(ENSEMBLE_SIZE, num_inputs, num_outputs).uniform_(-bound, bound))
        self.bias = nn.Parameter(torch.empty(ENSEMBLE_SIZE, 1, num_outputs).uniform_(-bound, bound))

    def forward(self, inputs: torch.Tensor) -> torch.Tensor:
        """Maps [K, ..., num_inputs] to [K, ..., num_outputs]."""
        outputs = torch.baddbmm(self.bias, inputs.flatten(1, -2), self.weight)
        return outputs.reshape(*inputs.shape[:-1], -1)
