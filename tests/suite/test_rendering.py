"""Rendering: which GL backend draws, what happens without one, and how contexts come and go."""

import ctypes.util
import os
import warnings

import interpreters
import numpy as np
import pytest
import torch

from physexp import suite
from physexp.cli import doctor
from physexp.suite import gymnasium
from physexp.suite.engine import gl, rendering

HEAVIER = ("which_is_heavier", "pixels")
LIBRARIES = ("EGL", "OSMesa")
PACKAGES = ("libegl1", "libgl1-mesa-dri", "libosmesa6")  # Debian's.
NO_DISPLAY = {"DISPLAY": None, "WAYLAND_DISPLAY": None}
# The renderer itself is not tested here.
pytestmark = pytest.mark.filterwarnings("ignore:PIXELS ARE DRAWN BY THE PROCESSOR")

needs_gl = pytest.mark.skipif(
    gl.choose_backend() == "disable", reason=f"needs GL: apt-get install {' '.join(PACKAGES)}"
)


def _needs_library(name: str) -> None:
    if not ctypes.util.find_library(name):
        pytest.skip(f"needs lib{name}: apt-get install {' '.join(PACKAGES)}")


# Defines `play_features()`, and `draw()`: errors of an environment and of a batch that draw, and the images' means.
PLAY = """
from physexp import suite

def play_features():
    for domain_name, task_name in suite.ALL_TASKS:
        if task_name.endswith("features"):
            env = suite.load(domain_name, task_name, {"random": 0})
            env.reset()
            env.step(0)
            env.close()
    batch = suite.load_batch("which_is_heavier", "features", 2, {"random": 0})
    batch.reset()
    batch.step([0, 1])
    batch.close()
    return True

def draw():
    errors, means = [], []
    for size in (None, 2):
        try:
            if size is None:
                environment = suite.load("which_is_heavier", "pixels", {"random": 0})
            else:
                environment = suite.load_batch("which_is_heavier", "pixels", size, {"random": 0})
            means.append(float(environment.reset().observation["pixels"].mean()))
            environment.close()
        except Exception as error:
            errors.append((type(error).__name__, str(error)))
    return {"errors": errors, "means": means}
"""


def _assert_drawn(drawn: dict) -> None:
    assert drawn["errors"] == []
    assert all(50 < mean < 250 for mean in drawn["means"]), "the images are black or white"


def _assert_refused(drawn: dict, *fragments: str) -> None:
    """Each of the two says in one RuntimeError what to install."""
    assert [name for name, _ in drawn["errors"]] == ["RuntimeError"] * 2, drawn
    for _, message in drawn["errors"]:
        assert all(fragment in message for fragment in (*PACKAGES, *fragments)), message


# The choice of a backend.


def _pretend(*installed: str) -> str:
    """Code after which the package, and nothing else, finds at most these of the GL libraries."""
    return f"""
import ctypes.util, os, sys
find_library = ctypes.util.find_library
def pretend(name):
    asks = sys._getframe(1).f_globals["__name__"]
    if name in {LIBRARIES!r} and asks.startswith("physexp"):
        return find_library(name) if name in {installed!r} else None
    return find_library(name)
ctypes.util.find_library = pretend
"""


CHOOSE = """
import physexp.suite
found.update(backend=os.environ["MUJOCO_GL"], threads=os.environ["LP_NUM_THREADS"])
"""


@pytest.mark.parametrize(
    "installed, backend", [(LIBRARIES, "egl"), (("OSMesa",), "osmesa"), ((), "disable")], ids=["both", "OSMesa", "none"]
)
def test_without_a_choice_the_backend_is_egl_then_osmesa_then_none(installed, backend):
    """And Mesa draws in the calling thread."""
    if installed:
        _needs_library(installed[0])
    found, _ = interpreters.run(_pretend(*installed) + CHOOSE, MUJOCO_GL=None, LP_NUM_THREADS=None)
    assert found == {"backend": backend, "threads": "0"}


