"""The examples of the documentation run, and show what the pages say."""

from pathlib import Path
import re
import sys

import blocks
import numpy as np
import pytest
from seeds import fresh_seed

from physexp import suite
from physexp.agents import environment_loop
from physexp.analysis.data import episodes
from physexp.analysis.experiments import base, reproduce
from physexp.analysis.score import protocol

DOCS = Path(__file__).parent.parent / "docs"
sys.path[:0] = [str(DOCS), str(DOCS / "examples")]

import bolted  # noqa: E402
import haste  # noqa: E402
import play_page  # noqa: E402
import poke_all  # noqa: E402
import train_bolted  # noqa: E402


def pages():
    return sorted([*DOCS.glob("*.md"), *DOCS.glob("*.ipynb")])


def test_files_and_folders_that_pages_name_are_there():
    for page in [*DOCS.glob("*.md"), DOCS.parent / "README.md"]:
        text = page.read_text()
        for name in re.findall(r"`((?:physexp|docs|tests|benchmarks|results)/[\w./]*)`", text):
            # TRIAL and NAME stand for names.
            assert re.search("[A-Z]{4}", name) or (DOCS.parent / name).exists(), f"{page.name} names {name}"
        for link in re.findall(r"\]\(([^)#\s]+?)(?:#[^)]*)?\)", text):
            assert "://" in link or (page.parent / link).exists(), f"{page.name} links to {link}"


PYTHON = [
    (page.name, block) for page in sorted(DOCS.glob("*.md")) for block in blocks.of(page) if block.language == "python"
]


@pytest.mark.parametrize("page, block", PYTHON, ids=[f"{name}-{number}" for number, (name, _) in enumerate(PYTHON)])
def test_python_of_a_page_prints_the_output_on_the_page(page, block, monkeypatch):
    monkeypatch.chdir(blocks.ROOT)  # The folder of results/.
    printed = blocks.run(block)
    assert printed == block.shown or not block.shown


def test_the_index_lists_every_page_and_the_pages_show_every_example():
    index = (DOCS / "index.md").read_text()
    listed = set(re.findall(r"^([a-z_]+)$", index, re.MULTILINE))
    assert {page.stem for page in pages()} - {"index"} == listed
    text = "".join(page.read_text() for page in pages())
    assert all(f"examples/{example.name}" in text for example in (DOCS / "examples").glob("*.py"))


def test_the_page_beside_the_pages_has_every_replay_of_the_leaderboard():
    tasks, replays = play_page.tasks(), play_page.replays()
    assert {f"{domain}/{task}" for domain, task in suite.tagged("features")} <= {
        data["name"] for data in tasks.values()
    }
    assert len(replays) > 10
    environments = {data["name"]: protocol.load(*protocol.named([data["name"]])) for data in tasks.values()}
    instances = {(data["name"], each["episode"]): each for data in tasks.values() for each in data["instances"]}
    for replay in replays:
        actions, number = [int(action) for action in replay["actions"].split(",")], int(replay["episode"])
        played = episodes.play(environments[replay["task"]], environment_loop.Repeat(actions), number)
        instance = instances[replay["task"], number]
        assert played.actions.tolist() == actions and instance["answers"] == played.answers.tolist()
        assert instance["others"]["the ideal"] != actions
    for environment in environments.values():
        environment.close()


def test_only_pulling_is_informative_in_the_example_task():
    environment = suite.Environment(bolted.features(random=fresh_seed()))
    for _ in range(10):
        assert not environment.reset().observation["heights"].any(), "all blocks look alike before the first pull"
        rises = [environment.step(k).observation["heights"][k] for k in range(3)]
        # 5 N move 1 kg against 10 N s/m by some 2 cm within 0.1 s, and a bolted block, 1e6 N s/m, by 0.5 um.
        assert np.argmin(rises) == environment.task.correct_answer and min(rises) < 1e-4 < 5e-3 < sorted(rises)[1]


def test_the_example_agent_names_the_heaviest_block():
    assert poke_all.play() == [1.0] * 20


@pytest.mark.long
def test_an_agent_of_ours_learns_the_example_task():
    # Chance is a third; 64 guesses stay below 1/3 + 5 sqrt(2/9 / 64) = 0.63.
    assert train_bolted.train() > 0.75


@pytest.mark.long
def test_the_example_experiment_runs_from_nothing_to_a_verdict(tmp_path):
    lines = []
    results = base.Results(tmp_path)
    reproduce.run([haste.EXPERIMENT], results, observations=("features",), num_seeds=2, frames=5_000, tell=lines.append)
    assert (tmp_path / "figures" / "haste.png").exists()
    (verdict,) = [line for line in lines if "An agent that is in a hurry" in line]
    assert verdict.split()[0] in ("holds", "fails", "undecided")
