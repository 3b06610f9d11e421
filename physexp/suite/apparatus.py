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
      readings: for each observation, the sensor addresses that make it up, int of the observation's shape.
      rest_qpos: `qpos` of the initial state, float64 [nq].
      rest_sensordata: sensor values of the initial state, float64 [nsensordata].
      held_qpos: addresses in `qpos` of the coordinates that look at rest until they are moved.
      held_sensors: addresses of the sensors that show them.
      hidden_bodies: the bodies whose masses differ from episode to episode.
      hidden_dofs: the degree of freedom, a slide, of each of them.
    """

    model: mujoco.MjModel
    readings: dict[str, np.ndarray]
    rest_qpos: np.ndarray
    rest_sensordata: np.ndarray
    held_qpos: np.ndarray
    held_sensors: np.ndarray
    hidden_bodies: np.ndarray
    hidden_dofs: np.ndarray

    def observe(self, sensordata: np.ndarray, touched: np.ndarray) -> dict[str, np.ndarray]:
        """What there is to see: where nothing has been touched, held parts look exactly as they did at the start.

        Args:
          sensordata: sensor values, float64 [N, nsensordata].
          touched: whether held parts have been touched, bool [N].

        Returns:
          The observations, float32 [N, ...].
        """
        shown = sensordata.copy()
        shown[np.ix_(~touched, self.held_sensors)] = self.rest_sensordata[self.held_sensors]
        return {name: shown[:, addresses].astype(np.float32) for name, addresses in self.readings.items()}

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


def build(mjcf_model, sensors: dict[str, tuple], held_joints, held_sensors, hidden_joints) -> Apparatus:
    """Compiles an MJCF model.

    Args:
      mjcf_model: a `dm_control.mjcf.RootElement`.
      sensors: for each observation, the sensor elements that make it up and the observation's shape.
      held_joints: joint elements that look at rest until something moves them.
      held_sensors: sensor elements that show them.
      hidden_joints: slides whose bodies' masses differ from episode to episode.
    """
    model = compile_xml(mjcf_model.to_xml_string())
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    held = [model.joint(joint.full_identifier) for joint in held_joints]
    hidden = [model.joint(joint.full_identifier) for joint in hidden_joints]
    return Apparatus(
        model=model,
        readings={name: _sensors(model, elements).reshape(shape) for name, (elements, shape) in sensors.items()},
        rest_qpos=model.qpos0.copy(),
        rest_sensordata=data.sensordata.copy(),
        held_qpos=_addresses(joint.qposadr[0] + np.arange(joint.qpos0.size) for joint in held),
        held_sensors=_sensors(model, held_sensors),
        hidden_bodies=_addresses(joint.bodyid for joint in hidden),
        hidden_dofs=_addresses(joint.dofadr for joint in hidden),
    )


def _sensors(model: mujoco.MjModel, elements) -> np.ndarray:
    """Addresses in `sensordata` of sensor elements."""
    found = [model.sensor(element.full_identifier) for element in elements]
    return _addresses(sensor.adr[0] + np.arange(sensor.dim[0]) for sensor in found)


def _addresses(ranges) -> np.ndarray:
    return np.concatenate([np.zeros(0, np.intp), *ranges]).astype(np.intp)
