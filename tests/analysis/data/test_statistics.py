"""Estimates are those of the formulas, and 95 % of the intervals hold the truth: counted over data we have made."""

import math

from chance import P_VALUE
import numpy as np
import pytest
from scipy import stats
from seeds import fresh_seed

from physexp.analysis.data import estimates

_NORMAL_975 = stats.norm.ppf(0.975)


def generator():
    return np.random.default_rng(fresh_seed())


def assert_covers(estimates, truth, level=0.95, slack=0.0):
    """The share of intervals that hold the truth is the level, to what chance and a slack may change."""
    held = np.mean([estimate.low <= truth <= estimate.high for estimate in estimates])
    least, most = stats.binom.ppf([P_VALUE, 1 - P_VALUE], len(estimates), level) / len(estimates)
    assert least - slack <= held <= most + slack, f"{held:.3f} of {len(estimates)}, wanted {level:.3f}"


def assert_same(estimate, expected, **tolerance):
    assert (estimate.value, estimate.low, estimate.high) == pytest.approx(expected, **tolerance)


def test_a_proportion_is_the_share_with_wilsons_interval():
    outcomes = [True, False, True, True]
    # 3 of 4: z^2 = 3.841459; centre (3/4 + z^2/8) / (1 + z^2/4) = 1.230182 / 1.960365 = 0.627527; half width
    # z / (1 + z^2/4) * sqrt(3/64 + z^2/64) = 0.999793 * sqrt(0.106898) = 0.326885.
    assert_same(estimates.proportion(outcomes), (0.75, 0.300642, 0.954412), abs=1e-6)
    assert estimates.proportion(np.array(outcomes)) == estimates.proportion(outcomes)
    assert estimates.proportion([False] * 3).value == 0 and estimates.proportion([False] * 3).low == 0


def test_intervals_of_proportions_hold_the_truth_on_average_over_truths():
    source, shares = generator(), []
    for _ in range(2000):  # At a single truth Wilson's coverage goes up and down around the level: one outcome is many.
        truth = source.uniform(0.1, 0.9)
        estimate = estimates.proportion(source.random(40) < truth)
        shares.append(estimate.low <= truth <= estimate.high)
    # The average over truths is that of the formula, from the binomial's probabilities.
    truths = np.linspace(0.1, 0.9, 401)
    counts = np.arange(41)
    ends = np.array([estimates.wilson_interval(int(count), 40) for count in counts])
    held = (ends[:, :1] <= truths) & (truths <= ends[:, 1:])
    expected = (stats.binom.pmf(counts[:, None], 40, truths) * held).sum(axis=0).mean()
    assert abs(expected - 0.95) < 0.005
    assert stats.binomtest(int(np.sum(shares)), len(shares), expected).pvalue > P_VALUE


def test_the_interval_of_a_mean_is_students():
    # Of 1, 2, 3, 6: mean 3, variance 14 / 3, standard error sqrt(14 / 12) = 1.080123; t_3 at 97.5 % is 3.182446.
    assert_same(estimates.mean([1, 2, 3, 6]), (3.0, 3 - 3.437434, 3 + 3.437434), abs=1e-5)
    source = generator()
    for count in (2, 5, 40):
        values = source.normal(source.normal(), 2, count)
        expected = stats.ttest_1samp(values, 0).confidence_interval(0.95)
        assert_same(estimates.mean(values), (values.mean(), *expected), rel=1e-9)


@pytest.mark.parametrize("count", [2, 3, 10])
def test_intervals_of_means_hold_the_truth_even_with_few_agents(count):
    draws = generator().normal(0.7, 0.1, (1000, count))
    assert_covers([estimates.mean(values) for values in draws], 0.7)


def test_the_interval_of_a_median_is_between_order_statistics():
    # The k-th smallest and k-th largest of n hold the median unless fewer than k are on one side, which happens with
    # probability 2 P(Binomial(n, 1/2) < k): for n = 10, 22 / 1024 = 2 % with k = 2, and 11 % with k = 3.
    assert_same(estimates.median([7, 1, 10, 4, 2, 9, 5, 3, 8, 6]), (5.5, 2.0, 9.0))
    # For n = 6 it is 2 / 64 = 3 % with k = 1; for n = 5 it is 2 / 32 = 6 %, which is too much for any interval.
    assert_same(estimates.median([6, 1, 5, 2, 4, 3]), (3.5, 1.0, 6.0))
    for count in (1, 5):
        assert_same(estimates.median(np.arange(count)), ((count - 1) / 2, -math.inf, math.inf))


