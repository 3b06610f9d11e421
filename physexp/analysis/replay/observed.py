"""Poses of an episode that follows from its observations alone, to be drawn before the answer."""

from collections.abc import Mapping, Sequence

import mujoco
import numpy as np

from physexp.analysis.data import readings
from physexp.suite.engine import composer_task

Poses = tuple[np.ndarray, np.ndarray, np.ndarray]
"""Positions, m [F, K, 3], rotations, [F, K, 3, 3], and whether the observations determine the positions, bool [K]."""

Sizes = dict[int, np.ndarray]
"""The sizes of geoms that have one for each reading, m [F, 3], by geom."""


def poses(
    task: composer_task.ComposerTask, geoms: np.ndarray, observations: Mapping[str, np.ndarray], ends: Sequence[int]
) -> tuple[Poses, Sizes]:
    """Returns the poses of K geoms in all frames up to the last observation, and the sizes of those that change theirs.

    Each reading moves from one observation to the next by the clock, slowly at both ends. Readings alone place geoms:
    indicators of a reading, geoms whose joints are all read, and geoms whose position is read, which keep the model's
    orientation. All other geoms stay as in the model. Observations are [T + 1, ...]; `ends` are their frames.
    """
    frames = np.arange(ends[-1] + 1)
    before = np.searchsorted(ends, frames, side="right") - 1
    after = np.minimum(before + 1, len(ends) - 1)
    share = (frames - np.take(ends, before)) / np.maximum(np.take(ends, after) - np.take(ends, before), 1)
    eased = (share * share * (3 - 2 * share))[:, None]
    shown = {}
    for name in task.readings.keys() & observations.keys():
        values = observations[name].reshape(len(ends), -1).astype(float)
        shown[name] = values[before] + eased * (values[after] - values[before])
    positions, rotations, are_placed = _placed(task, shown, len(frames))
    sizes = _indicate(task, shown, positions, are_placed)
    return (positions[:, geoms], rotations[:, geoms], are_placed[geoms]), sizes


def _placed(task: composer_task.ComposerTask, shown: Mapping[str, np.ndarray], size: int) -> Poses:
    """Returns the poses of all geoms from the readings of joints and positions, [size, S] by name."""
    model, start = task.apparatus.model, task.apparatus.start.shown
    joints, displacements = {}, {}
    for name, values in shown.items():
        if task.readings[name].measure is not None:
            continue
        for sensor in task.readings[name].sensors:
            compiled = model.sensor(sensor.full_identifier)
            address, number = compiled.adr[0] + np.arange(compiled.dim[0]), compiled.objid[0]
            told = values[:, np.isin(task.apparatus.readings[name].ravel(), address)]
            if sensor.tag == "jointpos":
                joints[number] = told
            elif sensor.tag == "framepos" and sensor.reftype is None:
                thing = readings.owner(mujoco.mj_id2name(model, compiled.objtype[0], number))
                displacements[thing] = told - start["sensordata"][0, address]
    positions, rotations = _posed(model, {model.jnt_qposadr[joint]: told for joint, told in joints.items()}, size)
    are_placed = np.array([_joints_of(model, body) <= joints.keys() for body in model.geom_bodyid])
    for geom in range(model.ngeom):
        thing = readings.owner(model.geom(geom).name)
        if thing in displacements:
            positions[:, geom] = start["geom_xpos"][0, geom] + displacements[thing]
            are_placed[geom] = True
    return positions, rotations, are_placed


def _posed(model: mujoco.MjModel, coordinates: Mapping[int, np.ndarray], size: int) -> tuple[np.ndarray, np.ndarray]:
    """Returns positions and rotations of all geoms for values [size, 1] of some coordinates."""
    data = mujoco.MjData(model)
    positions, rotations = np.zeros((size, model.ngeom, 3)), np.zeros((size, model.ngeom, 3, 3))
    for frame in range(size):
        for address, values in coordinates.items():
            data.qpos[address] = values[frame, 0]
        mujoco.mj_kinematics(model, data)
        positions[frame], rotations[frame] = data.geom_xpos, data.geom_xmat.reshape(-1, 3, 3)
    return positions, rotations


def _joints_of(model: mujoco.MjModel, body: int) -> set[int]:
    """Returns the joints that move a body."""
    found: set[int] = set()
    while body:
        found.update(model.body_jntadr[body] + np.arange(model.body_jntnum[body]))
        body = model.body_parentid[body]
    return found


def _indicate(
    task: composer_task.ComposerTask, shown: Mapping[str, np.ndarray], positions: np.ndarray, are_placed: np.ndarray
) -> Sizes:
    """Writes the positions of indicators, and whether their readings are observed; returns sizes that show readings."""
    start, sizes = task.apparatus.start.shown, {}
    for indicator in task.scene.indicators:
        geom, name = task.apparatus.model.geom(indicator.geom.full_identifier).id, indicator.reading
        positions[:, geom] = start["geom_xpos"][0, geom]
        are_placed[geom] = name in shown
        if name in shown:
            first = task.apparatus.read(name, start["sensordata"]).ravel()[indicator.component]
            values = shown[name][:, indicator.component, None] - first
            positions[:, geom] += values * np.array(indicator.travel)
            if indicator.size:
                sizes[geom] = indicator.size(shown[name][:, indicator.component])
    return sizes
