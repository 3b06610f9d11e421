"""Draws docs/DOMAIN.gif of each domain: an episode of a belief learner, with its belief and the ideal experimenter's.

Arguments name the domains; without any, all are drawn.
"""

from collections.abc import Iterator, Sequence
import copy
import dataclasses
import json
from pathlib import Path
import sys
import textwrap

import matplotlib
import numpy as np
from PIL import Image, ImageColor, ImageDraw, ImageFont

from physexp.analysis.replay import beliefs, layout, palette, recording
from physexp.analysis.training import finding
from physexp.suite.engine import rendering

# isort: split
import mujoco  # After physexp, which chooses how it draws.

EPISODES = {
    "which_is_heavier": ("which_is_heavier/features", 12, 1),
    "towers": ("towers/fist_features", 8, 0),
    "threshold": ("threshold/features", 5, 6),
    "balance": ("balance/features", 5, 1),
    "strings": ("strings/features", 5, 2),
    "sealed_box": ("sealed_box/features", 5, 7),
    "strike": ("strike/features", 5, 0),
    "crush": ("crush/features", 5, 6),
    "lump": ("lump/features", 5, 6),
}
"""For each picture the agent, which keeps a belief, and the seed and the index of the episode."""

SCALE = 2  # Pixels of a unit, for dense screens; all lengths below are in units.
WIDTH, MARGIN = 280, 6
LINE = 15  # Of the question's text.
SCENE = (36, 220)  # Upper edge and height.
ACTION, LEGEND, ROWS, HEIGHT = 260, 277, 292, 400  # Upper edges, and that of the end.
MOST_ROWS = 8  # More labels are in two columns.
FRAMES_PER_STEP = 5
STRIDE = 10  # Physics steps between frames of a film after an answer.
THINKING, MOVING, ENDING = 800, 80, 3000  # ms, of a decision, of a frame that moves, of the verdict
COLORS = 128
PAPER, MAT, INK, TRACK, BELIEF = "#f3f1ec", "#fbfaf7", "#222222", "#e4e1da", "#2b8a94"
RIGHT, WRONG = "#2f7d3b", "#b3362b"
GLASS = 0.25  # Opacity of covers after the answer.


@dataclasses.dataclass(frozen=True)
class Frame:
    """The content of a frame.

    Attributes:
      substep: of the physics: the poses follow from the observations, and with the verdict they are the true ones.
      action: in words.
      beliefs: the agent's and the ideal experimenter's probabilities of the labels, float64 [2, L].
      verdict: in words, at the end.
      duration: ms.
    """

    substep: int
    action: str
    beliefs: np.ndarray
    verdict: str
    duration: int


def recorded(name: str) -> recording.Film:
    """Returns the episode that a picture shows."""
    target, seed, index = EPISODES[name]
    agent = finding.find_agent(target)
    return recording.reenact(agent.network, agent.config, seed, index, None)


def record(name: str, episode: recording.Film) -> str:
    """Returns a picture's record, as players write it, which the picture carries as its comment."""
    target, seed, index = EPISODES[name]
    return json.dumps({"task": target, "seed": seed, "episode": index, "actions": episode.actions.tolist()})


def believed(episode: recording.Film) -> np.ndarray:
    """Returns the agent's and the ideal experimenter's beliefs before each of T actions, float64 [T, 2, L]."""
    ideal = beliefs.of_ideal(episode)
    assert ideal is not None
    return np.stack([beliefs.of_agent(episode), ideal[: len(episode.actions)]], axis=1)


