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


def renderer() -> str:
    """What draws: the GL renderer's own name, or why there is none."""
    backend = choose_backend()
    if backend not in ("egl", "osmesa", "glfw"):
        return "none: install Debian's libegl1 and libgl1-mesa-dri, or libosmesa6 (feature tasks need none)"
    import mujoco

    try:
        context = mujoco.GLContext(8, 8)
    except Exception as error:  # Whatever the driver raises is what the user wants to read.
        return f"none: {backend} does not work here ({error})"
    context.make_current()
    from OpenGL import GL

    name = GL.glGetString(GL.GL_RENDERER).decode()
    context.free()
    return name
