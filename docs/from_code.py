"""Directives that make parts of pages from the code: tables of the suite, and the picture of the structure."""

from collections.abc import Iterator, Sequence
import dataclasses
from pathlib import Path
import re

from docutils import nodes
from docutils.statemachine import StringList
import play_page
from sphinx.util.docutils import SphinxDirective
import structure

from physexp import checks, suite

README = Path(__file__).parents[1] / "README.md"


def cards() -> Iterator[Sequence[str]]:
    """Yields a card for each question, with a moving picture."""
    yield "an agent experiments", "question"
    skills = dict(re.findall(r"^\| \[`(\w+)`\]\S* \| [^|]* \| ([^|]*) \|", README.read_text(), re.MULTILINE))
    for domain, names in suite.TASKS_BY_DOMAIN.items():
        task = suite.load_task(domain, names[0])
        words = domain.replace("_", " ").capitalize()
        picture = f"![{words}, played by an agent]({domain}.gif)"
        link = f'<a href="{play_page.NAME}?task={domain}/{names[0]}">Play it</a>'
        yield picture, f"**{words}.** {task.question} The skill is {skills[domain]}. Gamma is {task.discount:g}. {link}"


def tasks() -> Iterator[Sequence[str]]:
    """Yields the rows of the table of tasks."""
    yield "task", "actions", "observations (float32)", "question"
    for domain, name in suite.ALL_TASKS:
        if "pixels" in suite.tags(domain, name):
            continue
        task = suite.load_task(domain, name)
        first, last = task.num_interactions, task.num_interactions + task.num_labels - 1
        actions = f"0-{first - 1} {task.action_names[0]}, ...; {first}-{last} {task.action_names[first]}, ..."
        arrays = ", ".join(f"`{key}` {spec.shape}" for key, spec in task.observation_spec().items())
        yield f"`{domain}/{name}`", actions, arrays, task.question


def features() -> Iterator[Sequence[str]]:
    """Yields the rows of the table of features."""
    yield "domain", "feature", "meaning"
    seen = set()
    for domain, name in suite.ALL_TASKS:
        task = suite.load_task(domain, name)
        for feature, meaning in task.observation_meanings.items():
            if feature != "pixels" and (domain, feature) not in seen:
                seen.add((domain, feature))
                yield f"`{domain}`", f"`{feature}`", meaning


def options() -> Iterator[Sequence[str]]:
    """Yields the rows of the table of options: those of all domains, then each domain's own."""
    yield "domain", "option", "default", "value"
    common = {field.name for field in dataclasses.fields(suite.Options)}
    for domain in suite.TASKS_BY_DOMAIN:
        kind = suite.options(domain)
        helps = checks.help_of(kind)
        for field in dataclasses.fields(kind):
            if field.name not in common:
                yield f"`{domain}`", f"`{field.name}`", str(field.default), helps[field.name]


def common_options() -> Iterator[Sequence[str]]:
    """Yields the rows of the table of the options that every domain has."""
    yield "option", "default", "value"
    for name, text in checks.help_of(suite.Options).items():
        (field,) = [field for field in dataclasses.fields(suite.Options) if field.name == name]
        default = "the domain's" if field.default is dataclasses.MISSING else str(field.default)
        yield f"`{name}`", default, text


def limits() -> Iterator[Sequence[str]]:
    """Yields the rows of the table of step limits and discounts."""
    yield "domain", "steps at most", "gamma"
    for domain, names in suite.TASKS_BY_DOMAIN.items():
        task = suite.load_task(domain, names[0])
        yield f"`{domain}`", str(task.rules.step_limit), f"{task.discount:g}"


TABLES = {function.__name__: function for function in (cards, tasks, features, options, common_options, limits)}


class SuiteTable(SphinxDirective):
    """A table of `TABLES`, by name."""

    required_arguments = 1

    def run(self) -> list[nodes.Node]:
        head, *rows = TABLES[self.arguments[0]]()
        lines = ["| " + " | ".join(row) + " |" for row in (head, ["---"] * len(head), *rows)]
        section = nodes.Element()
        self.state.nested_parse(StringList(lines, source=__file__), self.content_offset, section)
        for table in section.findall(nodes.table):
            table["classes"] += self.arguments
        return section.children


class StructurePicture(SphinxDirective):
    """The picture of rooms and arrows."""

    def run(self) -> list[nodes.Node]:
        return [nodes.raw("", structure.picture(), format="html")]


def setup(app) -> dict:
    """Adds the directives."""
    app.add_directive("suite-table", SuiteTable)
    app.add_directive("structure-picture", StructurePicture)
    return {"parallel_read_safe": True}
