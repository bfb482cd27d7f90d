"""Many worlds at once."""

from __future__ import annotations

from operator import index
from typing import Any, Callable, Mapping, Sequence, Union

import numpy as np
import numpy.typing as npt

from . import _core
from ._numbers import count_of, numbers
from ._types import Bools, Ids, Reals
from .errors import ArgumentError, most_open, too_many
from .scenes import Scene
from .simulation import Simulation, open

__all__ = ["batch", "Batch"]

#: Values of a parameter: one a world; or a range (low, high), from which they are drawn; or a function of a generator.
Values = Union[Sequence[Any], npt.NDArray[Any], Callable[[np.random.Generator], Any]]


def batch(scene: Scene, n: int, *, seed: int = 0, vary: Mapping[str, Values] | None = None, threads: int = 0,
          **overrides: Any) -> Batch:
    """Opens a scene ``n`` times, to be stepped in one call on all threads.

    ``vary`` gives parameters that differ, by path: ``n`` values, a tuple ``(low, high)`` to draw from, or a function
    of a NumPy generator that returns ``n`` values. The same ``seed`` draws the same values. ``threads`` 0 is the
    number of cores; results do not depend on it. At most 4096 worlds are open at once: beyond, MemoryError. Raises SceneError
    as ``open`` does, and ValueError for values that are not ``n``, or that give worlds of unequal numbers of particles.

    >>> worlds = batch("rope", 8, vary={"figures.rope.weight": (1, 20)}, seed=1)
    >>> worlds.step(10)
    >>> worlds.positions.shape == (8, len(worlds.worlds[0]), 2)
    True
    """
    if index(n) < 1:
        raise ArgumentError(f"a batch has at least one world, not {n}")
    if n > most_open:
        raise too_many(f"a batch of {n} worlds has too many open simulations")
    if vary is not None and not isinstance(vary, Mapping):
        raise TypeError(f"what varies is a dict of paths and values, not {type(vary).__name__}")
    if not 0 <= index(threads) <= 1024:
        raise ArgumentError(f"a batch has 1 to 1024 threads, or 0 for as many as cores, not {threads}")
    random = np.random.default_rng(seed)
    values = {path: _drawn(path, given, n, random) for path, given in (vary or {}).items()}
    if values:
        worlds = [open(scene, {path: column[i] for path, column in values.items()}, **overrides) for i in range(n)]
    else:
        first = open(scene, **overrides)
        worlds = [first, *(first.copy() for _ in range(n - 1))]
    return Batch(worlds, values, threads)


def _drawn(path: str, given: Values, n: int, random: np.random.Generator) -> npt.NDArray[Any]:
    if callable(given):
        given = given(random)
    elif isinstance(given, tuple) and len(given) == 2:
        if not np.isfinite(numbers(given, f"{path}: a range has two numbers, not {given!r}")).all():
            raise ArgumentError(f"{path}: a range has two finite numbers, not {given!r}")
        if given[1] < given[0]:
            raise ArgumentError(f"{path}: the range ends before it begins: {given[1]} < {given[0]}")
        return random.uniform(given[0], given[1], n)
    column = np.asarray(given)
    if column.ndim == 0 or len(column) != n:
        raise ArgumentError(f"{path} has {n} values, one a world, or a range (low, high); not {given!r}")
    return column


