"""Edits between steps, and the pointer."""

from __future__ import annotations

from typing import Sequence

import numpy as np
import numpy.typing as npt

from ._numbers import is_name
from .errors import ArgumentError, NotFoundError
from .names import AnyParticle, Names
from .parts import Particle


class Edits(Names):
    """Adding, removing, grabbing and cutting."""

    __slots__ = ()

    def add_particle(self, position: npt.ArrayLike, velocity: npt.ArrayLike | None = None, *, mass: float = 1,
                     radius: float = 0) -> Particle:
        """Adds a particle at a position with a velocity, (dimension,) each; ``mass`` may be infinite: immovable. Raises
        ValueError for a mass or radius below 0 and for numbers that are not finite."""
        still = np.zeros(self.dimension) if velocity is None else self._point(velocity, "a velocity")
        return Particle(self._self, self._core.add_particle(self._point(position, "a position"), still, mass, radius))

    def add_constraint(self, kind: str, particles: Sequence[AnyParticle], *, low: float | None = None,
                       high: float | None = None, compliance: float = 0, max_force: float = 0,
                       breaking_strain: float = 0) -> int:
        """Adds a constraint and returns its id.

        Without ``low`` and ``high`` it keeps the present measure; with one of them the other side is free: a rope has
        only ``high``. ``compliance`` is 1 / stiffness, 0 rigid; ``max_force`` 0 is without limit; ``breaking_strain``
        0 never breaks. Measures are lengths, areas and volumes in the units of the scene, angles in radians. Raises
        ValueError for an unknown kind, another number of particles or numbers out of range, NotFoundError for particles.
        """
        limits = (1, 0) if low is None and high is None else (-np.inf if low is None else low, np.inf if high is None else high)
        if low is not None and high is not None and low > high:
            raise ArgumentError(f"the lower limit is above the higher: {low} > {high}")
        if low == np.inf or high == -np.inf:
            raise ArgumentError(f"no measure is within these limits: {low} to {high}")
        number = self._kind(kind)
        members = np.array([self._id(particle) for particle in particles], np.uint64)
        try:
            return self._core.add_constraint(number, members, *limits, compliance, max_force, breaking_strain)
        except ArgumentError as problem:
            if not str(problem).endswith("so many particles"):
                raise
            message = f"a constraint of kind {kind!r} joins {self._arities[kind]} particles, not {len(particles)}"
            raise ArgumentError(message) from None

    def remove_constraint(self, which: str | int) -> None:
        """Removes the constraint with this name or id. Raises NotFoundError."""
        self._core.remove_constraint(self._constraint_id(which))

    def move_collider(self, name: str, position: npt.ArrayLike, turn: float = 0, axis: npt.ArrayLike = (0, 0, 1)) -> None:
        """Sets the pose of a collider of the scene at the end of the next step, approached evenly: what touches it is
        carried along."""
        if not is_name(name):
            raise NotFoundError(f"no collider is called {name!r}")
        self._core.move_collider(self._core.find_collider(name), self._point(position, "a position"), turn,
                                 np.asarray(axis, np.float64))

    # --- pointer ----------------------------------------------------------------------------------------------------

    def grab(self, at: AnyParticle | npt.ArrayLike, radius: float = 0) -> bool:
        """Grabs a particle, or in 2D whatever is within ``radius`` of a point, as a pointer does: with a force of 100
        times gravity at most. False if nothing that could move is there. ``drag`` moves it, ``let_go`` releases it.
        """
        if isinstance(at, (str, int, Particle)):
            return self._core.grab_particle(self._id(at))
        return self._core.grab(self._point(at), radius)

    def drag(self, to: npt.ArrayLike) -> None:
        """Target of the held point at the end of the next step, (dimension,)."""
        self._core.drag(self._point(to))

    def let_go(self) -> None:
        """Releases what is held; it keeps its velocity."""
        self._core.let_go()

    def point_at(self, at: npt.ArrayLike) -> None:
        """Position of the pointer, for pins that follow it, (dimension,)."""
        self._core.point_at(self._point(at))

    def cut(self, start: npt.ArrayLike, end: npt.ArrayLike) -> int:
        """Cuts every link that crosses a line, as seen in the scene's own view. Returns the number cut."""
        return self._core.cut(self._point(start), self._point(end))
