"""A domain of another package works as the package's own: in the suite, Gymnasium, training, score and commands."""

import os
from pathlib import Path
import shutil
import subprocess
import sys
import textwrap

import interpreters
import pytest

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


@pytest.fixture(scope="module")
def path(tmp_path_factory):
    """The search path with an installed package that has the domain `loose`, its facts and an ideal experimenter."""
    folder = tmp_path_factory.mktemp("site")
    for name in ("loose", "loose_facts"):
        shutil.copy(EXAMPLES / f"{name}.py", folder)
    return install(
        folder,
        """
        [physexp.domains]
        loose = loose

        [physexp.facts]
        loose = loose_facts:DOMAIN
        """,
    )


def _run(path: str, *arguments: str, folder: Path) -> str:
    """Returns the output of a command line."""
    finished = subprocess.run(
        [sys.executable, "-m", "physexp", *arguments],
        env={**os.environ, "PYTHONPATH": path},
        cwd=folder,
        capture_output=True,
        text=True,
        check=False,
    )
    assert finished.returncode == 0, finished.stderr
    return finished.stdout


def test_the_suite_gymnasium_and_the_ideal_know_it(path):
    code = """
import gymnasium, numpy as np
from physexp import suite
from physexp.analysis import domains
import physexp.suite.gymnasium
found["tasks"] = suite.TASKS_BY_DOMAIN["loose"]
batch = suite.load_batch("loose", "features", 3, {"random": 0})
single = suite.load("loose", "features", {"random": suite.environment_seed(0, 2)})
step, alone = batch.reset(), single.reset()
for action in (0, 1, 2):
    step, alone = batch.step(np.full(3, action)), single.step(action)
    assert all(value[2].tobytes() == alone.observation[name].tobytes() for name, value in step.observation.items())
environment = gymnasium.make("physexp/loose-features-v0", random=1)
environment.reset()
found["reward"] = environment.step(4 + environment.unwrapped.dm_env.task.correct_answer)[1]
found["value"] = domains.find("loose").ideal("features", {}, 0.95).value
"""
    found, _ = interpreters.run(code, PYTHONPATH=path)
    assert found["tasks"] == ["features", "pixels"] and found["reward"] == 1
    # The ideal pulls up to three of the four blocks. 1/4 (g + g^2 + 2 g^3) with g = 0.95.
    assert found["value"] == pytest.approx((0.95 + 0.95**2 + 2 * 0.95**3) / 4)


def test_commands_train_solve_and_score_it(path, tmp_path):
    assert "loose" in _run(path, "tasks", folder=tmp_path)
    assert "--rail-stiffness" in _run(path, "train", "loose", "features", "--help", folder=tmp_path)
    train = ["train", "loose", "features", "--agent", "ppo", "--frames", "500", "--run-dir", "run"]
    _run(path, *train, folder=tmp_path)
    assert (tmp_path / "run" / "config.json").exists()
    assert "0.89" in _run(path, "ideal", "loose", folder=tmp_path)
    scored = _run(path, "score", "run", "--episodes", "20", "--json", folder=tmp_path)
    assert "loose" in scored and (tmp_path / "scores").is_dir()


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
    assert words in errors and len(found["domains"]) == 7
