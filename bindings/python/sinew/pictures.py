"""Pictures of a simulation."""

from __future__ import annotations

import json
import os
from typing import TYPE_CHECKING, Any, Sequence

import numpy as np
import numpy.typing as npt

from . import _core
from .errors import ArgumentError
from .state import State

if TYPE_CHECKING:
    from .films import Exported
    from .notebook import Animation


class Pictures(State):
    """Pictures, films and the player of a notebook."""

    __slots__ = ()

    def draw(self, width: int | None = None, height: int | None = None, overlays: Sequence[str] = ()) -> npt.NDArray[np.uint8]:
        """A picture, (height, width, 3): red, green and blue. ``overlays``: names of ``sinew.overlays()``."""
        return self._core.pixels(*self._view(width, height, overlays))

    def _repr_png_(self) -> bytes:
        return self._core.png(*self._view())

    def play(self, seconds: float | None = None, width: int | None = None, height: int | None = None) -> Animation:
        """In a notebook, the scene from its start, moving, to be dragged with the pointer; it pauses after ``seconds``,
        or the scene's ``duration``, unless somebody holds it. It runs in the page by itself, without a network. Raises Error
        where the package has no engine for the browser."""
        from .notebook import Animation

        return Animation(self._self, self.duration if seconds is None else seconds, self._view(width, height)[:2])

    def save_picture(self, path: str | os.PathLike[str], width: int | None = None, height: int | None = None,
                     overlays: Sequence[str] = ()) -> None:
        """Writes a picture: .png, .svg or .pdf."""
        from .films import film

        film(self._self, path, None, None, self._view(width, height, overlays))

    def save_film(self, path: str | os.PathLike[str], seconds: float, fps: float | None = None, width: int | None = None,
                  height: int | None = None, overlays: Sequence[str] = ()) -> None:
        """Steps for so many seconds and writes a film of it: .gif, .mp4 or .webp. Needs ffmpeg."""
        from .films import film

        film(self._self, path, seconds, fps, self._view(width, height, overlays))

    def save_frames(self, folder: str | os.PathLike[str], seconds: float, fps: float = 25, part: tuple[int, int] = (1, 1),
                    width: int | None = None, height: int | None = None, overlays: Sequence[str] = ()) -> list[str]:
        """Steps for so many seconds and writes frames, 000000.png and on, into a folder; returns their paths.

        ``part`` (i, n) writes every n-th from the i-th on, i from 1: n processes, on any machines that see the folder,
        render a film together. All parts have the same bits, so no seam shows.
        """
        from .films import frames

        return frames(self._self, folder, seconds, fps, part, self._view(width, height, overlays))

    def export(self, path: str | os.PathLike[str], seconds: float | None = None, fps: float | None = None,
               figures: Sequence[str] = (), width: int | None = None, height: int | None = None, background: str = "",
               follow: str = "", caption: str = "", error: float | None = None) -> Exported:
        """Writes a file of another program, by its ending: .glb, .pc2, .mdd, .obj or .ply; moving .svg or Lottie's .json;
        a trace as .csv or .jsonl; .png, .apng, .webm or .mov, transparent with ``background="none"``.

        A film takes ``seconds`` (the scene's ``duration`` if left out), and the simulation is stepped by them; an .obj,
        .ply or .png is the present moment, or a sequence with a number in its name: ``"silk-%04d.obj"``. ``figures`` are
        those that are written alone. ``error`` is by how much points may be off between keys: pixels, in a .glb millimetres. The
        result has the ``files`` and ``notes`` about what the format could not take.
        """
        from .films import export

        return export(self._self, os.fspath(path), seconds, fps, list(figures), self._view(width, height)[:2],
                      (background, follow, caption), error)

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
