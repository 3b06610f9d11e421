"""Noise: readings are inexact, in every episode in the same way, whatever is hidden."""

from chance import P_VALUE
from every_task import NOISY
import numpy as np
import pytest
from scipy import stats

from physexp import suite

NOISE = 0.01  # m
every_noisy_task = pytest.mark.parametrize("domain, task", [name.split("/") for name in NOISY])


def _flat(observation):
    return np.concatenate([value.reshape(len(value), -1) for value in observation.values()], axis=1)


def _played(domain, task, seed, size, noise, hidden=None, episode=0):
    """All that environments of a batch observe under fixed actions, float32 [steps, size, readings]."""
    batch = suite.load_batch(domain, task, size, {"random": seed, "noise": noise})
    observed = [_flat(batch.reset(episode=episode, hidden=hidden).observation)]
    actions = np.random.default_rng(seed).integers(batch.task.num_interactions, size=(6, size))
    observed += [_flat(batch.step(taken).observation) for taken in actions]
    batch.close()
    return np.array(observed)


@every_noisy_task
def test_noise_is_normal_and_new_in_every_reading_and_step(seed, domain, task):
    differences = [
        (_played(domain, task, seed, 50, NOISE, episode=e) - _played(domain, task, seed, 50, 0.0, episode=e)).ravel()
        for e in (0, 1)
    ]
    found = np.concatenate(differences)
    # Readings are float32, of the order of a metre: their last bit is 1e-7, a hundred-thousandth of the noise.
    assert stats.kstest(found / NOISE, "norm").pvalue > P_VALUE
    assert len(np.unique(np.round(found, 7))) > 0.9 * len(found)
    assert abs(np.corrcoef(*differences)[0, 1]) < 5 / np.sqrt(len(differences[0]))


@every_noisy_task
def test_noise_is_the_same_whatever_is_hidden(seed, domain, task):
    size = 16
    drawn = suite.load_task(domain, task, {"random": seed}).draw(np.full(size, seed), np.arange(size))
    one, other = (
        _played(domain, task, seed, size, NOISE, hidden) - _played(domain, task, seed, size, 0.0, hidden)
        for hidden in (drawn, drawn[::-1])
    )
    np.testing.assert_allclose(one, other, atol=1e-6)


@every_noisy_task
def test_readings_with_noise_have_no_bounds(domain, task):
    noisy, exact = (suite.load(domain, task, {"noise": noise}) for noise in (NOISE, 0.0))
    for name, spec in noisy.observation_spec().items():
        assert not hasattr(spec, "minimum") and hasattr(exact.observation_spec()[name], "minimum")
        assert spec.shape == exact.observation_spec()[name].shape
