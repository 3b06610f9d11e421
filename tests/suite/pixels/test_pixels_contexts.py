"""Environments that draw by turns, in any thread, and end in any order do not disturb one another."""

import ctypes.util

from images import MARKS
import interpreters
import pytest
import screens

pytestmark = MARKS


DISTURB = """
import gc
import glfw, mujoco
from physexp import suite
from physexp.suite import gymnasium
from physexp.suite.engine import gl

def play(load, *task, **more):
    environment = load(*task, **more)
    environment.reset()
    environment.step(1 if load is suite.load else [0, 1])
    return environment

features = play(suite.load, "balance", "features", task_kwargs={"random": 0})
batch = play(suite.load_batch, "strike", "features", 2, task_kwargs={"random": 0})
pixels = suite.load("towers", "fist_pixels", {"random": 0})
wrapped = gymnasium.Environment("threshold", "features", render_mode="rgb_array", random=0)
wrapped.reset()
theirs = play(suite.load, "strings", "features", task_kwargs={"random": 0})
raw = mujoco.Renderer(theirs.physics.model.ptr, 60, 80)
raw.update_scene(theirs.physics.data.ptr, "observer")
ours = {
    "environment": features.render,
    "batch": batch.render,
    "Gymnasium": wrapped.render,
    "pixels": lambda: pixels.reset().observation["pixels"],
}
guests = {"dm_control": lambda: theirs.physics.render(60, 80, camera_id="observer"), "mujoco": raw.render}
everything = guests | ours
expected = {name: draw().copy() for name, draw in everything.items()}
found["drawn"] = {name: float(image.std()) for name, image in expected.items()}
found["changed"] = []

def compare(after, painters):
    for name, draw in painters.items():
        if (draw() != expected[name]).any():
            found["changed"].append((after, name))

compare("all have drawn by turns", everything)
other = play(suite.load, "strike", "pixels", task_kwargs={"random": 0})
compare("an environment has drawn its first pixels", everything)
other.close()
compare("it is closed", everything)
other = play(suite.load_batch, "strike", "pixels", 2, task_kwargs={"random": 0})
compare("a batch has drawn its first pixels", everything)
del other
gc.collect()
compare("it is dropped", everything)
gl.check()
compare("drawing is checked", everything)
gl.renderer_name()
compare("the renderer is named", everything)
second = mujoco.Renderer(theirs.physics.model.ptr, 30, 40)
compare("another makes a context", ours)
second.close(), raw.close()
compare("another frees its contexts", ours)
passing = play(suite.load, "strings", "features", task_kwargs={"random": 0})
passing.physics.render(30, 40)
passing.close()
compare("dm_control has freed its context", ours)
assert glfw.init()
glfw.window_hint(glfw.VISIBLE, False)
window = glfw.create_window(64, 64, "theirs", None, None)
glfw.make_context_current(window)
compare("a window is current", ours)
glfw.terminate()
theirs.close()  # With OSMesa, dm_control makes noise in the end.
"""


@screens.needs_screen
@pytest.mark.parametrize("backend", ["egl", "osmesa"])
def test_no_context_of_anybodys_changes_the_pictures_of_another(backend):
    if not ctypes.util.find_library({"egl": "EGL", "osmesa": "OSMesa"}[backend]):
        pytest.skip("needs a library of GL: apt-get install libegl1 libgl1-mesa-dri libosmesa6")
    with screens.screen() as display:
        found, errors = interpreters.run(DISTURB, MUJOCO_GL=backend, DISPLAY=display)
    assert found["changed"] == []
    assert all(spread > 5 for spread in found["drawn"].values()), "an image is of one colour"
    assert errors == "", "a process that closes nothing ends in silence"


# Threads and the end.


POOL = """
import multiprocessing
import numpy as np
from physexp import suite

drawn = [suite.load("strike", "features", {"random": 0}), suite.load_batch("strike", "features", 2, {"random": 0})]

def draw():
    made = suite.load("strike", "pixels", {"random": 0})
    images = [made.reset().observation["pixels"]]
    made.close()
    for environment in drawn:
        environment.reset()
        images.append(environment.render())
    return images

here = draw()
with multiprocessing.get_context("fork").Pool(2) as pool:
    there = pool.apply_async(draw), pool.apply_async(draw)
    found["same"] = [bool((a == b).all()) for result in there for a, b in zip(here, result.get(60), strict=True)]
"""


@pytest.mark.parametrize("backend", ["egl", "osmesa"])
def test_forked_workers_of_a_pool_draw_with_environments_of_their_parent(backend):
    if not ctypes.util.find_library({"egl": "EGL", "osmesa": "OSMesa"}[backend]):
        pytest.skip("needs a library of GL: apt-get install libegl1 libgl1-mesa-dri libosmesa6")
    assert interpreters.run(POOL, MUJOCO_GL=backend) == ({"same": [True] * 6}, "")


AT_ONCE = """
import os, signal, sys, threading
from physexp import suite

sys.setswitchinterval(1e-6)
drawn = [suite.load("strike", "features", {"random": 0}) for _ in range(8)]
for environment in drawn:
    environment.reset()
begin, is_over = threading.Barrier(8), threading.Event()

def draw(environment):
    begin.wait()
    while not is_over.is_set():
        environment.render()

threads = [threading.Thread(target=draw, args=[environment]) for environment in drawn[1:]]
for thread in threads:
    thread.start()
begin.wait()
image = drawn[0].render()
found["drawing threads"] = sum(thread.name == "physexp drawing" for thread in threading.enumerate())
found["forks"] = []
for _ in range(20):
    if not (child := os.fork()):
        signal.alarm(30)
        os._exit(0 if (drawn[0].render() == image).all() else 1)
    found["forks"].append(os.waitpid(child, 0)[1])
is_over.set()
"""


def test_one_thread_draws_for_all_and_a_fork_waits_for_its_image():
    assert interpreters.run(AT_ONCE) == ({"drawing threads": 1, "forks": [0] * 20}, "")
