"""The documentation's worked examples do what it says they do."""

import ast
from pathlib import Path
import re
import sys

import blocks
import numpy as np
import pytest
from seeds import fresh_seed

from physexp import suite
from physexp.analysis.experiments import base, reproduce

DOCS = Path(__file__).parent.parent / "docs"
sys.path.insert(0, str(DOCS / "examples"))

import bolted  # noqa: E402
import haste  # noqa: E402
import poke_all  # noqa: E402
import train_bolted  # noqa: E402


def pages():
    return sorted([*DOCS.glob("*.md"), *DOCS.glob("*.ipynb")])


@pytest.mark.parametrize("page", sorted(DOCS.glob("*.md")), ids=lambda page: page.name)
def test_what_a_page_says_of_the_tree_is_there(page):
    for name in re.findall(r"`((?:physexp|docs|tests|benchmarks|results)/[\w./]*)`", page.read_text()):
        if not re.search("[A-Z]{4}", name):  # TRIAL and NAME stand for names.
            assert (DOCS.parent / name).exists(), f"{page.name} speaks of {name}"


PYTHON = [
    (page.name, block) for page in sorted(DOCS.glob("*.md")) for block in blocks.of(page) if block.language == "python"
]


@pytest.mark.parametrize("page, block", PYTHON, ids=[f"{name}-{number}" for number, (name, _) in enumerate(PYTHON)])
def test_the_python_of_a_page_runs_and_prints_what_the_page_shows(page, block, monkeypatch):
    monkeypatch.chdir(blocks.ROOT)  # Where results/ is.
    printed = blocks.run(block)
    assert printed == block.shown or not block.shown


@pytest.mark.parametrize(("domain", "task"), suite.ALL_TASKS)
def test_the_page_of_the_interface_says_what_each_feature_says(domain, task):
    rows = (DOCS / "interface.md").read_text().splitlines()
    played = suite.load_task(domain, task)
    assert set(played.observation_meanings) == set(played.observation_spec())
    for name, meaning in played.observation_meanings.items():
        assert meaning
        assert name not in played.readings or f"| `{domain}` | `{name}` | {meaning} |" in rows


def commented(tree):
    """Names and docstrings of properties, and of attributes of modules and classes."""
    for node in ast.walk(tree):
        match node:
            case ast.FunctionDef(decorator_list=decorators) if any("property" in ast.unparse(d) for d in decorators):
                yield node.name, ast.get_docstring(node) or ""
            case ast.Module(body=body) | ast.ClassDef(body=body):
                for one, after in zip(body, body[1:], strict=False):
                    match one, after:
                        case ast.Assign() | ast.AnnAssign(), ast.Expr(value=ast.Constant(value=str(text))):
                            yield ast.unparse(one), text


def test_no_docstring_of_a_value_begins_with_words_and_a_colon_which_sphinx_takes_for_its_type():
    for path in (blocks.ROOT / "physexp").rglob("*.py"):
        for name, text in commented(ast.parse(path.read_text())):
            first = re.sub("`.*?`", "", (text.splitlines() or [""])[0])
            assert ": " not in first, f"{path.name}, {name}: {text}"


def test_every_link_of_a_page_to_a_file_has_a_file():
    for page in DOCS.glob("*.md"):
        for link in re.findall(r"\]\(([^)#\s]+?)(?:#[^)]*)?\)", page.read_text()):
            assert "://" in link or (DOCS / link).exists(), f"{page.name} links to {link}"


def test_every_page_can_be_reached_from_the_index():
    index = (DOCS / "index.md").read_text()
    listed = set(re.findall(r"^([a-z_]+)$", index, re.MULTILINE))
    assert {page.stem for page in pages()} - {"index"} == listed


def test_every_example_is_shown_on_a_page():
    text = "".join(page.read_text() for page in pages())
    for example in (DOCS / "examples").glob("*.py"):
        assert f"examples/{example.name}" in text


def test_the_example_task_is_the_same_alone_and_in_a_batch():
    seed = fresh_seed()
    batch = suite.BatchEnvironment(bolted.features(random=seed), 6)
    timestep = batch.reset()
    actions = np.random.default_rng(seed).integers(0, 3, size=(5, 6))
    seen = [timestep.observation["heights"]] + [batch.step(row).observation["heights"] for row in actions]
    for i in range(6):
        environment = suite.Environment(bolted.features(random=suite.environment_seed(seed, i)))
        alone = [environment.reset()] + [environment.step(action) for action in actions[:, i]]
        np.testing.assert_array_equal([one.observation["heights"] for one in alone], [row[i] for row in seen])
        assert environment.task.correct_answer == batch.correct_answers[i]


def test_in_the_example_task_only_pulling_tells():
    environment = suite.Environment(bolted.features(random=fresh_seed()))
    for _ in range(10):
        assert not environment.reset().observation["heights"].any(), "nothing is seen before the first pull"
        rises = [environment.step(k).observation["heights"][k] for k in range(3)]
        # 5 N move 1 kg against 10 N s/m by some 2 cm within 0.1 s, and what is bolted, 1e6 N s/m, by 0.5 um.
        assert np.argmin(rises) == environment.task.correct_answer and min(rises) < 1e-4 < 5e-3 < sorted(rises)[1]


def test_the_example_task_can_be_drawn():
    environment = suite.Environment(bolted.pixels(random=0))
    assert environment.reset().observation["pixels"].std() > 0


def test_the_example_agent_names_the_heaviest_block():
    assert poke_all.play() == [1.0] * 20


def test_an_agent_of_ours_learns_the_example_task():
    # Chance is a third; 64 guesses stay below 1/3 + 5 sqrt(2/9 / 64) = 0.63.
    assert train_bolted.train() > 0.75


def test_the_example_experiment_runs_from_nothing_to_a_verdict(tmp_path):
    lines = []
    results = base.Results(tmp_path)
    reproduce.run([haste.EXPERIMENT], results, observations=("features",), num_seeds=2, frames=5_000, tell=lines.append)
    assert (tmp_path / "figures" / "haste.svg").exists()
    (verdict,) = [line for line in lines if "An agent that is in a hurry" in line]
    assert verdict.split()[0] in ("holds", "fails", "undecided")
