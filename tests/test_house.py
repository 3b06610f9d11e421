"""The house stays in order: a domain is named in its own files alone, and imports flow one way."""

import ast
import dataclasses
import functools
import graphlib
from pathlib import Path
import re

import pytest

from physexp import suite

ROOT = Path(__file__).parent.parent
MODULES = sorted((ROOT / "physexp").rglob("*.py"))
COMMON = {field.name for field in dataclasses.fields(suite.Options)}

# What may speak of a domain: itself, on either side; the experiments, which are questions about domains; and the
# demonstration, which is an experiment that everybody makes.
MAY_NAME_A_DOMAIN = ("suite/domains/", "analysis/domains/", "analysis/experiments/", "cli/demo.py")

# Rooms of the analysis, each of which imports from those before it alone.
FLOORS = (
    ("data",),
    ("ideal",),
    ("domains",),
    ("training",),
    ("replay", "score"),
    ("experiments", "play"),
    ("bench",),
)


@functools.cache
def words_in(path: Path) -> frozenset[str]:
    """The names and texts of a module's code, without its docstrings."""
    return frozenset(words_of(ast.parse(path.read_text())))


def words_of(tree: ast.AST):
    """The same of its tree, some more than once."""
    docstrings = {
        id(node.body[0].value)
        for node in ast.walk(tree)
        if isinstance(node, (ast.Module, ast.ClassDef, ast.FunctionDef))
        and node.body
        and isinstance(node.body[0], ast.Expr)
    }
    docstrings |= {id(node.value) for node in ast.walk(tree) if isinstance(node, ast.Expr)}
    for node in ast.walk(tree):
        match node:
            case ast.Constant(value=str(text)) if id(node) not in docstrings:
                yield from re.findall(r"\w+", text)
            case ast.Name(id=name) | ast.Attribute(attr=name) | ast.arg(arg=name) | ast.keyword(arg=str(name)):
                yield name
            case ast.alias(name=name):
                yield from name.split(".")


def own_words(domain: str) -> set[str]:
    """A domain's name, and its options that not every domain has."""
    options = {field.name for field in dataclasses.fields(suite.options(domain))} - COMMON
    shared = {"difficulty"}  # Every domain may have one; old records have a column of this name.
    return {domain} | (options - shared)


@pytest.mark.parametrize("domain", suite.TASKS_BY_DOMAIN)
def test_a_domain_is_named_in_its_own_files_alone(domain):
    named = {}
    for path in MODULES:
        place = str(path.relative_to(ROOT / "physexp"))
        if not place.startswith(MAY_NAME_A_DOMAIN):
            found = own_words(domain) & words_in(path)
            if found:
                named[place] = found
    assert not named


def module_name(path: Path) -> str:
    parts = path.relative_to(ROOT).with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


NAMES = {module_name(path) for path in MODULES}


def imports_of(path: Path) -> set[str]:
    """The modules of the project that a module imports, wherever in its text, but for types alone."""
    tree = ast.parse(path.read_text())
    for_types = {
        id(inner)
        for node in ast.walk(tree)
        if isinstance(node, ast.If) and "TYPE_CHECKING" in ast.unparse(node.test)
        for inner in ast.walk(node)
    }
    found = set()
    for node in ast.walk(tree):
        if id(node) in for_types:
            continue
        match node:
            case ast.ImportFrom(module=str(module), names=names) if module.startswith("physexp"):
                for alias in names:
                    found.add(f"{module}.{alias.name}" if f"{module}.{alias.name}" in NAMES else module)
            case ast.Import(names=names):
                found |= {alias.name for alias in names if alias.name in NAMES}
    return found - {module_name(path)}


@functools.cache
def imports() -> dict[str, set[str]]:
    """The same of each module."""
    return {module_name(path): imports_of(path) for path in MODULES}


def test_no_module_imports_itself_over_others():
    graph = {name: {other for other in others if not is_inside(name, other)} for name, others in imports().items()}
    try:
        tuple(graphlib.TopologicalSorter(graph).static_order())
    except graphlib.CycleError as error:
        pytest.fail(" imports ".join(reversed(error.args[1])))


def is_inside(module: str, package: str) -> bool:
    """Whether a module belongs to a package, whose own imports are then under way."""
    return module.startswith(f"{package}.")


def test_the_suite_knows_no_agents_and_the_agents_no_tasks():
    for name, others in imports().items():
        for room, strangers in (("suite", ("agents", "analysis", "cli")), ("agents", ("suite", "analysis", "cli"))):
            if name.startswith(f"physexp.{room}"):
                assert not {other for other in others if other.startswith(tuple(f"physexp.{s}" for s in strangers))}, (
                    name
                )


def test_the_rooms_of_the_analysis_import_from_the_floors_below_alone():
    floor = {room: number for number, rooms in enumerate(FLOORS) for room in rooms}
    upwards = []
    for name, others in imports().items():
        room = name.removeprefix("physexp.analysis.").split(".")[0] if name.startswith("physexp.analysis.") else None
        if room is None:
            continue
        for other in others:
            its = other.removeprefix("physexp.analysis.").split(".")[0]
            if other.startswith("physexp.analysis.") and its != room and floor[its] > floor[room]:
                upwards.append(f"{name} imports {other}")
    assert not upwards


def test_every_module_says_in_its_first_line_what_it_is_for():
    silent = [
        str(path.relative_to(ROOT))
        for path in MODULES
        if path.read_text().strip() and not (ast.get_docstring(ast.parse(path.read_text())) or "").strip()
    ]
    assert not silent


def test_the_formatter_is_hardly_ever_overruled():
    overruled = [path for path in [*MODULES, *(ROOT / "tests").rglob("*.py")] if "fmt: " + "skip" in path.read_text()]
    assert len(overruled) <= 10
