"""The commit and the versions of the source that runs are named."""

from pathlib import Path
import subprocess

import pytest

from physexp.analysis.data import provenance


def git(folder: Path, *words: str) -> str:
    identity = ["-c", "user.name=somebody", "-c", "user.email=somebody@example.org"]
    return subprocess.run(
        ["git", "-C", str(folder), *identity, *words], check=True, capture_output=True, text=True
    ).stdout.strip()


def test_a_commit_is_that_of_this_source_not_of_a_project_around_it(tmp_path, monkeypatch):
    source = tmp_path / "venv" / "physexp" / "__init__.py"
    source.parent.mkdir(parents=True)
    source.touch()
    (tmp_path / "theirs").touch()
    git(tmp_path, "init", "-q")
    git(tmp_path, "add", "theirs")
    git(tmp_path, "commit", "-qm", "theirs")
    monkeypatch.setattr(provenance.physexp, "__file__", str(source))
    assert provenance.commit() == "unknown"
    git(tmp_path, "add", "venv")
    git(tmp_path, "commit", "-qm", "ours")
    head = git(tmp_path, "rev-parse", "HEAD")
    assert provenance.commit() == head
    source.write_text("changed")
    assert provenance.commit() == f"{head}+"


@pytest.mark.parametrize(
    ("commit", "expected"),
    [
        ("0123456789" * 4, "0123456789"),
        ("0123456789" * 4 + "+", "0123456789+"),  # Files differed from it.
        ("unknown", "unknown"),
        ("not recorded", "not recorded"),  # An agent's card that has none.
    ],
)
def test_a_commit_is_shortened_and_other_words_are_not(commit, expected):
    assert provenance.shortened(commit) == expected
