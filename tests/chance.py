"""A test of random draws that fails by chance once in 100 million comparisons."""

from scipy import stats

P_VALUE = 1e-8  # For one comparison; a run of all tests makes some hundreds.


def assert_drawn(counts, probabilities):
    """Asserts that no count is too rare for its probability."""
    total = int(sum(counts))
    for place, (count, probability) in enumerate(zip(counts, probabilities, strict=True)):
        found = stats.binomtest(int(count), total, float(probability))
        assert found.pvalue > P_VALUE, f"number {place} is drawn {count} of {total} times, wanted {probability:.5f}"
