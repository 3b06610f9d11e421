"""Chooses the GL backend, and has one thread make, use and free its off-screen contexts.

A GL context is current to a thread. All contexts of this package belong to a thread of their own: drawing leaves the
caller's current context as it is, and the caller's contexts, of any library, leave this package's as they are.
"""

from collections.abc import Callable, Iterator
from concurrent import futures
import contextlib
import ctypes
import ctypes.util
import functools
import importlib
import importlib.util
import os
from pathlib import Path
import queue
import sys
import threading
from typing import Any
import warnings

DEBIAN_PACKAGES = "Debian's libegl1 and libgl1-mesa-dri, or libosmesa6"

_PLATFORM_DEVICE = 0x313F  # EGL_PLATFORM_DEVICE_EXT
_OFF = ("disable", "disabled", "off", "false", "0")  # Words that MuJoCo takes for no GL.
_WINDOWS = ("glfw", "enable", "enabled", "on", "true", "1")  # Words that MuJoCo takes for the window system's GL.
_SAID = "PHYSEXP_SOFTWARE_RENDERING_SAID"  # Workers inherit it: one of all processes says it.
_SOFTWARE = ("llvmpipe", "softpipe", "swrast", "software rasterizer")


def prepare() -> None:
    """Chooses the backend, and imports mujoco and dm_control with it, or without GL if that fails.

    Both read the environment variables once, at import. `make_context` names a variable that they cannot follow.
    """
    backend = choose_backend()
    try:
        _import_simulators()
        if theirs := sys.modules.get("dm_control._render.pyopengl.egl_renderer"):
            from mujoco import egl

            # Both share one display, which dm_control terminates last of all: hooks run in the opposite order.
            egl.EGL_DISPLAY = egl.EGL_DISPLAY or theirs.EGL_DISPLAY
    except Exception:  # The driver, PyOpenGL and MuJoCo raise errors of many kinds.
        os.environ["MUJOCO_GL"] = "disable"
        try:
            _import_simulators()
        finally:
            os.environ["MUJOCO_GL"] = backend


def _import_simulators() -> None:
    for module in ("mujoco", "dm_control._render"):
        importlib.import_module(module)


def choose_backend() -> str:
    """Sets MUJOCO_GL, unless the user has: EGL if it works, else OSMesa if it is installed, else `disable`; returns it.

    PYOPENGL_PLATFORM, if it is set, decides between the two.
    """
    # Mesa's software renderer hands small images to threads at a greater cost than drawing them.
    os.environ.setdefault("LP_NUM_THREADS", "0")
    _load_triton()
    backend = os.environ.get("MUJOCO_GL", "").lower().strip()  # As MuJoCo reads it.
    if not backend:
        egl, osmesa = (ctypes.util.find_library(name) for name in ("EGL", "OSMesa"))
        platform = os.environ.get("PYOPENGL_PLATFORM")
        if egl and platform in (None, "egl") and _egl_works(egl):
            backend = "egl"
        else:
            backend = "osmesa" if osmesa and platform in (None, "osmesa") else "disable"
    os.environ["MUJOCO_GL"] = backend
    return backend


@functools.cache
def _load_triton() -> None:
    """Loads the library of triton, which torch's CUDA builds bring, before GL's.

    Mesa draws with LLVM, of which triton's library has a copy. Loaded after Mesa's, as by torch's optimizers, it ends
    the process with a segmentation fault (seen with triton of torch 2.13 and Mesa 22.3).
    """
    spec = importlib.util.find_spec("triton")
    for folder in (spec and spec.submodule_search_locations) or ():
        for library in Path(folder, "_C").glob("libtriton*.so"):
            ctypes.CDLL(str(library))


def _egl_works(library: str) -> bool:
    """Whether EGL has a device to draw with: it may be installed without a driver, and dm_control then fails."""
    try:
        egl = ctypes.CDLL(library)
    except OSError:
        return False
    egl.eglGetProcAddress.restype = ctypes.c_void_p

    def function(name: bytes, result: Any, *arguments: Any) -> Any:
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


_DRAWING = threading.Lock()
"""Held while a job is done and while this process is forked, so that no fork finds the driver's own locks taken."""
os.register_at_fork(before=_DRAWING.acquire, after_in_parent=_DRAWING.release, after_in_child=_DRAWING.release)

_QUEUES: dict[int, queue.SimpleQueue[Any]] = {}  # Of futures and functions; by process, since a fork has no thread.


