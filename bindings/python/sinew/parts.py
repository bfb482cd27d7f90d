"""Parts of a simulation: a particle, a figure, or any selection of particles."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from ._numbers import numbers
from ._types import Ids, Reals
from .errors import ArgumentError, NotFoundError

if TYPE_CHECKING:
    from .simulation import Simulation

__all__ = ["Particle", "Particles", "Figure", "Pin"]


def points(values: npt.ArrayLike, count: int, dimension: int, what: str) -> npt.NDArray[np.float64]:
    """An array of shape (count, dimension), or (1, dimension) for one point for all; raises for any other shape."""
    array = numbers(values, f"{what} are numbers, of shape ({count}, {dimension}) or ({dimension},)")
    if array.shape == (dimension,):
        return array.reshape(1, dimension)
    if array.shape == (count, dimension):
        return array
    raise ArgumentError(f"{what} have shape ({count}, {dimension}) or ({dimension},), not {array.shape}")


class Pin:
    """Holds a particle: where it is, or at a target that moves. See ``Particle.pin``."""

    __slots__ = ("_simulation", "_number")

    def __init__(self, simulation: Simulation, number: int):
        self._simulation, self._number = simulation, number

    def move(self, to: npt.ArrayLike) -> None:
        """Sets the target at the end of the next step, (dimension,); it is approached in a straight line."""
        self._simulation._core.move_pin(self._number, self._simulation._point(to, "a target"))

    def remove(self) -> None:
        """Lets the particle go."""
        self._simulation._core.unpin(self._number)


class Particles:
    """A selection of particles of a simulation. ``simulation["cloth/*"]`` makes one; after a restart make it again.

    Arrays are views of the simulation's memory where the particles lie side by side, and copies otherwise.
    """

    __slots__ = ("_simulation", "_ids")

    def __init__(self, simulation: Simulation, ids: Ids):
        self._simulation, self._ids = simulation, ids

    @property
    def simulation(self) -> Simulation:
        """The simulation that this is a part of."""
        return self._simulation

    @property
    def ids(self) -> Ids:
        """Ids, (n,) of uint64. They stay valid while rows move, until a restart."""
        return self._ids

    @property
    def rows(self) -> npt.NDArray[np.int64]:
        """Rows in the arrays of the simulation, (n,)."""
        return self._simulation._core.rows_of(self.ids)

    @property
    def _index(self) -> slice | npt.NDArray[np.int64]:
        """The rows as a slice, if they are one."""
        rows = self.rows
        if len(rows) and rows[-1] - rows[0] + 1 == len(rows) and (np.diff(rows) == 1).all():
            return slice(int(rows[0]), int(rows[-1]) + 1)
        return rows

    def __len__(self) -> int:
        return len(self.ids)

    @property
    def names(self) -> list[str]:
        """Names of the particles: ["bob/head", ...]."""
        all_names = self._simulation.names
        return [all_names[row] for row in self.rows]

    @property
    def positions(self) -> Reals:
        """Positions, (n, dimension). Assigning moves the particles, without giving them a velocity."""
        return self._simulation.positions[self._index]

    @positions.setter
    def positions(self, values: npt.ArrayLike) -> None:
        self._edit("set_positions", values, "positions")

    @property
    def velocities(self) -> Reals:
        """Velocities, (n, dimension). May be assigned."""
        return self._simulation.velocities[self._index]

    @velocities.setter
    def velocities(self, values: npt.ArrayLike) -> None:
        self._edit("set_velocities", values, "velocities")

    @property
    def masses(self) -> Reals:
        """Masses, (n,), a copy; infinite for what cannot move."""
        return self._simulation.masses[self._index]

    @property
    def radii(self) -> Reals:
        """Collision radii, (n,)."""
        return self._simulation.radii[self._index]

    @property
    def center(self) -> npt.NDArray[np.float64]:
        """Centre of mass of the particles that can move, or the mean position if none can; (dimension,)."""
        masses = self.masses.astype(np.float64)
        moves = np.isfinite(masses)
        if not moves.any():
            return np.asarray(self.positions.mean(axis=0), np.float64)
        return np.average(self.positions[moves].astype(np.float64), axis=0, weights=masses[moves])

    def apply_force(self, force: npt.ArrayLike) -> None:
        """Adds a force on each particle for the next step: (dimension,) or (n, dimension)."""
        self._edit("apply_forces", force, "forces")

    def apply_impulse(self, impulse: npt.ArrayLike) -> None:
        """Adds an impulse to each particle: (dimension,) or (n, dimension)."""
        self._edit("apply_impulses", impulse, "impulses")

    def remove(self) -> None:
        """Removes the particles with all their constraints."""
        for number in self.ids.tolist():
            self._simulation._core.remove_particle(number)

    def _edit(self, what: str, values: npt.ArrayLike, called: str) -> None:
        ids = self.ids
        getattr(self._simulation._core, what)(ids, points(values, len(ids), self._simulation.dimension, called))

    def __repr__(self) -> str:
        return f"<{len(self)} particles>"


class Figure(Particles):
    """A figure of the scene: what a prefab built, or a list of particles. ``simulation["bob"]`` finds one."""

    __slots__ = ("_name",)

    def __init__(self, simulation: Simulation, name: str):
        self._simulation, self._name = simulation, name

    def _state(self) -> tuple[int, str, str, bool]:
        state = self._simulation._core.find_figure(self._name)
        if state is None:
            raise NotFoundError(f"the figure {self._name!r} is gone")
        return state

    @property
    def name(self) -> str:
        """Name in the scene."""
        return self._name

    @property
    def prefab(self) -> str:
        """Name of the prefab: "ragdoll"; empty if made by hand."""
        return self._state()[2]

    @property
    def is_quarantined(self) -> bool:
        """True if it is frozen, because a number became infinite or not-a-number."""
        return self._state()[3]

    @property
    def ids(self) -> Ids:
        """Ids of the particles in the figure, (n,) of uint64."""
        return self._simulation.ids[self._index]

    @property
    def rows(self) -> npt.NDArray[np.int64]:
        """Rows in the arrays of the simulation, (n,)."""
        return np.flatnonzero(self._simulation.figure_indices == self._state()[0])

    def __getitem__(self, name: str) -> Particle | Particles:
        """The particle, or selection, of this figure: ``simulation["bob"]["head"]`` is ``simulation["bob/head"]``."""
        found = self._simulation[f"{self._name}/{name}"]
        assert not isinstance(found, Figure)
        return found

    def _ipython_key_completions_(self) -> list[str]:
        return [name.removeprefix(self._name + "/") for name in self.names if name]

    def __repr__(self) -> str:
        return f"<figure {self._name!r}: {self.prefab or 'by hand'}, {len(self)} particles>"


class Particle:
    """A particle. ``simulation["bob/head"]`` finds one by name, which also lasts over a restart;
    ``simulation.particle(id)`` has that of an id."""

    __slots__ = ("_simulation", "_which")

    def __init__(self, simulation: Simulation, which: str | int):
        self._simulation, self._which = simulation, which
        self.row  # raises where there is none

    @property
    def simulation(self) -> Simulation:
        """The simulation that this is a part of."""
        return self._simulation

    @property
    def id(self) -> int:
        """Stays valid while rows move, until a restart."""
        which = self._which
        return self._simulation._core.find_particle(which) if isinstance(which, str) else which

    @property
    def _ids(self) -> Ids:
        return np.array([self.id], np.uint64)

    @property
    def row(self) -> int:
        """Row in the arrays of the simulation. Raises NotFoundError once the particle has been removed."""
        return int(self._simulation._core.rows_of(self._ids)[0])

    @property
    def name(self) -> str:
        """"bob/head"; empty if it has none."""
        return self._simulation.names[self.row]

    @property
    def position(self) -> Reals:
        """Position, (dimension,): a view, which follows the particle. Assigning moves it."""
        return self._simulation.positions[self.row]

    @position.setter
    def position(self, value: npt.ArrayLike) -> None:
        self._edit("set_positions", value, "a position")

    @property
    def velocity(self) -> Reals:
        """Velocity, (dimension,). May be assigned."""
        return self._simulation.velocities[self.row]

    @velocity.setter
    def velocity(self, value: npt.ArrayLike) -> None:
        self._edit("set_velocities", value, "a velocity")

    @property
    def mass(self) -> float:
        """Mass; infinite if it cannot move. May be assigned, above 0."""
        inverse = float(self._simulation.inverse_masses[self.row])
        return 1 / inverse if inverse else float("inf")

    @mass.setter
    def mass(self, value: float) -> None:
        self._simulation._core.set_mass(self.id, value)

    @property
    def radius(self) -> float:
        """Collision radius."""
        return float(self._simulation.radii[self.row])

    def apply_force(self, force: npt.ArrayLike) -> None:
        """Adds a force for the next step, (dimension,)."""
        self._edit("apply_forces", force, "a force")

    def apply_impulse(self, impulse: npt.ArrayLike) -> None:
        """Adds an impulse, (dimension,)."""
        self._edit("apply_impulses", impulse, "an impulse")

    def pin(self) -> Pin:
        """Holds the particle where it is; the pin moves it and lets it go."""
        return Pin(self._simulation, self._simulation._core.pin(self.id))

    def remove(self) -> None:
        """Removes the particle with all its constraints."""
        self._simulation._core.remove_particle(self.id)

    def _edit(self, what: str, value: npt.ArrayLike, called: str) -> None:
        point = self._simulation._point(value, called).reshape(1, -1)
        getattr(self._simulation._core, what)(self._ids, point)

    def __eq__(self, other: Any) -> bool:
        return isinstance(other, Particle) and (self._simulation, self.id) == (other._simulation, other.id)

    def __hash__(self) -> int:
        return hash((id(self._simulation), self._which))

    def __repr__(self) -> str:
        return f"<particle {self.name!r} at {', '.join(f'{x:g}' for x in self.position)}>"
