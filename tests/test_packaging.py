"""What a user gets who installs a wheel instead of a checkout."""

import importlib.metadata
from pathlib import Path
import shutil
import subprocess
import sys
import sysconfig
import zipfile

from packaging.requirements import Requirement
from packaging.utils import canonicalize_name
import pytest

ROOT = Path(__file__).parents[1]

NOT_SOURCE = shutil.ignore_patterns(".*", "__pycache__", "build", "dist", "runs", "results", "*.egg-info")

# Runs without `site`, so that no .pth file of an editable install puts the checkout on the path.
PLAY_EVERY_TASK = """
import sys
sys.path[:0] = sys.argv[1:]
import physexp
print(physexp.__file__)

from physexp import agents, suite

for domain, task in suite.ALL_TASKS:
    environment = suite.load(domain, task, task_kwargs={"random": 0})
    assert environment.reset().first()
    assert environment.step(environment.action_spec().generate_value()).mid()

    batch = suite.load_batch(domain, task, num_environments=2, task_kwargs={"random": 0})
    assert batch.reset().first().all()
    action = batch.action_spec().generate_value()
    assert batch.step([action, action]).mid().all()

    actor = agents.load_pretrained(domain, task)
    timestep = environment.reset()
    actor.observe_first(timestep)
    environment.step(actor.select_action(timestep.observation))

    print(domain, task)
"""


@pytest.fixture(scope="module")
def source(tmp_path_factory):
    """A copy of the checkout, without what earlier builds left there."""
    return Path(shutil.copytree(ROOT, tmp_path_factory.mktemp("source") / "physexp", ignore=NOT_SOURCE))


@pytest.fixture(scope="module")
def wheel(source, tmp_path_factory):
    """The path of a wheel built from the checkout."""
    folder = tmp_path_factory.mktemp("wheel")
    run_pip("wheel", "--no-deps", "--no-build-isolation", "--wheel-dir", folder, source)
    (path,) = folder.glob("*.whl")
    return path


@pytest.fixture(scope="module")
def installed(wheel, tmp_path_factory):
    """A folder with the wheel installed in it and nothing else."""
    folder = tmp_path_factory.mktemp("installed")
    run_pip("install", "--no-deps", "--target", folder, wheel)
    return folder


@pytest.fixture(scope="module")
def distribution(installed):
    (folder,) = installed.glob("*.dist-info")
    return importlib.metadata.Distribution.at(folder)


def run_pip(command, *arguments):
    subprocess.run([sys.executable, "-m", "pip", command, "--quiet", "--no-index", *arguments], check=True)


def test_every_task_plays_from_the_wheel_outside_the_checkout(installed, tmp_path):
    libraries = {sysconfig.get_path("purelib"), sysconfig.get_path("platlib")}
    lines = subprocess.run(
        [sys.executable, "-I", "-S", "-c", PLAY_EVERY_TASK, installed, *libraries],
        cwd=tmp_path,
        stdout=subprocess.PIPE,
        text=True,
        check=True,
    ).stdout.splitlines()

    from physexp import suite

    assert Path(lines[0]).is_relative_to(installed)
    assert lines[1:] == [f"{domain} {task}" for domain, task in suite.ALL_TASKS]


def test_the_wheel_holds_the_package_with_its_types_and_trained_agents_and_no_tests(source, wheel):
    modules = {str(path.relative_to(source)) for path in (source / "physexp").rglob("*.py")}
    trained = {str(path.relative_to(source)) for path in (source / "physexp/agents/pretrained_agents").iterdir()}
    names = zipfile.ZipFile(wheel).namelist()

    assert trained
    assert {name for name in names if ".dist-info/" not in name} == modules | trained | {"physexp/py.typed"}


def test_the_wheel_carries_the_licence(distribution):
    assert distribution.read_text("licenses/LICENSE") == (ROOT / "LICENSE").read_text()


def test_the_wheel_declares_the_command_line(distribution):
    (command,) = distribution.entry_points.select(group="console_scripts")

    assert (command.name, command.value) == ("physexp", "physexp.cli:main")


def test_every_requirement_has_a_pin_that_it_allows(distribution):
    requirements = [Requirement(line) for line in distribution.requires]
    lines = (ROOT / "constraints.txt").read_text().splitlines()
    pins = dict(line.split("==") for line in lines if not line.startswith("#"))
    pins = {canonicalize_name(name): version for name, version in pins.items()}

    for requirement in requirements:
        if requirement.name != "physexp":  # An extra that includes another.
            assert pins[canonicalize_name(requirement.name)] in requirement.specifier