def test_a_median_and_its_interval_are_those_of_the_sorted_values_whatever_their_order_and_type():
    source = generator()
    values = source.integers(0, 30, 101).astype(np.int16)
    estimate = estimates.median(values)
    # 2 P(Binomial(101, 1/2) < 41) = 0.046, and 0.072 with 42: the 41st smallest and the 41st largest.
    ranked = np.sort(values)
    assert_same(estimate, (ranked[50], ranked[40], ranked[60]))
    assert estimate == estimates.median(source.permutation(values))
    assert estimate == estimates.median(list(values.astype(float)))


@pytest.mark.parametrize("count", [10, 101])
def test_intervals_of_medians_hold_the_truth_of_a_skewed_distribution(count):
    draws = generator().exponential(1.0, (400, count))
    held = 1 - 2 * stats.binom.cdf({10: 1, 101: 40}[count], count, 0.5)  # As derived above: 98 % and 95 %.
    assert_covers([estimates.median(values) for values in draws], math.log(2), level=held)


def test_the_interval_of_a_mean_share_ends_where_shares_do():
    # Of 0.9, 1: mean 0.95, standard error 0.05; t_1 at 97.5 % is 12.706205, so that Student's goes beyond both ends.
    assert_same(estimates.mean([0.9, 1.0]), (0.95, 0.95 - 0.635310, 0.95 + 0.635310), abs=1e-5)
    assert_same(estimates.mean_share([0.9, 1.0]), (0.95, 0.95 - 0.635310, 1.0), abs=1e-5)
    assert_same(estimates.mean_share([0.1, 0.0]), (0.05, 0.0, 0.05 + 0.635310), abs=1e-5)
    assert_same(estimates.mean_share([0.7]), (0.7, 0.0, 1.0))
    inside = [0.4, 0.5, 0.6]
    assert estimates.mean_share(inside) == estimates.mean(inside)


def test_a_ratio_of_means_is_that_of_the_geometric_ones_with_welchs_interval():
    # Geometric means of (2, 8) and (1, 4): 4 and 2. Logarithms deviate by log 2 from their means: variances
    # 2 log(2)^2 each, standard error sqrt(2 log(2)^2) = 0.980258, 2 degrees of freedom, t_2 at 97.5 % 4.302653.
    half = 4.302653 * 0.980258
    assert_same(estimates.ratio_of_means([2, 8], [1, 4]), (2.0, 2 * math.exp(-half), 2 * math.exp(half)), rel=1e-5)
    source = generator()
    for counts in ((2, 3), (5, 10), (30, 4)):
        groups = [np.exp(source.normal(0, spread, count)) for spread, count in zip((0.2, 1), counts, strict=True)]
        logs = [np.log(group) for group in groups]
        interval = stats.ttest_ind(*logs, equal_var=False).confidence_interval(0.95)
        expected = np.exp([logs[0].mean() - logs[1].mean(), interval.low, interval.high])
        assert_same(estimates.ratio_of_means(*groups), tuple(expected), rel=1e-9)


def test_the_ratio_turned_about_is_the_inverse():
    source = generator()
    groups = [np.exp(source.normal(0, 0.3, count)) for count in (5, 8)]
    ratio, turned = estimates.ratio_of_means(*groups), estimates.ratio_of_means(*groups[::-1])
    assert_same(turned, (1 / ratio.value, 1 / ratio.high, 1 / ratio.low))


@pytest.mark.parametrize("counts", [(3, 3), (10, 5), (40, 40)])
def test_intervals_of_ratios_hold_the_truth_with_unequal_spreads(counts):
    source = generator()
    found = [
        estimates.ratio_of_means(
            *(
                np.exp(source.normal(mean, spread, count))
                for mean, spread, count in zip((1.0, 0.2), (0.1, 0.4), counts, strict=True)
            )
        )
        for _ in range(1000)
    ]
    # Welch's degrees of freedom are an approximation, good to about a hundredth where there are three values.
    assert_covers(found, math.exp(0.8), slack=0.012 if min(counts) < 5 else 0.005)


