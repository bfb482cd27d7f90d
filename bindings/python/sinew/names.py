"""Parts of a simulation by name."""

from __future__ import annotations

import difflib
import fnmatch
import json
from typing import Iterable, Union

import numpy as np

from . import _core
from ._numbers import id_of, is_name
from ._types import Ids
from .errors import ArgumentError, NotFoundError
from .parts import Figure, Particle, Particles
from .records import ConstraintState
from .state import State

#: A particle: its name, its id, or itself.
AnyParticle = Union[str, int, Particle]


class Names(State):
    """Figures, particles and constraints by name."""

    __slots__ = ()

    @property
    def figures(self) -> dict[str, Figure]:
        """The figures by name."""
        return {name: Figure(self._self, name) for _, name, _, _ in self._core.figures()}

    def __getitem__(self, name: str) -> Figure | Particle | Particles:
        """A figure ("bob"), a particle ("bob/head"), or the particles whose names match ("cloth/*", as file names do).

        Raises NotFoundError, which names the nearest.
        """
        if not isinstance(name, str):
            raise TypeError(f"a part has a name; rows are those of arrays: positions[{name!r}]")
        if is_name(name) and self._core.find_figure(name):
            return Figure(self._self, name)
        if any(mark in name for mark in "*?["):
            found = self._matching(name)
            if len(found):
                return Particles(self._self, found)
        elif is_name(name):
            try:
                return Particle(self._self, name)
            except NotFoundError:
                pass
        near = difflib.get_close_matches(name, self._part_names(), 3, 0.5)
        meant = f"; did you mean {' or '.join(map(repr, near))}?" if near else ""
        raise NotFoundError(f"no figure or particle is called {name!r}{meant}")

    def __iter__(self) -> Iterable[Figure]:
        raise TypeError("figures are in simulation.figures, particles in the rows of simulation.positions")

    def __contains__(self, name: object) -> bool:
        try:
            return isinstance(name, str) and self[name] is not None
        except NotFoundError:
            return False

    def particle(self, which: AnyParticle) -> Particle:
        """The particle with this id or name."""
        if isinstance(which, Particle):
            return which
        found = self[which] if isinstance(which, str) else Particle(self._self, id_of(which, "particle"))
        if not isinstance(found, Particle):
            raise ArgumentError(f"{which!r} is not one particle")
        return found

    def _part_names(self) -> list[str]:
        return [name for name in [*self.figures, *self.names] if name]

    _ipython_key_completions_ = _part_names

    def _matching(self, pattern: str) -> Ids:
        matches = [fnmatch.fnmatchcase(name, pattern) for name in self.names]
        return self.ids[np.array(matches, bool)]

    def _id(self, which: AnyParticle) -> int:
        if isinstance(which, str):
            return self.particle(which).id
        return which.id if isinstance(which, Particle) else id_of(which, "particle")

    def constraint(self, which: str | int) -> ConstraintState:
        """Measure, error, strain and tension of a constraint, by name or id."""
        return ConstraintState(*self._core.constraint(self._constraint_id(which)))

    def _constraint_id(self, which: str | int) -> int:
        if not isinstance(which, str):
            return id_of(which, "constraint")
        if not is_name(which):
            raise NotFoundError(f"no constraint is called {which!r}")
        return self._core.find_constraint(which)

    def constraints(self, kind: str = "distance") -> Ids:
        """Ids of the constraints of a kind ("distance", "angle", "area", ...), (n,) of uint64. Those of kind distance
        are in the order of ``ends``, ``tensions`` and ``strains``."""
        return self._core.constraint_ids(self._kind(kind))

    @property
    def kinds(self) -> list[str]:
        """The kinds of constraints of this dimension."""
        return list(self._arities)

    @property
    def _arities(self) -> dict[str, int]:
        """How many particles a constraint joins at least, by its kind."""
        return {kind["name"]: kind["particles"] for kind in json.loads(_core.describe("kinds"))[str(self.dimension)]}

    def _kind(self, name: str) -> int:
        kinds = self.kinds
        if name not in kinds:
            near = difflib.get_close_matches(name, kinds, 1) if isinstance(name, str) else []
            meant = f"did you mean {near[0]!r}? There are" if near else "there are"
            raise ArgumentError(f"no kind of constraint is called {name!r}; {meant} {', '.join(kinds)}")
        return kinds.index(name)
