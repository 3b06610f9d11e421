"""The apparatus: a compiled model with the places where its state is read and written.

One environment and a batch both step apparatuses of the same task, which is why they agree bit for bit.
"""

import dataclasses
import functools

import mujoco
import numpy as np


@dataclasses.dataclass(frozen=True)
class Apparatus:
    """A compiled model and the addresses in it. Not to be modified: it is shared.

    Attributes:
      model: the compiled model.
      readings: for each feature, the sensor addresses that make it up, int of the feature's shape.
      rest_qpos: `qpos` of the initial state, float64 [nq].
      rest: fields of `MjData` in the initial state, float64, by name.
      held_qpos: addresses in `qpos` of the coordinates that look at rest until they are moved.
      held: for each field in `rest`, the addresses of what shows them.
      hidden_bodies: the bodies whose masses differ from episode to episode.
      hidden_dofs: the degree of freedom, a slide, of each of them.
    """

    model: mujoco.MjModel
    readings: dict[str, np.ndarray]
    rest_qpos: np.ndarray
    rest: dict[str, np.ndarray]
    held_qpos: np.ndarray
    held: dict[str, np.ndarray]
    hidden_bodies: np.ndarray
    hidden_dofs: np.ndarray

    def shown(self, field: str, values: np.ndarray, touched: np.ndarray) -> np.ndarray:
        """A field as it may be seen: where nothing has been touched, held parts are exactly as they were at the start.

        Args:
          field: name of the field, one in `rest`.
          values: its values, float64 [N, ...].
          touched: whether held parts have been touched, bool [N].

        Returns:
          A copy, float64 [N, ...].
        """
        shown = values.copy()
        shown[np.ix_(~touched, self.held[field])] = self.rest[field][self.held[field]]
        return shown

    def moved(self, qpos: np.ndarray, tolerance: float) -> np.ndarray:
        """Whether any held coordinate has left its rest value by more than `tolerance`: bool [N] from [N, nq]."""
        displacement = np.abs(qpos[:, self.held_qpos] - self.rest_qpos[self.held_qpos])
        return displacement.max(axis=1, initial=0.0) > tolerance

    def mass_fields(self, kilograms: np.ndarray) -> dict[str, tuple[np.ndarray, np.ndarray]]:
        """The model fields that follow from the hidden bodies' masses, float64 [N, k]: addresses and values of each.

        They are what `mj_setConst` would compute for bodies on one slide each, at a hundredth of its cost.
        """
        return {
            "body_mass": (self.hidden_bodies, kilograms),
            "dof_M0": (self.hidden_dofs, kilograms),
            "dof_invweight0": (self.hidden_dofs, 1 / kilograms),
        }


@functools.lru_cache(maxsize=256)
def compile_xml(xml: str) -> mujoco.MjModel:
    """The model of an MJCF string, compiled once per process."""
    return mujoco.MjModel.from_xml_string(xml)


def build(mjcf_model, sensors: dict[str, tuple], held_joints, held_sensors, held_geoms, hidden_joints) -> Apparatus:
    """Compiles an MJCF model.

    Args:
      mjcf_model: a `dm_control.mjcf.RootElement`.
      sensors: for each feature, the sensor elements that make it up and the feature's shape.
      held_joints: joint elements that look at rest until something moves them.
      held_sensors, held_geoms: sensor and geom elements that show them.
      hidden_joints: slides whose bodies' masses differ from episode to episode.
    """
    model = compile_xml(mjcf_model.to_xml_string())
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    held = [model.joint(joint.full_identifier) for joint in held_joints]
    geoms = np.array([model.geom(geom.full_identifier).id for geom in held_geoms], np.intp)
    hidden = [model.joint(joint.full_identifier) for joint in hidden_joints]
    return Apparatus(
        model=model,
        readings={name: _sensors(model, elements).reshape(shape) for name, (elements, shape) in sensors.items()},
        rest_qpos=model.qpos0.copy(),
        rest={field: getattr(data, field).copy() for field in ("sensordata", "geom_xpos", "geom_xmat")},
        held_qpos=_addresses(joint.qposadr[0] + np.arange(joint.qpos0.size) for joint in held),
        held={"sensordata": _sensors(model, held_sensors), "geom_xpos": geoms, "geom_xmat": geoms},
        hidden_bodies=_addresses(joint.bodyid for joint in hidden),
        hidden_dofs=_addresses(joint.dofadr for joint in hidden),
    )


def _sensors(model: mujoco.MjModel, elements) -> np.ndarray:
    """Addresses in `sensordata` of sensor elements."""
    found = [model.sensor(element.full_identifier) for element in elements]
    return _addresses(sensor.adr[0] + np.arange(sensor.dim[0]) for sensor in found)


def _addresses(ranges) -> np.ndarray:
    return np.concatenate([np.zeros(0, np.intp), *ranges]).astype(np.intp)
