"""Writes recorded episodes for the rerun viewer, with a blueprint.

world/room/...         the floor and all that stands still
world/things/NAME      what moves, where the observations place it; after the answer, where it is in the simulation
world/hidden/NAME      all that moves, where it is in the simulation, and what the task reveals, in a view of its own
world/.../action       the force or velocity applied, as an arrow
seen/...               what the agent observed: the image, or readings as plots; seen/moved the distances from the start
belief/now             the belief, and the policy of the labels, as a table with bars
belief/labels          the belief: the agent's own, or its policy restricted to the labels and renormalized
belief/policy          the policy: the probability of every action; belief/answers: of all labels together
belief/value           the return that the agent expects
belief/ideal           what an ideal experimenter would believe, where that is known
did/actions            the actions so far; did/outcome: the question and the outcome, as text

Everything is on one timeline, `time`, in seconds. Episodes side by side have their entities below A, B and so on.
"""

from collections.abc import Callable, Iterator, Sequence
import contextlib
import os
from pathlib import Path
import subprocess

import numpy as np
import rerun as rr
from scipy.spatial import transform

from physexp.agents import files
from physexp.analysis.data import readings
from physexp.analysis.replay import beliefs, layout, palette, recording, words
from physexp.analysis.replay.layout import TIMELINE
from physexp.analysis.replay.viewing import PROGRAM, last_line
from physexp.analysis.training import callbacks
from physexp.suite.engine import declarations

_ARROW_LENGTH = 0.25  # m
_FLOOR_THICKNESS, _FLOOR_COLOR = 0.01, (190, 190, 185)  # m
_BAND_RADIUS = 0.004  # m
_TEXT_ABOVE = (0.05, 0.11)  # m, of a mark above its thing: neighbours' texts at two heights.
_MERGE_SECONDS = 300.0  # A few hundred times what it takes.
_OFF = ("off", "false", "0")  # Values of RERUN with which rerun drops all data.


def write(
    path: Path,
    groups: Sequence[Callable[[], Sequence[recording.Episode]]],
    tell: callbacks.Tell = callbacks.ignore,
) -> Path:
    """Writes recordings into one file; after each of them the file is whole.

    Args:
      path: of the file, `*.rrd`, in a folder that exists.
      groups: called one after the other, each for the episodes of one recording: one, or several side by side.
      tell: called with a line for each recording.

    Returns:
      The path.

    Raises:
      OSError: if the file cannot be written; what had been written stays.
      RuntimeError: if rerun's own program fails.
      ValueError: if the path is none of a replay.
    """
    check_output(path)
    written = b""
    for number, group in enumerate(groups):
        episodes = list(group())
        with _strictly():
            newest = _recording(episodes)
        written = _merge(written + newest) if written else newest
        files.write_atomically(path, written)
        tell(f"{number + 1} of {len(groups)}: {words.name(episodes[0])}")
    return path


def check_output(path: Path) -> None:
    """Checks where a file is going to be written.

    Raises:
      OSError: if the file cannot be written.
      ValueError: if its name does not end in .rrd, something else than a regular file is there, its folder is none, or
        rerun is switched off.
    """
    if os.environ.get("RERUN", "on").lower() in _OFF:
        raise ValueError("RERUN in the environment switches rerun off, so no replay can be written; unset it")
    if path.is_symlink():
        raise ValueError(f"{path} is a symbolic link; name a file")
    if path.is_dir():
        raise ValueError(f"{path} is a folder; name a file")
    if path.exists() and not path.is_file():
        raise ValueError(f"{path} is a pipe or a device; name a file")
    if path.suffix != ".rrd":
        raise ValueError(f"{path} is no name of a replay; name a file that ends in .rrd")
    if not path.parent.is_dir():
        raise ValueError(f"{path.parent} is no folder; make it, or name a file in another")
    if not os.access(path.parent, os.W_OK | os.X_OK):
        raise PermissionError(f"{path.parent} is a folder that you may not write to; name a file in another")


@contextlib.contextmanager
def _strictly() -> Iterator[None]:
    """Makes rerun raise errors, which are otherwise warnings beside dropped data."""
    before = rr.strict_mode()
    rr.set_strict_mode(True)
    try:
        yield
    finally:
        rr.set_strict_mode(before)


