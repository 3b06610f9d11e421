"""Draws docs/DOMAIN.gif of each domain: an episode of an agent that comes with the package."""

from collections.abc import Iterator, Sequence
import dataclasses
from pathlib import Path

from matplotlib import figure
from matplotlib.backends import backend_agg
import numpy as np
from PIL import Image

from physexp.analysis.replay import beliefs, palette, recording
from physexp.analysis.training import finding
from physexp.suite.engine import rendering

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

SCALE = 2  # For dense screens.
SIZE = (880 * SCALE, 400 * SCALE)  # pixels
SCENE = 340 * SCALE  # pixels
FRAMES_PER_STEP = 4
STRIDE = 10  # Physics steps between frames of what an answer leads to.
MANY_LABELS = 8  # More are written smaller.
THINKING, MOVING, ENDING = 700, 100, 3000  # ms, of a decision, of a frame that moves, of the verdict
COLORS = 96
LABEL_COLOR, RIGHT, WRONG = "#2b8a94", "#2f7d3b", "#b3362b"


@dataclasses.dataclass(frozen=True)
class Frame:
    """The content of a frame.

    Attributes:
      substep: of the physics: the poses follow from the observations, and with the verdict they are the true ones.
      action: in words.
      belief: probabilities of the labels, float64 [L].
      verdict: in words, at the end.
      duration: ms.
    """

    substep: int
    action: str
    belief: np.ndarray
    verdict: str
    duration: int


def recorded(name: str) -> recording.Film:
    """Returns the episode that a picture shows."""
    target, seed, index = EPISODES[name]
    agent = finding.find_agent(target)
    return recording.reenact(agent.network, agent.config, seed, index, None)


def frames(episode: recording.Film) -> list[Frame]:
    """Returns the frames of an episode: each decision, its effect, and the verdict."""
    task = episode.declared
    belief, substeps, found = beliefs.of_agent(episode), task.options.substeps, []
    for step, action in enumerate(episode.actions):
        said, start = f"step {step + 1}: {task.action_names[action]}", step * substeps
        if action >= task.num_interactions:
            verdict = "Right!" if episode.rewards[-1] > 0 else f"Wrong: it is {task.label_names[episode.answer]}."
            end = len(episode.times) - 1  # Later than the start where the answer is played out.
            found += [Frame(substep, said, belief[step], "", MOVING) for substep in range(start, end, STRIDE)]
            found.append(Frame(end, said, belief[step], verdict, ENDING))
            continue
        for number in range(FRAMES_PER_STEP):
            duration = MOVING if number else THINKING
            found.append(Frame(start + number * substeps // FRAMES_PER_STEP, said, belief[step], "", duration))
    return found


def scenes(episode: recording.Film, shown: Sequence[Frame]) -> Iterator[np.ndarray]:
    """Yields the scenes of some frames, uint8 [SCENE, SCENE, 3]."""
    apparatus, geoms = episode.declared.apparatus, episode.shapes.geoms
    renderer = rendering.Renderer(apparatus.model, apparatus.moving_geoms, size=2 * SCENE)
    large = np.zeros((1, 2 * SCENE, 2 * SCENE, 3), np.uint8)
    positions, rotations = np.zeros((1, apparatus.model.ngeom, 3)), np.zeros((1, apparatus.model.ngeom, 9))
    for frame in shown:
        film = (episode.positions, episode.rotations, episode.sizes)
        if frame.verdict:
            film = (episode.true_positions, episode.true_rotations, episode.true_sizes)
        positions[0, geoms] = film[0][frame.substep]
        rotations[0, geoms] = film[1][frame.substep].reshape(-1, 9)
        sizes = {geom: values[frame.substep, None] for geom, values in film[2].items()}
        renderer.render(positions, rotations, np.zeros(1, int), large, sizes=sizes)
        yield np.asarray(Image.fromarray(large[0]).resize((SCENE, SCENE), Image.Resampling.LANCZOS))
    renderer.close()


def drawn(episode: recording.Film, frame: Frame, scene: np.ndarray) -> Image.Image:
    """Returns a frame: the scene, the action in words, the belief as named bars, and the verdict."""
    labels = episode.declared.label_names
    names = palette.short(labels, episode.shapes)
    of_things = {palette.of_thing(episode.shapes, thing) for thing in episode.shapes.names}
    colors = [
        np.array(color) / 255 if color in of_things else LABEL_COLOR
        for color in palette.of_labels(labels, episode.shapes)
    ]
    are_many = len(labels) > MANY_LABELS
    width, height = SIZE
    picture = figure.Figure((width / 100 / SCALE, height / 100 / SCALE), dpi=100 * SCALE, facecolor="white")
    canvas = backend_agg.FigureCanvasAgg(picture)
    picture.figimage(scene, 20 * SCALE, 20 * SCALE)
    picture.text(
        20 * SCALE / width,
        1 - 24 * SCALE / height,
        episode.declared.question,
        fontsize=14,
        fontweight="bold",
        va="center",
    )
    left = (40 * SCALE + SCENE) / width
    picture.text(left, 0.82, frame.action, fontsize=13, va="center")
    indent = max(0.17 if are_many else 0.11, 0.015 + 0.0085 * max(map(len, names)))
    axes = picture.add_axes((left + indent, 0.2 if are_many else 0.27, 0.92 - indent - left, 0.5 if are_many else 0.38))
    axes.barh(names, frame.belief, color=colors, height=0.7)
    axes.invert_yaxis()
    axes.set_xlim(0, 1)
    axes.set_title("the agent's belief", fontsize=11, loc="left", color="#555555")
    axes.set_xticks([])
    axes.tick_params(axis="y", length=0, labelsize=9 if are_many else 12)
    axes.spines[:].set_visible(False)
    axes.spines["left"].set_visible(True)
    for row, chance in enumerate(frame.belief):
        axes.text(chance + 0.015, row, f"{chance:.0%}", va="center", fontsize=9 if are_many else 11)
    color = RIGHT if episode.rewards[-1] > 0 else WRONG
    picture.text(left, 0.12, frame.verdict, fontsize=15, fontweight="bold", color=color, va="center")
    canvas.draw()
    return Image.fromarray(np.asarray(canvas.buffer_rgba())[..., :3].copy())


def save(pictures: Sequence[Image.Image], durations: Sequence[int], path: Path) -> None:
    """Writes an animation whose frames share their colours, so that what stays takes no space."""
    samples = pictures[:: max(1, len(pictures) // 6)]
    colors = Image.fromarray(np.concatenate([np.asarray(picture) for picture in samples])).quantize(COLORS)
    table = np.reshape(colors.getpalette(), (-1, 3))
    table[table.min(axis=1) > 245] = 255  # The ground is the page's white, not a mean of what is nearly white.
    colors.putpalette(table.ravel().tolist())
    plain = [picture.quantize(palette=colors, dither=Image.Dither.NONE) for picture in pictures]
    plain[0].save(path, save_all=True, append_images=plain[1:], duration=list(durations), loop=0, optimize=True)


if __name__ == "__main__":
    for name in EPISODES:
        episode = recorded(name)
        shown = frames(episode)
        images = scenes(episode, shown)
        pictures = [drawn(episode, frame, scene) for frame, scene in zip(shown, images, strict=True)]
        save(pictures, [frame.duration for frame in shown], Path(__file__).with_name(f"{name}.gif"))
