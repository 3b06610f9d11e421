"""Writing recorded episodes as recordings for the rerun viewer, with a blueprint that opens ready to read.

world/things/NAME      what moves, with its true pose at every physics step; world/room the floor
world/action           the force or velocity applied, as an arrow
world/hidden/...       what cannot be seen: glue, masses; in a view of its own
seen/...               what the agent observed: the image, or features as plots; seen/moved the distances from the start
belief/now             the belief, and the policy of the labels, as a table with bars
belief/labels          the belief: the policy restricted to the labels and renormalized
belief/policy          the policy: the probability of every action; belief/answers: of all labels together
belief/value           the return that the agent expects
belief/ideal           what an ideal experimenter would believe, where that is known
did/...                actions as a log, the question and the outcome as text

Everything is on one timeline, `time`, in seconds. Episodes side by side have their entities below A, B and so on.
"""

from collections.abc import Callable, Sequence
import os
from pathlib import Path
import subprocess

import numpy as np
import rerun as rr
from scipy.spatial import transform

from physexp import suite
from physexp.agents import files
from physexp.analysis import callbacks
from physexp.analysis.replay import beliefs, layout, palette, recording, words
from physexp.analysis.replay.layout import TIMELINE
from physexp.analysis.replay.viewing import PROGRAM, last_line
from physexp.suite.parts import block

_ARROW_LENGTH = 0.25  # m
_MERGE_SECONDS = 300.0  # A few hundred times what it takes.


def write(
    path: Path,
    groups: Sequence[Callable[[], Sequence[recording.Episode]]],
    tell: callbacks.Tell = callbacks.ignore,
) -> Path:
    """Writes recordings into one file; after each of them the file is whole.

    Args:
      path: of the file, usually `*.rrd`.
      groups: called one after the other, each for the episodes of one recording: one, or several side by side.
      tell: called with a line for each recording.

    Returns:
      The path.

    Raises:
      OSError: if the file cannot be written; what had been written stays.
      RuntimeError: if rerun's own program fails.
      ValueError: if there is something else than a regular file at that path.
    """
    check_output(path)
    rr.set_strict_mode(True)  # Otherwise errors are warnings, and data is dropped.
    written = b""
    for number, group in enumerate(groups):
        episodes = list(group())
        newest = _recording(episodes)
        written = _merge(written + newest) if written else newest
        files.write_atomically(path, written)
        tell(f"{number + 1} of {len(groups)}: {words.name(episodes[0])}")
    return path


def check_output(path: Path) -> None:
    """Makes the folder of a file that is going to be written.

    Raises:
      OSError: if the file cannot be written.
      ValueError: if there is something else than a regular file.
    """
    if path.is_symlink():
        raise ValueError(f"{path} is a symbolic link; name a file")
    if path.is_dir():
        raise ValueError(f"{path} is a folder; name a file")
    if path.exists() and not path.is_file():
        raise ValueError(f"{path} is a pipe or a device; name a file")
    path.parent.mkdir(parents=True, exist_ok=True)
    if not os.access(path.parent, os.W_OK | os.X_OK):
        raise PermissionError(f"{path.parent} is a folder that you may not write to; name a file in another")


