"""Installations from a wheel work like a checkout."""

import ast
import importlib.metadata
from pathlib import Path
import re
import shutil
import subprocess
import sys
import sysconfig
import zipfile

from packaging.requirements import Requirement
from packaging.utils import canonicalize_name
import pytest

import physexp
from physexp import extras, suite

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
    timestep = environment.reset()
    assert environment.step(0).mid()
    print(domain, task)

actor = agents.load_pretrained(*suite.ALL_TASKS[0])
environment = suite.load(*suite.ALL_TASKS[0])
timestep = environment.reset()
actor.observe_first(timestep)
environment.step(actor.select_action(timestep.observation))
"""


@pytest.fixture(scope="module")
def source(tmp_path_factory):
    """A copy of the checkout without earlier builds."""
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
    command = [sys.executable, "-I", "-S", "-c", PLAY_EVERY_TASK, installed, *libraries]
    lines = subprocess.run(command, cwd=tmp_path, stdout=subprocess.PIPE, text=True, check=True).stdout.splitlines()
    assert Path(lines[0]).is_relative_to(installed)
    assert lines[1:] == [f"{domain} {task}" for domain, task in suite.ALL_TASKS]


def test_the_wheel_holds_the_package_with_its_data_and_no_tests(source, wheel, distribution):
    files = {str(path.relative_to(source)) for path in (source / "physexp").rglob("*") if path.is_file()}
    assert {"physexp/py.typed"} < files
    assert {name for name in zipfile.ZipFile(wheel).namelist() if ".dist-info/" not in name} == files
    assert wheel.stat().st_size < 15e6  # Agents take up to 12 MB, and the page 3 MB.
    assert distribution.read_text("licenses/LICENSE") == (ROOT / "LICENSE").read_text()
    (command,) = distribution.entry_points.select(group="console_scripts")
    assert (command.name, command.value) == ("physexp", "physexp.cli:main")


BROUGHT = {"OpenGL": "dm-control", **dict.fromkeys(("anyio", "mcp_types", "uvicorn"), "mcp")}
"""Imported modules that come with a library of the core or of an extra."""


def required(distribution, extra=""):
    """The libraries that physexp, or one of its extras alone, requires, and the extras that it includes."""
    lines = map(Requirement, distribution.requires)
    wanted = [line for line in lines if (line.marker.evaluate({"extra": extra}) if line.marker else not extra)]
    inner = {name for line in wanted if line.name == "physexp" for name in line.extras}
    return {canonicalize_name(line.name) for line in wanted}, inner


def imported():
    """The names of all top-level modules that the package imports."""
    for path in (ROOT / "physexp").rglob("*.py"):
        for node in ast.walk(ast.parse(path.read_text())):
            if isinstance(node, ast.Import):
                yield from (alias.name.partition(".")[0] for alias in node.names)
            elif isinstance(node, ast.ImportFrom):
                yield node.module.partition(".")[0]


def test_every_library_comes_with_the_core_or_with_its_extra(distribution):
    core, _ = required(distribution)
    owners = importlib.metadata.packages_distributions()
    for module, library in BROUGHT.items():
        brought = {canonicalize_name(Requirement(line).name) for line in importlib.metadata.requires(library)}
        assert library in core | set(extras.EXTRAS) and not brought.isdisjoint(map(canonicalize_name, owners[module]))
    modules = set(imported()) - set(sys.stdlib_module_names) - {"physexp", *BROUGHT}
    elsewhere = {module for module in modules if core.isdisjoint(map(canonicalize_name, owners[module]))}
    # torch imports TensorBoard for us.
    assert elsewhere <= set(extras.EXTRAS) and set(extras.EXTRAS) - elsewhere <= {"tensorboard"}
    for module, extra in extras.EXTRAS.items():
        assert canonicalize_name(module) in required(distribution, extra)[0] - core
    _, included = required(distribution, "all")
    assert included.union(*(required(distribution, extra)[1] for extra in included)) >= set(extras.EXTRAS.values())


def test_every_requirement_has_a_pin_that_it_allows(distribution):
    lines = (ROOT / "constraints.txt").read_text().splitlines()
    pins = dict(line.split("==") for line in lines if not line.startswith("#"))
    pins = {canonicalize_name(name): version for name, version in pins.items()}
    for requirement in map(Requirement, distribution.requires):
        if requirement.name != "physexp":  # An extra that includes another.
            assert pins[canonicalize_name(requirement.name)] in requirement.specifier


def test_the_citation_and_the_changelog_are_of_this_version():
    version = re.escape(physexp.__version__)
    assert re.search(rf"^version: {version}$", (ROOT / "CITATION.cff").read_text(), re.MULTILINE)
    assert re.search(rf"^## \[{version}\]", (ROOT / "CHANGELOG.md").read_text(), re.MULTILINE)
