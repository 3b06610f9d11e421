"""The apparatus: a compiled model with the places where its state is read and written.

One environment and a batch both step apparatuses of the same task, which is why they agree bit for bit.
"""

from collections.abc import Callable, Iterable, Mapping, Sequence
import copy
import dataclasses
import functools
import math
from typing import Any

from dm_control import composer, mjcf
import mujoco
import numpy as np

from physexp.suite.engine import declarations

# A held entity looks exactly as at the start until it has moved by more than this. Contacts at rest settle by less than
# a tenth of it, and the weakest touch moves a block by several times as much.
TOUCH_TOLERANCE = 1e-4  # m, or the same in a quaternion's components

_PLACING = ("body_pos", "body_quat")  # The model fields that say where things are.

LOOKED_AT = ("sensordata", "geom_xpos", "geom_xmat")
"""The fields of `MjData` that observations are made of."""

Sizes = dict[int, np.ndarray]
"""The sizes of geoms that have one for each reading, m [N, 3], by geom."""


@dataclasses.dataclass(frozen=True)
class Held:
    """A held entity.

    Attributes:
      qpos: addresses of its coordinates, int [K].
      bodies: its bodies, int [M].
      shows: for each field of `LOOKED_AT`, the addresses of its values that show the entity.
    """

    qpos: np.ndarray
    bodies: np.ndarray
    shows: dict[str, np.ndarray]


@dataclasses.dataclass(frozen=True)
class Starts:
    """The initial states of N episodes.

    Attributes:
      qpos: coordinates, float64 [N, nq].
      shown: the fields of `LOOKED_AT`, float64 [N, ...], by name.
      strength: factors on the control signals, [N, 1 or nu].
      camera: displacements of the camera, m [N, 3].
    """

    qpos: np.ndarray
    shown: dict[str, np.ndarray]
    strength: np.ndarray
    camera: np.ndarray

    def repeated(self, size: int) -> "Starts":
        """Returns the only initial state, repeated `size` times; not to be written to."""
        return self._changed(lambda values: np.broadcast_to(values, (size, *values.shape[1:])))

    def of(self, rows: np.ndarray) -> "Starts":
        """Returns the initial states of some episodes, int [K]."""
        return self._changed(lambda values: values[rows])

    def _changed(self, change: Callable[[np.ndarray], np.ndarray]) -> "Starts":
        shown = {field: change(values) for field, values in self.shown.items()}
        return Starts(change(self.qpos), shown, change(self.strength), change(self.camera))

    def put(self, rows: np.ndarray, starts: "Starts") -> None:
        """Writes the initial states of some episodes, int [K]."""
        self.qpos[rows], self.strength[rows], self.camera[rows] = starts.qpos, starts.strength, starts.camera
        for field, values in self.shown.items():
            values[rows] = starts.shown[field]