def frames(episode: recording.Film, shares: np.ndarray) -> list[Frame]:
    """Returns the frames of an episode: each decision, its effect, and the verdict; `shares` as `believed` returns."""
    task = episode.declared
    substeps, found = task.options.substeps, []
    for step, action in enumerate(episode.actions):
        said, start = f"{step + 1}. {task.action_names[action]}", step * substeps
        if action >= task.num_interactions:
            end = len(episode.times) - 1  # Later than the start where the answer is played out.
            found += [Frame(substep, said, shares[step], "", MOVING) for substep in range(start, end, STRIDE)]
            found.append(Frame(end, said, shares[step], "right" if episode.rewards[-1] > 0 else "wrong", ENDING))
            continue
        for number in range(FRAMES_PER_STEP):
            duration = MOVING if number else THINKING
            found.append(Frame(start + number * substeps // FRAMES_PER_STEP, said, shares[step], "", duration))
    return found


def stage(episode: recording.Film) -> mujoco.MjModel:
    """Returns a model of the scene that is lit for people."""
    task, model = episode.declared, copy.copy(episode.declared.apparatus.model)
    width, height = (2 * SCALE * length for length in (WIDTH, SCENE[1]))
    model.vis.global_.offwidth, model.vis.global_.offheight = width, height
    quality = model.vis.quality
    quality.shadowsize, quality.numslices, quality.numstacks = 4096, 48, 48
    model.light_castshadow[:] = True
    model.vis.headlight.ambient[:], model.vis.headlight.diffuse[:] = 0.5, 0.05
    model.vis.map.shadowclip = 5 / model.stat.extent
    floor, mat = (model.geom(geom.full_identifier).id for geom in (task.root_entity.floor, task.root_entity.mat))
    model.geom_type[floor] = mujoco.mjtGeom.mjGEOM_PLANE  # A large box shades its own seams.
    model.geom_rgba[[floor, mat], :3] = np.array([ImageColor.getrgb(PAPER), ImageColor.getrgb(MAT)]) / 255
    return model


def named(episode: recording.Film, model: mujoco.MjModel) -> dict[int, str]:
    """Returns the texts on things that can be acted on, stand still or show readings, by shape."""
    task, shapes = episode.declared, episode.shapes
    still = np.setdiff1d(np.flatnonzero(shapes.are_drawn & ~shapes.are_moving), layout.covers(episode))
    things = [*sorted({each.thing for each in task.interactions}), *(shapes.names[shape] for shape in still)]
    found = {shapes.names.index(thing): thing.replace("_", " ") for thing in things}
    for each in task.scene.indicators:
        is_only = sum(other.reading == each.reading for other in task.scene.indicators) == 1
        (shape,) = np.flatnonzero(shapes.geoms == model.geom(each.geom.full_identifier).id)
        text = each.reading if is_only else f"{each.reading} {each.component}"
        if text not in found.values():
            found.setdefault(int(shape), text)
    return found


def scenes(episode: recording.Film, shown: Sequence[Frame]) -> Iterator[Image.Image]:
    """Yields the scenes of some frames; with the verdict, the true scene behind glass."""
    model, shapes, size = stage(episode), episode.shapes, (SCALE * WIDTH, SCALE * SCENE[1])
    names, data, option = named(episode, model), mujoco.MjData(model), mujoco.MjvOption()
    revealed, covers, pairs = episode.declared.reveal(episode.hidden), layout.covers(episode), []
    mujoco.mj_forward(model, data)
    option.geomgroup[rendering.UNDRAWN_GROUP] = False
    with mujoco.Renderer(model, 2 * size[1], 2 * size[0]) as renderer:
        for frame in shown:
            positions, rotations, sizes = episode.positions, episode.rotations, episode.sizes
            if frame.verdict:
                positions, rotations, sizes = episode.true_positions, episode.true_rotations, episode.true_sizes
                names = {shapes.names.index(thing): text for thing, text in revealed.marks.items()}
                pairs = [[*map(shapes.names.index, pair)] for pair in (*revealed.joined, *revealed.tied)]
                model.geom_group[shapes.geoms] = 0
                model.geom_rgba[shapes.geoms[covers], 3] = GLASS
                model.light_castshadow[:] = not covers  # Glass has none.
            data.geom_xpos[shapes.geoms] = positions[frame.substep]
            data.geom_xmat[shapes.geoms] = rotations[frame.substep].reshape(-1, 9)
            for geom, values in sizes.items():
                model.geom_size[geom] = values[frame.substep]
            renderer.update_scene(data, "observer", option)
            image = Image.fromarray(renderer.render()).resize(size, Image.Resampling.LANCZOS)
            places, pen = positions[frame.substep], ImageDraw.Draw(image)
            for pair in pairs:
                ends = [seen_at(model, data, places[shape]) for shape in pair]
                pen.line(np.ravel(ends).tolist(), INK, 2 * SCALE)
            above = {shape: places[shape] + (0, 0, shapes.sizes[shape, 2]) for shape in names}
            are_seen = {k: above[k][2] > 0 and 0 < seen_at(model, data, places[k])[0] < size[0] for k in names}
            write_names(pen, {seen_at(model, data, above[k]): names[k] for k in names if are_seen[k]})
            yield image


def write_names(pen: ImageDraw.ImageDraw, texts: dict[tuple[float, float], str]) -> None:
    """Writes texts on a scene above places, x and y in pixels, or higher where another text is."""
    taken: list[np.ndarray] = []
    for place, text in texts.items():
        box = np.array(pen.textbbox(place, text, _font(9), "mb", stroke_width=SCALE))
        box += np.tile(np.clip(0, -box[:2], np.array(pen.im.size) - box[2:]), 2)  # Inside the picture.
        while any((box[:2] < other[2:]).all() and (other[:2] < box[2:]).all() for other in taken):
            box -= [0, SCALE, 0, SCALE]
        taken.append(box)
        pen.text((box[:2] + box[2:]) / 2, text, INK, _font(9), "mm", stroke_width=SCALE, stroke_fill="white")


def seen_at(model: mujoco.MjModel, data: mujoco.MjData, position: np.ndarray) -> tuple[float, float]:
    """Returns the pixel, x and y, at which a position, m (3,), is seen."""
    camera, half = data.camera("observer"), SCALE * SCENE[1] / 2
    right, up, back = (position - camera.xpos) @ camera.xmat.reshape(3, 3)
    far = np.tan(np.radians(model.camera("observer").fovy[0] / 2))
    return SCALE * WIDTH / 2 - half * right / (back * far), half + half * up / (back * far)


def _font(size: float, style: str = "") -> ImageFont.FreeTypeFont:
    return ImageFont.truetype(f"{matplotlib.get_data_path()}/fonts/ttf/DejaVuSans{style}.ttf", size * SCALE)


def drawn(episode: recording.Film, frame: Frame, scene: Image.Image) -> Image.Image:
    """Returns a frame: the question, the scene, the action in words, and the beliefs as named bars."""
    labels = episode.declared.label_names
    names, colors = palette.short(labels, episode.shapes), palette.of_labels(labels, episode.shapes)
    of_things = {palette.of_thing(episode.shapes, thing) for thing in episode.shapes.names}
    picture = Image.new("RGB", (WIDTH * SCALE, HEIGHT * SCALE), "white")
    picture.paste(scene, (0, SCENE[0] * SCALE))
    pen = ImageDraw.Draw(picture)

    def write(x: float, y: float, text: str, size: float, color: str = INK, style: str = "", anchor: str = "lm"):
        pen.text((x * SCALE, y * SCALE), text, color, _font(size, style), anchor=anchor)

    def box(x: float, y: float, length: float, height: float, **look):
        if length * SCALE >= 1:
            pen.rectangle([x * SCALE, y * SCALE, (x + length) * SCALE - 1, (y + height) * SCALE - 1], **look)

    question = episode.declared.question
    lines = [question] if len(question) <= 40 else textwrap.wrap(question, min(40, len(question) // 2 + 6))
    for number, line in enumerate(lines):
        write(MARGIN, SCENE[0] / 2 + (number - (len(lines) - 1) / 2) * LINE, line, 11.5, style="-Bold")
    write(MARGIN, ACTION + 8, frame.action, 11)
    verdict = {"right": RIGHT, "wrong": WRONG, "": INK}[frame.verdict]
    write(WIDTH - MARGIN, ACTION + 8, frame.verdict, 11.5, verdict, "-Bold", "rm")
    box(MARGIN, LEGEND + 2, 10, 8, fill=BELIEF)
    write(MARGIN + 14, LEGEND + 6, "the agent's belief", 9)
    box(WIDTH / 2, LEGEND + 2, 10, 8, outline=INK, width=SCALE)
    write(WIDTH / 2 + 14, LEGEND + 6, "the ideal experimenter's", 9)
    columns = 1 if len(labels) <= MOST_ROWS else 2
    rows = -(-len(labels) // columns)
    height, size = (HEIGHT - ROWS - 4) / rows, 10 if columns == 1 else 9
    indent = max(_font(size).getlength(name) for name in names) / SCALE + 5
    full = WIDTH / columns - indent - MARGIN - 3
    for k, name in enumerate(names):
        column, row = divmod(k, rows)
        x, y = column * WIDTH / columns + MARGIN, ROWS + row * height
        color = colors[k] if colors[k] in of_things else BELIEF
        write(x, y + height / 2, name, size)
        box(x + indent, y + 1, full, height - 2, fill=TRACK)
        box(x + indent, y + 1, full * frame.beliefs[0, k], height - 2, fill=color)
        box(x + indent, y + 1, full * frame.beliefs[1, k], height - 2, outline=INK, width=SCALE)
    return picture


def save(pictures: Sequence[Image.Image], durations: Sequence[int], path: Path, comment: str) -> None:
    """Writes an animation whose frames share their colours, so that what stays takes no space."""
    samples = [*pictures[:: len(pictures) // 6 + 1], pictures[-1]]
    joined = Image.fromarray(np.concatenate([np.asarray(picture) for picture in samples]))
    colors = joined.quantize(COLORS, Image.Quantize.FASTOCTREE)  # It keeps colours of small areas, too.
    table = np.reshape(colors.getpalette(), (-1, 3))
    table[table.min(axis=1) > 245] = 255  # The ground is the page's white, not a mean of what is nearly white.
    colors.putpalette(table.ravel().tolist())
    plain = [picture.quantize(palette=colors, dither=Image.Dither.NONE) for picture in pictures]
    look = dict(duration=list(durations), loop=0, optimize=True, comment=comment.encode())
    plain[0].save(path, save_all=True, append_images=plain[1:], **look)


if __name__ == "__main__":
    for name in sys.argv[1:] or EPISODES:
        episode = recorded(name)
        shown = frames(episode, believed(episode))
        pictures = [drawn(episode, *each) for each in zip(shown, scenes(episode, shown), strict=True)]
        path = Path(__file__).with_name(f"{name}.gif")
        save(pictures, [frame.duration for frame in shown], path, record(name, episode))
