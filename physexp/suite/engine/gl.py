"""Chooses the GL backend, makes its off-screen contexts, and names the renderer that draws."""

import contextlib
import ctypes
import ctypes.util
import functools
import glob
import importlib
import importlib.util
import os
import warnings

DEBIAN_PACKAGES = "Debian's libegl1 and libgl1-mesa-dri, or libosmesa6"


_PLATFORM_DEVICE = 0x313F  # EGL_PLATFORM_DEVICE_EXT
_OFF = ("disable", "disabled", "off", "false", "0")  # What MuJoCo understands as no GL.
_SAID = "PHYSEXP_SOFTWARE_RENDERING_SAID"  # Workers inherit it: one of all processes says it.
_SOFTWARE = ("llvmpipe", "softpipe", "swrast", "software rasterizer")


def choose_backend() -> str:
    """Sets MUJOCO_GL, unless the user has: EGL if it works, else OSMesa if it is installed, else `disable`; returns it.

    To be called before mujoco and dm_control are imported, which look at it once. Feature tasks need no backend.
    """
    # Mesa's software renderer hands small images to threads at a greater cost than drawing them.
    os.environ.setdefault("LP_NUM_THREADS", "0")
    _load_triton()
    if not os.environ.get("MUJOCO_GL"):
        egl, osmesa = (ctypes.util.find_library(name) for name in ("EGL", "OSMesa"))
        if egl and _egl_works(egl):
            os.environ["MUJOCO_GL"] = "egl"
        else:
            os.environ["MUJOCO_GL"] = "osmesa" if osmesa else "disable"
    return os.environ["MUJOCO_GL"].lower().strip()  # As MuJoCo reads it.


@functools.cache
def _load_triton() -> None:
    """Loads the library of triton, which torch's CUDA builds bring, before GL's.

    Mesa draws with LLVM, of which triton's library has a copy. Loaded after Mesa's, as by torch's optimizers, it ends
    the process with a segmentation fault (seen with triton of torch 2.13 and Mesa 22.3).
    """
    spec = importlib.util.find_spec("triton")
    for folder in (spec and spec.submodule_search_locations) or ():
        for library in glob.glob(os.path.join(folder, "_C", "libtriton*.so")):
            ctypes.CDLL(library)


def _egl_works(library: str) -> bool:
    """Whether EGL has a device to draw with: it may be installed without a driver, and dm_control then fails."""
    try:
        egl = ctypes.CDLL(library)
    except OSError:
        return False
    egl.eglGetProcAddress.restype = ctypes.c_void_p

    def function(name: bytes, result, *arguments):
        address = egl.eglGetProcAddress(name)
        return ctypes.CFUNCTYPE(result, *arguments)(address) if address else None

    pointer, number = ctypes.c_void_p, ctypes.c_int
    query = function(b"eglQueryDevicesEXT", number, number, ctypes.POINTER(pointer), ctypes.POINTER(number))
    display = function(b"eglGetPlatformDisplayEXT", pointer, number, pointer, pointer)
    initialize = function(b"eglInitialize", number, pointer, pointer, pointer)
    devices, count = (pointer * 16)(), number()
    if not (query and display and initialize) or not query(16, devices, ctypes.byref(count)):
        return False
    return any(initialize(display(_PLATFORM_DEVICE, device, None), None, None) for device in devices[: count.value])


def make_context(size: int):
    """Makes an off-screen GL context for images of `size` by `size` pixels.

    Raises:
      RuntimeError: if no GL backend works; it says what to install.
    """
    backend = choose_backend()
    if backend in _OFF:
        raise RuntimeError(f"no GL library is here to draw pixels with; install {DEBIAN_PACKAGES} (features need none)")
    try:
        if backend not in ("egl", "osmesa") and not (os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY")):
            raise RuntimeError("there is no display")  # glfw itself says so by ending the process.
        # Not mujoco.GLContext, which is what MUJOCO_GL said when mujoco was imported, perhaps before this package.
        module = backend if backend in ("egl", "osmesa") else "glfw"
        return importlib.import_module(f"mujoco.{module}").GLContext(size, size)
    except Exception as error:  # Whatever the driver raises is what the user wants to read.
        why = " ".join(str(error).split())  # In one line.
        raise RuntimeError(
            f"the GL backend {backend} (MUJOCO_GL) does not work here: {why}; install {DEBIAN_PACKAGES}, "
            "or set MUJOCO_GL to egl, osmesa or glfw"
        ) from error


@contextlib.contextmanager
def current(context):
    """Makes a GL context current in this thread, and afterwards what was current before, where the backend can tell.

    So any thread may draw, and whoever else draws here (dm_control for one, which remembers what it made current) finds
    its own context as it was.
    """
    backend = choose_backend()
    if backend == "egl":
        from mujoco import egl

        before = egl.EGL.eglGetCurrentContext() or egl.EGL.EGL_NO_CONTEXT
        put_back = functools.partial(egl.EGL.eglMakeCurrent, egl.EGL_DISPLAY, *[egl.EGL.EGL_NO_SURFACE] * 2, before)
    elif backend == "osmesa":
        from OpenGL import GL, osmesa

        put_back = functools.partial(osmesa.OSMesaMakeCurrent, None, None, GL.GL_FLOAT, 0, 0)
    else:
        import glfw

        put_back = functools.partial(glfw.make_context_current, glfw.get_current_context())
    context.make_current()
    try:
        yield
    finally:
        put_back()


def gl_renderer_name() -> str:
    """Returns the name of the current GL context's renderer, GL_RENDERER."""
    from OpenGL import GL

    return GL.glGetString(GL.GL_RENDERER).decode()


def check() -> None:
    """Makes sure that images can be drawn here.

    Raises:
      RuntimeError: if no GL backend works; it says what to install.
    """
    make_context(8).free()


@functools.cache
def renderer_name() -> str:
    """Returns the name of the GL renderer that draws images in this process, or why there is none."""
    try:
        context = make_context(8)
    except RuntimeError as error:
        return f"none: {error}"
    with current(context):
        name = gl_renderer_name()
    context.free()
    return name


def is_software(name: str) -> bool:
    """Whether a GL renderer of this name draws on the CPU."""
    return any(software in name.lower() for software in _SOFTWARE)


def warn_if_software(name: str) -> None:
    """Warns, once in all processes, that images are drawn on the CPU although the machine has a GPU."""
    if is_software(name) and gpu_is_present() and _SAID not in os.environ:
        os.environ[_SAID] = "1"
        warnings.warn(
            f"PIXELS ARE DRAWN BY THE PROCESSOR ({name}) although this machine has a GPU: "
            "its EGL driver is not visible; install it, or set MUJOCO_GL",
            RuntimeWarning,
            stacklevel=2,
        )


def gpu_is_present() -> bool:
    """Whether the system lists a GPU's device."""
    return bool(glob.glob("/dev/nvidia[0-9]*") + glob.glob("/dev/dri/renderD*"))