def test_a_ratio_allows_for_values_that_are_all_the_same_in_one_group():
    # Median interactions are whole numbers: agents often agree. Then only the other group's spread is left: Student's.
    varied = np.array([30.0, 29.0, 33.0])
    expected = estimates.mean(np.log(varied / 2))
    for same in ([2, 2, 2], np.full(4, 2, np.float32)):
        estimate = estimates.ratio_of_means(varied, same)
        assert_same(estimate, tuple(np.exp([expected.value, expected.low, expected.high])), rel=1e-9)
    assert_same(estimates.ratio_of_means([3, 3, 3], [2, 2]), (1.5, 1.5, 1.5))


def test_a_ratio_of_what_is_not_positive_and_finite_has_an_infinite_interval():
    for wrong in ([0.0, 1.0, 2.0], [1.0, 2.0, math.inf], [math.inf] * 3):
        for groups in ((wrong, [1.0, 2.0]), ([1.0, 2.0], wrong), (wrong, wrong)):
            estimate = estimates.ratio_of_means(*groups)
            assert (estimate.low, estimate.high) == (0, math.inf)


def test_a_bootstrapped_interval_is_made_of_the_statistic_of_values_drawn_again():
    # The mean of two values drawn from 0 and 1 is 0, 1/2 or 1, with probabilities 1/4, 1/2 and 1/4.
    assert_same(estimates.bootstrap([0, 1], np.mean), (0.5, 0.0, 1.0))
    # The largest of ten values is drawn again with probability 1 - 0.9^10 = 65 %; one of the largest two with 89 %, of
    # the three 97 %, of the four 99.4 %: 2.5 % of the draws are below the third largest or at most it.
    estimate = estimates.bootstrap(np.arange(10), np.max)
    assert (estimate.value, estimate.high) == (9, 9) and estimate.low in (6, 7)


def test_the_bootstrap_repeats_with_its_seed():
    values = generator().normal(size=12)
    first, again, other = (estimates.bootstrap(values, np.mean, seed=seed) for seed in (1, 1, 2))
    assert first == again != other
    assert first.value == other.value == values.mean()


def test_bootstrapped_intervals_of_means_hold_the_truth_as_often_as_the_method_does():
    draws = generator().normal(0.7, 0.1, (100, 10))
    found = [estimates.bootstrap(values, _sum_over_ten) for values in draws]
    # Means of values drawn again are spread by s sqrt((n - 1) / n) / sqrt(n): a normal interval of that width holds the
    # truth with P(|t| < 1.96 sqrt((n - 1) / n)), which is 90 % of the time for 10 values.
    level = 1 - 2 * stats.t.sf(_NORMAL_975 * math.sqrt(0.9), 9)
    assert round(level, 2) == 0.9
    assert_covers(found, 0.7, level=level, slack=0.01)


def _sum_over_ten(values):
    return values.sum() / 10  # Their mean; quicker than np.mean, and called 200,000 times.


def test_a_slope_is_that_of_least_squares_with_whites_standard_error():
    # x = 0, 1, 2, y = 0, 0, 3: slope 3/2 about the means 1 and 1; residuals 1/2, -1, 1/2. Sum of squares of centred x
    # is 2; of them times squared residuals 1/4 + 0 + 1/4 = 1/2; times n / (n - 2) = 3: error sqrt(3/2) / 2 = 0.612372.
    half = 1.959964 * 0.612372
    assert_same(estimates.slope(np.arange(3.0), np.array([0.0, 0, 3])), (1.5, 1.5 - half, 1.5 + half), abs=1e-5)


