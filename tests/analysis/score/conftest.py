"""Fixtures of the tests of scores and exports."""

import made_agents
import pytest


@pytest.fixture
def here(monkeypatch, tmp_path):
    """A folder with agents, which is the current one."""
    made_agents.put_into(tmp_path)
    monkeypatch.chdir(tmp_path)
    return tmp_path
