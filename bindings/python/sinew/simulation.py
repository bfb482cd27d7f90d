"""A running scene."""

from __future__ import annotations

import fnmatch
import json
import difflib
import os
from typing import TYPE_CHECKING, Any, Iterable, Mapping, Sequence, Union

import numpy as np
import numpy.typing as npt

from . import _core
from ._types import Bools, Ids, Indices, Reals
from .errors import ArgumentError, NotFoundError
from .parts import Figure, Particle, Particles, points
from .records import ConstraintState, Contact, Event, Near, NearLink, RayHit, Report, vector
from .scenes import Files, Scene, opened, overrides_of

if TYPE_CHECKING:
    import pandas

    from .notebook import Animation

__all__ = ["Simulation", "open"]

_position, _previous, _velocity, _inverse_mass, _radius, _figure, _ends, _mobility, _asleep, _tension, _strain = range(11)
_phases = ("begin", "persist", "end")

#: A particle: its name, its id, or itself.
AnyParticle = Union[str, int, Particle]


def open(scene: Scene, overrides: Mapping[str, Any] | None = None, /, **more: Any) -> Simulation:
    """Opens a scene at its start.

    ``scene`` is a dict, JSON text, the path of a file, or a name of the catalogue. Any value of it can be set, by
    keyword or by path:

    >>> sim = open("ragdoll", mode="classic", solver={"passes": 10})
    >>> sim = open("ragdoll", {"figures.bob.height": 150})

    Raises SceneError for a scene with mistakes: its ``errors`` have line and column, and as text it reads as the
    command prints it. Raises NotFoundError for an unknown name, FileNotFoundError for a missing file.
    """
    return Simulation(*opened(scene, {**(overrides or {}), **more}))


