"""Running cases, in any process of any machine."""

from __future__ import annotations

import contextlib
import signal
import threading
import time
from typing import Any, Iterable, Iterator, NamedTuple

from .. import _core
from ..errors import SceneError
from ..scenes import Files, overrides_of
from ..simulation import Simulation
from .measures import Measures, Quantity


_longest_reason = 1000  #: characters


class Job(NamedTuple):
    """All that cases of a study have in common; small, and picklable."""

    text: str  #: of the scene
    name: str  #: of the scene, for messages
    models: list[tuple[str, str]]
    set: dict[str, Any]
    measure: dict[str, Any]
    functions: dict[str, str]  #: text of the Python files by name
    seconds: float
    event: str | None  #: at which a case ends early
    time_limit: float  #: real seconds of a case


class Row(NamedTuple):
    """Result of a case."""

    number: int
    measures: dict[str, float | None]
    hash: str
    reason: str  #: of a failure; empty if there was none
    took: float  #: real seconds


class Failed(BaseException):
    """No Exception, which a function of a user may catch and go on."""


def simulation_of(job: Job, values: dict[str, Any], images: list[tuple[str, bytes]] | None = None) -> Simulation:
    """The scene of a case at its start; its bits are the same without images."""
    files = Files(images or [], job.models)
    return Simulation(_core.Simulation(job.text, job.name, overrides_of({**job.set, **values}), files.images, files.models), files)


def functions_of(job: Job) -> dict[str, Quantity]:
    """The functions that measures name as "file.py:function"."""
    spaces: dict[str, dict[str, Any]] = {}
    found = {}
    for measure in job.measure.values():
        if isinstance(measure, dict) and "function" in measure:
            file, _, function = measure["function"].partition(":")
            if file not in spaces:
                spaces[file] = {"__name__": file.removesuffix(".py")}
                exec(compile(job.functions[file], file, "exec"), spaces[file])
            found[measure["function"]] = spaces[file][function]
    return found


@contextlib.contextmanager
def within(seconds: float) -> Iterator[None]:
    """Raises Failed in the block after so many real seconds, also in a function that never returns. Only a main thread can
    be interrupted; in any other a case looks at the clock between its steps."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return

    def late(number: int, frame: object) -> None:
        raise Failed(f"it took longer than {seconds:g} s")

    before = signal.signal(signal.SIGALRM, late)
    signal.setitimer(signal.ITIMER_REAL, seconds, 1)  # again each second, where a function has caught the first
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)


def run_cases(job: Job, cases: Iterable[tuple[int, dict[str, Any]]]) -> list[Row]:
    """Runs cases one after the other. A case that fails is a row with its reason."""
    return [_run(job, number, values) for number, values in cases]


def _run(job: Job, number: int, values: dict[str, Any]) -> Row:
    start = time.perf_counter()
    measures: dict[str, float | None] = {}
    hash_, reason = "", ""
    try:
        with within(job.time_limit), simulation_of(job, values) as simulation:
            measuring = Measures(job.measure, functions_of(job), simulation)
            advance(job, simulation, measuring, start + job.time_limit)
            hash_ = simulation.hash()
            measures = measuring.results(simulation)
            frozen = [event.where for event in simulation.events() if event.what == "quarantined"]
            if frozen:
                raise Failed(f"{frozen[0]} became infinite or not-a-number, and is frozen")
    except SceneError as error:
        reason = "; ".join(mistake.message for mistake in error.errors)
    except Failed as problem:
        reason = str(problem)
    except KeyboardInterrupt:
        raise
    except BaseException as problem:  # of a measure in Python, above all, also sys.exit(): the other cases go on
        reason = f"{type(problem).__name__}: {_text_of(problem)}"
    return Row(number, measures, hash_, _storable(reason), time.perf_counter() - start)


def _text_of(problem: BaseException) -> str:
    try:
        return str(problem)
    except Exception as another:
        return f"without a text: {type(another).__name__}"


def _storable(reason: str) -> str:
    """Text that tables hold: of a bounded length, and without halves of characters, which names of files may have."""
    return reason[:_longest_reason].encode("utf-8", "backslashreplace").decode("utf-8")


def advance(job: Job, simulation: Simulation, measuring: Measures, deadline: float) -> None:
    """Steps to the end of the case. Looks at measures over time in every step, and else at events and the clock as seldom
    as they allow."""
    left = round(job.seconds * simulation.rate)
    block = 1 if measuring.wants_steps or job.event else 16
    measuring.note(simulation)
    seen = 0
    while left > 0:
        simulation.step(min(block, left))
        left -= min(block, left)
        measuring.note(simulation)
        if job.event:
            new = simulation.events(seen)
            seen += len(new)
            if any(event.what == job.event for event in new):
                return
        if time.perf_counter() > deadline:
            raise Failed(f"it took longer than {job.time_limit:g} s, {left / simulation.rate:.2f} s before its end")
