"""Estimates follow their formulas, and 95 % of the intervals contain the truth, counted over made data."""

import math

from chance import P_VALUE
import numpy as np
import pytest
from scipy import stats
from seeds import fresh_seed

from physexp.analysis.data import estimates

_NORMAL_975 = stats.norm.ppf(0.975)
_EVERYTHING = (-math.inf, math.inf)


def generator():
    return np.random.default_rng(fresh_seed())


def assert_same(estimate, expected, **tolerance):
    assert (estimate.value, estimate.low, estimate.high) == pytest.approx(expected, **tolerance)


def assert_unknown(estimate, ends=_EVERYTHING):
    assert (estimate.low, estimate.high) == ends and not estimate.can_be_tested
    assert estimate.p_value(1.0, "greater") == estimate.p_value(1.0, "less") == 1


def test_a_proportion_has_wilsons_interval():
    # 3 of 4: z^2 = 3.841459; centre (3/4 + z^2/8) / (1 + z^2/4) = 1.230182 / 1.960365 = 0.627527; half width
    # z / (1 + z^2/4) * sqrt(3/64 + z^2/64) = 0.999793 * sqrt(0.106898) = 0.326885.
    assert_same(estimates.proportion(3, 4), (0.75, 0.300642, 0.954412), abs=1e-6)
    assert estimates.proportion(0, 3).value == 0 and estimates.proportion(0, 3).low == 0


def test_the_interval_of_a_mean_is_students():
    # Of 1, 2, 3, 6: mean 3, variance 14 / 3, standard error sqrt(14 / 12) = 1.080123; t_3 at 97.5 % is 3.182446.
    assert_same(estimates.mean([1, 2, 3, 6]), (3.0, 3 - 3.437434, 3 + 3.437434), abs=1e-5)
    values = generator().normal(3, 2, 40)
    assert_same(estimates.mean(values), (values.mean(), *stats.ttest_1samp(values, 0).confidence_interval(0.95)))


def test_the_interval_of_a_median_is_between_order_statistics():
    # The k-th smallest and k-th largest of n hold the median unless fewer than k are on one side, which happens with
    # probability 2 P(Binomial(n, 1/2) < k): for n = 10, 22 / 1024 = 2 % with k = 2, and 11 % with k = 3.
    assert estimates.median_interval([7, 1, 10, 4, 2, 9, 5, 3, 8, 6]) == (2.0, 9.0)
    # For n = 6 it is 2 / 64 = 3 % with k = 1; for n = 5 it is 2 / 32 = 6 %, which is too much for any interval.
    assert estimates.median_interval([6, 1, 5, 2, 4, 3]) == (1.0, 6.0)
    assert np.isnan(estimates.median_interval([1, 2, 3, 4, 5])).all()


def test_a_ratio_of_means_is_geometric_with_welchs_interval():
    # Geometric means of (2, 8) and (1, 4): 4 and 2. Logarithms deviate by log 2 from their means: variances
    # 2 log(2)^2 each, standard error sqrt(2 log(2)^2) = 0.980258, 2 degrees of freedom, t_2 at 97.5 % 4.302653.
    half = 4.302653 * 0.980258
    ratio = estimates.ratio_of_means([2, 8], [1, 4])
    assert_same(ratio, (2.0, 2 * math.exp(-half), 2 * math.exp(half)), rel=1e-5)
    turned = estimates.ratio_of_means([1, 4], [2, 8])
    assert_same(turned, (1 / ratio.value, 1 / ratio.high, 1 / ratio.low))
    # With equal values in one group only the other group's spread is left: Student's.
    expected = estimates.mean(np.log(np.array([30.0, 29.0, 33.0]) / 2))
    estimate = estimates.ratio_of_means([30.0, 29.0, 33.0], [2, 2, 2])
    assert_same(estimate, tuple(np.exp([expected.value, expected.low, expected.high])))


def test_a_ratio_of_pairs_is_geometric_with_students_interval():
    # Ratios 2, 8: logarithms log 2 and 3 log 2, mean 2 log 2: 4. Their deviation is sqrt(2) log 2, the error of the
    # mean log 2, and Student's factor for one degree of freedom 12.7062: from 4 / 2^12.7062 to 4 * 2^12.7062.
    expected = (4, 4 / 2**12.7062, 4 * 2**12.7062)
    assert_same(estimates.ratio_of_pairs([2.0, 24.0], [1.0, 3.0]), expected, rel=1e-4)
    assert_same(estimates.geometric_mean([2.0, 8.0]), expected, rel=1e-4)
    # Pairs that differ more from one another than within are told apart only as pairs.
    bottom = np.array([1.0, 3.0, 9.0, 27.0])
    assert estimates.ratio_of_pairs(1.1 * bottom, bottom).low == pytest.approx(1.1)
    assert estimates.ratio_of_means(1.1 * bottom, bottom).low < 0.2


@pytest.mark.parametrize("wrong", [[0.0, 1.0, 2.0], [1.0, 2.0, math.inf]])
def test_a_ratio_needs_positive_and_finite_values(wrong):
    for estimate in (
        estimates.ratio_of_means(wrong, [1.0, 2.0]),
        estimates.ratio_of_means([1.0, 2.0], wrong),
        estimates.ratio_of_pairs(wrong, [1.0] * 3),
        estimates.geometric_mean(wrong),
    ):
        assert_unknown(estimate, (0, math.inf))


