"""Draws images of a scene, whatever the poses of its geoms."""

import atexit
from collections.abc import Mapping
import copy
import functools
from typing import Any
import weakref

import mujoco
import numpy as np

from physexp.suite.engine import gl

SIZE = 84  # pixels, the edge of an image (paper, Section 4)
SIZE_FOR_PEOPLE = 480  # pixels
LARGEST = 4096  # pixels, that people may ask for
UNDRAWN_GROUP = 4  # Of geoms that are in no image.


class Renderer:
    """Draws images of one scene, whatever the poses of its geoms, in a GL context of its own.

    Any thread may call it, one at a time: the process's drawing thread does the work.

    Attributes:
      size: edge of an image, pixels.
      context: its GL context; None once it is closed.
      scene: the `MjvScene` that is drawn.
      buffers: the `MjrContext` that it is drawn with; None once it is closed.
    """

    def __init__(self, model: mujoco.MjModel, moving_geoms: np.ndarray, camera: str = "observer", size: int = SIZE):
        """Makes a context and uploads the scene; raises RuntimeError if no GL backend works.

        The moving geoms, int [M], whose poses differ between images, come after those that stand still.
        """
        self.size = size
        drawn = copy.copy(model)
        drawn.vis.global_.offwidth = drawn.vis.global_.offheight = size  # Software GL clears the whole buffer.
        self.context, self.buffers, drawn_by = gl.draw(functools.partial(_upload, drawn, size))
        # The drawing thread frees them, also after the renderer has been dropped.
        self._free = weakref.finalize(self, gl.later, functools.partial(_free, self.context, self.buffers))
        _close_at_exit()
        _OPEN.add(self)
        gl.warn_if_software(drawn_by)
        self.scene = _make_scene(drawn, camera)
        self._eyes = [eye.pos.astype(float) for eye in self.scene.camera]
        upside_down = np.zeros((size, size, 3), np.uint8)  # As GL reads it: the lowest row first.
        self._image = upside_down[::-1]
        rectangle = mujoco.MjrRect(0, 0, size, size)
        self._draw = functools.partial(mujoco.mjr_render, rectangle, self.scene)
        self._read = functools.partial(mujoco.mjr_readPixels, upside_down, None, rectangle)
        drawn_geoms = [geom.objid for geom in self.scene.geoms[: self.scene.ngeom]]
        self._moving = [geom for geom in drawn_geoms if geom in moving_geoms]
        first = drawn_geoms.index(self._moving[0])
        assert drawn_geoms[first:] == self._moving  # The arena, which stands still, comes first.
        self._drawn_geoms = drawn_geoms
        fields = ("rgba", "size", "pos", "mat")
        self._colors, self._sizes, positions, rotations = (_views(self.scene, field) for field in fields)
        self._positions, self._rotations = positions[first:], rotations[first:]

    def render(
        self,
        geom_xpos: np.ndarray,
        geom_xmat: np.ndarray,
        rows: np.ndarray,
        images: np.ndarray,
        camera: np.ndarray | None = None,
        colors: np.ndarray | None = None,
        sizes: Mapping[int, np.ndarray] | None = None,
    ) -> None:
        """Draws images of N poses into rows, int [N], of `images`; raises RuntimeError if the renderer is closed.

        Positions (m) and rotation matrices of geoms are [N, number of geoms, 3 and 9], displacements of the camera
        m [N, 3]. Colours of geoms, [number of geoms, 4] in [0, 1], hold from now on, and so do the last sizes of some
        geoms, m [N, 3].
        """
        if self.context is None:
            raise RuntimeError("the renderer is closed")
        positions = geom_xpos[:, self._moving].astype(np.float32)
        rotations = geom_xmat[:, self._moving].astype(np.float32)
        if colors is not None:
            self._colors[:] = colors[self._drawn_geoms]
        displaced = camera if camera is not None and camera.any() else None
        sized = [(self._drawn_geoms.index(geom), values) for geom, values in (sizes or {}).items()]
        gl.draw(functools.partial(self._draw_all, positions, rotations, sized, rows, images, displaced))

    def _draw_all(
        self,
        positions: np.ndarray,
        rotations: np.ndarray,
        sized: list[tuple[int, np.ndarray]],
        rows: np.ndarray,
        images: np.ndarray,
        displaced: np.ndarray | None,
    ) -> None:
        with gl.current(self.context):
            for number, (row, position, rotation) in enumerate(zip(rows, positions, rotations, strict=True)):
                if displaced is not None:
                    self._displace(displaced[number])
                self._positions[:] = position
                self._rotations[:] = rotation
                for place, sizes in sized:
                    self._sizes[place] = sizes[number]
                self._draw(self.buffers)
                self._read(self.buffers)
                images[row] = self._image
        if displaced is not None:
            self._displace(np.zeros(3))

    def _displace(self, camera: np.ndarray) -> None:
        for eye, place in zip(self.scene.camera, self._eyes, strict=True):
            eye.pos[:] = place + camera

    def close(self) -> None:
        """Frees the context. Closing twice does nothing."""
        self.context = self.buffers = None
        self._free()


_OPEN: weakref.WeakSet[Renderer] = weakref.WeakSet()


@functools.cache
def _close_at_exit() -> None:
    """Registers a hook that closes all renderers before the backend's own hook: the last hook runs first."""
    atexit.register(_close_all)


def _close_all() -> None:
    for renderer in list(_OPEN):
        renderer.close()
    gl.draw(lambda: None)  # It waits until all are freed.


def _upload(model: mujoco.MjModel, size: int) -> tuple[Any, Any, str]:
    """Returns a new context, its buffers for a model, and the name of the GL renderer."""
    context = gl.make_context(size)
    with gl.current(context):
        buffers = mujoco.MjrContext(model, mujoco.mjtFontScale.mjFONTSCALE_50)
        mujoco.mjr_setBuffer(mujoco.mjtFramebuffer.mjFB_OFFSCREEN.value, buffers)
        return context, buffers, gl.gl_renderer_name()


def _free(context: Any, buffers: Any) -> None:
    with gl.current(context):
        buffers.free()
    context.free()


def _make_scene(model: mujoco.MjModel, camera: str) -> mujoco.MjvScene:
    """Returns the scene in the initial state, without effects that take time and change no pixel."""
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    scene = mujoco.MjvScene(model, maxgeom=64)
    for effect in ("SHADOW", "REFLECTION", "SKYBOX", "HAZE"):
        scene.flags[getattr(mujoco.mjtRndFlag, f"mjRND_{effect}")] = False
    option = mujoco.MjvOption()
    option.geomgroup[UNDRAWN_GROUP] = False
    option.sitegroup[:] = False
    view = mujoco.MjvCamera()
    view.type = mujoco.mjtCamera.mjCAMERA_FIXED
    view.fixedcamid = model.camera(camera).id
    mujoco.mjv_updateScene(model, data, option, mujoco.MjvPerturb(), view, mujoco.mjtCatBit.mjCAT_ALL.value, scene)
    return scene


def _views(scene: mujoco.MjvScene, field: str) -> np.ndarray:
    """Returns a field of a scene's geoms, [number of geoms, ...], as a view: the bindings write one geom at a time."""
    first, second = (getattr(geom, field).ravel() for geom in scene.geoms[:2])
    stride = second.__array_interface__["data"][0] - first.__array_interface__["data"][0]
    return np.lib.stride_tricks.as_strided(first, (scene.ngeom, first.size), (stride, first.itemsize))