class Batch:
    """Worlds with the same particles, stepped together. ``sinew.batch`` makes one.

    ``positions`` and ``velocities`` are arrays of (n, particles, dimension), which ``step`` and ``reset`` write anew:
    copy what should last. A world has the same bits as a simulation by itself. ``worlds`` are those simulations, for
    whatever is not here; call ``refresh`` after editing them. Particles that tearing adds are not in the arrays.
    """

    __slots__ = ("worlds", "values", "threads", "_positions", "_velocities", "_core", "_all", "_ids", "__weakref__")

    def __init__(self, worlds: Sequence[Simulation], values: Mapping[str, npt.NDArray[Any]] | None = None, threads: int = 0):
        if not worlds:
            raise ArgumentError("a batch has at least one world")
        if len(set(map(id, worlds))) < len(worlds):
            raise ArgumentError("a world is in a batch once: two threads would step it at a time; copy() makes another")
        first = worlds[0]
        shapes = {(len(world), world.dimension, world.precision) for world in worlds}
        if len(shapes) > 1:
            raise ArgumentError("worlds of a batch have equal particles, dimension and precision; these have "
                                + " and ".join(f"{count} of {precision} in {dimension}D" for count, dimension, precision in sorted(shapes)))
        self.worlds: list[Simulation] = list(worlds)
        self.values: dict[str, npt.NDArray[Any]] = dict(values or {})  #: what differs: by path, a value a world
        self.threads: int = threads or _core.hardware_threads()
        shape = (len(worlds), len(first), first.dimension)
        self._positions: Reals = np.empty(shape, first.positions.dtype)
        self._velocities: Reals = np.empty(shape, first.velocities.dtype)
        self._core = _core.Batch([world._core for world in worlds], len(first))
        self._all = np.ones(len(worlds), bool)
        self._ids: dict[str, Ids] = {}
        self.refresh()

    def __len__(self) -> int:
        """Number of worlds."""
        return len(self.worlds)

    @property
    def positions(self) -> Reals:
        """Positions, (n, particles, dimension)."""
        return self._positions

    @property
    def velocities(self) -> Reals:
        """Velocities, (n, particles, dimension)."""
        return self._velocities

    @property
    def rate(self) -> float:
        """Steps per second."""
        return self.worlds[0].rate

    def step(self, count: int = 1) -> None:
        """Takes ``count`` steps in every world. Ctrl-C ends it after a number of steps that is the same in all."""
        self._core.step(count_of(count, "a number of steps"), self._all, self._positions, self._velocities, self.threads)

    def refresh(self) -> None:
        """Reads the arrays again, after an edit of a world."""
        self._ids.clear()
        self._core.step(0, self._all, self._positions, self._velocities, 1)

    def reset(self, mask: npt.ArrayLike | None = None) -> None:
        """Returns the worlds of a mask, (n,) of truth, to their start; all without one. Their parameters stay, their
        pins are gone."""
        self._ids.clear()  # a restart makes the particles anew
        chosen = self._all if mask is None else self._mask(mask)
        self._core.restart(chosen, self.threads)
        self._core.step(0, chosen, self._positions, self._velocities, 1)

    def row(self, name: str) -> int:
        """Row of a particle in the arrays: ``positions[:, worlds.row("bob/head")]`` are its positions."""
        return self.worlds[0].particle(name).row

    def apply_force(self, name: str, forces: npt.ArrayLike) -> None:
        """Adds a force on a particle of every world for the next step: (n, dimension)."""
        if name not in self._ids:
            self._ids[name] = np.array([world.particle(name).id for world in self.worlds], np.uint64)
        self._core.apply_forces(self._ids[name], self._points(forces, "forces"))

    def pin(self, name: str) -> Pins:
        """Holds a particle of every world where it is; the pins move them."""
        pins = [world._core.pin(world.particle(name).id) for world in self.worlds]
        return Pins(self, np.array(pins, np.uint64))

    @property
    def hashes(self) -> list[str]:
        """Hash of the state of each world."""
        return [world.hash() for world in self.worlds]

    def __reduce__(self) -> tuple[Any, ...]:
        return Batch, (self.worlds, self.values, self.threads)

    def _mask(self, mask: npt.ArrayLike) -> Bools:
        chosen = np.asarray(mask)
        if chosen.dtype != bool or chosen.shape != (len(self),):
            raise ArgumentError(f"a mask has shape ({len(self)},) of truth, not {chosen.shape} of {chosen.dtype}")
        return chosen

    def _points(self, values: npt.ArrayLike, what: str) -> npt.NDArray[np.float64]:
        shape = (len(self), self.positions.shape[2])
        array = numbers(values, f"{what} have shape {shape} and are numbers")
        if array.shape != shape:
            raise ArgumentError(f"{what} have shape {shape}, not {array.shape}")
        return array

    def __repr__(self) -> str:
        n, particles, dimension = self.positions.shape
        return f"<batch of {n} worlds of {particles} particles in {dimension}D>"


class Pins:
    """Pins of one particle in every world. ``Batch.pin`` makes them."""

    def __init__(self, batch: Batch, numbers: Ids):
        self._batch, self._numbers = batch, numbers

    def move(self, to: npt.ArrayLike) -> None:
        """Sets the targets at the end of the next step, (n, dimension)."""
        self._batch._core.move_pins(self._numbers, self._batch._points(to, "targets"))
