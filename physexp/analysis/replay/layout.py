"""Layout of a recording: the scene at the left, observations and beliefs at the right."""

from collections.abc import Sequence
import functools
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
_MARGIN = 0.05  # Of the reading's range, below and above.
_FIELD_OF_VIEW = 55.0  # degrees, of the viewer's own eye
_INVISIBLE = rrb.EntityBehavior(visible=False)
_NEARER = 0.7  # Of the distance that shows the camera's image, since a window is wider.


def blueprint(episodes: Sequence[recording.Film], roots: Sequence[str]) -> rrb.Blueprint:
    """Returns the layout of episodes side by side, each below its root entity."""
    columns = [_column(episode, root) for episode, root in zip(episodes, roots, strict=True)]
    body = columns[0] if len(columns) == 1 else rrb.Horizontal(*columns)
    return rrb.Blueprint(
        body,
        rrb.TimePanel(timeline=TIMELINE, playback_speed=_SPEED, play_state="playing", state="collapsed"),
        rrb.BlueprintPanel(state="collapsed"),
        rrb.SelectionPanel(state="collapsed"),
    )


def titled(root: str, title: str) -> str:
    """Returns the title of a view, with its root for episodes side by side."""
    return f"{root}: {title}" if root else title


def _column(episode: recording.Film, root: str) -> rrb.Container:
    scene, about, seen = _scene(episode, root), _about(root), _readings(episode, root)
    now, curves = _thoughts(episode, root)
    if root:
        plots = [rrb.Tabs(*(view for views in curves for view in views), active_tab=0)] if curves else []
        return rrb.Vertical(
            scene,
            about,
            rrb.Horizontal(*now, *seen, column_shares=[5, 4][: len(now) + len(seen)]),
            *plots,
            row_shares=[5, 4, 4, 4][: 3 + len(plots)],
        )
    right = [*seen, *now, *(rrb.Tabs(*views, active_tab=0) for views in curves)]
    left = rrb.Vertical(scene, about, row_shares=[3, 2])
    return rrb.Horizontal(left, rrb.Vertical(*right, row_shares=[5, 4, 4, 4][: len(right)]), column_shares=[3, 2])


def _scene(episode: recording.Film, root: str) -> rrb.Tabs:
    """Returns tabs of the observed scene and of the true one, in which covers are transparent."""
    edges = rr.Boxes3D.from_fields(fill_mode="majorwireframe")
    hidden = {f"{root}/world/{entity}": edges for entity in _covers(episode)}
    return rrb.Tabs(
        _observed(episode, root),
        _world(episode, root, words.HIDDEN_TAB, {f"{root}/world/things": _INVISIBLE, **hidden}),
        active_tab=0,
    )


def _observed(episode: recording.Film, root: str) -> rrb.View:
    """Returns the scene as readings place it, or the image."""
    title, images = episode.agent or "scene", _images(episode)
    if images:
        return rrb.Spatial2DView(origin=f"{root}/seen/{images[0]}", name=titled(root, f"{title}: the image"))
    return _world(episode, root, title, {f"{root}/world/hidden": _INVISIBLE})


def _world(episode: recording.Film, root: str, title: str, overrides: Any) -> rrb.View:
    return rrb.Spatial3DView(
        origin=f"{root}/world", name=titled(root, title), eye_controls=_eye(episode), overrides=overrides
    )


def _images(episode: recording.Film) -> list[str]:
    """Returns the names of the observations that are images."""
    return [name for name in episode.observations if name not in episode.declared.observer.readings]


def _covers(episode: recording.Film) -> list[str]:
    """Returns the entities of boxes that hold an unplaced thing at the start."""
    shapes, positions = episode.shapes, episode.positions[0]
    covers = []
    for k in np.flatnonzero(shapes.are_drawn).tolist():
        within = np.abs((positions - positions[k]) @ episode.rotations[0, k]) < shapes.sizes[k]
        is_inside = within.all(axis=1) & ~shapes.are_placed & (np.arange(len(positions)) != k)
        if shapes.kinds[k] == "box" and is_inside.any():
            covers.append(f"{'hidden' if shapes.are_moving[k] else 'room'}/{shapes.names[k]}")
    return covers


