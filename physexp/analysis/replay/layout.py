"""Layout of a recording: the scene at the left, observations and beliefs at the right."""

from collections.abc import Sequence
from typing import Any

import numpy as np
import rerun as rr
import rerun.blueprint as rrb

from physexp.analysis import domains
from physexp.analysis.data import readings
from physexp.analysis.replay import recording, words

TIMELINE = "time"

_SPEED = 0.1  # Of playback, since an episode of three actions lasts 0.3 s.
_PLOT_DURATION = 1.5  # Of the episode's duration, so that names at the right have room.
_MARGIN = 0.05  # Of the range of a plot, below and above.
_FIELD_OF_VIEW = 55.0  # degrees, of the viewer's own eye
_INVISIBLE = rrb.EntityBehavior(visible=False)
_NEARER = 0.7  # Of the distance that shows the camera's image, since a window is wider.


def blueprint(episodes: Sequence[recording.Film], roots: Sequence[str]) -> rrb.Blueprint:
    """Returns the layout of episodes side by side, each below its root entity."""
    columns = [_Views(episode, root).arranged() for episode, root in zip(episodes, roots, strict=True)]
    time = rrb.TimePanel(timeline=TIMELINE, playback_speed=_SPEED, play_state="playing", state="collapsed")
    body = columns[0] if len(columns) == 1 else rrb.Horizontal(*columns)
    return rrb.Blueprint(body, time, collapse_panels=True)


def entity(reading: readings.Shown, component: str) -> str:
    """Returns the entity of a reading's component."""
    return f"seen/{reading.name}/{component}".removesuffix("/")