def _merge(recordings: bytes) -> bytes:
    """One file of what is several, one after the other.

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
    """A recording in memory, because rerun drops what it cannot write to a file without a word."""
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
        self._task = suite.load_task(episode.domain, episode.task, episode.task_kwargs)
        # Of what was seen: before each action, and at the end. A label takes no time.
        steps = np.minimum(np.arange(len(episode.actions) + 1), self._num_interactions)
        self._step_times = steps * self._task.control_timestep

    @property
    def _num_interactions(self) -> int:
        return int((self._episode.actions < self._task.num_interactions).sum())

    def write(self, already: int = 0) -> None:
        """Everything; the log has so many actions already."""
        self.write_so_far(already)
        self._write_hidden()
        self._write_belief()
        self._write_outcome()

    def write_so_far(self, already: int = 0) -> None:
        """What may be known before the question is answered; the log has so many actions already."""
        self._write_scene()
        self._write_seen()
        self._write_actions(already)

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
        things = self._episode.things
        self._log("world", rr.ViewCoordinates.RIGHT_HAND_Z_UP)
        self._log(
            "world/room",
            rr.Boxes3D(
                centers=[(0, 0, -0.005)], half_sizes=[(0.7, 0.6, 0.005)], colors=[(190, 190, 185)], fill_mode="solid"
            ),
        )
        for k, name in enumerate(things.names):
            color = (255 * things.colors[k]).astype(np.uint8)
            shape = rr.Boxes3D if things.kinds[k] == "box" else rr.Ellipsoids3D
            self._log(f"world/things/{name}", shape(half_sizes=[things.sizes[k]], colors=[color], fill_mode="solid"))
            self._follow(f"world/things/{name}", k)

    def _follow(self, entity: str, k: int) -> None:
        """Gives an entity the pose of a thing."""
        episode = self._episode
        quaternions = transform.Rotation.from_matrix(episode.rotations[:, k]).as_quat()
        columns = rr.Transform3D.columns(translation=episode.positions[:, k], quaternion=quaternions)
        self._columns(entity, episode.times, columns)

    def _write_hidden(self) -> None:
        """Texts beside things, and bars between things that are joined, which move with the first of them."""
        episode, names = self._episode, self._episode.things.names
        revealed = self._task.reveal(episode.hidden)
        for number, (thing, text) in enumerate(revealed.marks.items()):
            entity = f"world/hidden/mark_{thing}"
            place = (0, 0, 0.1 + 0.06 * (number % 2))  # Neighbours' texts at two heights.
            self._log(entity, rr.Points3D([place], labels=[text], radii=[0.006], show_labels=True))
            self._follow(entity, names.index(thing))
        for first, second in revealed.joined:
            entity, k, other = f"world/hidden/{first}_to_{second}", names.index(first), names.index(second)
            middle = (episode.positions[0, other] - episode.positions[0, k]) @ episode.rotations[0, k] / 2
            half = (0.4 * block.HALF_SIZE, 1.15 * block.HALF_SIZE, 0.8 * block.HALF_SIZE)
            self._log(entity, rr.Boxes3D(centers=[middle], half_sizes=[half], colors=[palette.GLUE], fill_mode="solid"))
            self._follow(entity, k)

    # What was seen.

    def _write_seen(self) -> None:
        moved: dict[str, np.ndarray] = {}
        sensed = palette.sensed_things(self._task)
        for name, values in self._episode.observations.items():
            if values.dtype == np.uint8:
                for time, image in zip(self._step_times, values, strict=True):
                    self._log(f"seen/{name}", rr.Image(image), time)
            elif values[0].size == len(sensed[name]):
                self._curves(f"seen/{name}", values, sensed[name])
            else:
                places = values.reshape(len(values), len(sensed[name]), -1)
                for axis, letter in enumerate("xyz"):
                    self._curves(f"seen/{name}/{letter}", places[..., axis], sensed[name])
                moved.update(zip(sensed[name], np.linalg.norm(places - places[0], axis=2).T, strict=True))
        if moved:
            self._curves("seen/moved", np.stack(list(moved.values()), axis=1), list(moved))

    def _curves(self, entity: str, values: np.ndarray, things: Sequence[str]) -> None:
        """Curves [T, S] of what is known of S things, at the times of the steps."""
        colors = [palette.of_thing(self._episode.things, thing) for thing in things]
        self._series(entity, values, [palette.spoken(thing) for thing in things], colors)

    def _series(self, entity: str, values: np.ndarray, names: Sequence[str], colors=None, steps: bool = False) -> None:
        """Curves [T, S] at the times of the steps; with `steps` each value holds until the next."""
        lines = rr.SeriesLines(
            names=list(names),
            colors=colors,
            widths=[2.0] * len(names),
            interpolation_mode="StepAfter" if steps else None,
        )
        self._log(entity, lines)
        self._columns(entity, self._step_times[: len(values)], rr.Scalars.columns(scalars=values))

    # What was believed.

    def _write_belief(self) -> None:
        episode, things, labels = self._episode, self._episode.things, self._task.label_names
        names, colors = [palette.short(label, things) for label in labels], palette.of_labels(labels, things)
        ideal = beliefs.of_ideal(episode)
        if ideal is not None:
            self._series("belief/ideal", ideal, names, colors, steps=True)
        if len(episode.policies):
            first_label = self._task.num_interactions
            belief, answers = beliefs.of_policy(episode.policies, first_label), episode.policies[:, first_label:]
            for step in range(len(belief)):
                table = words.bars(names, belief[step], answers[step], None if ideal is None else ideal[step])
                self._markdown("belief/now", table, self._step_times[step])
            self._series("belief/labels", belief, names, colors, steps=True)
            self._series("belief/policy", episode.policies, self._task.action_names, steps=True)
            self._series(
                "belief/answers", answers.sum(axis=1, keepdims=True), ["answers now"], [palette.ANSWERS], steps=True
            )
            self._series("belief/value", episode.values[:, None], ["value"], [palette.VALUE], steps=True)

    # What was done.

    def _write_actions(self, already: int) -> None:
        names = self._task.action_names
        for step, action in list(enumerate(self._episode.actions))[already:]:
            self._log("did/actions", rr.TextLog(f"step {step}: {names[action]}"), self._step_times[step])
        if not already:
            self._markdown("did/outcome", words.about(self._episode, self._task.question, "Not answered yet."), 0.0)
        if len(self._episode.actions):
            self._write_arrows()

    def _write_outcome(self) -> None:
        text = words.about(self._episode, self._task.question, words.outcome(self._episode))
        self._markdown("did/outcome", text, self._step_times[-1])

    def _markdown(self, entity: str, text: str, time: float) -> None:
        self._log(entity, rr.TextDocument(text, media_type="text/markdown"), time)

    def _write_arrows(self) -> None:
        """At every physics step, where the action acts and in which direction; of no length where there is none."""
        episode, interactions = self._episode, self._task.interactions
        steps = np.ceil(episode.times / self._task.control_timestep - 1e-6).astype(int) - 1  # Of the action under way.
        steps = np.clip(steps, 0, len(episode.actions) - 1)
        origins, vectors = np.zeros((2, len(steps), 3))
        for frame, step in enumerate(steps):
            if episode.actions[step] < len(interactions):
                interaction = interactions[episode.actions[step]]
                origins[frame] = episode.positions[frame, episode.things.names.index(interaction.thing)]
                vectors[frame] = _ARROW_LENGTH * np.array(interaction.vector) / np.linalg.norm(interaction.vector)
        self._log("world/action", rr.Arrows3D.from_fields(colors=[palette.ACTION], radii=[0.012]))
        self._columns("world/action", episode.times, rr.Arrows3D.columns(origins=origins, vectors=vectors))
        end = self._step_times[-1] + 1e-3  # After the last step, when nothing is done any more.
        self._columns("world/action", [end], rr.Arrows3D.columns(origins=[(0, 0, 0)], vectors=[(0, 0, 0)]))