def test_a_slope_is_that_of_the_sandwich_of_matrices():
    source = generator()
    x = source.uniform(0, 1, 30)
    y = 3 - 2 * x + source.normal(0, 0.1 + x)
    design = np.stack([np.ones(30), x], axis=1)
    bread = np.linalg.inv(design.T @ design)
    coefficients = bread @ design.T @ y
    residuals = y - design @ coefficients
    errors = np.sqrt(np.diag(bread @ (design.T * residuals**2) @ design @ bread) * 30 / 28)
    half = _NORMAL_975 * errors[1]
    expected = (coefficients[1], coefficients[1] - half, coefficients[1] + half)
    assert_same(estimates.slope(x, y), expected, rel=1e-9)
    assert coefficients[1] == pytest.approx(stats.linregress(x, y).slope)


def test_intervals_of_slopes_hold_the_truth_where_the_spread_changes_with_x():
    source, found, textbook = generator(), [], []
    for _ in range(1000):
        x = source.uniform(0, 1, 300)
        y = 1 - 2 * x + source.normal(0, 4 * np.abs(x - 0.5) ** 2)
        found.append(estimates.slope(x, y))
        line = stats.linregress(x, y)
        textbook.append(abs(line.slope + 2) < _NORMAL_975 * line.stderr)
    assert_covers(found, -2, slack=0.007)  # The interval is exact for many pairs only.
    # The spread is largest at the ends, which bear most on the slope: the textbook's interval is far too narrow.
    # Its variance is E[s^2] / (N Var x) instead of E[(x - 1/2)^2 s^2] / (N Var(x)^2), with s = 4 (x - 1/2)^2:
    # E[s^2] = 1/5, Var x = 1/12, E[(x - 1/2)^2 s^2] = 1/28: a ratio of 1/5 / (12/28) = 7/15.
    level = 1 - 2 * stats.norm.sf(_NORMAL_975 * math.sqrt(7 / 15))
    assert abs(np.mean(textbook) - level) < 5 * math.sqrt(level * (1 - level) / 1000) + 0.01


def test_a_line_without_spread_has_an_interval_without_width():
    x = np.arange(5.0)
    assert_same(estimates.slope(x, 3 * x), (3.0, 3.0, 3.0))
    assert_same(estimates.slope(x, np.full(5, 0.1)), (0.0, 0.0, 0.0), abs=1e-12)


def test_equal_values_have_intervals_without_width():
    for count in (3, 7):
        assert_same(estimates.mean([0.1] * count), (0.1, 0.1, 0.1))
        assert_same(estimates.bootstrap([0.1] * count, np.median), (0.1, 0.1, 0.1))
    assert_same(estimates.median([0.1] * 7), (0.1, 0.1, 0.1))


def test_two_values_that_are_the_same_say_nothing_of_the_spread():
    assert_same(estimates.mean([0.1, 0.1]), (0.1, -math.inf, math.inf))
    for groups in (([3, 3], [2, 2]), ([3, 3], [2, 2, 2])):
        estimate = estimates.ratio_of_means(*groups)
        assert_same(estimate, (1.5, 0.0, math.inf))
        assert not estimate.can_be_tested


def test_a_single_value_says_nothing_of_the_spread():
    everything = (-math.inf, math.inf)
    for estimate in (estimates.mean([3]), estimates.median([3]), estimates.bootstrap([3], np.median)):
        assert (estimate.value, estimate.low, estimate.high) == (3, *everything)
    for groups in (([3], [2]), ([3], [2, 2]), ([3, 3], [2])):
        assert_same(estimates.ratio_of_means(*groups), (1.5, 0.0, math.inf))


def test_a_line_through_two_points_or_over_one_place_has_an_infinite_interval():
    everything = (-math.inf, math.inf)
    two = estimates.slope(np.array([0.0, 1.0]), np.array([0.0, 2.0]))
    assert (two.value, two.low, two.high) == (2, *everything)
    for count in (1, 4):
        estimate = estimates.slope(np.ones(count), np.arange(count, dtype=float))
        assert (estimate.low, estimate.high) == everything


def test_intervals_hold_their_estimates():
    source = generator()
    for count in (2, 6, 25):
        values, others = source.gamma(2.0, size=count), source.gamma(2.0, size=count + 1)
        for estimate in (
            estimates.mean(values),
            estimates.median(values),
            estimates.bootstrap(values, np.median),
            estimates.ratio_of_means(values, others),
            estimates.proportion(values > 1),
        ):
            assert estimate.low <= estimate.value <= estimate.high


