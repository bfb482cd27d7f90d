"""Studies: many cases of a scene, measured. ``Study("bridge.study.json").run()``; docs/how/studies.md is the manual."""

from .results import ResultsError
from .run import Study
from .spec import StudyError

__all__ = ["Study", "StudyError", "ResultsError"]
