"""Writing recorded episodes as recordings for the rerun viewer, with a blueprint that opens ready to read.

world/things/NAME      what moves, with its true pose at every physics step; world/room the floor
world/action           the force or velocity applied, as an arrow
world/hidden/...       what cannot be seen: glue, masses; switched off until it is wanted
seen/...               what the agent observed: the image, or features as plots
belief/...             probabilities of all actions, and of the labels if one had to be given now, as bars; those of the
                       labels and the value as curves; for Which is Heavier the ideal experimenter's posterior
did/...                actions as a log, the outcome as text

Everything is on one timeline, `time`, in seconds. Episodes side by side have their entities below their agents' names.
"""

from collections.abc import Callable, Sequence
import os
from pathlib import Path
import subprocess
import sys
import tempfile
from typing import Any

import numpy as np
import rerun as rr
import rerun.blueprint as rrb
import rerun_cli
from scipy.spatial import transform

from physexp import suite
from physexp.agents import checkpointing, environment_loop
from physexp.analysis.ideal import which_is_heavier as ideal
from physexp.analysis.replay import recording
from physexp.suite import block, tower, which_is_heavier

PROGRAM = Path(rerun_cli.__file__).with_name("rerun")
"""Rerun's own program, with its viewer and its tools for files."""

_ARROW_LENGTH = 0.25  # m
_ARROW_COLOR = (220, 40, 120)
_GLUE_COLOR = (255, 255, 255)
_TIMELINE = "time"


def write(path: Path, groups: Sequence[Callable[[], Sequence[recording.Episode]]],
          report: Callable[[str], None] = lambda line: None) -> Path:  # fmt: skip
    """Writes recordings into one file; after each of them the file is whole.

    Args:
      path: of the file, usually `*.rrd`.
      groups: called one after the other, each for the episodes of one recording: one, or several side by side.
      report: called with a line for each recording.

    Returns:
      The path.

    Raises:
      OSError: if the file cannot be written; what had been written stays.
      ValueError: if the path is that of a folder.
    """
    if path.is_dir():
        raise ValueError(f"{path} is a folder; name a file")
    rr.set_strict_mode(True)  # Otherwise errors are warnings, and data is dropped.
    path.parent.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(dir=path.parent, prefix=".replay-") as folder:
        parts: list[Path] = []
        for number, group in enumerate(groups):
            parts.append(Path(folder) / f"{number:06d}.rrd")
            episodes = list(group())
            newest = _recording(episodes)
            parts[-1].write_bytes(newest)
            merged = _run("rrd", "merge", *map(str, parts)) if len(parts) > 1 else newest
            checkpointing.write_atomically(path, merged)
            report(f"{number + 1} of {len(groups)}: {_name(episodes[0])}")
    return path


class Live(environment_loop.Observer):
    """Shows an episode in the viewer while it is played: what may be known, and all of it once it is over."""

    def __init__(self, recorder: recording.EpisodeRecorder, open_stream: Callable[[rr.RecordingStream, Any], None]):
        """Prepares to show.

        Args:
          recorder: observes the same episodes, before this observer does.
          open_stream: called with the stream of each episode and its blueprint, to connect it to a viewer or a file.
        """
        self._recorder, self._open_stream = recorder, open_stream

    def observe_first(self, environment, timestep):
        episode = self._recorder.episode
        self._stream = rr.RecordingStream(f"physexp-{episode.domain}-{episode.task}",
                                          recording_id=f"{episode.seed}-{episode.number}-live")  # fmt: skip
        self._open_stream(self._stream, blueprint([episode], [""]))
        self._stream.send_recording_name(_name(episode))
        self._show(is_over=False)

    def observe(self, environment, timestep, action):
        self._show(timestep.last())

    def get_metrics(self):
        """Nothing: this only shows."""
        return {}

    def _show(self, is_over: bool) -> None:
        writer = _Writer(self._stream, self._recorder.episode, "")
        writer.write() if is_over else writer.write_so_far()
        self._stream.flush()


