"""Running states as bytes."""

from __future__ import annotations

import contextlib
import os
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple, Union

from . import _core
from .errors import ArgumentError
from .scenes import Files, Source, files_of, path_of

if TYPE_CHECKING:
    from .simulation import Simulation

_begin = b"SINEWSNP"

#: What ``Simulation.save`` returned or wrote.
Saved = Union[bytes, bytearray, memoryview, str, "os.PathLike[str]"]


class Snapshot(NamedTuple):
    """A running state, and the folder of the files that its scene names, unless it tells its own."""

    data: bytes
    folder: Path


def snapshot_of(scene: object) -> Snapshot | None:
    """The snapshot in bytes, or in the file of a path; None for anything else."""
    if isinstance(scene, (bytes, bytearray, memoryview)):
        return Snapshot(bytes(scene), Path())
    if not isinstance(scene, (str, os.PathLike)) or (isinstance(scene, str) and scene.lstrip().startswith("{")):
        return None
    return _snapshot_at(path_of(scene))


def saved_in(saved: object) -> Snapshot:
    """The snapshot in bytes, or in the file of a path, which is no name of the catalogue. Raises ArgumentError for anything else,
    OSError for a file that cannot be read."""
    if isinstance(saved, os.PathLike) or (isinstance(saved, str) and not saved.lstrip().startswith("{")):
        found = _snapshot_at(Path(saved))
    else:
        found = snapshot_of(saved)
    if found is None:
        raise ArgumentError("what save() returned or wrote is expected")
    return found


def _snapshot_at(path: Path) -> Snapshot | None:
    with open(path, "rb") as file:
        begin = file.read(len(_begin))
        return Snapshot(begin + file.read(), path.parent) if begin == _begin else None


def files_of_snapshot(snapshot: Snapshot, own: Files = Files([], [])) -> Files:
    """Images and models of the scene; those of `own` where the snapshot's folder has none. Raises ArgumentError."""
    text, file = _core.scene_of_snapshot(snapshot.data)
    source = os.fsdecode(file)
    folder = Path(source).parent if source and Path(source).is_file() else snapshot.folder
    found = files_of(Source(text.decode("utf-8", "replace"), source, folder))
    images, models = {**dict(own.images), **dict(found.images)}, {**dict(own.models), **dict(found.models)}
    return Files(list(images.items()), list(models.items()), source)


def loaded(snapshot: Snapshot) -> tuple[_core.Simulation, Files]:
    """Raises ArgumentError for bytes that no simulation of this version saved."""
    files = files_of_snapshot(snapshot)
    return _core.Simulation.load(snapshot.data, files.images, files.models), files


def unpickled(data: bytes, files: Files) -> Simulation:
    from .simulation import Simulation

    return Simulation(_core.Simulation.load(data, files.images, files.models), files)


def write(data: bytes, path: str | os.PathLike[str]) -> None:
    """The file appears when it is complete, or not at all."""
    partial = Path(f"{os.fspath(path)}.partial")
    try:
        partial.write_bytes(data)
        os.replace(partial, path)
    except OSError as problem:
        with contextlib.suppress(OSError):
            partial.unlink(missing_ok=True)
        raise OSError(problem.errno, problem.strerror, os.fspath(path)) from None