def _eye(episode: recording.Film) -> rrb.EyeControls3D:
    """Returns an eye in the direction of the agent's camera."""
    camera = episode.declared.root_entity.camera
    right, up = np.reshape(camera.xyaxes, (2, 3))
    forward = np.cross(up, right)
    distance = -float(camera.pos @ forward)  # To the middle of the room.
    target = camera.pos + distance * forward
    nearer = _NEARER * distance * np.tan(np.radians(camera.fovy / 2)) / np.tan(np.radians(_FIELD_OF_VIEW / 2))
    return rrb.EyeControls3D(position=target - nearer * forward, look_target=target, eye_up=(0, 0, 1))


def _about(root: str) -> rrb.Container:
    text = rrb.TextDocumentView(origin=f"{root}/did/outcome", name=titled(root, "question and outcome"))
    log = rrb.TextDocumentView(origin=f"{root}/did/actions", name=titled(root, "actions so far"))
    return rrb.Horizontal(text, log, column_shares=[2, 1])


def _readings(episode: recording.Film, root: str) -> list[rrb.View | rrb.Container]:
    """Returns plots of the readings, in tabs if there are several."""
    curves, seen = functools.partial(_curves, episode, root), readings.shown(episode.declared.observer.readings)
    seen = [reading for reading in seen if reading.name in episode.observations]
    views: list[rrb.View | rrb.Container] = []
    if any(reading.is_position for reading in seen):
        views.append(curves("seen: distance from start, m", ["seen/moved"]))
    views += [curves(title, *plot) for title, plot in _plots(seen).items()]
    return views if len(views) < 2 else [rrb.Tabs(*views, active_tab=0)]


def _plots(seen: Sequence[readings.Shown]) -> dict[str, tuple[list[str], tuple[float, float] | None]]:
    """Returns entities and limits of each plot by its title; components of one name share a plot."""
    found: dict[str, list] = {}
    for reading in seen:
        for number, component in enumerate(reading.components):
            name = component or f"seen: {readings.spoken(reading.name)}"
            title = f"{name}, {reading.unit}" if reading.unit else name
            limits = None if reading.limits is None else reading.limits[number]
            found.setdefault(title, []).append((entity(reading, component), limits))
    return {
        title: ([path for path, _ in plot], _widened(readings.joined_limits([limits for _, limits in plot])))
        for title, plot in found.items()
    }


def _widened(limits: tuple[float, float] | None) -> tuple[float, float] | None:
    """Returns limits with a margin."""
    if limits is None:
        return None
    margin = _MARGIN * (limits[1] - limits[0])
    return limits[0] - margin, limits[1] + margin


def entity(reading: readings.Shown, component: str) -> str:
    """Returns the entity of a reading's component."""
    return f"seen/{reading.name}/{component}" if component else f"seen/{reading.name}"


def _thoughts(episode: recording.Film, root: str) -> tuple[list[rrb.View], list[list[rrb.View]]]:
    """Returns the view of the current belief, and groups of plots over time."""
    curves, chances = functools.partial(_curves, episode, root), (-0.05, 1.05)
    is_known = domains.find(episode.domain).ideal_with(episode.task_kwargs) is not None
    ideal = [curves("belief of an ideal experimenter", ["belief/ideal"], chances)] if is_known else []
    if not len(episode.policies):
        return [], [ideal] if ideal else []
    now = rrb.TextDocumentView(origin=f"{root}/belief/now", name=titled(root, "belief and policy, now"))
    answers = curves("answers now (policy), and value", ["belief/answers", "belief/value"], (-1.05, 1.05))
    policy = curves("policy of every action", ["belief/policy"], chances)
    return [now], [[curves("belief", ["belief/labels"], chances), *ideal], [answers, policy]]


def _curves(
    episode: recording.Film,
    root: str,
    title: str,
    entities: Sequence[str],
    limits: tuple[float, float] | None = None,
) -> rrb.View:
    """Returns a plot of some entities up to the current time."""
    until = _PLOT_DURATION * float(episode.times[episode.num_played])
    start, now = rr.TimeRangeBoundary.absolute(seconds=0), rr.TimeRangeBoundary.cursor_relative(seconds=0)
    return rrb.TimeSeriesView(
        origin=f"{root}/",
        name=titled(root, title),
        contents=[f"{root}/{entity}" for entity in entities],
        plot_legend=rrb.PlotLegend(rrb.Corner2D.RightTop),
        time_ranges=rrb.VisibleTimeRange(TIMELINE, start=start, end=now),
        axis_x=None
        if not until
        else rrb.TimeAxis(view_range=rr.TimeRange(start=start, end=rr.TimeRangeBoundary.absolute(seconds=until))),
        axis_y=None if limits is None else rrb.ScalarAxis(range=limits),
    )