def test_the_ratio_of_pairs_is_the_geometric_mean_with_students_interval_of_the_logarithms():
    # Ratios 2, 8: logarithms log 2 and 3 log 2, mean 2 log 2: 4. Their deviation is sqrt(2) log 2, the error of the
    # mean log 2, and Student's factor for one degree of freedom 12.7062: from 4 / 2^12.7062 to 4 * 2^12.7062.
    estimate = estimates.ratio_of_pairs([2.0, 24.0], [1.0, 3.0])
    assert estimate.value == pytest.approx(4)
    assert estimate.low == pytest.approx(4 / 2**12.7062, rel=1e-4)
    assert estimate.high == pytest.approx(4 * 2**12.7062, rel=1e-4)


def test_a_geometric_mean_has_students_interval_of_the_logarithms():
    # Logarithms log 2 and 3 log 2, as above.
    estimate = estimates.geometric_mean([2.0, 8.0])
    assert estimate.value == pytest.approx(4)
    assert (estimate.low, estimate.high) == pytest.approx((4 / 2**12.7062, 4 * 2**12.7062), rel=1e-4)
    for unknown in ([2.0], [2.0, math.inf], [2.0, 0.0]):  # Of agents, say, one of whom never comes that far.
        estimate = estimates.geometric_mean(unknown)
        assert (estimate.low, estimate.high) == (0.0, math.inf)


def test_pairs_that_differ_from_one_another_more_than_within_are_told_apart_only_as_pairs():
    bottom = np.array([1.0, 3.0, 9.0, 27.0])
    assert estimates.ratio_of_pairs(1.1 * bottom, bottom).low == pytest.approx(1.1)
    assert estimates.ratio_of_means(1.1 * bottom, bottom).low < 0.2


def test_a_ratio_of_pairs_with_a_zero_or_of_one_pair_has_an_infinite_interval():
    for top, bottom in (([0.0, 1.0], [1.0, 1.0]), ([1.0, 1.0], [1.0, math.inf]), ([2.0], [1.0])):
        estimate = estimates.ratio_of_pairs(top, bottom)
        assert (estimate.low, estimate.high) == (0.0, math.inf)


@pytest.mark.parametrize("values", [[], [1.0, math.nan, 2.0]])
def test_the_mean_of_nothing_or_of_what_is_not_known_says_nothing(values):
    estimate = estimates.mean(values)
    assert math.isnan(estimate.value) and (estimate.low, estimate.high) == (-math.inf, math.inf)
    assert not estimate.can_be_tested


def test_the_correlation_of_three_pairs_may_be_any():
    for count in range(4):
        estimate = estimates.correlation(np.arange(count), np.array([0.0, 2.0, 1.0])[:count])
        assert math.isnan(estimate.value) and (estimate.low, estimate.high) == (-1.0, 1.0)


def test_the_p_value_of_an_end_of_an_interval_is_what_the_interval_leaves_out_there():
    source = generator()
    x, y = source.normal(size=(2, 30))
    found = [
        estimates.proportion(source.random(40) < 0.4),
        estimates.mean(x),
        estimates.mean_share(0.5 + x / 100),
        estimates.ratio_of_means(np.exp(x), np.exp(2 * y[:20])),
        estimates.ratio_of_means(np.exp(x), [2.0, 2.0]),
        estimates.ratio_of_means([2.0, 2.0], np.exp(x)),
        estimates.ratio_of_pairs(np.exp(x), np.exp(y)),
        estimates.normal(1.0, 0.3),
        estimates.difference_of_shares(x > 0, y > 0.5),
        estimates.slope(x, y),
        estimates.correlation(x, y),
    ]
    for estimate in found:
        ends = [(estimate.low, "greater", "less"), (estimate.high, "less", "greater")]
        for end, inwards, outwards in ends:
            assert estimate.p_value(end, inwards) == pytest.approx(0.025, rel=1e-4)
            assert estimate.p_value(end, outwards) == pytest.approx(0.975, rel=1e-4)
        assert estimate.p_value(estimate.value, "less") == pytest.approx(0.5)


