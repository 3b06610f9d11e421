"""The belief learner's learner: steps of Adam on whole episodes from the replay, after each round of new ones."""

from collections.abc import Callable
import copy
import functools
import math

import numpy as np
import torch

from physexp.agents import acting as acting_lib
from physexp.agents import learning, rounds, synchronous
from physexp.agents.belief import acting, losses, networks, replay
from physexp.agents.belief import config as config_lib

_OUTCOMES = 1024  # Answers that calibration is measured on.
_WINDOW = 512  # Greedy episodes between two looks at how well it plays.
_NOTHING = dict.fromkeys(("belief_loss", "value_loss", "gradient_norm"), math.nan)  # Of a round without a step.
_BEST, _VARIANCE, _COUNT, _SUM, _SQUARES, _IS_WORSE = range(6)

Play = Callable[[networks.BeliefNetwork, int, acting_lib.Choose], rounds.Round]
"""Plays the round of a number with a network, which only advises, and keeps what it took in."""


class Variables(learning.Variables[networks.BeliefNetwork]):
    """All that training changes; `network` is the one that learns.

    Attributes:
      averaged: the network that acts while it learns, a moving average.
      best: the averaged network when it played best.
      handed_out: the averaged network; but the best one, once the averaged one has become worse.
      episodes: what was played last.
      moments: how far inputs have moved: the sum of squares and the count, float64 [2].
      outcomes: of the last greedy answers, the belief in them and whether they were right, float32 [N, 2]; -1 for none.
      scores: of the best window of greedy episodes, mean return and its variance; of the window that is being played,
        count, sum of returns and of their squares; and whether the last window was worse than the best, float64 [6].
    """

    def __init__(self, network: networks.BeliefNetwork, episodes: replay.Replay, weight_decay: float):
        """Gives a network an optimizer with a weight decay, its averages, and what it has played."""
        super().__init__(network, weight_decay=weight_decay)
        self.averaged, self.best, self.handed_out = (copy.deepcopy(network) for _ in range(3))
        self.episodes = episodes
        self.moments = torch.zeros(2, dtype=torch.float64)
        self.outcomes = torch.full((_OUTCOMES, 2), -1.0)
        self.scores = torch.tensor([-1.0, 0.0, 0.0, 0.0, 0.0, 0.0], dtype=torch.float64)

    def tensors(self):
        named = {name.replace("network/", "trained/", 1): value for name, value in super().tensors().items()}
        for prefix, network in (("averaged", self.averaged), ("best", self.best), ("network", self.handed_out)):
            named |= {f"{prefix}/{name}": value for name, value in network.state_dict().items()}
        own = {"moments": self.moments, "outcomes": self.outcomes, "scores": self.scores}
        return {**named, **own, "episodes/actions": self.episodes.actions}

    def hand_out(self) -> None:
        """Sets `handed_out` to the averaged network, or to the best one."""
        chosen = self.best if self.scores[_IS_WORSE] else self.averaged
        self.handed_out.load_state_dict(chosen.state_dict())