@dataclasses.dataclass(frozen=True)
class Apparatus:
    """A compiled model and the addresses in it. Not to be modified: it is shared.

    Attributes:
      model: the compiled model.
      readings: for each feature, the sensor addresses that make it up: int of the feature's shape, or [number of sensor
        values] where the feature is measured from them.
      start: how an episode starts without variation; N is 1.
      told: the sensor addresses of the values that the task tells, int [T].
      held: the entities that must look untouched until they are.
      moving_geoms: the geoms that do not stand still in images, int [M].
    """

    model: mujoco.MjModel
    readings: dict[str, np.ndarray]
    start: Starts
    told: np.ndarray
    held: tuple[Held, ...]
    moving_geoms: np.ndarray
    _measures: Mapping[str, declarations.Measure]
    _indicators: tuple[tuple[int, np.ndarray, declarations.Indicator], ...]  # Geoms, their places, and what they show.
    # Results of `dofs`: names are looked up once, since every reset asks.
    _dofs: dict[tuple[str, ...], tuple[np.ndarray, np.ndarray]] = dataclasses.field(default_factory=dict, init=False)

    def starts(self, circumstances: declarations.Circumstances, size: int) -> Starts:
        """Returns the initial states of `size` episodes."""
        starts = self.start.of(np.zeros(size, np.intp))
        for own, given in ((starts.strength, circumstances.strength), (starts.camera, circumstances.camera)):
            if given is not None:
                own[:] = given
        if circumstances.qpos is not None:
            addresses, values = circumstances.qpos
            starts.qpos[:, addresses] = values
        placing = {field: given for field, given in circumstances.fields.items() if field in _PLACING}
        if circumstances.qpos is not None or placing:
            model, data = self._scratch
            seen = [(shown, getattr(data, field)) for field, shown in starts.shown.items()]
            for row in range(size):
                for field, (addresses, values) in placing.items():
                    getattr(model, field)[addresses] = values[row]
                data.qpos[:] = starts.qpos[row]
                mujoco.mj_kinematics(model, data)
                mujoco.mj_sensorPos(model, data)
                for shown, value in seen:
                    shown[row] = value
            self.indicate(starts.shown["geom_xpos"], starts.shown["sensordata"])
        return starts

    @functools.cached_property
    def _scratch(self) -> tuple[mujoco.MjModel, mujoco.MjData]:
        """A copy of the model, to be changed, and its data."""
        model = copy.copy(self.model)
        return model, mujoco.MjData(model)

    def shown(
        self, field: str, values: np.ndarray, touched: np.ndarray, starts: Starts, rows: np.ndarray
    ) -> np.ndarray:
        """Returns a copy of a field for observations: held entities that were not touched are exactly as at the start.

        The values, [N, ...], and what was touched, bool [N, number of held entities], are of the episodes `rows`.
        """
        shown = values.copy()
        for held, is_touched in zip(self.held, touched.T, strict=True):
            places = held.shows[field]
            shown[np.ix_(~is_touched, places)] = starts.shown[field][np.ix_(rows[~is_touched], places)]
        return shown

    def moved(self, qpos: np.ndarray, start: np.ndarray) -> np.ndarray:
        """Returns which held entities have left their place: bool [N, number of held entities] from [N, nq]."""
        moved = np.zeros((len(qpos), len(self.held)), bool)
        for k, held in enumerate(self.held):
            displacement = np.abs(qpos[:, held.qpos] - start[:, held.qpos])
            moved[:, k] = displacement.max(axis=1, initial=0.0) > TOUCH_TOLERANCE
        return moved

    def read(self, name: str, sensordata: np.ndarray) -> np.ndarray:
        """Returns a feature, float64 [N, ...], from `sensordata`, float64 [N, nsensordata]."""
        values = sensordata[:, self.readings[name]]
        return self._measures[name](values) if name in self._measures else values

    def indicate(self, geom_xpos: np.ndarray, sensordata: np.ndarray) -> None:
        """Moves the indicators to where the readings place them: writes to `geom_xpos`, [N, ngeom, 3]."""
        for geom, place, indicator in self._indicators:
            geom_xpos[:, geom] = place + self._indicated(indicator, sensordata)[:, None] * np.array(indicator.travel)

    def sizes(self, sensordata: np.ndarray) -> Sizes:
        """Returns the sizes of the indicators that have a size for each reading."""
        return {
            geom: indicator.size(self._indicated(indicator, sensordata))
            for geom, _, indicator in self._indicators
            if indicator.size
        }

    def _indicated(self, indicator: declarations.Indicator, sensordata: np.ndarray) -> np.ndarray:
        """Returns the values of the reading that an indicator shows, [N]."""
        values = self.read(indicator.reading, sensordata)
        return values.reshape(len(values), math.prod(values.shape[1:]))[:, indicator.component]

    def dofs(self, joints: tuple[str, ...]) -> tuple[np.ndarray, np.ndarray]:
        """Returns the degrees of freedom and the bodies, int [K] each, of slides or hinges by their full names."""
        if joints not in self._dofs:
            found = [self.model.joint(joint) for joint in joints]
            dofs, bodies = (np.array([getattr(each, field)[0] for each in found]) for field in ("dofadr", "bodyid"))
            self._dofs[joints] = dofs, bodies
        return self._dofs[joints]


def slide_masses(apparatus: Apparatus, joints: tuple[str, ...], kilograms: np.ndarray) -> declarations.Fields:
    """Returns the model fields that follow from the masses, float64 [N, K], of bodies on one slide each.

    They are the values of `mj_setConst`, at a hundredth of its cost, without those that contacts and other joints need.
    """
    dofs, bodies = apparatus.dofs(joints)
    return {"body_mass": (bodies, kilograms), "dof_M0": (dofs, kilograms), "dof_invweight0": (dofs, 1 / kilograms)}


def scaled_masses(apparatus: Apparatus, bodies: np.ndarray, factors: np.ndarray) -> declarations.Fields:
    """Returns the model fields of bodies, int [K], whose masses are multiplied by factors, [N]; as `mj_setConst` does.

    The bodies must be all that moves with their degrees of freedom.
    """
    model = apparatus.model
    dofs = np.flatnonzero(np.isin(model.dof_bodyid, bodies))
    found = {}
    for name in ("body_mass", "body_inertia", "body_subtreemass", "body_invweight0", "dof_M0", "dof_invweight0"):
        places = bodies if name.startswith("body") else dofs
        found[name] = places, np.multiply.outer(factors ** (-1 if "inv" in name else 1), getattr(model, name)[places])
    return found


