"""Scenes: where they come from, and the files they name."""

from __future__ import annotations

import difflib
import json
import os
from pathlib import Path
from typing import Any, Iterator, Mapping, NamedTuple, Union

from . import _core
from ._numbers import is_name
from .errors import ArgumentError, Diagnostic, NotFoundError, SceneError

#: A scene: a dict, JSON text, the path of a file, or a name of the catalogue.
Scene = Union[Mapping[str, Any], str, "os.PathLike[str]"]

__all__ = ["Scene", "catalogue", "catalogue_folder", "check", "prefabs", "schema"]


def catalogue_folder() -> Path:
    """Folder of the scenes with a name, the first of: ``SINEW_SCENES`` of the environment; the package's own; in a source
    tree, its scenes."""
    wanted = os.environ.get("SINEW_SCENES")
    own = Path(__file__).parent / "scenes"
    if wanted:
        return Path(wanted)
    return own if own.is_dir() else Path(__file__).resolve().parents[3] / "scenes"


def catalogue() -> list[str]:
    """Names of the scenes that come with the package, in alphabetical order.

    >>> "ragdoll" in catalogue()
    True
    """
    return sorted(path.stem for path in catalogue_folder().glob("*.json"))


class Source(NamedTuple):
    """The text of a scene, its name in messages, the folder of the files it names, and whether that is its own."""

    text: str
    name: str
    folder: Path
    is_file: bool = False


def source_of(scene: Scene) -> Source:
    source = _source_of(scene)
    if "\0" in source.text:
        raise ArgumentError(f"{source.name}: the scene has a zero byte")
    return source


def _source_of(scene: Scene) -> Source:
    if isinstance(scene, Mapping):
        return Source(_json_of(scene), "scene", Path())
    if isinstance(scene, str) and scene.lstrip().startswith("{"):
        return Source(scene, "scene", Path())
    if not isinstance(scene, (str, os.PathLike)):
        raise TypeError(f"a scene is a dict, JSON text, a path or a name of the catalogue, not {type(scene).__name__}")
    path = path_of(scene)
    return Source(path.read_text(encoding="utf-8", errors="surrogateescape"), str(path), path.parent, True)


def _json_of(value: Any) -> str:
    try:
        return json.dumps(value, default=_plain, ensure_ascii=False)
    except TypeError as problem:
        raise TypeError(f"a scene holds what JSON can say: {problem}") from None
    except (ValueError, RecursionError):
        raise ArgumentError("a scene holds what JSON can say: this one contains itself, or is too deep") from None


def _plain(value: Any) -> Any:
    """Numbers and arrays of NumPy as Python's."""
    if hasattr(value, "tolist"):
        return value.tolist()
    raise TypeError(f"no {type(value).__name__}, as {value!r}")


def path_of(scene: str | os.PathLike[str]) -> Path:
    """A bare word is a name of the catalogue first; a word with a dot or a slash is a path."""
    path = Path(scene)
    if not os.fspath(scene):
        raise ArgumentError("the name of a scene is empty (sinew.catalogue() lists them)")
    is_name = isinstance(scene, str) and not ("." in scene or "/" in scene or os.sep in scene)
    named = catalogue_folder() / f"{scene}.json"
    if is_name and named.exists():
        return named
    if path.is_dir():
        raise IsADirectoryError(f"{path} is a folder, not a scene file")
    if path.exists():
        return path
    near = difflib.get_close_matches(path.stem, catalogue(), 1, 0.5 if is_name else 0.8)
    help_text = f"; did you mean {near[0]!r}?" if near else ""
    if is_name:
        raise NotFoundError(f"no scene is called {scene!r}{help_text} (sinew.catalogue() lists them)")
    raise FileNotFoundError(f"there is no file {str(path)!r}" + (f"; the catalogue has {near[0]!r}" if near else ""))


