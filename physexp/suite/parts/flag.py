"""The flag: a board that shows a reading by where it stands."""

from collections.abc import Sequence

from dm_control import composer, mjcf

HALF_SIZE = (0.035, 0.01, 0.035)  # m


class Flag(composer.Entity):
    """A board without contacts that stands where it is put; an `Indicator` moves it in images."""

    def _build(self, rgba: Sequence[float], name: str = "flag") -> None:
        """Builds a board of the given colour."""
        self._root = mjcf.RootElement(model=name)
        self.geom = self._root.worldbody.add(
            "geom", name="geom", type="box", size=HALF_SIZE, rgba=rgba, contype=0, conaffinity=0
        )

    @property
    def mjcf_model(self) -> mjcf.RootElement:
        return self._root


def stand(room: composer.Arena, name: str, rgba: Sequence[float], x: float, y: float) -> mjcf.Element:
    """Stands a board on the floor, m, and returns its geom."""
    board = Flag(rgba, name=name)
    room.attach(board).pos = [x, y, HALF_SIZE[2]]
    return board.geom
