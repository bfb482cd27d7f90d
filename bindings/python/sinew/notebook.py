"""A simulation in a notebook: the player of the web page, without a network."""

from __future__ import annotations

import base64
import gzip
import html
import json
import posixpath
import re
from pathlib import Path
from typing import TYPE_CHECKING

from ._numbers import duration
from .errors import ArgumentError, Error

if TYPE_CHECKING:
    from .simulation import Simulation

__all__ = ["Animation"]

_entries = ("engine.js", "painters/canvas2d.js")  # imported by player.html
_import = re.compile(r'from "(\.\.?/[^"]+)"')


def web_folder() -> Path | None:
    """Folder of the engine for the browser: in the package, or in a source tree where ``./dev web`` has been."""
    own = Path(__file__).parent / "web"
    tree = Path(__file__).resolve().parents[3] / "web" / "sinew"
    return next((folder for folder in (own, tree) if (folder / "sinew.wasm").is_file()), None)


def _base64(data: bytes) -> str:
    return base64.b64encode(data).decode()


def _imported(name: str, word: str) -> str:
    """Name of the module that `name` imports by a relative word."""
    return posixpath.normpath(posixpath.join(posixpath.dirname(name), word))


def modules_of(folder: Path) -> dict[str, str]:
    """Text by name of all modules that the player needs. Imports become bare names, which the page's import map knows."""
    found: dict[str, str] = {}
    left = list(_entries)
    while left:
        name = left.pop()
        if name not in found:
            text = (folder / name).read_text(encoding="utf-8")
            left += [_imported(name, word) for word in _import.findall(text)]
            found[name] = _import.sub(lambda match: f'from "sinew/{_imported(name, match[1])}"', text)
    return found


class Animation:
    """What ``Simulation.play`` shows. ``page()`` is its HTML, for a file of its own."""

    def __init__(self, simulation: Simulation, seconds: float, size: tuple[int, int]):
        if not duration(seconds) > 0:
            raise ArgumentError(f"an animation lasts longer than {seconds} s")
        folder = web_folder()
        if folder is None:
            raise Error("the package has no engine for the browser; in a source tree ./dev web builds it")
        self._folder = folder
        self._scene, self._files = simulation.scene, simulation._files
        self._is_float = simulation.precision == "float"
        self._seconds, self._size = seconds, size

    def page(self) -> str:
        """HTML of a page without any other file: the engine for the browser and the scene. About 1.5 MB."""
        folder = self._folder
        given = {
            "scene": json.dumps(self._scene), "seconds": self._seconds, "size": self._size,
            "images": {name: _base64(Path(path.decode()).read_bytes()) for name, path in self._files.images},
            "models": dict(self._files.models),
            # The first module has worlds of double.
            "overrides": {"solver.precision": "double"} if self._is_float else {},
            "engine": _base64(gzip.compress((folder / "sinew.wasm").read_bytes(), mtime=0)),
        }
        modules = {f"sinew/{name}": "data:text/javascript;base64," + _base64(text.encode()) for name, text in modules_of(folder).items()}
        template = (Path(__file__).parent / "player.html").read_text(encoding="utf-8")
        quoted = json.dumps(given).replace("</", "<\\/")
        return template.replace("$modules", json.dumps(modules)).replace("$given", quoted)

    def save(self, path: str | Path) -> None:
        """Writes the page."""
        Path(path).write_text(self.page(), encoding="utf-8")

    def _repr_html_(self) -> str:
        width, height = self._size
        return (f'<iframe srcdoc="{html.escape(self.page())}" width="{width}" height="{height + 40}" '
                'sandbox="allow-scripts" style="border: 0; max-width: 100%"></iframe>')
