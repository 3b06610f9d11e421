"""How rarely a test of what is drawn at random may fail although all is right."""

from scipy import stats

P_VALUE = 1e-8  # Of a single comparison; a run of all tests makes some hundreds of them.


def assert_drawn(counts, probabilities):
    """Asserts that none of some counts is one that its probability makes that rare."""
    total = int(sum(counts))
    for place, (count, probability) in enumerate(zip(counts, probabilities, strict=True)):
        found = stats.binomtest(int(count), total, float(probability))
        assert found.pvalue > P_VALUE, f"number {place} is drawn {count} of {total} times, wanted {probability:.5f}"
