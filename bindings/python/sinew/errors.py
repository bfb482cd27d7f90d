"""Exceptions of the package."""

from __future__ import annotations

from typing import Any, NamedTuple, Sequence

__all__ = ["Error", "SceneError", "NotFoundError", "ClosedError", "Diagnostic"]


class Error(Exception):
    """Anything that the engine refuses."""


class NotFoundError(Error, LookupError):
    """Nothing has this name or id, or it has been removed."""


class ClosedError(Error):
    """The simulation has been closed."""


class ArgumentError(Error, ValueError):
    """A number out of range, an array of the wrong shape, an unknown word."""


most_open = 4096  #: simulations of a process


class FullError(Error, MemoryError):
    """More than 4096 simulations are open."""


class Diagnostic(NamedTuple):
    """A mistake in a scene, for its author."""

    source: str  #: name of the file, or "<command line>" for an override
    line: int  #: from 1; of an override, in the override
    column: int  #: from 1, in characters
    length: int  #: characters
    path: str  #: JSON pointer: "/figures/0/mass"
    message: str  #: 'unknown property "masss"'
    help: str  #: 'did you mean "mass"?'; may be empty
    text: str  #: as the command prints it, with the line and a mark below
    is_override: bool  #: the mistake is in an override


class SceneError(Error, ValueError):
    """A scene with mistakes. ``errors`` lists all of them; as text they read as the command prints them."""

    def __init__(self, errors: Sequence[Diagnostic]):
        super().__init__(errors)
        self.errors: list[Diagnostic] = list(errors)

    def __str__(self) -> str:
        return "\n".join(error.text.rstrip("\n") for error in self.errors)


_of_status = {1: ClosedError, 2: NotFoundError, 4: ArgumentError, 5: NotFoundError, 7: FullError}


def error_of(status: int, message: str) -> Error:
    """The exception of a sinew_status (bindings/c/sinew.h)."""
    if status == 1:
        return ClosedError("the simulation is closed")
    if status == 7 and message.endswith("open simulations"):
        return too_many(message)
    return _of_status.get(status, Error)(message)


def too_many(message: str) -> FullError:
    return FullError(f"{message}: a process has {most_open} at most; close() frees one")


def scene_error(rows: Sequence[tuple[Any, ...]]) -> SceneError:
    return SceneError([Diagnostic(*row) for row in rows])