def later(function: Callable[[], Any]) -> futures.Future[Any]:
    """Has the drawing thread of this process call a function, after its earlier jobs; the first call starts it."""
    new: queue.SimpleQueue[Any] = queue.SimpleQueue()
    jobs = _QUEUES.setdefault(os.getpid(), new)  # Of several threads that come first, one starts it.
    if jobs is new:  # It outlives the hooks of `atexit`.
        threading.Thread(target=_work, args=(jobs,), name="physexp drawing", daemon=True).start()
    future: futures.Future[Any] = futures.Future()
    jobs.put((future, function))
    return future


def _work(jobs: queue.SimpleQueue[Any]) -> None:
    while True:
        _do(*jobs.get())  # In a function of its own, which keeps nothing of the last job alive.


def _do(future: futures.Future[Any], function: Callable[[], Any]) -> None:
    try:
        with _DRAWING:
            result = function()
        future.set_result(result)
    except BaseException as error:  # The thread that waits raises it.
        future.set_exception(error)


def draw(function: Callable[[], Any]) -> Any:
    """Returns the result of a function, or raises its error, after the drawing thread has called it.

    No other thread may touch a GL context.
    """
    return later(function).result()


def make_context(size: int) -> Any:
    """Makes an off-screen GL context for images of `size` by `size` pixels; only the drawing thread calls it.

    If no GL backend works, it raises RuntimeError, which names the environment variables and a remedy.
    """
    backend = choose_backend()
    try:
        # Not mujoco.GLContext: mujoco chose its backend when it was imported, perhaps before this package.
        return importlib.import_module(f"mujoco.{_module(backend)}").GLContext(size, size)
    except Exception as error:  # The user is to read the driver's own words.
        platform = os.environ.get("PYOPENGL_PLATFORM", backend)
        variables = {"MUJOCO_GL": backend} | ({"PYOPENGL_PLATFORM": platform} if platform != backend else {})
        if device := os.environ.get("MUJOCO_EGL_DEVICE_ID"):
            variables["MUJOCO_EGL_DEVICE_ID"] = device
        settings = " and ".join(f"{name}={value}" for name, value in variables.items())
        why = " ".join(str(error).split())  # In one line.
        raise RuntimeError(
            f"no pixels can be drawn with {settings}: {why}; unset {' and '.join(variables)}, "
            f"and if that is not enough, install {DEBIAN_PACKAGES} (features need none)"
        ) from error


def _module(backend: str) -> str:
    """Returns the module of mujoco that makes a backend's contexts; raises RuntimeError if none can."""
    if backend in _OFF:
        raise RuntimeError("no GL library is here, or none is wanted")
    if backend in ("egl", "osmesa"):
        if os.environ.get("PYOPENGL_PLATFORM", backend) != backend:
            raise RuntimeError("the two differ")
        return backend
    if backend not in _WINDOWS:
        raise RuntimeError("MUJOCO_GL may be egl, osmesa or glfw")
    if sys.platform == "darwin":
        return "cgl"  # On macOS, GLFW works in the main thread alone.
    if not (os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY")):
        raise RuntimeError("there is no display")  # glfw itself says so by ending the process.
    return "glfw"


@contextlib.contextmanager
def current(context: Any) -> Iterator[None]:
    """Makes a GL context current, and afterwards none: a fork's drawing thread could not take over a current one."""
    context.make_current()
    try:
        yield
    finally:
        if choose_backend() == "egl":
            from mujoco import egl

            nothing = egl.EGL.EGL_NO_SURFACE
            egl.EGL.eglMakeCurrent(egl.EGL_DISPLAY, nothing, nothing, egl.EGL.EGL_NO_CONTEXT)


def gl_renderer_name() -> str:
    """Returns the name of the current GL context's renderer, GL_RENDERER."""
    from OpenGL import GL

    return GL.glGetString(GL.GL_RENDERER).decode()


def check() -> None:
    """Raises RuntimeError with a remedy if images cannot be drawn here."""
    draw(_name)


@functools.cache
def renderer_name() -> str:
    """Returns the name of the GL renderer that draws images in this process, or `none` and the reason."""
    try:
        return draw(_name)
    except RuntimeError as error:
        return f"none: {error}"


def _name() -> str:
    context = make_context(8)
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
    return any(Path("/dev").glob("nvidia[0-9]*")) or any(Path("/dev/dri").glob("renderD*"))
