"""A policy for K things with one odd one out and noisy readings, as a lower bound.

Things have the same physics and do not disturb each other, so a reading of one thing depends on its own value alone.
The belief is exact (Bayes' rule on a grid of values) and uses all readings, also of things that still move. The policy
looks one touch ahead (the value of information; Howard, 1966). It values untouched things as if they were read without
noise.
"""

import numpy as np
from scipy import special
from scipy.stats import qmc

from physexp.agents import core
from physexp.analysis.ideal import base, calibration, odd_one_out
from physexp.suite.engine import priors

VALUES = (np.arange(257) + 0.5) / 257
"""The values that are told apart: the middles of equal parts of [0, 1]."""
_OUTCOMES = 32  # Of a touch, to average over; drawn evenly (Sobol).
_MAX_TOUCHES = 12  # Then it answers, or waits for the last step.


def posterior(likelihoods: np.ndarray, prior: priors.OddOneOut) -> tuple[np.ndarray, np.ndarray]:
    """Returns the probability of each thing to have the largest value, [N, K], and the distributions, [N, K, G].

    The likelihoods are those of the readings of each thing, for values in the middles of G equal parts of [0, 1], up to
    a factor for each thing; float64 [N, K, G]. Of two values in one part, either is as likely to be the larger one.
    """
    edges = np.linspace(0, 1, likelihoods.shape[-1] + 1)
    # Every part has a positive probability, so that every reading is possible.
    chances = (np.diff(cdf(edges)) + np.finfo(float).tiny for cdf in (prior.common_cdf, prior.odd_cdf))
    common, odd = (chance * likelihoods for chance in chances)
    of_common, of_odd = common.sum(-1, keepdims=True), odd.sum(-1, keepdims=True)
    is_odd = of_odd[..., 0] / of_common[..., 0]
    is_odd = is_odd / is_odd.sum(1, keepdims=True)
    common, odd = common / of_common, odd / of_odd
    smaller, odd_smaller = (density.cumsum(-1) - density / 2 for density in (common, odd))
    largest = np.zeros(likelihoods.shape[:2])
    for one in range(prior.num_things):  # The odd one.
        densities, below = common.copy(), smaller.copy()
        densities[:, one], below[:, one] = odd[:, one], odd_smaller[:, one]
        for k in range(prior.num_things):
            others = np.delete(below, k, axis=1).prod(1)
            largest[:, k] += is_odd[:, one] * (densities[:, k] * others).sum(-1)
    mixed = is_odd[..., None] * odd + (1 - is_odd[..., None]) * common
    return largest / largest.sum(1, keepdims=True), mixed


class Player(core.EpisodicActor):
    """Plays the policy; its state is the likelihood of the readings of each thing, and the steps of its touches."""

    def __init__(self, exact: odd_one_out.Solution, responses: calibration.Responses, noise: float):
        """Takes the ideal experimenter without noise, the readings of `VALUES` without noise, and the noise, m."""
        self._exact, self._responses, self._noise = exact, responses, noise
        self._prior = exact.prior
        draws = qmc.Sobol(2, seed=0).random(_OUTCOMES)
        self._levels, self._errors = draws[:, 0], noise * special.ndtri(draws[:, 1])

    def beliefs(self) -> np.ndarray:
        """Returns the probability of each thing to have the largest value, float64 [K]."""
        return self._posterior(self._logs[None])[0][0]

    def _begin(self, timestep):
        self._touched: list[tuple[bool, ...]] = [()] * self._prior.num_things
        self._logs = np.zeros((self._prior.num_things, len(VALUES)))
        self._num_touches = 0

    def _choose(self, observation) -> int:
        beliefs, densities = self._posterior(self._logs[None])
        answer, label = base.answer_values(beliefs[0].max()), self._prior.num_things + int(beliefs[0].argmax())
        left = self._exact.step_limit - self._num_touches
        last = self._exact.discount ** (left - 1) * answer  # Value of answering in the last step.
        if left == 1 or self._num_touches >= _MAX_TOUCHES:
            return label if left == 1 or answer >= last else 0
        means = densities[0] @ self._responses.values
        unknown = [k for k, touched in enumerate(self._touched) if not touched]
        means[unknown] = np.nan
        if unknown and self._exact.evaluate(means[None], left)[1][0] > answer:
            return unknown[0]
        candidates = [k for k in range(self._prior.num_things) if k not in unknown[1:]]  # Untouched ones are equal.
        values = [self._value_of_touching(k, densities[0, k]) for k in candidates]
        best = int(np.argmax(values))
        return candidates[best] if max(values[best], last) > answer else label

    def _note(self, action, next_timestep):
        if action >= self._prior.num_things or next_timestep.last():
            return
        self._num_touches += 1
        if self._num_touches > _MAX_TOUCHES:
            return  # From here on it only waits.
        read = next_timestep.observation[self._responses.feature]
        for k, touched in enumerate(self._touched):
            if touched or k == action:
                self._touched[k] = (*touched, k == action)
                self._logs[k] += self._log_likelihoods(read[k], self._touched[k])

    def _log_likelihoods(self, read, touched: tuple[bool, ...]) -> np.ndarray:
        """Returns the log-likelihoods of the values, up to a constant: [G], or [N, G] for readings [N, 1]."""
        return -0.5 * ((read - self._responses.after(touched)) / self._noise) ** 2

    def _posterior(self, logs: np.ndarray):
        return posterior(np.exp(logs - logs.max(-1, keepdims=True)), self._prior)

    def _value_of_touching(self, thing: int, density: np.ndarray) -> float:
        """Returns the expected return of touching a thing once more and answering then."""
        touched = (*self._touched[thing], True)
        nodes = np.searchsorted(density.cumsum(), self._levels).clip(max=len(VALUES) - 1)
        read = self._responses.after(touched)[nodes] + self._errors
        logs = np.repeat(self._logs[None], _OUTCOMES, axis=0)
        logs[:, thing] += self._log_likelihoods(read[:, None], touched)
        beliefs, _ = self._posterior(logs)
        return self._exact.discount * float(base.answer_values(beliefs.max(1)).mean())
