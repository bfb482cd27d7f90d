"""State of a simulation, as arrays and numbers."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from . import _core
from ._numbers import count_of, numbers
from ._types import Bools, Ids, Indices, Reals
from .errors import ArgumentError
from .parts import points
from .records import Event, Report
from .scenes import Files

if TYPE_CHECKING:
    from .simulation import Simulation

_position, _previous, _velocity, _inverse_mass, _radius, _figure, _ends, _mobility, _asleep, _tension, _strain = range(11)


class State:
    """Arrays and numbers of a simulation."""

    # A misspelt name that is assigned to is an error, where a __dict__ would take it.
    __slots__ = ("_core", "_files", "_info", "__weakref__")

    def __init__(self, core: _core.Simulation, files: Files):
        self._core, self._files = core, files
        self._read_info()

    def _read_info(self) -> None:
        self._info: dict[str, Any] = self._core.info()

    @property
    def dimension(self) -> int:
        """2 or 3."""
        return self._info["dimension"]

    @property
    def precision(self) -> str:
        """"float" or "double"."""
        return "float" if self._info["real_bytes"] == 4 else "double"

    @property
    def rate(self) -> float:
        """Steps per second."""
        return self._info["rate"]

    @property
    def per_second(self) -> float:
        """How many of the scene's units of time a second has: 60 if it counts frames."""
        return self._info["per_second"]

    @property
    def size(self) -> tuple[int, int]:
        """Width and height of the picture that the scene asks for, pixels."""
        return self._info["size"]

    @property
    def duration(self) -> float:
        """How long the scene is worth watching, seconds."""
        return self._info["seconds"]

    @property
    def is_classic(self) -> bool:
        """True in mode "classic"."""
        return self._info["is_classic"]

    @property
    def y_is_down(self) -> bool:
        """True where y points down, as on screens."""
        return self._info["y_is_down"]

    @property
    def _self(self) -> Simulation:
        """The whole that this class is a part of."""
        from .simulation import Simulation

        assert isinstance(self, Simulation)
        return self

    def __len__(self) -> int:
        """Number of particles."""
        return len(self.inverse_masses)

    @property
    def positions(self) -> Reals:
        """Positions, (particles, dimension): a view. Assigning an array of that shape moves all particles."""
        return self._core.column(_position)

    @positions.setter
    def positions(self, values: npt.ArrayLike) -> None:
        self._core.set_positions(self.ids, points(values, len(self), self.dimension, "positions"))

    @property
    def previous(self) -> Reals:
        """Positions one step ago, (particles, dimension): a view."""
        return self._core.column(_previous)

    @property
    def velocities(self) -> Reals:
        """Velocities, (particles, dimension): a view. May be assigned."""
        return self._core.column(_velocity)

    @velocities.setter
    def velocities(self, values: npt.ArrayLike) -> None:
        self._core.set_velocities(self.ids, points(values, len(self), self.dimension, "velocities"))

    @property
    def inverse_masses(self) -> Reals:
        """Inverse masses, (particles,): a view. 0: immovable."""
        return self._core.column(_inverse_mass)

    @property
    def masses(self) -> Reals:
        """Masses, (particles,): a copy. Infinite: immovable."""
        inverse = self.inverse_masses
        return np.divide(1, inverse, out=np.full_like(inverse, np.inf), where=inverse != 0)

    @property
    def mobilities(self) -> Reals:
        """Inverse masses that the constraints see, (particles,): a view. 0 while pinned."""
        return self._core.column(_mobility)

    @property
    def radii(self) -> Reals:
        """Collision radii, (particles,): a view."""
        return self._core.column(_radius)

    @property
    def figure_indices(self) -> Indices:
        """Index of the figure of each particle, (particles,) of uint32: a view. 4294967295: none."""
        return self._core.column(_figure)

    @property
    def asleep(self) -> Bools:
        """True for particles at rest that are left out of the step until woken, (particles,): a copy."""
        return self._core.column(_asleep) != 0

    @property
    def ends(self) -> Indices:
        """Rows of the two ends of each link, (links, 2) of uint32: a view. Links are constraints of kind distance."""
        return self._core.column(_ends)

    @property
    def tensions(self) -> npt.NDArray[np.float64]:
        """Force in each link in the last step, (links,): a view. Positive when pulling; newtons in a scene of metres.

        It is computed when asked for, and again after each ``step`` or ``run`` while somebody holds it."""
        return self._core.column(_tension)

    @property
    def strains(self) -> npt.NDArray[np.float64]:
        """How far each link is outside its limits, as a fraction of the violated one, (links,): a view, computed as
        ``tensions`` are."""
        return self._core.column(_strain)

    @property
    def ids(self) -> Ids:
        """Ids of the particles, (particles,) of uint64: a copy. An id stays valid while rows move, until a restart."""
        return self._core.particle_ids()

    @property
    def names(self) -> list[str]:
        """Names of the particles by row: ["bob/head", ...]; empty text for those without."""
        return self._core.particle_names()

    def report(self) -> Report:
        """Time, energies, stretch and speed."""
        return Report(*self._core.report())

    @property
    def energy(self) -> float:
        """Kinetic, potential and stored energy."""
        return self.report().energy

    @property
    def stretch(self) -> float:
        """Largest strain of a link, as a fraction of its rest length."""
        return self.report().stretch_max

    def hash(self) -> str:
        """Hash of all state relevant to the future, 16 digits: equal on every machine, compiler and thread count."""
        return f"{self._core.hash():016x}"

    def events(self, since: int = 0) -> list[Event]:
        """The log since the start, without the first ``since`` entries: what tore, touched, was grabbed. At most
        10,000 are kept."""
        return [Event(*event) for event in self._core.events(count_of(since, "a number of entries"))]

    def _point(self, value: npt.ArrayLike, what: str = "a point") -> npt.NDArray[np.float64]:
        expected = f"{what} has {self.dimension} numbers here, not {value!r}"
        point = numbers(value, expected)
        if point.shape != (self.dimension,):
            raise ArgumentError(expected)
        return point
