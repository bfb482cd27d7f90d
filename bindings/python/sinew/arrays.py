"""Simulations from arrays of points and links."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from ._numbers import numbers
from .errors import ArgumentError
from .simulation import Simulation, open

__all__ = ["from_arrays"]


_usual_values = 400_000  #: of a scene, which the engine reads without being told to


def from_arrays(points: npt.ArrayLike, links: npt.ArrayLike = (), *, faces: npt.ArrayLike = (),
                masses: npt.ArrayLike = 1, radii: npt.ArrayLike = 0, velocities: npt.ArrayLike | None = None,
                pinned: npt.ArrayLike = (), lengths: npt.ArrayLike | None = None, compliance: npt.ArrayLike = 0,
                name: str = "body", **scene: Any) -> Simulation:
    """Opens a scene of one figure made from arrays. Row i of ``positions`` is point i, its name "body/i".

    points      (n, 2) or (n, 3), metres unless ``units`` says otherwise
    links       (m, 2) of rows: distances between two points
    faces       (f, k) of rows: drawn, without effect on the motion
    masses, radii   (n,) or one number for all; an infinite mass cannot move
    velocities  (n, dimension) or (dimension,)
    pinned      rows, or (n,) of truth: held where they are
    lengths     (m,) rest lengths; the distances of the points if left out
    compliance  (m,) or one number: 1 / stiffness, metres per newton; 0 is rigid
    scene       any section of a scene: ``world={"gravity": [0, -9.81]}``, ``solver``, ``view``, ``units``, ...

    Raises ValueError for shapes that do not fit, rows that no point has and not-a-numbers; SceneError, with the path of the
    value, for what no scene may hold: a negative mass, a link of a point to itself.

    >>> import numpy as np
    >>> sim = from_arrays(np.c_[np.arange(5), np.zeros(5)], [[0, 1], [1, 2], [2, 3], [3, 4]], pinned=[0])
    >>> sim["body/4"].position
    array([4., 0.])
    """
    places = _numbers(points, "points")
    if places.ndim != 2 or places.shape[1] not in (2, 3):
        raise ArgumentError(f"points have shape (n, 2) or (n, 3), not {places.shape}")
    count, dimension = places.shape
    ends = _rows(links, 2, count, "links")
    speeds = np.zeros(dimension) if velocities is None else _numbers(velocities, "velocities")
    columns = {"mass": (_column(masses, count, "masses"), 1), "radius": (_column(radii, count, "radii"), 0),
               "pinned": (_mask(pinned, count), False), "velocity": (_column(speeds, count, "velocities", dimension), [0] * dimension)}
    particles = {}
    for row, place in enumerate(places.tolist()):
        particle = {"at": place, **{key: values[row] for key, (values, usual) in columns.items() if values[row] != usual}}
        if particle.get("mass") == np.inf:
            del particle["mass"]
            particle["pinned"] = True
        particles[str(row)] = particle
    constraints = []
    rest = None if lengths is None else _column(lengths, len(ends), "lengths")
    soft = _column(compliance, len(ends), "compliance")
    for link, (first, second) in enumerate(ends.tolist()):
        constraint: dict[str, Any] = {"between": [str(first), str(second)]}
        if soft[link]:
            constraint["compliance"] = soft[link]
        if rest is not None:
            constraint["rest"] = rest[link]
        constraints.append(constraint)
    pieces = [{"mark": "fill", "through": [str(row) for row in face]} for face in _rows(faces, None, count, "faces").tolist()]
    figure = {"name": name, "particles": particles, "constraints": constraints, "pieces": pieces}
    # Arrays of the caller are no file of a stranger, whose number of values is limited.
    values = 12 * (count + len(ends)) + sum(1 + len(piece["through"]) for piece in pieces)
    limits = {"limits.values": values} if values > _usual_values else {}
    return open({"sinew": 1, "dimension": dimension, **scene, "figures": [figure, *scene.get("figures", [])]}, limits)


def _numbers(values: npt.ArrayLike, what: str) -> npt.NDArray[np.float64]:
    array = numbers(values, f"{what} are an array of numbers")
    if np.isnan(array).any():
        place = np.argwhere(np.isnan(array))[0]
        raise ArgumentError(f"{what} have a nan in row {int(place[0])}" if len(place) else f"{what}: nan is no number")
    return array


def _column(values: npt.ArrayLike, count: int, what: str, components: int | None = None) -> list[Any]:
    """A value per row, from one for all or one each."""
    one: tuple[int, ...] = () if components is None else (components,)
    array = _numbers(values, what)
    if array.shape not in (one, (count, *one)):
        raise ArgumentError(f"{what} have shape {(count, *one)} or {one}, not {array.shape}")
    found: list[Any] = np.broadcast_to(array, (count, *one)).tolist()
    return found


def _rows(values: npt.ArrayLike, width: int | None, count: int, what: str) -> npt.NDArray[np.int64]:
    array = np.asarray(values)
    if array.size == 0:
        return np.empty((0, width or 3), np.int64)
    if array.ndim != 2 or (width is not None and array.shape[1] != width):
        raise ArgumentError(f"{what} have shape (m, {width or 'k'}), not {array.shape}")
    if not np.issubdtype(array.dtype, np.integer):
        raise ArgumentError(f"{what} are rows, which are integers, not {array.dtype}")
    if array.min() < 0 or array.max() >= count:
        raise ArgumentError(f"{what} name row {array.max() if array.max() >= count else array.min()}; rows are 0 to {count - 1}")
    return array.astype(np.int64)


def _mask(values: npt.ArrayLike, count: int) -> list[bool]:
    array = np.asarray(values)
    mask = np.zeros(count, bool)
    if array.dtype == bool:
        if array.shape != (count,):
            raise ArgumentError(f"pinned has shape ({count},) or is a list of rows, not {array.shape}")
        mask = array
    elif array.size:
        mask[_rows(array.reshape(-1, 1), 1, count, "pinned")[:, 0]] = True
    found: list[bool] = mask.tolist()
    return found
