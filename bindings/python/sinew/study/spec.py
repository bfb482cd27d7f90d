"""A checked study."""

from __future__ import annotations

import hashlib
import json
from dataclasses import dataclass
from pathlib import Path

from .. import _core
from ..errors import SceneError
from ..scenes import Files
from .case import Job
from .design import Design


class StudyError(SceneError):
    """A study file with mistakes."""


@dataclass(frozen=True)
class StudyFile:
    """A checked study."""

    path: Path
    about: str
    job: Job
    files: Files  #: of the scene, for pictures
    design: Design
    best: str  #: name of a measure; empty if there is none
    wants_low: bool  #: the lowest is best
    key: str  #: hash of all that results depend on


def key_of(job: Job, design: Design) -> str:
    """Hash of all that results depend on: not on the path by which the scene was found."""
    plain = [_core.version, job._replace(name="")._asdict(), {path: vars(v) for path, v in design.vary.items()},
             {path: vars(v) for path, v in design.noise.items()}, design.sample, design.cases, design.repetitions, design.seed]
    return hashlib.sha256(json.dumps(plain, sort_keys=True).encode()).hexdigest()[:16]