class Simulation:
    """A running scene: particles, constraints, a clock, events. ``sinew.open`` makes one.

    Arrays such as ``positions`` are views of the simulation's memory: no copy is made, they follow the simulation as it
    steps, and cannot be written to. When particles are added or removed, take the array again: one taken before keeps
    its last values. A view stays safe to read when the simulation is gone.

    Numbers are in the units of the scene, angles in radians. One thread at a time uses a simulation, others wait; steps
    let other threads run, so several simulations step at once. ``with`` closes the simulation at the end of the block.
    """

    def __init__(self, core: _core.Simulation, files: Files):
        self._core, self._files = core, files
        info = core.info()
        self.dimension: int = info["dimension"]  #: 2 or 3
        self.precision: str = "float" if info["real_bytes"] == 4 else "double"
        self.rate: float = info["rate"]  #: steps per second
        self.size: tuple[int, int] = info["size"]  #: of the picture that the scene asks for, pixels
        self.duration: float = info["seconds"]  #: how long the scene is worth watching, seconds
        self.is_classic: bool = info["is_classic"]  #: in mode "classic"
        self.y_is_down: bool = info["y_is_down"]  #: y points down, as on screens

    # --- life -------------------------------------------------------------------------------------------------------

    def copy(self) -> Simulation:
        """A copy in the present state, which goes on by itself, with the same bits."""
        return Simulation(self._core.copy(), self._files)

    __copy__ = copy

    def __deepcopy__(self, memo: dict[int, Any]) -> Simulation:
        return self.copy()

    def close(self) -> None:
        """Frees the simulation now. Arrays taken before keep their last values."""
        self._core.close()

    def __enter__(self) -> Simulation:
        return self

    def __exit__(self, *reason: Any) -> None:
        self.close()

    # --- time -------------------------------------------------------------------------------------------------------

    def step(self, count: int = 1) -> None:
        """Takes ``count`` steps of ``1 / rate`` seconds. Ctrl-C ends it between two steps."""
        if count < 0:
            raise ArgumentError(f"a number of steps is not negative: {count}")
        if count:
            self._core.step(count)

    def run_until(self, seconds: float) -> None:
        """Steps until ``seconds`` have passed since the start, to within half a step."""
        self._core.run_until(seconds)

    def run(self, seconds: float) -> None:
        """Steps for so many seconds from now on."""
        self.run_until(self.seconds + seconds)

    def restart(self) -> None:
        """Returns to the start of the scene. Ids, pins and arrays taken before are those of particles that are gone."""
        self._core.restart()

    @property
    def seconds(self) -> float:
        """Simulated time since the start, seconds."""
        return self.report().seconds

    @property
    def steps(self) -> int:
        """Steps since the start."""
        return self.report().steps

    # --- state ------------------------------------------------------------------------------------------------------

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
        """Rows of the two ends of each link, (links, 2) of uint32: a copy. Links are constraints of kind distance."""
        return self._core.column(_ends)

    @property
    def tensions(self) -> npt.NDArray[np.float64]:
        """Force in each link in the last step, (links,): a copy. Positive when pulling; newtons in a scene of metres."""
        return self._core.column(_tension)

    @property
    def strains(self) -> npt.NDArray[np.float64]:
        """How far each link is outside its limits, as a fraction of the violated one, (links,): a copy."""
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
        return [Event(*event) for event in self._core.events(since)]

    # --- parts ------------------------------------------------------------------------------------------------------

    @property
    def figures(self) -> dict[str, Figure]:
        """The figures by name."""
        return {name: Figure(self, name) for _, name, _, _ in self._core.figures()}

    def __getitem__(self, name: str) -> Figure | Particle | Particles:
        """A figure ("bob"), a particle ("bob/head"), or the particles whose names match ("cloth/*", as file names do).

        Raises NotFoundError, which names the nearest.
        """
        if not isinstance(name, str):
            raise TypeError(f"a part has a name; rows are those of arrays: positions[{name!r}]")
        if self._core.find_figure(name):
            return Figure(self, name)
        if any(mark in name for mark in "*?["):
            found = self._matching(name)
            if len(found):
                return Particles(self, found)
        else:
            try:
                return Particle(self, name)
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
        found = self[which] if isinstance(which, str) else Particle(self, int(which))
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
        return which.id if isinstance(which, Particle) else int(which)

    def constraint(self, which: str | int) -> ConstraintState:
        """Measure, error, strain and tension of a constraint, by name or id."""
        return ConstraintState(*self._core.constraint(self._constraint_id(which)))

    def _constraint_id(self, which: str | int) -> int:
        return self._core.find_constraint(which) if isinstance(which, str) else int(which)

    def constraints(self, kind: str = "distance") -> Ids:
        """Ids of the constraints of a kind ("distance", "angle", "area", ...), (n,) of uint64. Those of kind distance
        are in the order of ``ends``, ``tensions`` and ``strains``."""
        return self._core.constraint_ids(self._kind(kind))

    @property
    def kinds(self) -> list[str]:
        """The kinds of constraints of this dimension."""
        return [kind["name"] for kind in json.loads(_core.describe("kinds"))[str(self.dimension)]]

    def _kind(self, name: str) -> int:
        kinds = self.kinds
        if name not in kinds:
            raise ArgumentError(f"no kind of constraint is called {name!r}; there are {', '.join(kinds)}")
        return kinds.index(name)

    # --- contacts and queries ---------------------------------------------------------------------------------------

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
        return Particles(self, self._core.particles_in(*self._region(center, radius, half, turn, axis)))

    def links_in(self, center: npt.ArrayLike, *, radius: float = 0, half: npt.ArrayLike | None = None,
                 turn: float = 0, axis: npt.ArrayLike = (0, 0, 1)) -> Ids:
        """Ids of the links that touch such a region, (n,) of uint64."""
        return self._core.links_in(*self._region(center, radius, half, turn, axis))

    def _region(self, center: npt.ArrayLike, radius: float, half: npt.ArrayLike | None, turn: float,
                axis: npt.ArrayLike) -> tuple[Any, ...]:
        edges = np.zeros(self.dimension) if half is None else self._point(half, "half of the edges")
        return self._point(center, "a centre"), edges, radius, turn, np.asarray(axis, np.float64)

    def _point(self, value: npt.ArrayLike, what: str = "a point") -> npt.NDArray[np.float64]:
        try:
            point = np.asarray(value, np.float64)
        except (TypeError, ValueError):
            point = np.empty(0)
        if point.shape != (self.dimension,):
            raise ArgumentError(f"{what} has {self.dimension} numbers here, not {value!r}")
        return point

    # --- edits ------------------------------------------------------------------------------------------------------

    def add_particle(self, position: npt.ArrayLike, velocity: npt.ArrayLike | None = None, *, mass: float = 1,
                     radius: float = 0) -> Particle:
        """Adds a particle; ``mass`` may be infinite: immovable."""
        still = np.zeros(self.dimension) if velocity is None else self._point(velocity, "a velocity")
        return Particle(self, self._core.add_particle(self._point(position, "a position"), still, mass, radius))

    def add_constraint(self, kind: str, particles: Sequence[AnyParticle], *, low: float | None = None,
                       high: float | None = None, compliance: float = 0, max_force: float = 0,
                       breaking_strain: float = 0) -> int:
        """Adds a constraint and returns its id.

        Without ``low`` and ``high`` it keeps the present measure; with one of them the other side is free: a rope has
        only ``high``. ``compliance`` is 1 / stiffness, 0 rigid; ``max_force`` 0 is without limit; ``breaking_strain``
        0 never breaks.
        """
        limits = (1, 0) if low is None and high is None else (-np.inf if low is None else low, np.inf if high is None else high)
        if low is not None and high is not None and low > high:
            raise ArgumentError(f"the lower limit is above the higher: {low} > {high}")
        members = np.array([self._id(particle) for particle in particles], np.uint64)
        return self._core.add_constraint(self._kind(kind), members, *limits, compliance, max_force, breaking_strain)

    def remove_constraint(self, which: str | int) -> None:
        self._core.remove_constraint(self._constraint_id(which))

    def move_collider(self, name: str, position: npt.ArrayLike, turn: float = 0, axis: npt.ArrayLike = (0, 0, 1)) -> None:
        """Sets the pose of a collider of the scene at the end of the next step, approached evenly: what touches it is
        carried along."""
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

    # --- the scene --------------------------------------------------------------------------------------------------

    @property
    def scene(self) -> dict[str, Any]:
        """The scene as a file states it, with all edits, as a new dict."""
        found: dict[str, Any] = json.loads(self._core.scene_text())
        return found

    @property
    def parameters(self) -> list[dict[str, Any]]:
        """Values that can be set: path, name, value, type, unit, low, high, choices, help."""
        found: list[dict[str, Any]] = json.loads(self._core.parameters())
        return found

    def set(self, path: str, value: Any) -> None:
        """Sets a value of the running scene: ``sim.set("world.gravity", [0, -1.6])``. Figures that it does not concern
        go on unchanged. Raises SceneError."""
        for pair in overrides_of({path: value}):
            self._core.set(pair)

    # --- tables -----------------------------------------------------------------------------------------------------

    def trace(self, seconds: float, of: str | Sequence[str] | None = None, every: int = 1) -> pandas.DataFrame:
        """Steps for so many seconds and notes where particles are, now and after each ``every`` steps.

        Returns a frame with the columns time, name, x, y (z), vx, vy (vz), a row a particle: those of the command's
        ``sinew run --trace``. ``of`` names particles and figures; all with a name if left out. Needs pandas.
        """
        from .tables import trace

        return trace(self, seconds, of, every)

    def history(self, seconds: float, *quantities: str, every: int = 1) -> pandas.DataFrame:
        """Steps for so many seconds and notes quantities, now and after each ``every`` steps.

        Returns a frame with the time as its index and a column each: "energy", "stretch", or any field of ``report()``.
        All if none is named. Needs pandas.
        """
        from .tables import history

        return history(self, seconds, quantities, every)

    def plot(self, *quantities: str, seconds: float | None = None, axes: Any = None) -> Any:
        """Steps for so many seconds, or the scene's ``duration``, and draws curves of quantities, as ``history`` has
        them: ``sim.plot("energy", "stretch")``. Returns the axes. Needs matplotlib and pandas."""
        from .plots import plot

        return plot(self, quantities, self.duration if seconds is None else seconds, axes)

    # --- pictures ---------------------------------------------------------------------------------------------------

    def draw(self, width: int | None = None, height: int | None = None, overlays: Sequence[str] = ()) -> npt.NDArray[np.uint8]:
        """A picture, (height, width, 3): red, green and blue. ``overlays``: names of ``sinew.overlays()``."""
        return self._core.pixels(*self._view(width, height, overlays))

    def _repr_png_(self) -> bytes:
        return self._core.png(*self._view())

    def play(self, seconds: float | None = None, width: int | None = None, height: int | None = None) -> Animation:
        """In a notebook, the scene from its start, moving, to be dragged with the pointer; it pauses after ``seconds``,
        or the scene's ``duration``, unless somebody holds it. It runs in the page by itself, without a network."""
        from .notebook import Animation

        return Animation(self, self.duration if seconds is None else seconds, self._view(width, height)[:2])

    def save_picture(self, path: str | os.PathLike[str], width: int | None = None, height: int | None = None,
                     overlays: Sequence[str] = ()) -> None:
        """Writes a picture: .png, .svg or .pdf."""
        from .films import film

        film(self, path, None, None, self._view(width, height, overlays))

    def save_film(self, path: str | os.PathLike[str], seconds: float, fps: float | None = None, width: int | None = None,
                  height: int | None = None, overlays: Sequence[str] = ()) -> None:
        """Steps for so many seconds and writes a film of it: .gif, .mp4 or .webp. Needs ffmpeg."""
        from .films import film

        film(self, path, seconds, fps, self._view(width, height, overlays))

    def _view(self, width: int | None = None, height: int | None = None, overlays: Sequence[str] = ()) -> tuple[int, int, int]:
        """Sides in pixels and bits of overlays. One side without the other keeps the proportions."""
        across, down = self.size
        if width is None:
            width = across if height is None else max(1, round(height * across / down))
        if height is None:
            height = down if width == across else max(1, round(width * down / across))
        if not (1 <= width <= 16384 and 1 <= height <= 16384):
            raise ArgumentError(f"the sides of a picture are 1 to 16384 pixels, not {width} x {height}")
        return width, height, _overlay_bits(overlays)

    def __repr__(self) -> str:
        try:
            report = self.report()
        except Exception as problem:
            return f"<simulation: {problem}>"
        return (f"<simulation of {len(self)} particles in {self.dimension}D, {self._core.info()['constraints']} constraints, "
                f"after {report.seconds:g} s>")


def overlays() -> list[str]:
    """Names of what a picture can show besides: tensions, velocities, ..."""
    return [overlay["name"] for overlay in json.loads(_core.describe("overlays"))]


def _overlay_bits(names: Sequence[str]) -> int:
    known = overlays()
    names = [names] if isinstance(names, str) else names
    for name in names:
        if name not in known:
            raise ArgumentError(f"no overlay is called {name!r}; there are {', '.join(known)}")
    return sum(1 << known.index(name) for name in set(names))