# Machines that cannot draw.

HIDE_GL = """
import ctypes.util, os, sys
find_library = ctypes.util.find_library
def is_gl(name):
    return any(part in os.path.basename(str(name)) for part in ("GL", "OSMesa", "glfw"))
ctypes.util.find_library = lambda name: None if is_gl(name) else find_library(name)
def refuse(event, arguments):
    if event == "ctypes.dlopen" and is_gl(arguments[0]):
        raise OSError(f"{arguments[0]}: cannot open shared object file: No such file or directory")
sys.addaudithook(refuse)
try:
    ctypes.CDLL("libEGL.so.1")
except OSError:
    found["hidden"] = True
"""


def test_without_gl_libraries_pixels_say_what_to_install():
    found, stderr = interpreters.run(
        f"""
{HIDE_GL}
{PLAY}
from physexp.suite.engine import gl
found["played"] = play_features()
found["drawn"] = draw()
found["name"] = gl.renderer_name()
found["played_again"] = play_features()
""",
        MUJOCO_GL=None,
    )
    assert found["hidden"] and found["played"] and found["played_again"]
    _assert_refused(found["drawn"])
    assert found["name"].startswith("none: ") and PACKAGES[0] in found["name"]
    assert stderr == ""


def test_without_a_gl_driver_pixels_say_what_to_install(tmp_path):
    """As on a machine that has libegl1 without libgl1-mesa-dri."""
    _needs_library("EGL")
    found, _ = interpreters.run(
        f"{_pretend('EGL')}\n{PLAY}\nfound['played'] = play_features()\nfound['drawn'] = draw()",
        MUJOCO_GL=None,
        LIBGL_DRIVERS_PATH=str(tmp_path),
        __EGL_VENDOR_LIBRARY_DIRS=str(tmp_path),
        __EGL_VENDOR_LIBRARY_FILENAMES=None,
    )
    assert found["played"]
    _assert_refused(found["drawn"])


@pytest.mark.parametrize(
    "variables", [{"MUJOCO_GL": "nonsense"}, {"MUJOCO_GL": "egl", "PYOPENGL_PLATFORM": "osmesa"}], ids=str
)
def test_a_variable_that_keeps_pixels_from_being_drawn_is_named(variables):
    """By the error and by the doctor, for which features play."""
    found, stderr = interpreters.run(
        f"""
{HIDE_GL}
{PLAY}
from physexp.cli import doctor
found["drawn"] = draw()
found["checks"] = {{check["check"]: check for check in doctor.examine()["checks"]}}
""",
        **variables,
    )
    assert stderr == "" and found["checks"]["environments"]["verdict"] == doctor.OK
    settings = [f"{name}={value}" for name, value in variables.items()]
    _assert_refused(found["drawn"], *settings, f"unset {' and '.join(variables)}")
    check = found["checks"]["OpenGL"]
    assert all(setting in check["found"] for setting in settings)
    assert check["advice"].startswith(f"unset {' and '.join(variables)}")


@needs_gl
@pytest.mark.parametrize(
    "first, choice",
    [
        ("from dm_control import suite", None),
        ("import mujoco", gl.choose_backend().upper()),  # dm_control takes no capitals.
    ],
)
def test_pixels_are_drawn_whatever_was_imported_first_or_spelled_how(first, choice):
    found, _ = interpreters.run(f"{first}\n{PLAY}\nfound['drawn'] = draw()", MUJOCO_GL=choice, **NO_DISPLAY)
    _assert_drawn(found["drawn"])


# Contexts.


@needs_gl
def test_no_context_is_made_before_the_first_image():
    """Not by playing with features, or by loading and reading the specs of pixel tasks."""
    found, _ = interpreters.run(
        f"""
import mujoco  # MUJOCO_GL is set.
made = []
make = mujoco.GLContext.__init__
mujoco.GLContext.__init__ = lambda self, *args: (made.append(1), make(self, *args))[1]
{PLAY}
play_features()
pixels = suite.load("which_is_heavier", "pixels", {{"random": 0}})
pixels.observation_spec(), pixels.action_spec()
found["counts"] = [len(made)]
for _ in range(3):
    pixels.reset(), pixels.step(0)
found["counts"].append(len(made))
""",
        MUJOCO_GL=gl.choose_backend(),
    )
    assert found["counts"] == [0, 1]


