"""Writes recorded episodes for the rerun viewer, with a blueprint.

world/room/...         floor and still things
world/things/NAME      moving things as the observations place them; after the answer, as in the simulation
world/hidden/NAME      moving things as in the simulation, and the hidden properties, in a view of its own
world/.../action       arrow of the applied force or velocity
seen/...               observations: the image, or readings as plots; seen/moved: distances from the start
belief/now             table of the belief and of the policy of the labels
belief/labels          belief of the agent, or its policy restricted to the labels and renormalized
belief/policy          probability of every action; belief/answers: of all labels together
belief/value           return that the agent expects
belief/ideal           belief of the ideal experimenter
did/actions            actions so far; did/outcome: question and outcome

Everything is on one timeline, `time`, in seconds. Episodes side by side have their entities below A, B and so on.
"""

from collections.abc import Callable, Iterable, Sequence
import os
from pathlib import Path
import string
import subprocess
from typing import Any

import numpy as np
import rerun as rr
from scipy.spatial import transform

from physexp.agents import environment_loop, files
from physexp.analysis.data import readings
from physexp.analysis.replay import beliefs, layout, palette, recording, viewing, words
from physexp.analysis.replay.viewing import PROGRAM, last_line
from physexp.analysis.training import callbacks
from physexp.suite.engine import declarations

_ARROW_LENGTH = 0.25  # m
_FLOOR_THICKNESS, _FLOOR_COLOR = 0.01, (190, 190, 185)  # m
_BAND_RADIUS = 0.004  # m
_TEXT_ABOVE = (0.05, 0.11)  # m above the thing; neighbours alternate.
_JUST_BEFORE = 1e-6  # s
_MERGE_SECONDS = 300.0  # Hundreds of times the usual duration.
_OFF = ("off", "false", "0")  # Values of RERUN that make rerun drop all data.


def write(
    path: Path, groups: Sequence[Callable[[], Sequence[recording.Film]]], tell: callbacks.Tell = callbacks.ignore
) -> Path:
    """Writes recordings into one file, which is complete after each of them; returns its path.

    Each group is a function that returns the episodes of one recording; several episodes are shown side by side. `tell`
    is called with a line for each recording.

    Raises:
      OSError, ValueError: as `check_output`; after an OSError, earlier recordings stay.
      RuntimeError: if rerun's program fails.
    """
    check_output(path)
    written = b""
    for number, group in enumerate(groups):
        episodes = list(group())
        newest = _recording(episodes)
        written = _merge(written + newest) if written else newest
        files.write_atomically(path, written)
        tell(f"{number + 1} of {len(groups)}: {words.name(episodes[0])}")
    return path


def check_output(path: Path) -> None:
    """Raises OSError or ValueError if a replay cannot be written to a path."""
    if os.environ.get("RERUN", "on").lower() in _OFF:
        raise ValueError("RERUN in the environment switches rerun off, so no replay can be written; unset it")
    if path.is_dir():
        raise ValueError(f"{path} is a folder; name a file")
    if path.suffix != ".rrd":
        raise ValueError(f"{path} is no name of a replay; name a file that ends in .rrd")
    if not path.parent.is_dir():
        raise ValueError(f"{path.parent} is no folder; make it, or name a file in another")
    if not os.access(path.parent, os.W_OK | os.X_OK):
        raise PermissionError(f"{path.parent} is a folder that you may not write to; name a file in another")


def _merge(recordings: bytes) -> bytes:
    """Returns one file of several concatenated ones; raises RuntimeError if rerun's program fails or hangs."""
    command = [str(PROGRAM), "rrd", "merge"]
    try:
        done = subprocess.run(command, input=recordings, capture_output=True, timeout=_MERGE_SECONDS, check=False)
    except subprocess.TimeoutExpired:
        raise RuntimeError(f"rerun has not merged the recordings within {_MERGE_SECONDS:g} s; try again") from None
    if done.returncode:
        raise RuntimeError(f"rerun cannot merge the recordings: {last_line(done.stderr)}")
    return done.stdout