def frictions(apparatus: Apparatus, joints: tuple[str, ...], newtons: np.ndarray) -> declarations.Fields:
    """Returns the model fields of dry friction, float64 [N, K], on slides (N) or hinges (N m)."""
    dofs, _ = apparatus.dofs(joints)
    return {"dof_frictionloss": (dofs, newtons)}


@functools.lru_cache(maxsize=256)
def compile_xml(xml: str) -> mujoco.MjModel:
    """Returns the model of an MJCF string, compiled once per process."""
    return mujoco.MjModel.from_xml_string(xml)


def build(
    xml: str,
    readings: Mapping[str, declarations.Reading],
    held: Sequence[composer.Entity] = (),
    indicators: Sequence[declarations.Indicator] = (),
) -> Apparatus:
    """Compiles the MJCF of a whole scene, with the names that its sensors, entities and geoms have in it."""
    model = compile_xml(xml)
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    geoms = [model.geom(indicator.geom.full_identifier).id for indicator in indicators]
    moving = model.body_weldid[model.geom_bodyid] != 0
    moving[geoms] = True
    addresses = {
        name: _addresses(model.sensor(sensor.full_identifier) for sensor in reading.sensors)
        for name, reading in readings.items()
    }
    measures = {name: reading.measure for name, reading in readings.items() if reading.measure is not None}
    built = Apparatus(
        model=model,
        readings={
            name: places if name in measures else places.reshape(readings[name].shape)
            for name, places in addresses.items()
        },
        start=Starts(
            qpos=model.qpos0[None].copy(),
            shown={field: getattr(data, field)[None].copy() for field in LOOKED_AT},
            strength=np.ones((1, model.nu)),
            camera=np.zeros((1, 3)),
        ),
        told=_addresses(map(model.sensor, np.flatnonzero(model.sensor_type == mujoco.mjtSensor.mjSENS_USER))),
        held=tuple(_find_held(model, mjcf.get_attachment_frame(entity.mjcf_model)) for entity in held),
        moving_geoms=np.flatnonzero(moving),
        _measures=measures,
        _indicators=tuple(zip(geoms, data.geom_xpos[geoms], indicators, strict=True)),
    )
    built.indicate(built.start.shown["geom_xpos"], built.start.shown["sensordata"])
    return built


def _find_held(model: mujoco.MjModel, frame: mjcf.Element) -> Held:
    """Finds what belongs to an entity: the bodies below its frame, their joints, geoms and sensors."""
    bodies = {model.body(frame.full_identifier).id}
    for body in range(model.nbody):  # A parent comes before its children.
        if model.body_parentid[body] in bodies:
            bodies.add(body)
    inside = np.array(sorted(bodies))
    geoms = np.flatnonzero(np.isin(model.geom_bodyid, inside))
    owner = {
        mujoco.mjtObj.mjOBJ_BODY: np.arange(model.nbody),
        mujoco.mjtObj.mjOBJ_XBODY: np.arange(model.nbody),
        mujoco.mjtObj.mjOBJ_JOINT: model.jnt_bodyid,
        mujoco.mjtObj.mjOBJ_GEOM: model.geom_bodyid,
        mujoco.mjtObj.mjOBJ_SITE: model.site_bodyid,
    }
    sensors = [
        model.sensor(number)
        for number, (kind, index) in enumerate(zip(model.sensor_objtype, model.sensor_objid, strict=True))
        if owner[mujoco.mjtObj(kind)][index] in bodies
    ]
    ends = np.append(model.jnt_qposadr[1:], model.nq)
    joints = zip(model.jnt_bodyid, model.jnt_qposadr, ends, strict=True)
    coordinates = [np.arange(first, end) for body, first, end in joints if body in bodies]
    return Held(
        qpos=np.concatenate([np.zeros(0, np.intp), *coordinates]).astype(np.intp),
        bodies=inside,
        shows={"sensordata": _addresses(sensors), "geom_xpos": geoms, "geom_xmat": geoms},
    )


def _addresses(sensors: Iterable[Any]) -> np.ndarray:
    """Returns the addresses in `sensordata` of some of a model's sensors, int [K]."""
    ranges = [sensor.adr[0] + np.arange(sensor.dim[0]) for sensor in sensors]
    return np.concatenate([np.zeros(0, np.intp), *ranges]).astype(np.intp)