@needs_gl
@pytest.mark.filterwarnings("error:The given NumPy array")
def test_torch_takes_every_image_as_it_is():
    """It takes no array of negative strides, and warns of one that cannot be written to."""
    single, batch = suite.load(*HEAVIER, {"random": 0}), suite.load_batch(*HEAVIER, 2, {"random": 0})
    wrapped = gymnasium.Environment(*HEAVIER, render_mode="rgb_array", random=0)
    vector = gymnasium.VectorEnvironment(*HEAVIER, 2, render_mode="rgb_array", random=0)
    images = [single.reset().observation["pixels"], single.step(0).observation["pixels"], single.render()]
    images += [batch.reset().observation["pixels"], batch.step([0, 1]).observation["pixels"], batch.render()]
    images += [wrapped.reset()[0]["pixels"], wrapped.step(0)[0]["pixels"], wrapped.render()]
    images += [vector.reset()[0]["pixels"], vector.step([0, 1])[0]["pixels"], *vector.render()]
    for image in images:
        assert image.flags.c_contiguous
        torch.from_numpy(image)[:] = 77  # They are the caller's own.
    again = [single.render(), single.step(0).observation["pixels"]]
    again += [batch.render(), *batch.step([0, 1]).observation["pixels"]]
    assert all((image != 77).any() for image in again)
    for environment in (single, batch, wrapped, vector):
        environment.close()


# The renderer.


@pytest.mark.parametrize(
    "name, has_gpu, is_said",
    [
        *((name, True, True) for name in ("llvmpipe (LLVM 15.0.6)", "softpipe", "Software Rasterizer", "swrast")),
        *((name, True, False) for name in ("NVIDIA H100/PCIe/SSE2", "Mesa Intel(R) UHD Graphics 620", "AMD Radeon")),
        ("llvmpipe (LLVM 15.0.6)", False, False),
    ],
)
def test_drawing_by_software_beside_a_gpu_warns_once_in_all_processes(name, has_gpu, is_said, monkeypatch):
    monkeypatch.setenv(gl._SAID, "")  # So that it is restored afterwards.
    monkeypatch.delenv(gl._SAID)
    monkeypatch.setattr(gl, "gpu_is_present", lambda: has_gpu)
    with warnings.catch_warnings(record=True) as warned:
        warnings.simplefilter("always")
        for _ in range(3):
            gl.warn_if_software(name)
    assert [name in str(warning.message) for warning in warned] == [True] * is_said
    assert (gl._SAID in os.environ) == is_said  # Which processes that this one starts inherit.


DRAW_ALL = """
import numpy as np
from physexp import suite
images = []
for domain_name, task_name, actions in (("which_is_heavier", "pixels", [0, 1, 2]), ("towers", "fist_pixels", [0] * 5)):
    env = suite.load(domain_name, task_name, {"random": 0})
    images += [env.reset().observation["pixels"], *(env.step(a).observation["pixels"] for a in actions)]
    env.close()
"""


def test_osmesa_draws_what_egl_draws_within_one_level(tmp_path):
    for library in LIBRARIES:
        _needs_library(library)
    images = []
    for backend in ("egl", "osmesa"):
        path = tmp_path / f"{backend}.npy"
        interpreters.run(f"{DRAW_ALL}\nnp.save({str(path)!r}, images)", MUJOCO_GL=backend)
        images.append(np.load(path).astype(int))
    assert images[0].shape == (10, rendering.SIZE, rendering.SIZE, 3) and images[0].std() > 10
    assert np.abs(images[0] - images[1]).max() <= 1