def _recording(episodes: Sequence[recording.Film]) -> bytes:
    """Returns a recording, made in memory because rerun silently drops data that it cannot write to a file."""
    players = "-".join(episode.agent for episode in episodes)
    stream = _new_stream(episodes[0], players)
    roots = [""] if len(episodes) == 1 else string.ascii_uppercase[: len(episodes)]
    memory, was_strict = stream.memory_recording(), rr.strict_mode()
    rr.set_strict_mode(True)  # Rerun raises errors instead of dropping data with a warning.
    try:
        stream.send_blueprint(layout.blueprint(episodes, roots), make_active=False, make_default=True)
        for episode, root in zip(episodes, roots, strict=True):
            _EpisodeWriter(stream, episode, root).write()
    finally:
        rr.set_strict_mode(was_strict)
    return memory.drain_as_bytes()


def _new_stream(episode: recording.Film, player: str) -> rr.RecordingStream:
    """Returns a stream for an episode."""
    name = f"physexp-{episode.domain}-{episode.task}"
    stream = rr.RecordingStream(name, recording_id=f"{episode.seed}-{episode.index}-{player}")
    stream.send_recording_name(words.name(episode))
    return stream


class Live(environment_loop.Observer):
    """Shows an episode while it is played: the observations at first, and everything after its end."""

    def __init__(self, recorder: recording.EpisodeRecorder, screen: viewing.Viewer):
        """Prepares to show the episodes of a recorder, which must observe them before this observer."""
        self._recorder, self._screen = recorder, screen

    def observe_first(self, environment, timestep):
        episode = self._recorder.episode
        self._stream = _new_stream(episode, "live")
        self._screen.show(self._stream, layout.blueprint([episode], [""]))
        self._show(is_over=False)

    def observe(self, environment, timestep, action):
        self._show(timestep.last())

    def _show(self, is_over: bool) -> None:
        writer = _EpisodeWriter(self._stream, self._recorder.episode, "")
        writer.write() if is_over else writer.write_so_far()
        self._screen.flush(self._stream)


