"""A domain of another package works as the package's own: in the suite, Gymnasium, training, score and commands."""

import json
import os
from pathlib import Path
import textwrap

import interpreters
import pytest

from physexp import suite

EXAMPLES = Path(__file__).parents[2] / "docs" / "examples"


def install(folder: Path, entry_points: str, **modules: str) -> str:
    """Installs a distribution with some modules and entry points into a folder; returns the search path with it."""
    information = folder / "my_lab-1.0.dist-info"
    information.mkdir()
    (information / "METADATA").write_text("Metadata-Version: 2.1\nName: my-lab\nVersion: 1.0\n")
    (information / "entry_points.txt").write_text(textwrap.dedent(entry_points))
    for name, text in modules.items():
        (folder / f"{name}.py").write_text(text)
    return os.pathsep.join(filter(None, (str(folder), os.environ.get("PYTHONPATH"))))


CODE = """
import contextlib, io, sys
import gymnasium, numpy as np
from physexp import cli, suite
import physexp.suite.gymnasium

found["names"] = suite.TASKS_BY_DOMAIN["loose"]
batch = suite.load_batch("loose", "features", 3, {"random": 0})
single = suite.load("loose", "features", {"random": suite.environment_seed(0, 2)})
step, alone = batch.reset(), single.reset()
for action in (0, 1, 2):
    step, alone = batch.step(np.full(3, action)), single.step(action)
    assert all(value[2].tobytes() == alone.observation[name].tobytes() for name, value in step.observation.items())
environment = gymnasium.make("physexp/loose-features-v0", random=1)
environment.reset()
found["reward"] = environment.step(4 + environment.unwrapped.dm_env.task.correct_answer)[1]

def run(line):
    sys.argv = line.split()
    with contextlib.redirect_stdout(io.StringIO()) as output, contextlib.suppress(SystemExit):
        cli.main()
    return output.getvalue()

for line in (
    "physexp tasks",
    "physexp train loose features --help",
    "physexp train loose features --agent ppo --frames 300 --run-dir run",
    "physexp ideal loose --json",
    "physexp score run --episodes 5 --json",
):
    found[line.split()[1] + line.partition("--help")[1]] = run(line)
"""


def test_the_suite_gymnasium_and_all_commands_know_it(tmp_path, monkeypatch):
    """Of an installed package that has the domain `loose`, its facts and an ideal experimenter."""
    modules = {name: (EXAMPLES / f"{name}.py").read_text() for name in ("loose", "loose_facts")}
    path = install(
        tmp_path, "[physexp.domains]\nloose = loose\n\n[physexp.facts]\nloose = loose_facts:DOMAIN\n", **modules
    )
    monkeypatch.chdir(tmp_path)
    found, _ = interpreters.run(CODE, PYTHONPATH=path)
    assert found["names"] == ["features", "pixels"] and found["reward"] == 1
    assert "Which block is loose?" in found["tasks"] and "--rail-stiffness" in found["train--help"]
    # The ideal pulls up to three of the four blocks. 1/4 (g + g^2 + 2 g^3) with g = 0.95.
    assert json.loads(found["ideal"])["value"] == pytest.approx((0.95 + 0.95**2 + 2 * 0.95**3) / 4)
    assert (tmp_path / "run" / "config.json").exists()
    assert json.loads(found["score"])["tasks"]["loose/features"]["episodes"] == 5 and (tmp_path / "scores").is_dir()


@pytest.mark.parametrize(
    "entry, words",
    [
        ("towers = my_module", "the domain towers of my-lab is left out: ValueError: there is a domain of this name"),
        ("empty = my_module", "the domain empty of my-lab is left out: ValueError: my_module is not a module with"),
        ("broken = no_module", "the domain broken of my-lab is left out: ModuleNotFoundError: "),
    ],
)
def test_a_domain_that_cannot_be_loaded_is_left_out(tmp_path, entry, words):
    path = install(tmp_path, f"[physexp.domains]\n{entry}\n", my_module="")
    code = "from physexp import suite\nfound['domains'] = list(suite.TASKS_BY_DOMAIN)"
    found, errors = interpreters.run(code, PYTHONPATH=path)
    assert words in errors and found["domains"] == list(suite.TASKS_BY_DOMAIN)
