"""Pictures and films into files."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

from . import _core
from .errors import ArgumentError

if TYPE_CHECKING:
    from .simulation import Simulation

_usual_fps = {".gif": 25.0}


def film(simulation: Simulation, path: str | os.PathLike[str], seconds: float | None, fps: float | None,
         view: tuple[int, int, int]) -> None:
    """One picture if `seconds` is None. The file appears when it is complete, or not at all."""
    extension = os.path.splitext(path)[1].lower()
    is_still = extension in (".png", ".svg", ".pdf")
    if is_still != (seconds is None):
        raise ArgumentError(f"{os.fspath(path)}: " + ("a film is .gif, .mp4 or .webp" if is_still else
                                                      "a picture is .png, .svg or .pdf"))
    rate = _usual_fps.get(extension, 60.0) if fps is None else fps
    if not rate > 0:
        raise ArgumentError(f"a film has more than {rate} frames a second")
    target = _core.Film(os.fsencode(path), view[0], view[1], rate)
    start = simulation.seconds
    for frame in range(1 if seconds is None else max(1, round(seconds * rate))):
        if frame:
            simulation.run_until(start + frame / rate)
        target.add(simulation._core, *view)
    target.finish()


def frames(simulation: Simulation, folder: str | os.PathLike[str], seconds: float, fps: float, part: tuple[int, int],
           view: tuple[int, int, int]) -> list[str]:
    """Writes the frames of one part of a film as PNG; every part steps through all of it."""
    number, count = part
    if not (1 <= number <= count and fps > 0):
        raise ArgumentError(f"a part is (i, n) with i from 1 to n, and a film has frames; not {part} at {fps} a second")
    os.makedirs(folder, exist_ok=True)
    start, written = simulation.seconds, []
    for frame in range(number - 1, max(1, round(seconds * fps)), count):
        simulation.run_until(start + frame / fps)
        path = os.path.join(folder, f"{frame:06}.png")
        partial = path + ".partial"
        with open(partial, "wb") as file:
            file.write(simulation._core.png(*view))
        os.replace(partial, path)
        written.append(path)
    return written