def _merge(recordings: bytes) -> bytes:
    """Returns one file of several, one after the other.

    Raises:
      RuntimeError: if rerun's program fails or does not answer.
    """
    command = [str(PROGRAM), "rrd", "merge"]
    try:
        done = subprocess.run(command, input=recordings, capture_output=True, timeout=_MERGE_SECONDS, check=False)
    except subprocess.TimeoutExpired:
        raise RuntimeError(f"rerun has not merged the recordings within {_MERGE_SECONDS:g} s; try again") from None
    if done.returncode:
        raise RuntimeError(f"rerun cannot merge the recordings: {last_line(done.stderr)}")
    return done.stdout


def _recording(episodes: Sequence[recording.Episode]) -> bytes:
    """Returns a recording, made in memory because rerun drops what it cannot write to a file without a word."""
    first, players = episodes[0], "-".join(episode.agent for episode in episodes)
    stream = rr.RecordingStream(
        f"physexp-{first.domain}-{first.task}", recording_id=f"{first.seed}-{first.episode}-{players}"
    )
    roots = [""] if len(episodes) == 1 else [f"{chr(ord('A') + index)}" for index in range(len(episodes))]
    memory = stream.memory_recording()
    stream.send_blueprint(layout.blueprint(episodes, roots), make_active=False, make_default=True)
    stream.send_recording_name(words.name(first))
    for episode, root in zip(episodes, roots, strict=True):
        EpisodeWriter(stream, episode, root).write()
    return memory.drain_as_bytes()


