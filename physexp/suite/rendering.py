"""The choice of a GL backend, made before dm_control is imported, which picks its own at import otherwise."""

import ctypes.util
import os

_LIBRARIES = {"egl": "EGL", "osmesa": "OSMesa"}  # In order of preference.


def choose_backend() -> str:
    """Settles MUJOCO_GL: as the user set it, or the first backend whose library is here, or `disable`.

    Feature tasks need none.
    """
    if not os.environ.get("MUJOCO_GL"):
        found = (backend for backend, library in _LIBRARIES.items() if ctypes.util.find_library(library))
        os.environ["MUJOCO_GL"] = next(found, "disable")
    return os.environ["MUJOCO_GL"]