class _Views:
    """The views of an episode whose entities are below a root."""

    def __init__(self, episode: recording.Film, root: str):
        self._episode, self._root, self._task = episode, root, episode.declared

    def arranged(self) -> rrb.Container:
        """Returns all views: in one column if the episode has a root, beside that of another episode."""
        scene, about = self._scene(), self._texts()
        seen, thoughts = self._readings(), self._thoughts()
        now = [self._text("belief/now", "belief and policy, now")] if len(self._episode.policies) else []
        if self._root:
            middle = rrb.Horizontal(*now, *seen, column_shares=[5, 4][: len(now) + len(seen)])
            rows: list[rrb.Container | rrb.View] = [scene, about, middle, *_tabs(sum(thoughts, []))]
            return rrb.Vertical(*rows, row_shares=[5, 4, 4, 4][: len(rows)])
        rows = [*seen, *now, *(tabs for views in thoughts for tabs in _tabs(views))]
        left = rrb.Vertical(scene, about, row_shares=[3, 2])
        return rrb.Horizontal(left, rrb.Vertical(*rows, row_shares=[5, 4, 4, 4][: len(rows)]), column_shares=[3, 2])

    def _named(self, title: str) -> str:
        return f"{self._root}: {title}" if self._root else title

    def _scene(self) -> rrb.Tabs:
        """Returns tabs of the observed scene or image, and of the true scene, in which covers are transparent."""
        world, title, shapes = f"{self._root}/world", self._episode.agent or "scene", self._episode.shapes
        edges = rr.Boxes3D.from_fields(fill_mode="majorwireframe")
        folders = ["hidden" if is_moving else "room" for is_moving in shapes.are_moving]
        glass = {f"{world}/{folders[k]}/{shapes.names[k]}": edges for k in covers(self._episode)}
        images = [name for name in self._episode.observations if name not in self._task.observer.readings]
        if images:
            name = self._named(f"{title}: the image")
            observed: rrb.View = rrb.Spatial2DView(origin=f"{self._root}/seen/{images[0]}", name=name)
        else:
            observed = self._world(title, {f"{world}/hidden": _INVISIBLE})
        true = self._world(words.HIDDEN_TAB, {f"{world}/things": _INVISIBLE, **glass})
        return rrb.Tabs(observed, true, active_tab=0)

    def _world(self, title: str, overrides: Any) -> rrb.View:
        eye, name = _eye(self._task.root_entity.camera), self._named(title)
        return rrb.Spatial3DView(origin=f"{self._root}/world", name=name, eye_controls=eye, overrides=overrides)

    def _texts(self) -> rrb.Container:
        about, log = self._text("did/outcome", "question and outcome"), self._text("did/actions", "actions so far")
        return rrb.Horizontal(about, log, column_shares=[2, 1])

    def _text(self, entity: str, title: str) -> rrb.View:
        return rrb.TextDocumentView(origin=f"{self._root}/{entity}", name=self._named(title))

    def _readings(self) -> list[rrb.Container]:
        """Returns plots of the readings; components of one name share a plot."""
        shown = readings.shown(self._task.observer.readings)
        seen = [reading for reading in shown if reading.name in self._episode.observations]
        plots: dict[str, list] = {}
        if any(reading.is_position for reading in seen):
            plots["seen: distance from start, m"] = [("seen/moved", None)]
        for reading in seen:
            for number, component in enumerate(reading.components):
                title = component or f"seen: {readings.spoken(reading.name)}"
                curve = entity(reading, component), None if reading.limits is None else reading.limits[number]
                plots.setdefault(f"{title}, {reading.unit}" if reading.unit else title, []).append(curve)
        views = []
        for title, curves in plots.items():
            paths, limits = zip(*curves, strict=True)
            views.append(self._plot(title, paths, readings.joined_limits(limits)))
        return _tabs(views)

    def _thoughts(self) -> list[list[rrb.View]]:
        """Returns groups of plots of beliefs and policies."""
        is_known = domains.find(self._episode.domain).ideal_with(self._episode.task_kwargs) is not None
        ideal = [self._plot("belief of an ideal experimenter", ["belief/ideal"], (0, 1))] if is_known else []
        if not len(self._episode.policies):
            return [ideal]
        belief = self._plot("belief", ["belief/labels"], (0, 1))
        answers = self._plot("answers now (policy), and value", ["belief/answers", "belief/value"], (-1, 1))
        return [[belief, *ideal], [answers, self._plot("policy of every action", ["belief/policy"], (0, 1))]]

    def _plot(self, title: str, entities: Sequence[str], limits: tuple[float, float] | None) -> rrb.View:
        """Returns a plot of some entities up to the current time."""
        until = _PLOT_DURATION * float(self._episode.times[self._episode.num_played])
        start, now = rr.TimeRangeBoundary.absolute(seconds=0), rr.TimeRangeBoundary.cursor_relative(seconds=0)
        duration = rr.TimeRange(start=start, end=rr.TimeRangeBoundary.absolute(seconds=until))
        margin = _MARGIN * (limits[1] - limits[0]) if limits else 0.0
        return rrb.TimeSeriesView(
            origin=f"{self._root}/",
            name=self._named(title),
            contents=[f"{self._root}/{path}" for path in entities],
            plot_legend=rrb.PlotLegend(rrb.Corner2D.RightTop),
            time_ranges=rrb.VisibleTimeRange(TIMELINE, start=start, end=now),
            axis_x=rrb.TimeAxis(view_range=duration) if until else None,
            axis_y=rrb.ScalarAxis(range=(limits[0] - margin, limits[1] + margin)) if limits else None,
        )


def _tabs(views: Sequence[rrb.View]) -> list[rrb.Container]:
    return [rrb.Tabs(*views, active_tab=0)] if views else []


def covers(episode: recording.Film) -> list[int]:
    """Returns the boxes that hold an unplaced thing at the start, by shape."""
    shapes, positions = episode.shapes, episode.positions[0]
    found = []
    for k in np.flatnonzero(shapes.are_drawn).tolist():
        within = np.abs((positions - positions[k]) @ episode.rotations[0, k]) < shapes.sizes[k]
        is_inside = within.all(axis=1) & ~shapes.are_placed & (np.arange(len(positions)) != k)
        if shapes.kinds[k] == "box" and is_inside.any():
            found.append(k)
    return found


def _eye(camera: Any) -> rrb.EyeControls3D:
    """Returns an eye in the direction of the agent's camera."""
    right, up = np.reshape(camera.xyaxes, (2, 3))
    forward = np.cross(up, right)
    distance = -float(camera.pos @ forward)  # To the middle of the room.
    target = camera.pos + distance * forward
    nearer = _NEARER * distance * np.tan(np.radians(camera.fovy / 2)) / np.tan(np.radians(_FIELD_OF_VIEW / 2))
    return rrb.EyeControls3D(position=target - nearer * forward, look_target=target, eye_up=(0, 0, 1))
