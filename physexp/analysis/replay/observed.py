"""Poses of an episode that follows from its observations alone, to be drawn before the answer."""

from collections.abc import Collection, Mapping, Sequence
import dataclasses

import mujoco
import numpy as np

from physexp.analysis.data import readings
from physexp.suite.engine import apparatus as apparatus_lib
from physexp.suite.engine import composer_task, contract, declarations

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
    (positions, rotations, are_placed), sizes = _placed(task, shown, len(frames))
    return (positions[:, geoms], rotations[:, geoms], are_placed[geoms]), sizes


@dataclasses.dataclass(frozen=True)
class Placing:
    """How readings place the geoms of a model.

    Attributes:
      joints: the reading and the column of each joint that is read, by the address of its coordinate.
      displaced: the reading and the columns (x, y, z) of each geom whose thing's position is read, by geom.
      indicators: the geoms that show readings.
      are_placed: whether a geom stands still, or readings determine its position, bool [ngeom].
    """

    joints: dict[int, tuple[str, int]]
    displaced: dict[int, tuple[str, list[int]]]
    indicators: list[tuple[int, declarations.Indicator]]
    are_placed: np.ndarray


def placing(task: contract.Task, apparatus: apparatus_lib.Apparatus, observed: Collection[str]) -> Placing:
    """Returns how the readings of these names place the geoms of a structure."""
    model, joints, things = apparatus.model, dict[int, tuple[str, int]](), dict[str, tuple[str, list[int]]]()
    for name in task.readings.keys() & observed:
        if task.readings[name].measure is not None:
            continue
        for sensor in task.readings[name].sensors:
            compiled = model.sensor(sensor.full_identifier)
            address, number = compiled.adr[0] + np.arange(compiled.dim[0]), compiled.objid[0]
            columns = np.flatnonzero(np.isin(apparatus.readings[name].ravel(), address)).tolist()
            if sensor.tag == "jointpos":
                joints[number] = name, columns[0]
            elif sensor.tag == "framepos" and sensor.reftype is None:
                things[readings.owner(mujoco.mj_id2name(model, compiled.objtype[0], number))] = name, columns
    owners = {geom: readings.owner(model.geom(geom).name) for geom in range(model.ngeom)}
    displaced = {geom: things[thing] for geom, thing in owners.items() if thing in things}
    are_placed = np.array([_joints_of(model, body) <= joints.keys() for body in model.geom_bodyid])
    are_placed[list(displaced)] = True
    indicators = [(model.geom(each.geom.full_identifier).id, each) for each in task.scene.indicators]
    for geom, indicator in indicators:
        are_placed[geom] = indicator.reading in observed
    addresses = {int(model.jnt_qposadr[joint]): told for joint, told in joints.items()}
    return Placing(addresses, displaced, indicators, are_placed)


def _placed(task: composer_task.ComposerTask, shown: Mapping[str, np.ndarray], size: int) -> tuple[Poses, Sizes]:
    """Returns the poses of all geoms, and the sizes of some, from readings, [size, S] by name."""
    apparatus, start = task.apparatus, task.apparatus.start.shown
    how, sizes = placing(task, apparatus, shown), {}
    coordinates = {address: shown[name][:, column] for address, (name, column) in how.joints.items()}
    positions, rotations = _posed(apparatus.model, coordinates, size)

    def moved(name: str, columns: list[int]) -> np.ndarray:
        return shown[name][:, columns] - apparatus.read(name, start["sensordata"]).ravel()[columns]

    for geom, (name, columns) in how.displaced.items():
        positions[:, geom] = start["geom_xpos"][0, geom] + moved(name, columns)
    for geom, indicator in how.indicators:
        positions[:, geom] = start["geom_xpos"][0, geom]
        if indicator.reading in shown:
            positions[:, geom] += moved(indicator.reading, [indicator.component]) * np.array(indicator.travel)
            if indicator.size:
                sizes[geom] = indicator.size(shown[indicator.reading][:, indicator.component])
    return (positions, rotations, how.are_placed), sizes


def _posed(model: mujoco.MjModel, coordinates: Mapping[int, np.ndarray], size: int) -> tuple[np.ndarray, np.ndarray]:
    """Returns positions and rotations of all geoms for values [size] of some coordinates."""
    data = mujoco.MjData(model)
    positions, rotations = np.zeros((size, model.ngeom, 3)), np.zeros((size, model.ngeom, 3, 3))
    for frame in range(size):
        for address, values in coordinates.items():
            data.qpos[address] = values[frame]
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