def open_viewer(stream: rr.RecordingStream, layout: rrb.Blueprint) -> None:
    """Connects a stream to the viewer, which is started where none is open.

    Raises:
      ValueError: where there is no display.
    """
    if sys.platform == "linux" and not (os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY")):
        raise ValueError("there is no display to open the viewer on (DISPLAY is not set); leave out --view")
    stream.spawn(default_blueprint=layout)


def _run(*arguments: str) -> bytes:
    """Runs rerun's own program; returns what it writes."""
    return subprocess.run([str(PROGRAM), *arguments], check=True, capture_output=True).stdout


def _name(episode: recording.Episode) -> str:
    return f"{episode.domain}/{episode.task}, seed {episode.seed}, episode {episode.number}"


def _recording(episodes: Sequence[recording.Episode]) -> bytes:
    """A recording in memory, because rerun drops what it cannot write to a file without a word."""
    first, players = episodes[0], "-".join(episode.agent for episode in episodes)
    stream = rr.RecordingStream(f"physexp-{first.domain}-{first.task}",
                                recording_id=f"{first.seed}-{first.number}-{players}")  # fmt: skip
    roots = [""] if len(episodes) == 1 else [f"{chr(ord('A') + index)}" for index in range(len(episodes))]
    memory = stream.memory_recording()
    stream.send_blueprint(blueprint(episodes, roots), make_active=False, make_default=True)
    stream.send_recording_name(_name(first))
    for episode, root in zip(episodes, roots, strict=True):
        _Writer(stream, episode, root).write()
    return memory.drain_as_bytes()


class _Writer:
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

    def write(self) -> None:
        self.write_so_far()
        self._write_hidden()
        self._write_belief()
        self._write_outcome()

    def write_so_far(self) -> None:
        """What may be known before the question is answered."""
        self._write_scene()
        self._write_seen()
        self._write_actions()

    def _path(self, entity: str) -> str:
        return f"{self._root}/{entity}"

    def _log(self, entity: str, archetype, time: float | None = None) -> None:
        if time is not None:
            self._stream.set_time(_TIMELINE, duration=time)
        self._stream.log(self._path(entity), archetype, static=time is None)

    def _columns(self, entity: str, times, columns) -> None:
        self._stream.send_columns(self._path(entity), [rr.TimeColumn(_TIMELINE, duration=times)], columns)

    # The scene.

    def _write_scene(self) -> None:
        things = self._episode.things
        self._log("world", rr.ViewCoordinates.RIGHT_HAND_Z_UP)
        self._log("world/room", rr.Boxes3D(centers=[(0, 0, -0.005)], half_sizes=[(0.7, 0.6, 0.005)],
                                           colors=[(190, 190, 185)], fill_mode="solid"))  # fmt: skip
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
        """Masses as labels; glued blocks joined by a bar that moves with the lower one."""
        names = self._episode.things.names
        if self._episode.domain == "which_is_heavier":
            for k, mass in enumerate(which_is_heavier.kilograms(self._episode.hidden)):
                entity, thing = f"world/hidden/mass_{k}", names.index(f"block_{k}")
                self._log(
                    entity,
                    rr.Points3D(
                        [(0, 0, 0.1 + 0.06 * (k % 2))], labels=[f"{mass:.2f} kg"], radii=[0.006], show_labels=True
                    ),
                )
                self._follow(entity, thing)
            return
        for k, glued in enumerate(tower.PATTERNS[int(self._episode.hidden)]):
            if glued:
                entity = f"world/hidden/glue_{k}"
                half = (0.4 * block.HALF_SIZE, 1.15 * block.HALF_SIZE, 0.8 * block.HALF_SIZE)
                self._log(entity, rr.Boxes3D(centers=[(0, 0, block.HALF_SIZE)], half_sizes=[half], colors=[_GLUE_COLOR],
                                             fill_mode="solid"))  # fmt: skip
                self._follow(entity, names.index(f"block_{k}"))

    # What was seen.

    def _write_seen(self) -> None:
        for name, values in self._episode.observations.items():
            if values.dtype == np.uint8:
                for time, image in zip(self._step_times, values, strict=True):
                    self._log(f"seen/{name}", rr.Image(image), time)
            elif values.ndim == 3:
                for axis, letter in enumerate("xyz"):
                    self._curves(
                        f"seen/{name}/{letter}", values[..., axis], [f"block {k}" for k in range(values.shape[1])]
                    )
            else:
                series = ["x", "y", "z"] if values.shape[1] == 3 else [f"block {k}" for k in range(values.shape[1])]
                self._curves(f"seen/{name}", values, series)

    def _curves(self, entity: str, values: np.ndarray, names: Sequence[str]) -> None:
        """Curves [T, S] at the times of the steps."""
        colors = [(255 * np.array(color)).astype(np.uint8) for color in block.COLORS[: len(names)]]
        self._log(entity, rr.SeriesLines(names=list(names), colors=colors, widths=[2.0] * len(names)))
        self._columns(entity, self._step_times[: len(values)], rr.Scalars.columns(scalars=values))

    # What was believed.

    def _write_belief(self) -> None:
        policies, first_label = self._episode.policies, self._task.num_interactions
        if len(policies):
            for time, policy in zip(self._step_times, policies, strict=False):
                self._log("belief/actions", rr.BarChart(policy), time)
                self._log("belief/labels", rr.BarChart(policy[first_label:] / policy[first_label:].sum()), time)
            self._curves("belief/history", policies[:, first_label:], list(self._task.label_names))
            self._curves("belief/value", self._episode.values[:, None], ["value"])
        if self._episode.domain == "which_is_heavier":
            self._curves(
                "belief/ideal", ideal_posteriors(self._episode), [f"ideal: {n}" for n in self._task.label_names]
            )

    # What was done.

    def _write_actions(self) -> None:
        episode, names = self._episode, self._task.action_names
        for step, (time, action) in enumerate(zip(self._step_times, episode.actions, strict=False)):
            self._log("did/actions", rr.TextLog(f"step {step}: {names[action]}"), time)
        self._log("did/outcome", rr.TextDocument(f"{episode.agent}\n\nThe question is open."), 0.0)
        if len(episode.actions):
            self._write_arrows()

    def _write_outcome(self) -> None:
        episode = self._episode
        self._log("did/outcome", rr.TextDocument(f"{episode.agent}\n\n{outcome(episode)}"), self._step_times[-1])

    def _write_arrows(self) -> None:
        """At every physics step, where the action acts and in which direction; of no length where there is none."""
        episode, effects = self._episode, self._task.effects
        steps = np.ceil(episode.times / self._task.control_timestep - 1e-6).astype(int) - 1  # Of the action under way.
        steps = np.clip(steps, 0, len(episode.actions) - 1)
        origins, vectors = np.zeros((2, len(steps), 3))
        for frame, step in enumerate(steps):
            if episode.actions[step] < len(effects):
                thing, effect = effects[episode.actions[step]]
                origins[frame] = episode.positions[frame, episode.things.names.index(thing)]
                vectors[frame] = _ARROW_LENGTH * np.array(effect) / np.linalg.norm(effect)
        self._log("world/action", rr.Arrows3D.from_fields(colors=[_ARROW_COLOR], radii=[0.012]))
        self._columns("world/action", episode.times, rr.Arrows3D.columns(origins=origins, vectors=vectors))
        end = self._step_times[-1] + 1e-3  # After the last step, when nothing is done any more.
        self._columns("world/action", [end], rr.Arrows3D.columns(origins=[(0, 0, 0)], vectors=[(0, 0, 0)]))


def ideal_posteriors(episode: recording.Episode) -> np.ndarray:
    """How likely each block is to be the heaviest, to who has seen what the pokes reveal: [T + 1, num_blocks]."""
    known = np.full((len(episode.actions) + 1, len(episode.hidden)), np.nan)
    for step, action in enumerate(episode.actions):
        if action < len(episode.hidden):
            known[step + 1 :, action] = episode.hidden[action]
    difficulty = episode.task_kwargs.get("difficulty", which_is_heavier.Options.difficulty)
    return ideal.posterior(known, difficulty)


def outcome(episode: recording.Episode) -> str:
    """How an episode ended, in words."""
    task = suite.load_task(episode.domain, episode.task, episode.task_kwargs)
    label = int(episode.actions[-1]) - task.num_interactions
    truth = task.label_names[episode.answer]
    if label < 0:
        return f"Time ran out. The right answer: {truth}."
    verdict = "right" if label == episode.answer else f"wrong; it is: {truth}"
    return f"Answer after {len(episode.actions) - 1} interactions: {task.label_names[label]}. That is {verdict}."


def blueprint(episodes: Sequence[recording.Episode], roots: Sequence[str]) -> rrb.Blueprint:
    """How a recording opens: the scene at the left, what was seen and believed at the right, time standing still."""
    columns = [_column(episode, root) for episode, root in zip(episodes, roots, strict=True)]
    body = columns[0] if len(columns) == 1 else rrb.Horizontal(*columns)
    return rrb.Blueprint(body, rrb.TimePanel(timeline=_TIMELINE, play_state="paused", state="collapsed"),
                         rrb.BlueprintPanel(state="collapsed"), rrb.SelectionPanel(state="collapsed"))  # fmt: skip


def _column(episode: recording.Episode, root: str):
    eye = rrb.EyeControls3D(position=(0.65, -1.1, 0.7), look_target=(0, 0, 0.22), eye_up=(0, 0, 1))
    if episode.domain == "which_is_heavier":
        eye = rrb.EyeControls3D(position=(0.1, -0.95, 0.45), look_target=(0, 0, 0.2), eye_up=(0, 0, 1))
    hidden: Any = {f"{root}/world/hidden": rrb.EntityBehavior(visible=False)}
    scene = rrb.Spatial3DView(origin=f"{root}/world", name=f"{episode.agent or 'scene'}", overrides=hidden,
                              eye_controls=eye)  # fmt: skip
    seen: rrb.View
    if "pixels" in episode.observations:
        seen = rrb.Spatial2DView(origin=f"{root}/seen/pixels", name="seen")
    else:
        seen = rrb.TimeSeriesView(origin=f"{root}/seen", name="seen, m")
    bars = rrb.BarChartView(origin=f"{root}/belief/labels", name="its answer, if it had to give one now")
    history = rrb.TimeSeriesView(origin=f"{root}/belief", name="beliefs", contents=["$origin/history", "$origin/value"])
    views = [seen, bars, history]
    if episode.domain == "which_is_heavier":
        views.append(rrb.TimeSeriesView(origin=f"{root}/belief/ideal", name="to the ideal experimenter"))
    words = rrb.Vertical(rrb.TextDocumentView(origin=f"{root}/did/outcome", name="outcome"),
                         rrb.TextLogView(origin=f"{root}/did/actions", name="actions"))  # fmt: skip
    return rrb.Horizontal(rrb.Vertical(scene, words, row_shares=[3, 1]), rrb.Vertical(*views), column_shares=[3, 2])