class _EpisodeWriter:
    """Writes one episode below a root entity."""

    def __init__(self, stream: rr.RecordingStream, episode: recording.Film, root: str):
        self._stream, self._episode, self._root = stream, episode, root
        self._task = episode.declared
        # Observations come before each action and at the end; a label takes no time.
        are_interactions = episode.actions < self._task.num_interactions
        self._step_times = np.cumsum([0, *are_interactions]) * episode.control_timestep

    def write(self) -> None:
        """Writes everything."""
        self.write_so_far()
        self._write_truth()
        self._write_belief()
        self._markdown("did/outcome", words.about(self._episode, words.outcome(self._episode)), self._step_times[-1])

    def write_so_far(self) -> None:
        """Writes the part that follows from observations and actions, and may be shown before the answer."""
        self._write_scene()
        self._write_seen()
        self._write_actions()

    def _log(self, entity: str, archetype, time: float | None = None) -> None:
        if time is not None:
            self._stream.set_time(layout.TIMELINE, duration=time)
        self._stream.log(f"{self._root}/{entity}", archetype, static=time is None)

    def _columns(self, entity: str, times, columns) -> None:
        self._stream.send_columns(f"{self._root}/{entity}", [rr.TimeColumn(layout.TIMELINE, duration=times)], columns)

    def _markdown(self, entity: str, text: str, time: float) -> None:
        self._log(entity, rr.TextDocument(text, media_type="text/markdown"), time)

    # The scene.

    def _write_scene(self) -> None:
        self._log("world", rr.ViewCoordinates.RIGHT_HAND_Z_UP)
        half = (*self._task.root_entity.mat.size[:2], _FLOOR_THICKNESS / 2)
        floor = rr.Boxes3D(centers=[(0, 0, -half[2])], half_sizes=[half], colors=[_FLOOR_COLOR], fill_mode="solid")
        self._log("world/room/floor", floor)
        shapes = self._episode.shapes
        are_seen = shapes.are_drawn & shapes.are_placed
        self._write_shapes("room", are_seen & ~shapes.are_moving)
        self._write_shapes("things", are_seen & shapes.are_moving)
        if len(self._episode.actions):
            self._write_arrows("world/things/action", self._episode.positions)

    def _write_shapes(self, folder: str, which: np.ndarray, is_true: bool = False, first: int = 0) -> None:
        """Writes some of the shapes, bool [K]; see `_follow`."""
        for k in np.flatnonzero(which).tolist():
            self._follow(f"world/{folder}/{self._episode.shapes.names[k]}", self._shape(k), k, is_true, first)

    def _shape(self, k: int):
        """Returns the rerun archetype of a shape."""
        shapes = self._episode.shapes
        size, radius, length = shapes.sizes[k], shapes.sizes[k, 0], 2 * shapes.sizes[k, 2]
        look: dict[str, Any] = {"colors": [(255 * shapes.colors[k]).astype(np.uint8)], "fill_mode": "solid"}
        if shapes.kinds[k] == "box":
            return rr.Boxes3D(half_sizes=[size], **look)
        if shapes.kinds[k] == "cylinder":
            return rr.Cylinders3D(lengths=[length], radii=[radius], **look)
        if shapes.kinds[k] == "capsule":  # Rerun places it by its lower end.
            return rr.Capsules3D(lengths=[length], radii=[radius], translations=[(0, 0, -length / 2)], **look)
        return rr.Ellipsoids3D(half_sizes=[size], **look)

    def _follow(self, entity: str, archetype, k: int, is_true: bool = False, first: int = 0) -> None:
        """Writes something that follows the poses of a shape, from a first frame on."""
        episode, times = self._episode, self._episode.times[first:]
        positions = episode.true_positions if is_true else episode.positions
        rotations = episode.true_rotations if is_true else episode.rotations
        self._log(entity, archetype, times[0] if first else None)
        quaternions = transform.Rotation.from_matrix(rotations[first:, k]).as_quat()
        poses = rr.Transform3D.columns(translation=positions[first:, k], quaternion=quaternions)
        self._columns(entity, times, poses)
        sizes, geom = episode.true_sizes if is_true else episode.sizes, episode.shapes.geoms[k]
        if geom in sizes and isinstance(archetype, rr.Ellipsoids3D):  # Texts and bars keep theirs.
            self._columns(entity, times, rr.Ellipsoids3D.columns(half_sizes=sizes[geom][first:]))

    def _write_truth(self) -> None:
        """Writes true poses, texts beside things, bars inside rigid bodies, and bands."""
        episode, shapes, after = self._episode, self._episode.shapes, self._episode.num_played + 1
        if after < len(episode.times):  # The answer is played out, and shows what observations do not place.
            self._write_shapes("things", shapes.are_drawn & ~shapes.are_placed, first=after)
        self._write_shapes("hidden", shapes.are_moving, is_true=True)
        self._write_arrows("world/hidden/action", episode.true_positions)
        revealed, find = self._task.reveal(episode.hidden), shapes.names.index
        for number, (thing, text) in enumerate(revealed.marks.items()):
            place = (0, 0, shapes.sizes[find(thing)].max() + _TEXT_ABOVE[number % 2])
            mark = rr.Points3D([place], labels=[text], colors=[palette.MARK], radii=[0.006], show_labels=True)
            self._follow(f"world/hidden/mark_{thing}", mark, find(thing), is_true=True)
        for first, second in revealed.joined:
            bar = self._bar(find(first), find(second))
            self._follow(f"world/hidden/{first}_to_{second}", bar, find(first), is_true=True)
        for first, second in revealed.tied:
            entity, strips = f"world/hidden/{first}_to_{second}", episode.true_positions[:, [find(first), find(second)]]
            self._log(entity, rr.LineStrips3D.from_fields(colors=[palette.JOINT], radii=[_BAND_RADIUS]))
            self._columns(entity, episode.times, rr.LineStrips3D.columns(strips=strips))

    def _bar(self, first: int, second: int) -> rr.Boxes3D:
        """Returns a bar through two shapes, in the frame of the first."""
        episode, size = self._episode, self._episode.shapes.sizes[first].max()
        offset = episode.true_positions[0, second] - episode.true_positions[0, first]
        between = offset @ episode.true_rotations[0, first]
        distance = np.linalg.norm(between)
        turn, _ = transform.Rotation.align_vectors(between / distance, (0, 0, 1))
        return rr.Boxes3D(
            centers=[between / 2],
            half_sizes=[(0.4 * size, 1.15 * size, 0.4 * distance)],
            quaternions=[turn.as_quat()],
            colors=[palette.JOINT],
            fill_mode="solid",
        )

    def _write_arrows(self, entity: str, positions: np.ndarray) -> None:
        """Writes the arrow of the action under way at every physics step."""
        episode, interactions = self._episode, self._task.interactions
        steps = np.ceil(episode.times / episode.control_timestep - 1e-6).astype(int) - 1  # Of the action under way.
        origins, vectors = np.zeros((2, len(steps), 3))
        taken = [interactions[action] for action in episode.actions if action < len(interactions)]
        for frame, step in enumerate(steps.clip(min=0)):
            if step < len(taken):
                origins[frame] = positions[frame, episode.shapes.names.index(taken[step].thing)]
                # The first frame shows the controls that are about to be sent.
                vectors[frame] = _arrow(taken[step], episode.controls[max(frame, 1)])
        self._log(entity, rr.Arrows3D.from_fields(colors=[palette.ACTION], radii=[0.012]))
        self._columns(entity, episode.times, rr.Arrows3D.columns(origins=origins, vectors=vectors))
        end = self._step_times[-1] + 1e-3  # No arrow after the last step.
        self._columns(entity, [end], rr.Arrows3D.columns(origins=[(0, 0, 0)], vectors=[(0, 0, 0)]))

    # Observations.

    def _write_seen(self) -> None:
        observations, colors_of = self._episode.observations, self._colors
        for name in observations.keys() - self._task.observer.readings.keys():
            for time, image in zip(self._step_times, observations[name], strict=True):
                self._log(f"seen/{name}", rr.Image(image), time)
        moved: dict[str, np.ndarray] = {}
        for reading in readings.shown(self._task.observer.readings):
            if reading.name not in observations:
                continue
            values = reading.values(observations[reading.name])
            for number, component in enumerate(reading.components):
                entity, curves = layout.entity(reading, component), values[..., number]
                self._series(entity, curves, reading.names, colors_of(reading.things))
            if reading.is_position:
                moved.update(zip(reading.things, np.linalg.norm(values - values[0], axis=2).T, strict=True))
        if moved:
            distances = np.stack(list(moved.values()), axis=1)
            self._series("seen/moved", distances, [*map(readings.spoken, moved)], colors_of(moved))

    def _colors(self, things: Iterable[str]) -> list[tuple[int, ...]]:
        return [palette.of_thing(self._episode.shapes, thing) for thing in things]

    def _series(self, entity: str, values: np.ndarray, names: Sequence[str], colors=None) -> None:
        """Writes curves [T, S] that keep their values from step to step."""
        widths = [2.0] * len(names)
        look = rr.SeriesLines(names=list(names), widths=widths, colors=colors, interpolation_mode="StepAfter")
        self._log(entity, look)
        starts = self._step_times[: len(values)]
        # The viewer draws a curve up to its next point, which therefore repeats the value.
        ends = np.maximum(starts[1:] - _JUST_BEFORE, starts[:-1])
        times, values = np.insert(starts, np.arange(1, len(starts)), ends), values.repeat(2, axis=0)[:-1]
        self._columns(entity, times, rr.Scalars.columns(scalars=values))

    # Beliefs and actions.

    def _write_belief(self) -> None:
        episode, shapes, labels = self._episode, self._episode.shapes, self._task.label_names
        names, colors = palette.short(labels, shapes), palette.of_labels(labels, shapes)
        ideal = beliefs.of_ideal(episode)
        if ideal is not None:
            self._series("belief/ideal", ideal, names, colors)
        if len(episode.policies):
            belief, answers = beliefs.of_agent(episode), episode.policies[:, self._task.num_interactions :]
            for step in range(len(belief)):
                table = words.bars(names, belief[step], answers[step], None if ideal is None else ideal[step])
                self._markdown("belief/now", table, self._step_times[step])
            self._series("belief/labels", belief, names, colors)
            self._series("belief/policy", episode.policies, self._task.action_names)
            self._series("belief/answers", answers.sum(axis=1, keepdims=True), ["answers now"], [palette.ANSWERS])
            self._series("belief/value", episode.values[:, None], ["value"], [palette.VALUE])

    def _write_actions(self) -> None:
        names = self._task.action_names
        lines = [f"- step {step}: {names[action]}" for step, action in enumerate(self._episode.actions)]
        for step in range(len(lines)):
            self._markdown("did/actions", "\n".join(lines[: step + 1]), self._step_times[step])
        self._markdown("did/outcome", words.about(self._episode, "Not answered yet."), 0.0)


def _arrow(interaction: declarations.Interaction, sent: np.ndarray) -> np.ndarray:
    """Returns the arrow of an interaction, (3,), reversed if the sent controls oppose the declared ones.

    All arrows have the same length, since no observation tells a varying strength.
    """
    vector, declared = np.array(interaction.vector, float), np.asarray(interaction.control, float)
    return _ARROW_LENGTH * np.sign(sent @ declared) * vector / (np.linalg.norm(vector) or 1.0)
