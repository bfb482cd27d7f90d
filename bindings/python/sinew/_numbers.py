"""Numbers that users give."""

from __future__ import annotations

import math
from operator import index

import numpy as np
import numpy.typing as npt

from .errors import ArgumentError, NotFoundError


def numbers(values: npt.ArrayLike, expected: str) -> npt.NDArray[np.float64]:
    """Real numbers as an array; complex ones, dates and words are none."""
    try:
        given = np.asarray(values)
        if given.dtype.kind not in "biufO":
            raise ArgumentError(expected)
        return given.astype(np.float64, copy=False)
    except (TypeError, ValueError):
        raise ArgumentError(expected) from None


def id_of(which: object, what: str) -> int:
    """Raises TypeError for what is no whole number, NotFoundError for one that no id can be."""
    number = index(which)  # type: ignore[arg-type]
    if not 0 <= number < 2**64:
        raise NotFoundError(f"no {what} has this id")
    return number


def count_of(number: object, what: str) -> int:
    """A number of the engine's 32 bits. Raises TypeError for what is no whole number."""
    count = index(number)  # type: ignore[arg-type]
    if not 0 <= count < 2**32:
        raise ArgumentError(f"{what} is 0 to {2**32 - 1}, not {count}")
    return count


def is_name(text: str) -> bool:
    """Text that the engine can look up: neither a zero nor half of a character."""
    return "\0" not in text and not any("\ud800" <= letter <= "\udfff" for letter in text)


def duration(seconds: float) -> float:
    if not 0 <= seconds <= 1e9:
        raise ArgumentError(f"a duration is 0 to 1e9 seconds, not {seconds}")
    return seconds


def frames_of(seconds: float, fps: float) -> int:
    """Number of frames of a film, which has one at least."""
    if not (math.isfinite(fps) and 0 < fps <= 1000):
        raise ArgumentError(f"a film has up to 1000 frames a second, not {fps}")
    return max(1, round(duration(seconds) * fps))