def overrides_of(values: Mapping[str, Any]) -> list[str]:
    """Pairs "path=value" of a dict, whose values may be dicts: {"solver": {"substeps": 16}} is "solver.substeps=16"."""
    try:
        pairs = [f"{path}={_value_text(value)}" for path, value in _leaves(values, "")]
    except RecursionError:
        raise ArgumentError("a value contains itself, or is too deep") from None
    for pair in pairs:
        if not is_name(pair):
            raise ArgumentError(f"a value has a zero or half of a character: {pair!r}")
    return pairs


def _leaves(values: Mapping[str, Any], prefix: str) -> Iterator[tuple[str, Any]]:
    for name, value in values.items():
        if not isinstance(name, str):
            raise TypeError(f"the name of a value is text, not {type(name).__name__}: {name!r}")
        if isinstance(value, Mapping) and value:
            yield from _leaves(value, f"{prefix}{name}.")
        else:
            yield prefix + name, value


def _value_text(value: Any) -> str:
    return value if isinstance(value, str) else _json_of(value)


def _under(document: Any, key: str) -> Iterator[Any]:
    """Values of a document under any key of this name."""
    if isinstance(document, Mapping):
        for name, value in document.items():
            if name == key:
                yield value
            yield from _under(value, key)
    elif isinstance(document, list):
        for value in document:
            yield from _under(value, key)


def _document(text: str) -> Any:
    """A scene as data, for the names of its files; mistakes are the engine's to tell."""
    lines = ("" if line.lstrip().startswith("//") else line for line in text.splitlines())
    try:
        return json.loads("\n".join(lines))
    except (ValueError, RecursionError):
        return {}


class Files(NamedTuple):
    """Files that a scene names: paths of images and texts of models."""

    images: list[tuple[str, bytes]]
    models: list[tuple[str, str]]
    source: str = ""  #: path of the scene's own file; empty if it has none


def files_of(source: Source) -> Files:
    try:
        return _files_of(source)
    except RecursionError:  # deeper than the engine reads, which says so
        return Files([], [])


def _files_of(source: Source) -> Files:
    document = _document(source.text)
    images = {}
    for image in _under(document, "image"):
        name = image.get("file") if isinstance(image, Mapping) else image
        if isinstance(name, str) and (source.folder / name).is_file():
            images[name] = os.fsencode(source.folder / name)
    models = {}
    for name in _under(document, "file"):
        if isinstance(name, str) and name.endswith(".obj") and (source.folder / name).is_file():
            models[name] = (source.folder / name).read_text(encoding="utf-8", errors="replace")
    return Files(list(images.items()), list(models.items()), str(Path(source.name).absolute()) if source.is_file else "")


def opened(scene: Scene, overrides: Mapping[str, Any]) -> tuple[_core.Simulation, Files]:
    source = source_of(scene)
    files = files_of(source)
    text = source.text.encode("utf-8", "surrogateescape")
    core = _core.Simulation(text, os.fsencode(source.name), overrides_of(overrides), files.images, files.models)
    return core, files


def check(scene: Scene, overrides: Mapping[str, Any] | None = None, /, **more: Any) -> list[Diagnostic]:
    """The mistakes of a scene, each with line, column and what was meant; empty if there are none. Values are set as
    ``sinew.open`` does.

    >>> [mistake.message for mistake in check({"sinew": 1, "figures": [{"prefab": "rope", "lenght": 2}]})]
    ['unknown property "lenght"']
    """
    try:
        opened(scene, {**(overrides or {}), **more})[0].close()
        return []
    except SceneError as error:
        return error.errors


def schema() -> dict[str, Any]:
    """JSON Schema of scene files, for the completion of an editor."""
    found: dict[str, Any] = json.loads(_core.describe("schema"))
    return found


def prefabs() -> list[dict[str, Any]]:
    """The prefabs: name, about, and parameters with type, unit, range and help."""
    found: list[dict[str, Any]] = json.loads(_core.describe("prefabs"))
    return found
