"""A running scene."""

from __future__ import annotations

import json
import os
from typing import TYPE_CHECKING, Any, Mapping, Sequence

from ._numbers import count_of
from .edits import Edits
from .errors import ArgumentError
from .pictures import Pictures
from .queries import Queries
from .scenes import Scene, opened, overrides_of
from .snapshots import Saved, Snapshot, files_of_snapshot, loaded, saved_in, snapshot_of, unpickled, write

if TYPE_CHECKING:
    import pandas

__all__ = ["Simulation", "open"]


def open(scene: Scene | bytes, overrides: Mapping[str, Any] | None = None, /, **more: Any) -> Simulation:
    """Opens a scene at its start.

    ``scene`` is a dict, JSON text, the path of a file, or a name of the catalogue. Any value of it can be set, by
    keyword or by path:

    >>> sim = open("ragdoll", mode="classic", solver={"passes": 10})
    >>> sim = open("ragdoll", {"figures.bob.height": 150})

    Raises SceneError for a scene with mistakes: its ``errors`` have line and column, and as text it reads as the
    command prints it. Raises NotFoundError for an unknown name, FileNotFoundError for a missing file.

    What ``Simulation.save`` returned or wrote, or the command's ``sinew run --save``, goes on where it was saved.
    """
    if overrides is not None and not isinstance(overrides, Mapping):
        raise TypeError(f"overrides are a dict of paths and values, not {type(overrides).__name__}")
    values = {**(overrides or {}), **more}
    snapshot = snapshot_of(scene)
    if snapshot is None:
        return Simulation(*opened(scene, values))  # type: ignore[arg-type]
    if values:
        raise ArgumentError("a snapshot goes on as it was saved; Simulation.set changes values of what runs")
    return Simulation(*loaded(snapshot))


class Simulation(Queries, Edits, Pictures):
    """A running scene: particles, constraints, a clock, events. ``sinew.open`` makes one.

    Arrays such as ``positions`` are views of the simulation's memory: no copy is made, they follow the simulation as it
    steps, and cannot be written to. When particles are added or removed, take the array again: one taken before keeps
    its last values. A view stays safe to read when the simulation is gone.

    Numbers are in the units of the scene, angles in radians. One thread at a time uses a simulation, others wait; steps
    let other threads run, so several simulations step at once. ``with`` closes the simulation at the end of the block.
    """

    __slots__ = ()

    # --- life -------------------------------------------------------------------------------------------------------

    def copy(self) -> Simulation:
        """A copy in the present state, which goes on by itself, with the same bits."""
        return Simulation(self._core.copy(), self._files)

    __copy__ = copy

    def __deepcopy__(self, memo: dict[int, Any]) -> Simulation:
        return self.copy()

    def save(self, path: str | os.PathLike[str] | None = None) -> bytes:
        """The present state as bytes: scene with all edits, particles, clock, events and grabs. ``path`` names a file to
        write it to as well. ``restore`` and ``sinew.open`` go on from it, on any machine, with the same bits, and so do
        the commands ``sinew run`` and ``sinew play``; a simulation can be pickled, too."""
        data = self._core.save(os.fsencode(self._files.source))
        if path is not None:
            write(data, path)
        return data

    def restore(self, saved: Saved) -> None:
        """Returns to a state that ``save`` returned or wrote, of this simulation or of any other of the same dimension
        and precision. Ids and pins are those of that moment; arrays taken before keep their last values. Raises
        ValueError for anything else, and changes nothing then."""
        snapshot = saved_in(saved)
        files = files_of_snapshot(snapshot, self._files)
        self._core.restore(snapshot.data, files.images, files.models)
        self._files = files
        self._read_info()

    def __reduce__(self) -> tuple[Any, ...]:
        return unpickled, (self._core.save(os.fsencode(self._files.source)), self._files)

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
        if taken := count_of(count, "a number of steps"):
            self._core.step(taken)

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

    # --- the scene --------------------------------------------------------------------------------------------------

    @property
    def scene(self) -> dict[str, Any]:
        """The scene as a file states it, with the edits of ``set``, as a new dict. ``save`` also has what calls and events
        have added."""
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
        ``sinew run --trace``, in the scene's own units, time too. ``of`` names particles and figures; all with a name if
        left out. Needs pandas.
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

    def __repr__(self) -> str:
        try:
            report = self.report()
        except Exception as problem:
            return f"<simulation: {problem}>"
        return (f"<simulation of {len(self)} particles in {self.dimension}D, {self._core.info()['constraints']} constraints, "
                f"after {report.seconds:g} s>")