def test_p_values_of_medians_count_how_many_values_lie_beyond():
    estimate = estimates.median([7, 1, 10, 4, 2, 9, 5, 3, 8, 6])
    # Were 1.5 the median, ten coins would show at most one head: (1 + 10) / 2^10.
    assert estimate.p_value(1.5, "greater") == pytest.approx(11 / 1024)
    assert estimate.p_value(10.5, "less") == pytest.approx(1 / 1024)
    assert estimate.p_value(10.5, "greater") == pytest.approx(1)


def test_p_values_of_the_bootstrap_count_what_was_drawn_beyond_and_are_never_nothing():
    estimate = estimates.bootstrap([0, 1], np.mean)  # Two drawn of two: 0, 1/2 or 1, with 1/4, 1/2 and 1/4.
    assert estimate.p_value(0.25, "greater") == pytest.approx(0.25, abs=0.05)
    assert estimate.p_value(-1, "greater") == estimate.p_value(2, "less") == 1 / 2001


def test_figures_without_a_spread_are_certain_and_single_values_tell_nothing():
    for estimate in (estimates.mean([2.0] * 3), estimates.normal(2.0, 0.0), estimates.ratio_of_means([4] * 3, [2] * 3)):
        assert estimate.p_value(1.0, "greater") == estimate.p_value(3.0, "less") == 0
        assert estimate.p_value(1.0, "less") == estimate.p_value(2.0, "greater") == estimate.p_value(2.0, "less") == 1
    for estimate in (
        estimates.mean([2.0]),
        estimates.ratio_of_means([2.0], [1.0]),
        estimates.bootstrap([2.0], np.mean),
    ):
        assert estimate.p_value(1.0, "greater") == estimate.p_value(1.0, "less") == 1


def test_a_correlation_is_pearsons_with_fishers_interval():
    x = np.arange(7.0)
    y = np.array([0.0, 2, 1, 4, 3, 6, 5])
    # Sums of products: Sxx = Syy = 28 and Sxy = 25, hence r = 25 / 28; atanh = 1.437, half width 1.96 / sqrt(4) = 0.98.
    r = 25 / 28
    half = 1.959964 / 2
    expected = (r, math.tanh(math.atanh(r) - half), math.tanh(math.atanh(r) + half))
    assert_same(estimates.correlation(x, y), expected, rel=1e-6)
    assert_same(estimates.correlation(x, 2 * x), (1.0, 1.0, 1.0), rel=1e-9)
    assert math.isnan(estimates.correlation(x, np.ones(7)).value)


def test_intervals_of_correlations_cover_them_where_few_pairs_weigh_much():
    # y = x e: x and y are uncorrelated, but E[x^2 y^2] = E[x^4] = 3, so that the error is the root of three times
    # Fisher's, whose interval would cover 0 in 74 % of samples: 2 Phi(1.96 / sqrt(3)) - 1.
    source = generator()
    covered = []
    for _ in range(400):
        x, noise = source.normal(size=(2, 2000))
        estimate = estimates.correlation(x, x * noise)
        covered.append(estimate.low < 0 < estimate.high)
    assert np.sum(covered) >= stats.binom.ppf(P_VALUE, len(covered), 0.95)


def test_a_median_of_too_few_or_of_something_unknown_tells_nothing():
    for values in ([1.0, 2, 3, 4, 5], [math.nan, 1, 1, 1, 1, 1, 1, 1, 1, 1]):
        estimate = estimates.median(values)
        assert (estimate.low, estimate.high) == (-math.inf, math.inf) and not estimate.can_be_tested
    assert estimates.median([1.0, 2, 3, 4, 5, 6]).can_be_tested


def test_a_difference_of_shares_has_the_variances_of_both():
    first, second = np.arange(100) < 60, np.arange(400) < 100
    half = 1.959964 * math.sqrt(0.6 * 0.4 / 100 + 0.25 * 0.75 / 400)
    assert_same(estimates.difference_of_shares(first, second), (0.35, 0.35 - half, 0.35 + half), rel=1e-6)
