"""The structure of the code: a domain is named in its own files alone, and imports flow one way."""

import ast
import dataclasses
import functools
import graphlib
from pathlib import Path
import re
import sys

import pytest

from physexp import suite

ROOT = Path(__file__).parent.parent
sys.path.insert(0, str(ROOT / "docs"))

import structure  # noqa: E402

MODULES = sorted((ROOT / "physexp").rglob("*.py"))
COMMON = set(suite.Options.__annotations__)
SHARED = {"difficulty", "questions", "num_questions"}  # Options of several domains, or with words of the whole package.
LONGEST = 400  # Lines of a module.

# Files that may name a domain: its own, in the suite and in the analysis; the experiments, which are questions about
# domains; and the demonstration.
MAY_NAME_A_DOMAIN = ("suite/domains/", "analysis/domains/", "analysis/experiments/", "cli/demo.py")


@functools.cache
def words_in(path: Path) -> frozenset[str]:
    """The names and texts of a module's code, without its docstrings."""
    tree = ast.parse(path.read_text())
    docstrings = {id(node.value) for node in ast.walk(tree) if isinstance(node, ast.Expr)}
    found: set[str] = set()
    for node in ast.walk(tree):
        match node:
            case ast.Constant(value=str(text)) if id(node) not in docstrings:
                found |= set(re.findall(r"\w+", text))
            case ast.Name(id=name) | ast.Attribute(attr=name) | ast.arg(arg=name) | ast.keyword(arg=str(name)):
                found.add(name)
            case ast.alias(name=name):
                found |= set(name.split("."))
    return frozenset(found)


@pytest.mark.parametrize("domain", suite.TASKS_BY_DOMAIN)
def test_a_domain_is_named_in_its_own_files_alone(domain):
    options = {field.name for field in dataclasses.fields(suite.options(domain))} - COMMON - SHARED
    places = {str(path.relative_to(ROOT / "physexp")): path for path in MODULES}
    named = {
        place: found
        for place, path in places.items()
        if not place.startswith(MAY_NAME_A_DOMAIN) and (found := ({domain} | options) & words_in(path))
    }
    assert not named


def test_no_module_imports_itself_through_others():
    imports = structure.imports()
    # A package's own imports are under way while its modules are imported.
    graph = {name: {other for other in others if not name.startswith(f"{other}.")} for name, others in imports.items()}
    try:
        tuple(graphlib.TopologicalSorter(graph).static_order())
    except graphlib.CycleError as error:
        pytest.fail(" imports ".join(reversed(error.args[1])))


def test_rooms_import_rooms_of_lower_floors_alone():
    floor = {room: number for number, rooms in enumerate(structure.FLOORS) for room in rooms}
    upwards = [arrow for arrow in structure.arrows() if floor[arrow[1]] >= floor[arrow[0]]]
    assert not upwards
    assert len(floor) <= 16 and len(structure.FLOORS) <= 8 and len(structure.arrows()) <= 65
    for low, high in (("suite", "agents"), ("agents", "suite")):
        assert (low, high) not in structure.arrows()


def test_modules_are_short_and_say_what_they_are_for():
    for path in MODULES:
        text = path.read_text()
        assert text.count("\n") <= LONGEST, path
        assert not text or ast.get_docstring(ast.parse(text)), path
