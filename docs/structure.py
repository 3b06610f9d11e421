"""The structure of the code, read from its imports: rooms, floors and arrows, and a picture of them.

Run as a program, it writes the picture of `docs/architecture.md` to the path that is given.
"""

import ast
import functools
import html
from pathlib import Path
import sys

ROOT = Path(__file__).parent.parent
FLOORS = (
    ("checks", "extras"),
    ("suite", "agents"),
    ("ideal", "data"),
    ("domains",),
    ("training",),
    ("replay", "score", "experiments"),
    ("play", "bench"),
    ("cli",),
)
"""The rooms from the ground up. A room imports rooms of lower floors alone."""

PURPOSES = {
    "checks": "checks of values",
    "extras": "optional libraries",
    "suite": "environments, batches",
    "agents": "actors, learners",
    "ideal": "ideal experimenters",
    "data": "tables, statistics, plots",
    "domains": "facts about each domain",
    "training": "runs, evaluation",
    "replay": "episodes for rerun",
    "score": "score, verify, export",
    "experiments": "claims, report",
    "play": "games for people",
    "bench": "measurements of speed",
    "cli": "the command physexp",
}
"""What a room is for, in a few words."""


@functools.cache
def imports() -> dict[str, set[str]]:
    """Returns the modules of the project that each module imports, apart from imports for types alone."""
    paths = {_name(path): path for path in sorted((ROOT / "physexp").rglob("*.py"))}
    return {name: _imports_of(path, set(paths)) - {name} for name, path in paths.items()}


def room(module: str) -> str | None:
    """Returns the room of a module; None for the package itself."""
    parts = module.split(".")[1:]
    if parts[:1] == ["analysis"]:
        parts = parts[1:]
    return parts[0] if parts else None


@functools.cache
def arrows() -> set[tuple[str, str]]:
    """Returns the pairs of rooms of which the first imports the second."""
    pairs = {(room(name), room(other)) for name, others in imports().items() for other in others}
    return {(one, two) for one, two in pairs if one and two and one != two}


def _name(path: Path) -> str:
    parts = path.relative_to(ROOT).with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


def _imports_of(path: Path, names: set[str]) -> set[str]:
    tree = ast.parse(path.read_text(encoding="utf-8"))
    for_types = {
        id(inner)
        for node in ast.walk(tree)
        if isinstance(node, ast.If) and "TYPE_CHECKING" in ast.unparse(node.test)
        for inner in ast.walk(node)
    }
    found = set()
    for node in ast.walk(tree):
        match node:
            case ast.ImportFrom(module=str(module), names=aliases) if id(node) not in for_types:
                inner = {f"{module}.{alias.name}" for alias in aliases}
                found |= (inner & names) | ({module} & names if inner - names else set())
            case ast.Import(names=aliases) if id(node) not in for_types:
                found |= {alias.name for alias in aliases} & names
    return found


# The picture.

_WIDTH, _HEIGHT = 190, 46  # A room.
_GAP, _RISE = 60, 92  # Between rooms of a floor, and from a floor to the next.


def picture() -> str:
    """Returns the picture as SVG: rooms with their purposes, and arrows without those that follow from others."""
    widest = max(map(len, FLOORS)) * (_WIDTH + _GAP) + 200
    height = len(FLOORS) * _RISE + 20
    places = {}
    for number, rooms in enumerate(FLOORS):
        left = (widest - len(rooms) * _WIDTH - (len(rooms) - 1) * _GAP) / 2
        for index, name in enumerate(rooms):
            places[name] = left + index * (_WIDTH + _GAP), height - (number + 1) * _RISE + 20
    shapes = [_arrow(places[one], places[two]) for one, two in sorted(_direct())]
    shapes += [_box(name, *place) for name, place in places.items()]
    head = '<marker id="head" viewBox="0 0 8 8" refX="8" refY="4" markerWidth="7" markerHeight="7" orient="auto">'
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {widest} {height}" font-family="sans-serif">'
        f'<defs>{head}<path d="M0 0L8 4L0 8z" fill="#7a8aa0"/></marker></defs>'
        f'<rect width="100%" height="100%" fill="white"/>{"".join(shapes)}</svg>\n'
    )


def _direct() -> set[tuple[str, str]]:
    """Returns the arrows between rooms that no longer way connects."""

    @functools.cache
    def below(name: str) -> set[str]:
        return {two for one, two in arrows() if one == name for two in {two, *below(two)}}

    return {
        (one, two)
        for one, two in arrows()
        if not any(two in below(between) for start, between in arrows() if start == one)
    }


def _box(name: str, x: float, y: float) -> str:
    middle = x + _WIDTH / 2
    return (
        f'<rect x="{x}" y="{y}" width="{_WIDTH}" height="{_HEIGHT}" rx="6" fill="#eef3fa" stroke="#3a5a8a"/>'
        f'<text x="{middle}" y="{y + 19}" text-anchor="middle" font-weight="bold" font-size="14">{name}</text>'
        f'<text x="{middle}" y="{y + 36}" text-anchor="middle" font-size="12">{html.escape(PURPOSES[name])}</text>'
    )


def _arrow(start: tuple[float, float], end: tuple[float, float]) -> str:
    """Returns a curve from the lower edge of a room to the upper edge of another."""
    (x1, y1), (x2, y2) = start, end
    x1, y1, x2 = x1 + _WIDTH / 2, y1 + _HEIGHT, x2 + _WIDTH / 2
    bend = (y2 - y1) / 2
    is_long = y2 - y1 > _RISE
    side = (110 if x2 >= x1 else -110) if is_long else 0
    path = f"M{x1} {y1}C{x1 + side} {y1 + bend} {x2 + side} {y2 - bend} {x2} {y2}"
    return f'<path d="{path}" fill="none" stroke="#7a8aa0" stroke-width="1.2" opacity="0.7" marker-end="url(#head)"/>'


if __name__ == "__main__":
    Path(sys.argv[1]).write_text(picture(), encoding="utf-8")