class EpisodeWriter:
    """Writes one episode below a root entity."""

    def __init__(self, stream: rr.RecordingStream, episode: recording.Episode, root: str):
        self._stream, self._episode, self._root = stream, episode, root
        self._task = episode.declared
        # Observations come before each action, and at the end. A label takes no time.
        steps = np.minimum(np.arange(len(episode.actions) + 1), self._num_interactions)
        self._step_times = steps * episode.control_timestep

    @property
    def _num_interactions(self) -> int:
        return int((self._episode.actions < self._task.num_interactions).sum())

    def write(self) -> None:
        """Writes everything."""
        self.write_so_far()
        self._write_played_out()
        self._write_hidden()
        self._write_belief()
        self._write_outcome()

    def write_so_far(self) -> None:
        """Writes all that may be known before the answer: nothing but what follows from observations and actions."""
        self._write_scene()
        self._write_seen()
        self._write_actions()

    def _path(self, entity: str) -> str:
        return f"{self._root}/{entity}"

    def _log(self, entity: str, archetype, time: float | None = None) -> None:
        if time is not None:
            self._stream.set_time(TIMELINE, duration=time)
        self._stream.log(self._path(entity), archetype, static=time is None)

    def _columns(self, entity: str, times, columns) -> None:
        self._stream.send_columns(self._path(entity), [rr.TimeColumn(TIMELINE, duration=times)], columns)

    # The scene.

    def _write_scene(self) -> None:
        self._log("world", rr.ViewCoordinates.RIGHT_HAND_Z_UP)
        half = (*self._task.root_entity.mat.size[:2], _FLOOR_THICKNESS / 2)
        floor = rr.Boxes3D(centers=[(0, 0, -half[2])], half_sizes=[half], colors=[_FLOOR_COLOR], fill_mode="solid")
        self._log("world/room/floor", floor)
        shapes, poses = self._episode.shapes, (self._episode.positions, self._episode.rotations)
        for k in np.flatnonzero(shapes.are_drawn & shapes.are_placed).tolist():
            entity = f"world/{'things' if shapes.are_moving[k] else 'room'}/{shapes.names[k]}"
            self._log(entity, self._shape(k))
            self._follow(entity, k, poses)
        if len(self._episode.actions):
            self._write_arrows("world/things/action", self._episode.positions)

    def _write_played_out(self) -> None:
        """Writes the things that images show and observations do not place: they appear after the answer."""
        episode, shapes, first = self._episode, self._episode.shapes, self._episode.num_played + 1
        for k in np.flatnonzero(shapes.are_drawn & ~shapes.are_placed).tolist():
            if first < len(episode.times):
                self._log(f"world/things/{shapes.names[k]}", self._shape(k), episode.times[first])
                self._follow(f"world/things/{shapes.names[k]}", k, (episode.positions, episode.rotations), first)

    def _shape(self, k: int):
        """Returns rerun's form of a shape."""
        shapes = self._episode.shapes
        return _archetype(shapes.kinds[k], shapes.sizes[k], (255 * shapes.colors[k]).astype(np.uint8))

    def _follow(self, entity: str, k: int, poses: tuple[np.ndarray, np.ndarray], first: int = 0) -> None:
        """Gives an entity the pose of a shape, in all frames from a first one on."""
        positions, rotations = (values[first:, k] for values in poses)
        quaternions = transform.Rotation.from_matrix(rotations).as_quat()
        columns = rr.Transform3D.columns(translation=positions, quaternion=quaternions)
        self._columns(entity, self._episode.times[first:], columns)

    def _write_hidden(self) -> None:
        """Writes where everything is, texts beside things, bars between things that are one, and bands."""
        episode, shapes = self._episode, self._episode.shapes
        poses = episode.true_positions, episode.true_rotations
        for k in np.flatnonzero(shapes.are_moving).tolist():
            self._log(f"world/hidden/{shapes.names[k]}", self._shape(k))
            self._follow(f"world/hidden/{shapes.names[k]}", k, poses)
        self._write_arrows("world/hidden/action", episode.true_positions)
        revealed = self._task.reveal(episode.hidden)
        for number, (thing, text) in enumerate(revealed.marks.items()):
            entity, k = f"world/hidden/mark_{thing}", shapes.index(thing)
            place = (0, 0, shapes.sizes[k].max() + _TEXT_ABOVE[number % 2])
            self._log(
                entity, rr.Points3D([place], labels=[text], colors=[palette.MARK], radii=[0.006], show_labels=True)
            )
            self._follow(entity, k, poses)
        for first, second in revealed.joined:
            entity = f"world/hidden/{first}_to_{second}"
            self._log(entity, self._bar(shapes.index(first), shapes.index(second)))
            self._follow(entity, shapes.index(first), poses)
        for first, second in revealed.tied:
            self._write_band(f"world/hidden/{first}_to_{second}", [shapes.index(first), shapes.index(second)])

    def _write_band(self, entity: str, ends: list[int]) -> None:
        """Writes a line between two shapes, wherever they are."""
        self._log(entity, rr.LineStrips3D.from_fields(colors=[palette.JOINT], radii=[_BAND_RADIUS]))
        self._columns(
            entity, self._episode.times, rr.LineStrips3D.columns(strips=self._episode.true_positions[:, ends])
        )

    def _bar(self, first: int, second: int) -> rr.Boxes3D:
        """Returns a bar from one shape to another, which stands out of both, as the first one sees it."""
        episode = self._episode
        offset = episode.true_positions[0, second] - episode.true_positions[0, first]
        between = offset @ episode.true_rotations[0, first]
        size, distance = episode.shapes.sizes[first].max(), np.linalg.norm(between)
        turn, _ = transform.Rotation.align_vectors(between / distance, (0, 0, 1))
        half = (0.4 * size, 1.15 * size, 0.4 * distance)
        return rr.Boxes3D(
            centers=[between / 2],
            half_sizes=[half],
            quaternions=[turn.as_quat()],
            colors=[palette.JOINT],
            fill_mode="solid",
        )

    # Observations.

    def _write_seen(self) -> None:
        observations = self._episode.observations
        for name in observations.keys() - self._task.all_readings.keys():
            for time, image in zip(self._step_times, observations[name], strict=True):
                self._log(f"seen/{name}", rr.Image(image), time)
        moved: dict[str, np.ndarray] = {}
        for reading in readings.shown(self._task.all_readings):
            if reading.name not in observations:
                continue
            values = reading.values(observations[reading.name])
            colors = [palette.of_thing(self._episode.shapes, thing) for thing in reading.things]
            for number, component in enumerate(reading.components):
                entity = layout.entity(reading, component)
                self._series(entity, values[..., number], reading.names, colors, steps=not reading.unit)
            if reading.is_position:
                moved.update(zip(reading.things, np.linalg.norm(values - values[0], axis=2).T, strict=True))
        if moved:
            colors = [palette.of_thing(self._episode.shapes, thing) for thing in moved]
            distances = np.stack(list(moved.values()), axis=1)
            self._series("seen/moved", distances, [readings.spoken(thing) for thing in moved], colors)

    def _series(self, entity: str, values: np.ndarray, names: Sequence[str], colors=None, steps: bool = False) -> None:
        """Writes curves [T, S] at the times of the steps; with `steps` each value holds until the next."""
        lines = rr.SeriesLines(
            names=list(names),
            colors=colors,
            widths=[2.0] * len(names),
            interpolation_mode="StepAfter" if steps else None,
        )
        self._log(entity, lines)
        self._columns(entity, self._step_times[: len(values)], rr.Scalars.columns(scalars=values))

    # Beliefs.

    def _write_belief(self) -> None:
        episode, shapes, labels = self._episode, self._episode.shapes, self._task.label_names
        names, colors = palette.short(labels, shapes), palette.of_labels(labels, shapes)
        ideal = beliefs.of_ideal(episode)
        if ideal is not None:
            self._series("belief/ideal", ideal, names, colors, steps=True)
        if len(episode.policies):
            belief, answers = beliefs.of_agent(episode), episode.policies[:, self._task.num_interactions :]
            for step in range(len(belief)):
                table = words.bars(names, belief[step], answers[step], None if ideal is None else ideal[step])
                self._markdown("belief/now", table, self._step_times[step])
            self._series("belief/labels", belief, names, colors, steps=True)
            self._series("belief/policy", episode.policies, self._task.action_names, steps=True)
            self._series(
                "belief/answers", answers.sum(axis=1, keepdims=True), ["answers now"], [palette.ANSWERS], steps=True
            )
            self._series("belief/value", episode.values[:, None], ["value"], [palette.VALUE], steps=True)

    # Actions.

    def _write_actions(self) -> None:
        names = self._task.action_names
        lines = [f"- step {step}: {names[action]}" for step, action in enumerate(self._episode.actions)]
        for step in range(len(lines)):
            self._markdown("did/actions", "\n".join(lines[: step + 1]), self._step_times[step])
        self._markdown("did/outcome", words.about(self._episode, "Not answered yet."), 0.0)

    def _write_outcome(self) -> None:
        text = words.about(self._episode, words.outcome(self._episode))
        self._markdown("did/outcome", text, self._step_times[-1])

    def _markdown(self, entity: str, text: str, time: float) -> None:
        self._log(entity, rr.TextDocument(text, media_type="text/markdown"), time)

    def _write_arrows(self, entity: str, positions: np.ndarray) -> None:
        """Writes, at every physics step, where the action acts and in which direction; no arrow where there is none."""
        episode, interactions = self._episode, self._task.interactions
        steps = np.ceil(episode.times / episode.control_timestep - 1e-6).astype(int) - 1  # Of the action under way.
        steps = np.clip(steps, 0, len(episode.actions) - 1)
        origins, vectors = np.zeros((2, len(steps), 3))
        for frame, step in enumerate(steps):
            if episode.actions[step] < len(interactions):
                origins[frame] = positions[frame, episode.shapes.index(interactions[episode.actions[step]].thing)]
                # Nothing has been sent yet in the first frame; it shows what is about to be.
                vectors[frame] = _arrow(interactions[episode.actions[step]], episode.controls[max(frame, 1)])
        self._log(entity, rr.Arrows3D.from_fields(colors=[palette.ACTION], radii=[0.012]))
        self._columns(entity, episode.times, rr.Arrows3D.columns(origins=origins, vectors=vectors))
        end = self._step_times[-1] + 1e-3  # After the last step, when nothing is done any more.
        self._columns(entity, [end], rr.Arrows3D.columns(origins=[(0, 0, 0)], vectors=[(0, 0, 0)]))


