"""Pictures and films into files."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, NamedTuple

from . import _core
from ._numbers import frames_of
from .errors import ArgumentError

if TYPE_CHECKING:
    from .simulation import Simulation

_usual_fps = {".gif": 25.0}


def _refuse_zero(path: str | os.PathLike[str]) -> None:
    """The engine's paths end at a zero: another file would be written."""
    if "\0" in os.fspath(path):
        raise ArgumentError(f"a path has no zero in it: {os.fspath(path)!r}")


def film(simulation: Simulation, path: str | os.PathLike[str], seconds: float | None, fps: float | None,
         view: tuple[int, int, int]) -> None:
    """One picture if `seconds` is None. The file appears when it is complete, or not at all."""
    _refuse_zero(path)
    extension = os.path.splitext(path)[1].lower()
    is_still = extension in (".png", ".svg", ".pdf")
    if is_still != (seconds is None):
        raise ArgumentError(f"{os.fspath(path)}: " + ("a film is .gif, .mp4 or .webp" if is_still else
                                                      "a picture is .png, .svg or .pdf"))
    rate = _usual_fps.get(extension, 60.0) if fps is None else fps
    count = 1 if seconds is None else frames_of(seconds, rate)
    target = _core.Film(os.fsencode(path), view[0], view[1], rate)
    start = simulation.seconds
    for frame in range(count):
        if frame:
            simulation.run_until(start + frame / rate)
        target.add(simulation._core, *view)
    target.finish()


class Exported(NamedTuple):
    """What an export has written, and what its format could not take."""

    files: list[str]
    notes: list[str]


def export(simulation: Simulation, path: str, seconds: float | None, fps: float | None, figures: list[str],
           size: tuple[int, int], words: tuple[str, str, str], error: float | None) -> Exported:
    """One frame if the format, or the name without a number, holds one."""
    _refuse_zero(path)
    target = _core.Export(os.fsencode(path), fps, figures, size, *words, error)
    if not target.is_film and seconds is not None:
        raise ArgumentError(f"{path} is one moment: a sequence has a number in its name, such as a-%04d.obj")
    start, rate = simulation.seconds, target.fps
    length = simulation.duration if seconds is None else seconds
    for frame in range(frames_of(length, rate) if target.is_film else 1):
        if frame:
            simulation.run_until(start + frame / rate)
        target.add(simulation._core)
    target.finish()
    return Exported(target.written, target.notes)


def frames(simulation: Simulation, folder: str | os.PathLike[str], seconds: float, fps: float, part: tuple[int, int],
           view: tuple[int, int, int]) -> list[str]:
    """Writes the frames of one part of a film as PNG; every part steps through all of it."""
    number, count = part
    if not 1 <= number <= count:
        raise ArgumentError(f"a part is (i, n) with i from 1 to n, not {part}")
    length = frames_of(seconds, fps)
    os.makedirs(folder, exist_ok=True)
    start, written = simulation.seconds, []
    for frame in range(number - 1, length, count):
        simulation.run_until(start + frame / fps)
        path = os.path.join(folder, f"{frame:06}.png")
        partial = path + ".partial"
        with open(partial, "wb") as file:
            file.write(simulation._core.png(*view))
        os.replace(partial, path)
        written.append(path)
    return written
