"""The study file: read, and checked like a scene."""

from __future__ import annotations

import ast
import json
from pathlib import Path
from typing import Any

from .. import scenes
from ..errors import Error, SceneError
from .case import Job, simulation_of
from .design import Design, Variation, samples
from .located import Mistakes, Node, Reader, Syntax, nearest
from .measures import UnknownQuantity, overs, quantity
from .spec import StudyError, StudyFile, key_of

max_cases = 10_000_000
_log = ("torn", "parted", "quarantined", "touched", "begin", "persist", "end", "hit")


def event_words() -> tuple[str, ...]:
    """Words of the log: the engine's own, and the events that a scene can have."""
    rules = scenes.schema()["properties"]["events"]["items"]["allOf"]
    return (*_log, *(word for rule in rules for word in rule.get("if", {}).get("required", [])))


def read(path: str | Path) -> StudyFile:
    """Reads a study file. Raises StudyError with all mistakes, OSError where the file cannot be read."""
    path = Path(path)
    text = path.read_text(encoding="utf-8", errors="replace")
    checker = _Checker(path, text)
    study = checker.study()
    if checker.mistakes.found or study is None:
        raise StudyError(sorted(checker.mistakes.found, key=lambda mistake: (mistake.line, mistake.column)))
    return study


class _Checker:
    def __init__(self, path: Path, text: str):
        self.path, self.text = path, text
        self.mistakes = Mistakes(str(path), text)

    # --- pieces -----------------------------------------------------------------------------------------------------

    def fields(self, node: Node, known: tuple[str, ...], path: str, required: tuple[str, ...] = ()) -> dict[str, Node]:
        """Values of an object by name."""
        if not isinstance(node.value, dict):
            self.mistakes.at(node, "expected an object", path)
            return {}
        for name, key in node.keys.items():
            if name not in known:
                self.mistakes.at(key, f'unknown property "{name}"', path, nearest(name, known))
        for name in required:
            if name not in node.value:
                self.mistakes.add(f'"{name}" is missing', node.start, node.start + 1, path)
        return {name: value for name, value in node.value.items() if name in known}

    def number(self, node: Node | None, usual: float, path: str, low: float, high: float, whole: bool = False) -> float:
        if node is None:
            return usual
        value = node.value
        if isinstance(value, bool) or not isinstance(value, (int, float)):
            self.mistakes.at(node, "expected a number", path)
        elif whole and value != int(value):
            self.mistakes.at(node, "expected a whole number", path)
        elif not low <= value <= high:
            self.mistakes.at(node, f"{value} is out of range", path, f"from {low:g} to {high:g}")
        else:
            return value
        return usual

    def word(self, node: Node | None, usual: str, path: str, known: tuple[str, ...] | None = None) -> str:
        if node is None:
            return usual
        if not isinstance(node.value, str):
            self.mistakes.at(node, "expected a text", path)
        elif known is not None and node.value not in known:
            self.mistakes.at(node, f'unknown word "{node.value}"', path, nearest(node.value, known))
        else:
            return node.value
        return usual

    # --- the file ---------------------------------------------------------------------------------------------------

    known = ("sinew_study", "about", "scene", "set", "vary", "noise", "sample", "cases", "repetitions", "seed", "until", "measure",
             "best", "case_limit")

    def study(self) -> StudyFile | None:
        try:
            root = Reader(self.text).document()
        except Syntax as error:
            self.mistakes.add(str(error), error.at, error.at + 1)
            return None
        given = self.fields(root, self.known, "", ("sinew_study", "scene", "vary", "measure"))
        if not given:
            return None
        self.number(given.get("sinew_study"), 1, "/sinew_study", 1, 1)
        self.word(given.get("about"), "", "/about")
        design = self.design(given)
        job = self.job(given)
        if job is None or self.mistakes.found:
            return None
        self.check_values(given, job, design)
        best, wants_low = self.best(given)
        return StudyFile(self.path, self.word(given.get("about"), "", "/about"), job, design, best, wants_low, key_of(job, design))

    def design(self, given: dict[str, Node]) -> Design:
        sample = self.word(given.get("sample"), "grid", "/sample", samples)
        vary = self.variations(given.get("vary"), "/vary", sample)
        noise = self.variations(given.get("noise"), "/noise", "random")
        drawn = sample not in ("grid", "list")
        cases = self.number(given.get("cases"), 0, "/cases", 1, max_cases, True)
        if drawn and "cases" not in given:
            node = given.get("sample", given["vary"] if "vary" in given else None)
            if node:
                self.mistakes.at(node, f'a sample "{sample}" needs a number of cases', "/sample", 'add "cases": 64')
        if not drawn and "cases" in given:
            self.mistakes.at(given["cases"], f'the cases of a {sample} follow from what varies', "/cases", "leave it out")
        design = Design(vary, noise, sample, int(cases), int(self.number(given.get("repetitions"), 1, "/repetitions", 1, max_cases, True)),
                        int(self.number(given.get("seed"), 1, "/seed", 0, 2**53, True)))
        if sample == "list" and len({len(v.values) for v in vary.values()}) > 1:
            lengths = ", ".join(f"{path} {len(v.values)}" for path, v in vary.items())
            self.mistakes.at(given["vary"], "the lists of a sample \"list\" are of equal length", "/vary", f"these have: {lengths}")
        elif len(design) > max_cases and "vary" in given:
            self.mistakes.at(given["vary"], f"{len(design):,} cases are more than {max_cases:,}", "/vary",
                             'fewer steps, or a "sample" with a number of cases')
        return design

    def variations(self, node: Node | None, path: str, sample: str) -> dict[str, Variation]:
        if node is None:
            return {}
        if not isinstance(node.value, dict):
            self.mistakes.at(node, "expected an object of paths and what they go through", path)
            return {}
        return {name: self.variation(value, f"{path}/{name}", sample) for name, value in node.value.items()}

    def variation(self, node: Node, path: str, sample: str) -> Variation:
        if isinstance(node.value, list):
            if not node.value:
                self.mistakes.at(node, "an empty list leaves no case", path)
            return Variation(values=tuple(node.plain()) or (None,))
        given = self.fields(node, ("from", "to", "steps", "scale", "whole"), path, ("from", "to"))
        low = self.number(given.get("from"), 0, path + "/from", -1e300, 1e300)
        high = self.number(given.get("to"), 1, path + "/to", -1e300, 1e300)
        is_log = self.word(given.get("scale"), "linear", path + "/scale", ("linear", "log")) == "log"
        steps = int(self.number(given.get("steps"), 1, path + "/steps", 1, max_cases, True))
        whole = given.get("whole")
        is_whole = bool(whole and whole.value)
        if is_log and not (low > 0 and high > 0):
            self.mistakes.at(node, "a logarithmic range is above 0", path)
        if is_whole and (low != int(low) or high != int(high)):
            self.mistakes.at(node, "a range of whole numbers has whole ends", path)
        if high < low:
            self.mistakes.at(node, f"the range ends before it begins: {high:g} < {low:g}", path)
        if sample == "grid" and "steps" not in given and "from" in given:
            self.mistakes.at(node, "a range in a grid needs a number of steps", path, 'add "steps": 5, or list the values: [1, 2, 5]')
        if sample == "list":
            self.mistakes.at(node, 'a sample "list" has lists', path, "[1, 2, 5]")
        return Variation((), low, high, steps, is_log, is_whole)

    # --- the scene and what is measured -------------------------------------------------------------------------------

    def job(self, given: dict[str, Node]) -> Job | None:
        node = given.get("scene")
        if node is None:
            return None
        try:
            scene = node.plain()
            if isinstance(scene, str) and any(mark in scene for mark in "./"):
                scene = self.path.parent / scene
            source = scenes.source_of(scene)
            files = scenes.files_of(source)
        except (Error, OSError, TypeError) as problem:
            self.mistakes.at(node, str(problem), "/scene")
            return None
        fixed = given["set"].plain() if "set" in given else {}
        if not isinstance(fixed, dict):
            self.mistakes.at(given["set"], "expected an object of paths and values", "/set")
            fixed = {}
        job = Job(source.text, source.name, files.models, fixed, {}, {}, 1, None, 0)
        try:
            simulation = simulation_of(job, {})
        except SceneError as error:
            for mistake in error.errors:
                where = given["set"] if mistake.is_override else node
                self.mistakes.at(where, f"{mistake.message} ({mistake.source}:{mistake.line}:{mistake.column})",
                                 "/set" if mistake.is_override else "/scene", mistake.help)
            return None
        seconds, event = self.until(given.get("until"), simulation.duration)
        functions = self.measures(given.get("measure"), simulation)
        limit = self.number(given.get("case_limit"), 600, "/case_limit", 0.001, 1e9)
        measure = given["measure"].plain() if "measure" in given else {}
        return job._replace(measure=measure, functions=functions, seconds=seconds, event=event, time_limit=limit)

    def until(self, node: Node | None, usual: float) -> tuple[float, str | None]:
        if node is None:
            return usual, None
        if not isinstance(node.value, dict):
            return self.number(node, usual, "/until", 0, 1e9), None
        given = self.fields(node, ("seconds", "event"), "/until")
        seconds = self.number(given.get("seconds"), usual, "/until/seconds", 0, 1e9)
        return seconds, self.word(given["event"], "", "/until/event", event_words()) if "event" in given else None

    def measures(self, node: Node | None, simulation: Any) -> dict[str, str]:
        functions: dict[str, str] = {}
        if node is None or not isinstance(node.value, dict):
            if node is not None:
                self.mistakes.at(node, "expected an object of names and what they measure", "/measure")
            return functions
        for name, measure in node.value.items():
            path = f"/measure/{name}"
            if isinstance(measure.value, str):
                self.quantity(measure, simulation, path)
            else:
                self.measure(measure, simulation, path, functions)
        return functions

    def measure(self, node: Node, simulation: Any, path: str, functions: dict[str, str]) -> None:
        words = (*overs, "first", "count", "function")
        given = self.fields(node, (*words, "where"), path)
        chosen = [word for word in words if word in given]
        if len(chosen) != 1:
            self.mistakes.at(node, "a measure is a quantity, or an object with one of its words", path, f"one of {', '.join(words)}")
            return
        word, value = chosen[0], given[chosen[0]]
        if word in overs:
            self.quantity(value, simulation, path)
        elif word == "function":
            self.function(value, path, functions)
        else:
            self.word(value, "", path, event_words())
            if "where" in given:
                place = self.word(given["where"], "", path + "/where")
                if place and place not in simulation:
                    self.mistakes.at(given["where"], f'no figure or particle is called "{place}"', path,
                                     nearest(place, simulation.figures))

    def quantity(self, node: Node, simulation: Any, path: str) -> None:
        if not isinstance(node.value, str):
            self.mistakes.at(node, "expected the name of a quantity", path)
            return
        try:
            quantity(node.value, simulation)
        except UnknownQuantity as problem:
            self.mistakes.at(node, problem.message, path, problem.help)
        except Error as problem:
            self.mistakes.at(node, str(problem), path)

    def function(self, node: Node, path: str, functions: dict[str, str]) -> None:
        file, colon, name = self.word(node, "", path).partition(":")
        if not colon:
            self.mistakes.at(node, 'a function is named "file.py:function"', path)
            return
        try:
            text = (self.path.parent / file).read_text(encoding="utf-8")
            tree = ast.parse(text, file)
        except (OSError, SyntaxError, ValueError) as problem:
            self.mistakes.at(node, f"{file}: {problem}", path)
            return
        known = {item.name for item in tree.body if isinstance(item, ast.FunctionDef)}
        if name not in known:
            self.mistakes.at(node, f'{file} has no function "{name}"', path, nearest(name, known))
        functions[file] = text

    def best(self, given: dict[str, Node]) -> tuple[str, bool]:
        """The measure by which cases are ranked, and whether the lowest is best."""
        node = given.get("best")
        measured = tuple(given["measure"].value) if isinstance(given["measure"].value, dict) else ()
        if node is None:
            return (measured[0] if measured else ""), True
        if isinstance(node.value, str):
            return self.word(node, "", "/best", measured), True
        fields = self.fields(node, ("lowest", "highest"), "/best")
        word = "highest" if "highest" in fields else "lowest"
        if word not in fields:
            self.mistakes.at(node, 'expected {"lowest": MEASURE} or {"highest": MEASURE}', "/best")
            return "", True
        return self.word(fields[word], "", f"/best/{word}", measured), word == "lowest"

    def check_values(self, given: dict[str, Node], job: Job, design: Design) -> None:
        """Opens the scene with the first and the last value of every path: unknown paths, values out of range."""
        for section, variations in (("vary", design.vary), ("noise", design.noise)):
            for path, variation in variations.items():
                values = variation.values or (variation.at(0), variation.at(1 - 1e-9))
                for place, value in enumerate(dict.fromkeys(json.dumps(value) for value in values)):
                    self.check_value(given[section], path, json.loads(value), job, f"/{section}/{path}")
                    if place > 100:
                        break

    def check_value(self, section: Node, path: str, value: Any, job: Job, where: str) -> None:
        assert isinstance(section.value, dict)
        try:
            simulation_of(job, {path: value}).close()
        except SceneError as error:
            mistake = error.errors[0]
            is_path = mistake.column <= len(path)
            node = section.keys[path] if is_path else section.value[path]
            self.mistakes.at(node, mistake.message + ("" if is_path else f" for {json.dumps(value)}"), where, mistake.help)


__all__ = ["StudyError", "StudyFile", "read"]
