"""Commits are told in few digits."""

import pytest

from physexp.analysis.data import provenance


@pytest.mark.parametrize(
    ("commit", "expected"),
    [
        ("0123456789" * 4, "0123456789"),
        ("0123456789" * 4 + "+", "0123456789+"),  # Files differed from it.
        ("unknown", "unknown"),
        ("not recorded", "not recorded"),  # An agent's card that has none.
    ],
)
def test_a_commit_is_shortened_and_a_word_that_stands_for_one_is_not(commit, expected):
    assert provenance.shortened(commit) == expected
