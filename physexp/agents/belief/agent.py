"""The belief learner: plays a round of whole episodes, learns from all that it has kept, and so on, in one process."""

from collections.abc import Mapping
import math

import numpy as np
import torch

from physexp.agents import acting as acting_lib
from physexp.agents import core, devices, rounds, starting, synchronous
from physexp.agents import learning as learning_lib
from physexp.agents.belief import acting, learning, losses, networks, replay
from physexp.agents.belief import config as config_lib

# One value for all tasks.
_LEARNING_RATE = 4e-3  # Adam's at the start; it decays linearly to zero over training.
_BATCH_SIZE = 32  # Episodes in a step of Adam.
_DROPOUT = 0.1  # Share of a memory's outputs that is dropped, so that beliefs are less sure of rare experience.
_EMA_DECAY = 0.99  # Of the network that acts, a moving average of the one that learns.
_FORESIGHT = 3.0  # Weight of the loss of foresight.
_LAMBDA = 0.9  # Weight of the return of greedy actions against the network's own values.
_NO_METRICS = dict.fromkeys(("belief_loss", "value_loss", "gradient_norm"), math.nan)  # Of a round without a step.


class Belief(synchronous.SynchronousAgent):
    """Keeps a belief about the answer, and estimates the value of each interaction."""

    variables: learning.Variables

    def __init__(self, make_environment: core.EnvironmentFactory, config: config_lib.BeliefConfig):
        """Makes the environments, the network, and the replay; raises ValueError if that is larger than memory."""
        num_environments = config_lib.NUM_ENVIRONMENTS
        super().__init__(make_environment, num_environments, config)
        network = starting.make_network(networks.BeliefNetwork, self._environment, config)
        network.calibrate(acting_lib.as_tensors(self._environment.reset().observation))
        network.to(devices.choose(config.device, network.sees_images))
        num_rounds = config.replay_episodes // num_environments
        dtype = np.float16 if network.sees_images else np.float32
        longest = network.max_interactions + self._environment.num_questions
        episodes = replay.Replay(num_rounds, longest, num_environments, network.num_inputs, dtype)
        self.variables, self._config = learning.Variables(network, episodes), config

    def _play(self, number: int, choose: acting_lib.Choose) -> rounds.Round:
        """Plays the round of a number with the averaged network, and keeps the encoded observations."""
        return acting_lib.play_round(self.variables.averaged, self._environment, number, choose, keep_inputs=True)

    def step(self) -> dict[str, float]:
        """Plays a round, and makes as many steps of Adam as its frames ask for."""
        config, variables, number = self._config, self.variables, self.next_episode
        num_questions = self._environment.num_questions
        network = variables.network
        policy = acting.BehaviourPolicy(
            network.num_interactions, network.max_interactions, config.seed, number, random_starts=config.foresight
        )
        self.last_round = played = self._play(number, policy.choose)
        variables.episodes.add(played, number)
        self._measure_changes(played)
        last = played.rewards[played.lengths - 1, np.arange(len(played.lengths))]
        answered = np.stack([policy.beliefs, last > 0], axis=1)
        variables.add_outcomes(torch.from_numpy(answered[policy.are_greedy & ~np.isnan(policy.beliefs)]))
        returns = (played.rewards * config.discount ** np.arange(float(len(played.rewards)))[:, None]).sum(axis=0)
        greedy_returns = torch.from_numpy(returns[policy.are_greedy])
        variables.compare(greedy_returns)
        steps_before = int(variables.frames) // config.period
        counts = variables.count(played.num_frames)
        learning_rate = _LEARNING_RATE * (1 - config.progress(int(variables.frames)))
        generator = np.random.default_rng([config.seed, number])
        metrics = []
        torch.default_generator.manual_seed(int(generator.integers(2**63)))  # Dropout draws from it.
        for _ in range(int(variables.frames) // config.period - steps_before):
            episodes, held_out = variables.episodes.sample(generator, _BATCH_SIZE, networks.ENSEMBLE_SIZE, number + 1)
            metrics.append(self._learn(episodes, held_out, learning_rate))
        variables.update_agent()
        return {
            **{name: float(np.mean([each[name] for each in metrics or [_NO_METRICS]])) for name in _NO_METRICS},
            "greedy_success_rate": float((played.rewards > 0).sum(0)[policy.are_greedy].mean() / num_questions),
            "greedy_return": float(greedy_returns.mean()),
            **self._calibration(),
            "learning_rate": learning_rate,
            **counts,
        }

    def _learn(self, episodes: rounds.Round, held_out: torch.Tensor, learning_rate: float) -> dict[str, float]:
        """Makes one step of Adam on B episodes with held-out members, int64 [B], ascending; returns its metrics."""
        config, network, averaged = self._config, self.variables.network, self.variables.averaged
        assert episodes.inputs is not None
        actions, played = torch.from_numpy(episodes.actions), torch.from_numpy(episodes.played)
        inputs = episodes.padded(episodes.inputs.to(network.device).float())
        unrolled = network.unroll(inputs, actions.to(network.device), _DROPOUT)
        logits, shares = unrolled.logits.cpu(), unrolled.shares.cpu()
        with torch.no_grad():
            outputs_of_held_out = averaged.held_out(inputs, actions.to(network.device))
        held_out_logits, held_out_shares = (part.cpu() for part in outputs_of_held_out)
        learns = torch.arange(networks.ENSEMBLE_SIZE)[:, None, None] != held_out
        are_ends, labels, are_counted = self._label_targets(episodes, held_out_logits)
        belief_loss = losses.belief_loss(logits, labels, are_counted & learns)
        beliefs = held_out_logits.softmax(-1)
        best = (shares.detach() * learns[..., None]).sum(0).argmax(-1)  # By the members that learn from the episode.
        interacting = network.values(beliefs, held_out_shares).gather(-1, best[..., None])[..., 0]
        answering, rewards = losses.answer_values(beliefs.amax(-1)), torch.from_numpy(episodes.rewards)
        are_final = self._final_steps(are_ends)
        targets = losses.interaction_targets(
            answering, interacting, best == actions, are_ends, are_final, rewards, config.discount, _LAMBDA
        )
        taken = actions.clamp(max=network.num_interactions - 1).expand(len(logits), *actions.shape)
        values = network.values(beliefs, shares).gather(-1, taken[..., None])[..., 0]
        value_loss = losses.value_loss(values, targets, played & (actions < network.num_interactions) & learns)
        loss = belief_loss + value_loss
        if unrolled.foreseen is not None:
            expected, moved = (part.cpu() for part in unrolled.foreseen)
            are_foreseen = played[1:] & (actions[:-1] < network.num_interactions) & learns
            loss = loss + _FORESIGHT * losses.foresight_loss(expected, moved, are_foreseen)
        gradients, norm = learning_lib.clipped_gradients(network, loss.sum(), episodes)
        self.variables.apply(gradients, learning_rate)
        with torch.no_grad():
            torch._foreach_lerp_(list(averaged.parameters()), list(network.parameters()), 1 - _EMA_DECAY)
        means = {"belief_loss": belief_loss.mean().item(), "value_loss": value_loss.mean().item()}
        return {**means, "gradient_norm": norm}

    def _label_targets(
        self, episodes: rounds.Round, held_out_logits: torch.Tensor
    ) -> tuple[torch.Tensor, torch.Tensor, torch.Tensor]:
        """Returns where questions end, bool [T, B], the targets of beliefs, and the steps that are learned from.

        Targets are probabilities, [T, B, L], of the labels of the current question, and steps are bool [T, B]. The
        logits are those of the held-out members' beliefs, [T, B, L].
        """
        actions, num_interactions = torch.from_numpy(episodes.actions), self.variables.network.num_interactions
        played, is_last = torch.from_numpy(episodes.played), torch.from_numpy(episodes.is_last)
        are_answers = played & (actions >= num_interactions)
        are_ends, steps = are_answers | is_last, torch.arange(len(actions))[:, None]
        ends = torch.where(are_ends, steps, len(actions) - 1).flip(0).cummin(0).values.flip(0)
        at_end = ends, torch.arange(actions.shape[1])
        num_questions = self._environment.num_questions
        if self._config.answers_revealed and num_questions == 1:
            answers = torch.from_numpy(episodes.answers)
            labels = torch.nn.functional.one_hot(answers, held_out_logits.shape[-1]).float().expand_as(held_out_logits)
            are_counted = played
        else:  # Several questions have two labels each, so a reward reveals the right one.
            left = torch.where(is_last, num_questions - are_answers.cumsum(0), 0)  # In the end, each costs 1.
            are_right = torch.from_numpy(episodes.rewards) + left > 0
            answered = (actions - num_interactions).clamp(min=0)
            labels = losses.label_posterior(held_out_logits[at_end], answered[at_end], are_right[at_end])
            are_counted = played & are_answers[at_end]
        return are_ends, labels, are_counted if self._config.learns_every_step else are_counted & are_ends

    def _final_steps(self, are_ends: torch.Tensor) -> torch.Tensor:
        """Returns the steps that are worth an answer alone, bool [T, B] or [T, 1].

        Exploring episodes are stopped early, and an interaction before that would seem to be worth less than it is. So
        with foresight only the step counts after which no interaction is allowed.
        """
        if not self._config.foresight:
            return are_ends
        return (torch.arange(len(are_ends)) >= self.variables.network.max_interactions)[:, None]

    def _measure_changes(self, played: rounds.Round) -> None:
        """Updates the unit of inputs: their root mean square change since the start of the episode."""
        variables = self.variables
        assert played.inputs is not None
        seen = played.padded(played.inputs.cpu())
        changes = (seen - seen[:1])[torch.from_numpy(played.played)].double()
        variables.moments += torch.stack([changes.square().sum(), (changes != 0).sum()])
        squares, count = variables.moments.tolist()
        if count:
            for network in (variables.network, variables.averaged):
                network.log_scale.fill_(0.5 * math.log(squares / count))

    def _calibration(self) -> dict[str, float]:
        beliefs, outcomes = self.variables.outcomes[self.variables.outcomes[:, 0] >= 0].T
        if not len(beliefs):
            return {"brier_score": math.nan, "calibration_error": math.nan}
        return {
            "brier_score": float((beliefs - outcomes).square().mean()),
            "calibration_error": losses.calibration_error(beliefs, outcomes),
        }

    def restore(self, tensors: Mapping[str, torch.Tensor]) -> None:
        """Takes up what `save` returned, and plays the kept episodes again to have their observations."""
        super().restore(tensors)
        self.variables.episodes.restore(self._play, self.next_episode)
