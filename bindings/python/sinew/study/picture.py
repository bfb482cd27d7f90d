"""A case as files: its scene, a picture of its end, and a page that plays it."""

from __future__ import annotations

import contextlib
import json
import os
import shutil
import time
from pathlib import Path
from typing import Any

from ..errors import Error
from ..scenes import Files
from .case import Failed, advance, simulation_of, within
from .measures import Measures
from .spec import StudyFile

_patience = 20.0  #: real seconds for a picture; a case that takes longer is shown as it is then


def picture_case(study: StudyFile, number: int, values: dict[str, Any], folder: Path) -> str:
    """Writes NUMBER.json, .png and .html into a folder; returns the name of the file to open, or "" where the values make
    no scene. The scene's images and models go beside it, so that the folder can be taken elsewhere."""
    patience = min(_patience, study.job.time_limit)
    try:
        simulation = simulation_of(study.job, values, study.files.images)
    except Error:
        return ""
    with simulation:
        scene = _with_files(simulation.scene, study.files, folder)
        (folder / f"{number}.json").write_text(json.dumps(scene, indent=1), encoding="utf-8")
        link = f"{number}.json"
        with contextlib.suppress(Error):  # without the engine for the browser the link is the scene itself
            simulation.play(study.job.seconds or 1).save(folder / f"{number}.html")
            link = f"{number}.html"
        with contextlib.suppress(Failed), within(patience):
            advance(study.job, simulation, Measures.none(simulation), time.perf_counter() + patience)
        simulation.save_picture(folder / f"{number}.png", width=320)
    return link


def _with_files(scene: Any, files: Files, folder: Path) -> Any:
    """The scene with the names of its files as they are in `folder`/files, where they are copied to."""
    names: dict[str, str] = {}
    for name, path in files.images:
        names[name] = _beside(name, names, folder)
        shutil.copyfile(path, folder / names[name])
    for name, text in files.models:
        names[name] = _beside(name, names, folder)
        (folder / names[name]).write_text(text, encoding="utf-8")
    return _renamed(scene, names) if names else scene


def _beside(name: str, names: dict[str, str], folder: Path) -> str:
    (folder / "files").mkdir(exist_ok=True)
    stem, ending = os.path.splitext(os.path.basename(name))
    found = f"files/{stem}{ending}"
    return found if found not in names.values() else f"files/{stem}-{len(names)}{ending}"


def _renamed(value: Any, names: dict[str, str], key: str = "") -> Any:
    if isinstance(value, dict):
        return {name: _renamed(inner, names, name) for name, inner in value.items()}
    if isinstance(value, list):
        return [_renamed(inner, names, key) for inner in value]
    return names.get(value, value) if isinstance(value, str) and key in ("image", "file") else value
