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
_TEXT_ABOVE = (0.05, 0.11)  # m above the thing; neighbours alternate.
_MERGE_SECONDS = 300.0  # Hundreds of times the usual duration.
_OFF = ("off", "false", "0")  # Values of RERUN that make rerun drop all data.


def write(
    path: Path,
    groups: Sequence[Callable[[], Sequence[recording.Film]]],
    tell: callbacks.Tell = callbacks.ignore,
) -> Path:
    """Writes recordings into one file, which is complete after each of them.

    Args:
      path: `*.rrd`, in a folder that exists.
      groups: functions that return the episodes of one recording; several episodes are shown side by side.
      tell: called with a line for each recording.

    Returns:
      The path.

    Raises:
      OSError: if the file cannot be written; earlier recordings stay.
      RuntimeError: if rerun's program fails.
      ValueError: if the path is not one of a replay.
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
    """Checks the path of a replay before it is played.

    Raises:
      OSError: if the file cannot be written.
      ValueError: if the name does not end in .rrd, the path is no regular file, the folder does not exist, or rerun is
        switched off.
    """
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


@contextlib.contextmanager
def _strictly() -> Iterator[None]:
    """Makes rerun raise errors instead of dropping data with a warning."""
    before = rr.strict_mode()
    rr.set_strict_mode(True)
    try:
        yield
    finally:
        rr.set_strict_mode(before)


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
    first, players = episodes[0], "-".join(episode.agent for episode in episodes)
    stream = rr.RecordingStream(
        f"physexp-{first.domain}-{first.task}", recording_id=f"{first.seed}-{first.index}-{players}"
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

    def __init__(self, stream: rr.RecordingStream, episode: recording.Film, root: str):
        self._stream, self._episode, self._root = stream, episode, root
        self._task = episode.declared
        # Observations come before each action and at the end; a label takes no time.
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
        """Writes the part that follows from observations and actions, and may be shown before the answer."""
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
        """Writes the drawn things that observations do not place, from the answer on."""
        episode, shapes, first = self._episode, self._episode.shapes, self._episode.num_played + 1
        for k in np.flatnonzero(shapes.are_drawn & ~shapes.are_placed).tolist():
            if first < len(episode.times):
                self._log(f"world/things/{shapes.names[k]}", self._shape(k), episode.times[first])
                self._follow(f"world/things/{shapes.names[k]}", k, (episode.positions, episode.rotations), first)

    def _shape(self, k: int):
        """Returns the rerun archetype of a shape."""
        shapes = self._episode.shapes
        return _archetype(shapes.kinds[k], shapes.sizes[k], (255 * shapes.colors[k]).astype(np.uint8))

    def _follow(self, entity: str, k: int, poses: tuple[np.ndarray, np.ndarray], first: int = 0) -> None:
        """Gives an entity the poses of a shape, from a first frame on."""
        positions, rotations = (values[first:, k] for values in poses)
        quaternions = transform.Rotation.from_matrix(rotations).as_quat()
        columns = rr.Transform3D.columns(translation=positions, quaternion=quaternions)
        self._columns(entity, self._episode.times[first:], columns)

    def _write_hidden(self) -> None:
        """Writes true poses, texts beside things, bars inside rigid bodies, and bands."""
        episode, shapes = self._episode, self._episode.shapes
        poses = episode.true_positions, episode.true_rotations
        for k in np.flatnonzero(shapes.are_moving).tolist():
            self._log(f"world/hidden/{shapes.names[k]}", self._shape(k))
            self._follow(f"world/hidden/{shapes.names[k]}", k, poses)
        self._write_arrows("world/hidden/action", episode.true_positions)
        revealed = self._task.reveal(episode.hidden)
        for number, (thing, text) in enumerate(revealed.marks.items()):
            entity, k = f"world/hidden/mark_{thing}", shapes.names.index(thing)
            place = (0, 0, shapes.sizes[k].max() + _TEXT_ABOVE[number % 2])
            self._log(
                entity, rr.Points3D([place], labels=[text], colors=[palette.MARK], radii=[0.006], show_labels=True)
            )
            self._follow(entity, k, poses)
        for first, second in revealed.joined:
            entity = f"world/hidden/{first}_to_{second}"
            self._log(entity, self._bar(shapes.names.index(first), shapes.names.index(second)))
            self._follow(entity, shapes.names.index(first), poses)
        for first, second in revealed.tied:
            self._write_band(
                f"world/hidden/{first}_to_{second}", [shapes.names.index(first), shapes.names.index(second)]
            )

    def _write_band(self, entity: str, ends: list[int]) -> None:
        """Writes a line between two moving shapes."""
        self._log(entity, rr.LineStrips3D.from_fields(colors=[palette.JOINT], radii=[_BAND_RADIUS]))
        self._columns(
            entity, self._episode.times, rr.LineStrips3D.columns(strips=self._episode.true_positions[:, ends])
        )

    def _bar(self, first: int, second: int) -> rr.Boxes3D:
        """Returns a bar through two shapes, in the frame of the first."""
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
        for name in observations.keys() - self._task.observer.readings.keys():
            for time, image in zip(self._step_times, observations[name], strict=True):
                self._log(f"seen/{name}", rr.Image(image), time)
        moved: dict[str, np.ndarray] = {}
        for reading in readings.shown(self._task.observer.readings):
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
        """Writes curves [T, S] at the times of the steps; `steps` draws them as step functions."""
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
        """Writes the arrow of the action under way at every physics step."""
        episode, interactions = self._episode, self._task.interactions
        steps = np.ceil(episode.times / episode.control_timestep - 1e-6).astype(int) - 1  # Of the action under way.
        steps = np.clip(steps, 0, len(episode.actions) - 1)
        origins, vectors = np.zeros((2, len(steps), 3))
        for frame, step in enumerate(steps):
            if episode.actions[step] < len(interactions):
                origins[frame] = positions[frame, episode.shapes.names.index(interactions[episode.actions[step]].thing)]
                # The first frame shows the controls that are about to be sent.
                vectors[frame] = _arrow(interactions[episode.actions[step]], episode.controls[max(frame, 1)])
        self._log(entity, rr.Arrows3D.from_fields(colors=[palette.ACTION], radii=[0.012]))
        self._columns(entity, episode.times, rr.Arrows3D.columns(origins=origins, vectors=vectors))
        end = self._step_times[-1] + 1e-3  # No arrow after the last step.
        self._columns(entity, [end], rr.Arrows3D.columns(origins=[(0, 0, 0)], vectors=[(0, 0, 0)]))


def _arrow(interaction: declarations.Interaction, sent: np.ndarray) -> np.ndarray:
    """Returns the arrow of an interaction, (3,), reversed if the sent controls oppose the declared ones.

    All arrows have the same length, since no observation tells a varying strength.
    """
    vector = np.array(interaction.vector, float)
    return (
        _ARROW_LENGTH
        * np.sign(sent @ np.asarray(interaction.control, float))
        * vector
        / (np.linalg.norm(vector) or 1.0)
    )


def _archetype(kind: str, size: np.ndarray, color: np.ndarray):
    """Returns the rerun archetype of a kind, half sizes, m, (3,), and a colour, uint8 (4,)."""
    if kind == "box":
        return rr.Boxes3D(half_sizes=[size], colors=[color], fill_mode="solid")
    radius, length = size[0], 2 * size[2]
    if kind == "cylinder":
        return rr.Cylinders3D(lengths=[length], radii=[radius], colors=[color], fill_mode="solid")
    if kind == "capsule":
        below = (0, 0, -length / 2)  # Rerun places a capsule by its lower end.
        return rr.Capsules3D(lengths=[length], radii=[radius], translations=[below], colors=[color], fill_mode="solid")
    return rr.Ellipsoids3D(half_sizes=[size], colors=[color], fill_mode="solid")
