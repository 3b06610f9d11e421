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
      held_qpos: addresses in `qpos` of the coordinates that are held until they are moved.
      held_qvel: addresses in `qvel` of the same.
      hidden_bodies: the bodies whose masses differ from episode to episode.
      hidden_dofs: the degree of freedom, a slide, of each of them.
    """

    model: mujoco.MjModel
    readings: dict[str, np.ndarray]
    rest_qpos: np.ndarray
    held_qpos: np.ndarray
    held_qvel: np.ndarray
    hidden_bodies: np.ndarray
    hidden_dofs: np.ndarray

    def read(self, name: str, sensordata: np.ndarray) -> np.ndarray:
        """One observation, float32 [..., *shape], from sensor values float64 [..., nsensordata]."""
        return sensordata[..., self.readings[name]].astype(np.float32)

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


def build(mjcf_model, sensors: dict[str, tuple], held_joints, hidden_joints) -> Apparatus:
    """Compiles an MJCF model.

    Args:
      mjcf_model: a `dm_control.mjcf.RootElement`.
      sensors: for each observation, the sensor elements that make it up and the observation's shape.
      held_joints: joint elements that are held at rest until something moves them.
      hidden_joints: slides whose bodies' masses differ from episode to episode.
    """
    model = compile_xml(mjcf_model.to_xml_string())
    readings = {}
    for name, (elements, shape) in sensors.items():
        found = [model.sensor(element.full_identifier) for element in elements]
        addresses = [np.arange(sensor.adr[0], sensor.adr[0] + sensor.dim[0]) for sensor in found]
        readings[name] = np.concatenate(addresses).reshape(shape)
    held = [model.joint(joint.full_identifier) for joint in held_joints]
    hidden = [model.joint(joint.full_identifier) for joint in hidden_joints]
    return Apparatus(
        model=model,
        readings=readings,
        rest_qpos=model.qpos0.copy(),
        held_qpos=_addresses(joint.qposadr[0] + np.arange(joint.qpos0.size) for joint in held),
        held_qvel=_addresses(joint.dofadr[0] + np.arange(joint.damping.size) for joint in held),
        hidden_bodies=_addresses(joint.bodyid for joint in hidden),
        hidden_dofs=_addresses(joint.dofadr for joint in hidden),
    )


def _addresses(ranges) -> np.ndarray:
    return np.concatenate([np.zeros(0, np.intp), *ranges]).astype(np.intp)
