"""Contacts and queries."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from ._types import Ids
from .parts import Particles
from .records import Contact, Near, NearLink, RayHit, vector
from .names import Names

_phases = ("begin", "persist", "end")


class Queries(Names):
    """What touches, and what is where."""

    __slots__ = ()

    def list_contacts(self, on: bool = True) -> None:
        """Lists touches of figures with each other and with planes of world.bounds, too, from the next step on."""
        self._core.list_contacts(on)

    def contacts(self) -> list[Contact]:
        """Contacts in the last step: always those with colliders; others after ``list_contacts()``."""
        names = {index: name for index, name, _, _ in self._core.figures()}
        found = []
        for row in self._core.contacts():
            phase, impulse, blow, before, particle, other, collider, figure, other_figure, name = row
            found.append(Contact(_phases[phase], impulse, blow, before, particle, other, collider, names.get(figure),
                                 names.get(other_figure), name))
        return found

    def nearest_particle(self, at: npt.ArrayLike, reach: float = 1e12) -> Near | None:
        """The particle whose surface is nearest to a point (dimension,), within ``reach``; None if there is none."""
        found = self._core.nearest_particle(self._point(at), reach)
        return found and Near(*found)

    def nearest_link(self, at: npt.ArrayLike, reach: float = 1e12) -> NearLink | None:
        """The link nearest to a point (dimension,), within ``reach``; None if there is none."""
        found = self._core.nearest_link(self._point(at), reach)
        return found and NearLink(*found)

    def cast_ray(self, start: npt.ArrayLike, end: npt.ArrayLike, radius: float = 0, mask: int = 0xFFFFFFFF) -> RayHit | None:
        """The first particle with a radius, collider or plane that a sphere meets on its way; None if nothing is met.

        ``radius`` 0 is a ray; only layers of ``mask`` count.
        """
        found = self._core.cast_ray(self._point(start), self._point(end), radius, mask)
        if found is None:
            return None
        share, at, normal, particle, collider = found
        return RayHit(share, vector(at, self.dimension), vector(normal, self.dimension), particle, collider)

    def particles_in(self, center: npt.ArrayLike, *, radius: float = 0, half: npt.ArrayLike | None = None,
                     turn: float = 0, axis: npt.ArrayLike = (0, 0, 1)) -> Particles:
        """Particles that touch a circle or sphere (``radius``), or a box (``half`` of its edges, turned by ``turn``
        radians, in 3D about ``axis``)."""
        return Particles(self._self, self._core.particles_in(*self._region(center, radius, half, turn, axis)))

    def links_in(self, center: npt.ArrayLike, *, radius: float = 0, half: npt.ArrayLike | None = None,
                 turn: float = 0, axis: npt.ArrayLike = (0, 0, 1)) -> Ids:
        """Ids of the links that touch such a region, (n,) of uint64."""
        return self._core.links_in(*self._region(center, radius, half, turn, axis))

    def _region(self, center: npt.ArrayLike, radius: float, half: npt.ArrayLike | None, turn: float,
                axis: npt.ArrayLike) -> tuple[Any, ...]:
        edges = np.zeros(self.dimension) if half is None else self._point(half, "half of the edges")
        return self._point(center, "a centre"), edges, radius, turn, np.asarray(axis, np.float64)
