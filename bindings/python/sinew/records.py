"""What a simulation reports, as named tuples. Numbers are in the units of the scene."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from ._types import Reals

__all__ = ["Report", "Event", "Contact", "ConstraintState", "Near", "NearLink", "RayHit"]


class Report(NamedTuple):
    """State of a simulation in numbers."""

    seconds: float  #: simulated time, seconds
    steps: int
    kinetic: float  #: energy
    potential: float  #: energy in gravity and other fields
    stored: float  #: energy in springs
    energy_lost: float  #: energy lost in impacts since the start
    stretch_max: float  #: largest strain of a distance, as a fraction of its rest length
    stretch_mean: float
    max_speed: float

    @property
    def energy(self) -> float:
        """Kinetic, potential and stored energy."""
        return self.kinetic + self.potential + self.stored


class Event(NamedTuple):
    """An entry of the log."""

    seconds: float  #: simulated time, seconds
    #: "torn", "parted", "quarantined", "touched" (a sensor), a phase of a contact that the scene waits for ("begin",
    #: "persist", "end", "hit"), or the name of a scene event ("grab")
    what: str
    where: str  #: figure or particle, or the text of a note; may be empty
    islands: int  #: "parted": number of islands of the figure
    with_: str  #: contacts: name of the collider or figure touched
    impulse: float  #: contacts: in the step


class Contact(NamedTuple):
    """A contact in the last step. A hit is one whose ``blow`` is above a number of yours, and ``blow_before`` was not."""

    phase: str  #: "begin", "persist" or "end"
    impulse: float  #: in the last step; friction is not counted
    blow: float  #: the same; in the step after the touch began, that of both steps
    blow_before: float  #: in the step before
    particle: int  #: id: of two figures the particle that is pressed hardest
    other: int | None  #: id of the particle of the other figure; None: a collider or a plane is touched
    collider: int | None  #: id; None: a figure or a plane is touched
    figure: str | None  #: None: a loose particle
    other_figure: str | None
    collider_name: str  #: as in the scene; may be empty; "bounds": a plane of world.bounds


class ConstraintState(NamedTuple):
    """State of one constraint."""

    measure: float  #: in the unit of its kind: length, radians, area, volume
    error: float  #: distance outside the limits; negative below the lower one
    strain: float  #: error as a fraction of the violated limit; of angles the error itself
    tension: float  #: force, positive when pulling


class Near(NamedTuple):
    """The nearest particle."""

    particle: int  #: id
    distance: float  #: from its surface; negative inside


class NearLink(NamedTuple):
    """The nearest link."""

    link: int  #: id of the distance
    t: float  #: place on the link, 0 at its first end and 1 at its second
    distance: float


class RayHit(NamedTuple):
    """The first thing that a ray meets."""

    share: float  #: of the way, 0 to 1
    point: Reals  #: (dimension,)
    normal: Reals  #: (dimension,)
    particle: int | None  #: id; None: a collider or a plane of world.bounds was met
    collider: int | None  #: id; None: a particle or a plane was met


def vector(numbers: tuple[float, float, float], dimension: int) -> npt.NDArray[np.float64]:
    return np.array(numbers[:dimension])
