"""Sinew: ropes, chains, cloth, ragdolls, bridges, jelly; all that Verlet points and constraints can make, in 2D and 3D.

    import sinew

    sim = sinew.open("ragdoll")              # a name of the catalogue, a file, or a dict
    sim.run_until(2)                         # seconds
    print(sim["bob/head"].position, sim.energy)
    sim["bob"].positions                     # a NumPy view of the figure's particles
    sim                                      # in a notebook: its picture

``sinew.catalogue()`` lists the scenes with a name; docs/how/python.md of the source tree is the manual. The same scene
has the same bits here as in C++, on the command line and in the browser: ``sim.hash()`` tells.

Errors are ``sinew.Error``: SceneError, a ValueError, for a scene with mistakes, all of them with line and column; NotFoundError, a
LookupError, for names and ids; ClosedError after ``close``; and a ValueError for numbers out of range and arrays of another
shape, whose message has the right one. A call that raises changes nothing.
"""

from ._core import simd, version as __version__
from .arrays import from_arrays
from .batch import Batch, batch
from .errors import ClosedError, Diagnostic, Error, NotFoundError, SceneError
from .parts import Figure, Particle, Particles, Pin
from .records import ConstraintState, Contact, Event, Near, NearLink, RayHit, Report
from .scenes import catalogue, check, prefabs, schema
from .pictures import overlays
from .simulation import Simulation, open

__all__ = [
    "open", "from_arrays", "batch", "check", "catalogue", "prefabs", "schema", "overlays", "simd",
    "Simulation", "Figure", "Particle", "Particles", "Pin", "Batch",
    "Report", "Event", "Contact", "ConstraintState", "Near", "NearLink", "RayHit",
    "Error", "SceneError", "NotFoundError", "ClosedError", "Diagnostic",
]