def test_a_value_between_two_bounds_is_tested_by_the_bound_on_each_side():
    lower, upper = estimates.geometric_mean([0.2, 0.3, 0.4]), estimates.geometric_mean([0.5, 0.6, 0.7])
    both = estimates.between(lower, upper)
    assert (both.value, both.low, both.high) == (upper.value, lower.low, upper.high)
    assert both.p_value(0.1, "greater") == lower.p_value(0.1, "greater")
    assert both.p_value(0.9, "less") == upper.p_value(0.9, "less")


def test_an_upper_bound_is_tested_from_above_alone():
    whole = estimates.geometric_mean([0.5, 0.6, 0.7])
    bound = estimates.at_most(whole)
    assert (bound.value, bound.low, bound.high) == (whole.value, 0.0, whole.high)
    assert bound.p_value(0.9, "less") == whole.p_value(0.9, "less") and bound.p_value(0.1, "greater") == 1
    assert_unknown(estimates.at_most(estimates.geometric_mean([0.5])), (0, math.inf))


def test_a_correlation_is_pearsons_with_fishers_interval():
    x = np.arange(7.0)
    y = np.array([0.0, 2, 1, 4, 3, 6, 5])
    # Sums of products: Sxx = Syy = 28 and Sxy = 25, hence r = 25 / 28; atanh = 1.437, half width 1.96 / sqrt(4) = 0.98.
    half = _NORMAL_975 / 2
    expected = (25 / 28, math.tanh(math.atanh(25 / 28) - half), math.tanh(math.atanh(25 / 28) + half))
    assert_same(estimates.correlation(x, y), expected, rel=1e-6)
    assert_same(estimates.correlation(x, 2 * x), (1.0, 1.0, 1.0), rel=1e-9)
    for few in ((x, np.ones(7)), (x[:3], y[:3])):
        estimate = estimates.correlation(*few)
        assert math.isnan(estimate.value) and (estimate.low, estimate.high) == (-1, 1)


def test_intervals_of_correlations_cover_them_if_few_pairs_weigh_much():
    # y = x e: x and y are uncorrelated, but E[x^2 y^2] = E[x^4] = 3, so that the error is the root of three times
    # Fisher's, whose interval would cover 0 in 74 % of samples: 2 Phi(1.96 / sqrt(3)) - 1.
    source = generator()
    covered = []
    for _ in range(400):
        x, noise = source.normal(size=(2, 2000))
        estimate = estimates.correlation(x, x * noise)
        covered.append(estimate.low < 0 < estimate.high)
    assert np.sum(covered) >= stats.binom.ppf(P_VALUE, len(covered), 0.95)


def test_data_without_a_spread_are_certain():
    for estimate in (estimates.mean([2.0] * 3), estimates.normal(2.0, 0.0), estimates.ratio_of_means([4] * 3, [2] * 3)):
        assert_same(estimate, (2.0, 2.0, 2.0))
        assert estimate.p_value(1.0, "greater") == estimate.p_value(3.0, "less") == 0
        assert estimate.p_value(1.0, "less") == estimate.p_value(2.0, "greater") == estimate.p_value(2.0, "less") == 1


def test_too_few_or_unknown_values_tell_nothing():
    for estimate in (
        estimates.mean([]),
        estimates.mean([3]),
        estimates.mean([0.1, 0.1]),  # Two may be equal by chance.
        estimates.mean([1.0, math.nan, 2.0]),
    ):
        assert_unknown(estimate)
    for groups in (([3], [2]), ([3], [2, 2]), ([3, 3], [2]), ([3, 3], [2, 2]), ([3, 3], [2, 2, 2])):
        estimate = estimates.ratio_of_means(*groups)
        assert estimate.value == pytest.approx(1.5)
        assert_unknown(estimate, (0, math.inf))


@pytest.mark.parametrize("number", [2, 6, 10])
def test_a_detectable_distance_is_noticed_in_four_cases_of_five(number):
    drawn = generator().normal(estimates.detectable(number), 1, (4000, number))
    noticed = np.sum(stats.ttest_1samp(drawn, 0, axis=1).pvalue < 0.05)
    assert stats.binomtest(int(noticed), len(drawn), 0.8).pvalue > P_VALUE


def test_the_p_value_at_an_end_of_an_interval_is_a_fortieth():
    source = generator()
    x, y = source.normal(size=(2, 30))
    found = [
        estimates.proportion(17, 40),
        estimates.mean(x),
        estimates.mean_share(0.5 + x / 100),
        estimates.ratio_of_means(np.exp(x), np.exp(2 * y[:20])),
        estimates.ratio_of_means(np.exp(x), [2.0, 2.0]),
        estimates.ratio_of_means([2.0, 2.0], np.exp(x)),
        estimates.ratio_of_pairs(np.exp(x), np.exp(y)),
        estimates.normal(1.0, 0.3),
        estimates.correlation(x, y),
    ]
    for estimate in found:
        assert estimate.low <= estimate.value <= estimate.high
        ends = [(estimate.low, "greater", "less"), (estimate.high, "less", "greater")]
        for end, inwards, outwards in ends:
            assert estimate.p_value(end, inwards) == pytest.approx(0.025, rel=1e-4)
            assert estimate.p_value(end, outwards) == pytest.approx(0.975, rel=1e-4)
        assert estimate.p_value(estimate.value, "less") == pytest.approx(0.5)