class BeliefLearner(synchronous.SynchronousLearner):
    """Plays rounds of episodes, keeps them, and learns from all that it keeps."""

    variables: Variables

    def __init__(self, variables: Variables, play: Play, config: config_lib.BeliefConfig):
        """Joins variables to episodes.

        Args:
          variables: the networks, the optimizer, and what was played.
          play: plays a round.
          config: the agent's configuration.
        """
        self.variables, self._play, self._config = variables, play, config

    def step(self) -> dict[str, float]:
        """Plays a round, and makes as many steps of Adam as its frames ask for."""
        config, variables, number = self._config, self.variables, self.next_episode
        explorer = acting.Explorer(variables.averaged, config, number)
        self.last_round = played = self._play(variables.averaged, number, explorer.choose)
        variables.episodes.add(played, number)
        self._measure_movement(played)
        self._measure_answers(explorer, played)
        returns = played.rewards.sum(axis=0) * config.discount ** (played.lengths - 1.0)
        greedy_returns = torch.from_numpy(returns[explorer.are_greedy])
        self._compare(greedy_returns)
        steps_before = int(variables.frames) // config.frames_per_step
        variables.rounds += 1
        variables.count(played.num_frames)
        learning_rate = config.learning_rate_at(int(variables.frames))
        generator = np.random.default_rng([config.seed, number])
        figures = []
        with torch.random.fork_rng(devices=[]):  # Which draws what drops out.
            torch.default_generator.manual_seed(int(generator.integers(2**63)))
            for _ in range(int(variables.frames) // config.frames_per_step - steps_before):
                drawn = variables.episodes.sample(generator, config.batch_size, config.num_members, number + 1)
                figures.append(self._learn(drawn, learning_rate))
        variables.hand_out()
        return {
            **{name: float(np.mean([each[name] for each in figures or [_NOTHING]])) for name in _NOTHING},
            "greedy_success_rate": float((greedy_returns > 0).double().mean()),
            "greedy_return": float(greedy_returns.mean()),
            **self._calibration(),
            "learning_rate": learning_rate,
            "updates": int(variables.updates),
            "frames": int(variables.frames),
        }

    def _learn(self, episodes: replay.Episodes, learning_rate: float) -> dict[str, float]:
        """Makes one step of Adam on some episodes; returns its metrics."""
        config, network, averaged = self._config, self.variables.network, self.variables.averaged
        played, actions, lengths = episodes.played, episodes.actions, episodes.lengths
        done = actions.to(network.device)
        inputs = _padded(episodes.inputs.to(network.device).float(), played)
        outputs = network.unroll(inputs, done, config.dropout)
        with torch.no_grad():
            judgement = averaged.judge(inputs, done)
        (logits, shares), (their_logits, their_shares) = (
            [part.cpu() for part in parts] for parts in (outputs, judgement)
        )
        learns = torch.arange(config.num_members)[:, None, None] != episodes.judges
        each = torch.arange(len(lengths))
        are_last = torch.arange(len(actions))[:, None] == lengths - 1
        last_actions = actions[lengths - 1, each]
        are_answered = last_actions >= network.num_interactions
        if config.answers_revealed:
            labels = torch.nn.functional.one_hot(episodes.answers, logits.shape[-1]).float()
            are_counted = played
        else:
            answers = (last_actions - network.num_interactions).clamp(min=0)
            labels = losses.hindsight(their_logits[lengths - 1, each], answers, episodes.rewards > 0)
            are_counted = played & are_answered
        if not config.every_step:
            are_counted = are_counted & are_last
        belief_loss = losses.belief_loss(logits, labels, are_counted & learns)
        beliefs = their_logits.softmax(-1)
        best = (shares.detach() * learns[..., None]).sum(0).argmax(-1)  # As those who learn from the episode see it.
        targets = losses.interaction_targets(
            losses.worth_of_answers(beliefs.amax(-1)),
            network.values(beliefs, their_shares).gather(-1, best[..., None])[..., 0],
            best == actions,
            are_last,
            episodes.rewards,
            config.discount,
            config.trace,
        )
        are_interactions = actions < network.num_interactions
        taken = actions.clamp(max=network.num_interactions - 1).expand(config.num_members, *actions.shape)
        values = network.values(beliefs, shares).gather(-1, taken[..., None])[..., 0]
        value_loss = losses.value_loss(values, targets, played & are_interactions & learns)
        gradients, norm = learning.clipped_gradients(
            network, (belief_loss + value_loss).sum(), config.max_gradient_norm, episodes.arrays
        )
        self.variables.apply(gradients, learning_rate)
        with torch.no_grad():
            torch._foreach_lerp_(list(averaged.parameters()), list(network.parameters()), 1 - config.averaging)
        return {
            "belief_loss": belief_loss.mean().item(),
            "value_loss": value_loss.mean().item(),
            "gradient_norm": norm,
        }

    def _measure_movement(self, played: rounds.Round) -> None:
        """Notes how far inputs are from where they were at the start of their episode: the unit they are taken in."""
        variables = self.variables
        assert played.inputs is not None
        were_played = torch.from_numpy(played.played)
        seen = _padded(played.inputs.cpu(), were_played)
        moved = (seen - seen[:1])[were_played].double()
        variables.moments += torch.stack([moved.square().sum(), (moved != 0).sum()])
        squares, count = variables.moments.tolist()
        if count:
            for network in (variables.network, variables.averaged):
                network.log_scale.fill_(0.5 * math.log(squares / count))

    def _measure_answers(self, explorer: acting.Explorer, played: rounds.Round) -> None:
        """Notes how sure the greedy answers of a round were, and which were right."""
        are_counted = explorer.are_greedy & ~np.isnan(explorer.beliefs)
        answered = np.stack([explorer.beliefs, played.rewards.sum(axis=0) > 0], axis=1)[are_counted]
        kept = torch.cat([self.variables.outcomes, torch.from_numpy(answered).float()])
        self.variables.outcomes.copy_(kept[-_OUTCOMES:])

    def _calibration(self) -> dict[str, float]:
        beliefs, outcomes = self.variables.outcomes[self.variables.outcomes[:, 0] >= 0].T
        if not len(beliefs):
            return {"brier_score": math.nan, "calibration_error": math.nan}
        return {
            "brier_score": float((beliefs - outcomes).square().mean()),
            "calibration_error": losses.calibration_error(beliefs, outcomes),
        }

    def _compare(self, returns: torch.Tensor) -> None:
        """Notes what greedy episodes returned and, when a window of them is over, whether it once was more."""
        variables, scores = self.variables, self.variables.scores
        scores[[_COUNT, _SUM, _SQUARES]] += torch.stack(
            [torch.tensor(float(len(returns))), returns.sum(), returns.square().sum()]
        )
        if scores[_COUNT] < _WINDOW:
            return
        mean = scores[_SUM] / scores[_COUNT]
        variance = (scores[_SQUARES] / scores[_COUNT] - mean**2) / scores[_COUNT]
        # Two standard errors: what is within them is luck.
        scores[_IS_WORSE] = mean < scores[_BEST] - 2 * (scores[_VARIANCE] + variance).sqrt()
        if mean > scores[_BEST]:
            scores[_BEST], scores[_VARIANCE] = mean, variance
            variables.best.load_state_dict(variables.averaged.state_dict())
        scores[[_COUNT, _SUM, _SQUARES]] = 0.0

    def restore(self, state):
        super().restore(state)
        play = functools.partial(self._play, self.variables.averaged)
        self.variables.episodes.restore(play, self.next_episode)


def _padded(packed: torch.Tensor, played: torch.Tensor) -> torch.Tensor:
    """Returns packed steps, [N, ...], as [T, B, ...], 0 where nothing was played."""
    padded = packed.new_zeros((*played.shape, *packed.shape[1:]))
    padded[played.to(packed.device)] = packed
    return padded