def _arrow(interaction: declarations.Interaction, sent: np.ndarray) -> np.ndarray:
    """Returns the arrow of an interaction that sent this, (3,): backwards, where that is against what it declares.

    All arrows have the same length, since no observation tells how strong an action is where strength varies.
    """
    vector = np.array(interaction.vector, float)
    return (
        _ARROW_LENGTH
        * np.sign(sent @ np.asarray(interaction.control, float))
        * vector
        / (np.linalg.norm(vector) or 1.0)
    )


def _archetype(kind: str, size: np.ndarray, color: np.ndarray):
    """Returns rerun's form of a shape: its kind, half its sizes, m, (3,), and its colour, uint8 (4,)."""
    if kind == "box":
        return rr.Boxes3D(half_sizes=[size], colors=[color], fill_mode="solid")
    radius, length = size[0], 2 * size[2]
    if kind == "cylinder":
        return rr.Cylinders3D(lengths=[length], radii=[radius], colors=[color], fill_mode="solid")
    if kind == "capsule":
        below = (0, 0, -length / 2)  # From where rerun's capsules begin.
        return rr.Capsules3D(lengths=[length], radii=[radius], translations=[below], colors=[color], fill_mode="solid")
    return rr.Ellipsoids3D(half_sizes=[size], colors=[color], fill_mode="solid")
