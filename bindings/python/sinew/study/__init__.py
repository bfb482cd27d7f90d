"""Studies: many cases of a scene, measured. ``Study("bridge.study.json").run()``; docs/how/studies.md is the manual."""

from .file import StudyError
from .results import ResultsError
from .run import Study

__all__ = ["Study", "StudyError", "ResultsError"]
