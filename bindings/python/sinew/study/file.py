"""The study file: read, and checked like a scene."""

from __future__ import annotations

import ast
import itertools
import json
from pathlib import Path
from typing import Any

from .. import scenes
from ..errors import Error, SceneError
from .case import Job, simulation_of
from .design import Design
from .located import Node, Reader, Syntax, nearest
from .measures import UnknownQuantity, overs, quantity
from .spec import StudyError, StudyFile, key_of
from .variations import Variations

_checked_values = 100  #: of a path
_log = ("torn", "parted", "quarantined", "touched", "begin", "persist", "end", "hit")


def event_words() -> tuple[str, ...]:
    """Words of the log: the engine's own, and the events that a scene can have."""
    rules = scenes.schema()["properties"]["events"]["items"]["allOf"]
    return (*_log, *(word for rule in rules for word in rule.get("if", {}).get("required", [])))


def read(path: str | Path) -> StudyFile:
    """Reads a study file. Raises StudyError with all mistakes, OSError where the file cannot be read."""
    path = Path(path)
    text = path.read_text(encoding="utf-8-sig", errors="replace")
    checker = _Checker(path, text)
    study = checker.study()
    if checker.mistakes.found or study is None:
        raise StudyError(sorted(checker.mistakes.found, key=lambda mistake: (mistake.line, mistake.column)))
    return study


class _Checker(Variations):
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
        self.version(given.get("sinew_study"))
        self.word(given.get("about"), "", "/about")
        design = self.design(given)
        self.disjoint(given)
        opened = self.job(given)
        if opened is None or self.mistakes.found:
            return None
        job, files = opened
        self.check_values(given, job, design)
        best, wants_low = self.best(given)
        return StudyFile(self.path, self.word(given.get("about"), "", "/about"), job, files, design, best, wants_low, key_of(job, design))

    def version(self, node: Node | None) -> None:
        if node and (isinstance(node.value, bool) or node.value != 1):
            self.mistakes.at(node, "this Sinew reads version 1 of the study format", "/sinew_study", 'begin the file with {"sinew_study": 1, ...')

    # --- the scene and what is measured -------------------------------------------------------------------------------

    def job(self, given: dict[str, Node]) -> tuple[Job, scenes.Files] | None:
        """What the cases have in common, and the files of the scene; None where the scene cannot be opened."""
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
            self.scene_mistakes(error, node, given, job)
            return None
        except Error as problem:
            self.mistakes.at(given["set"], str(problem), "/set")
            return None
        seconds, event = self.until(given.get("until"), simulation.duration)
        functions = self.measures(given.get("measure"), simulation)
        limit = self.number(given.get("case_limit"), 600, "/case_limit", 0.001, 1e9)
        measure = given["measure"].plain() if "measure" in given else {}
        simulation.close()
        return job._replace(measure=measure, functions=functions, seconds=seconds, event=event, time_limit=limit), files

    def scene_mistakes(self, error: SceneError, node: Node, given: dict[str, Node], job: Job) -> None:
        """Mistakes of the scene and of what is set in it. Those of a scene in the study's own file have their place there."""
        found = len(self.mistakes.found)
        for path, value in job.set.items():
            fixed = given["set"].value
            assert isinstance(fixed, dict)
            self.check_value(given["set"], path, value, job._replace(set={}), f"/set/{path}", fixed[path], only_override=True)
        if isinstance(node.value, dict):
            lines = self.text[: node.start].split("\n")
            padded = "\n" * (len(lines) - 1) + " " * len(lines[-1]) + self.text[node.start : node.end]
            try:
                simulation_of(job._replace(text=padded, set={}), {}).close()
            except SceneError as inner:
                for mistake in inner.errors:
                    start = sum(len(line) + 1 for line in self.text.split("\n")[: mistake.line - 1]) + mistake.column - 1
                    self.mistakes.add(mistake.message, start, start + mistake.length, "/scene" + mistake.path, mistake.help)
        else:
            for mistake in error.errors:
                if not mistake.is_override:
                    self.mistakes.at(node, f"{mistake.message} ({mistake.source}:{mistake.line}:{mistake.column})", "/scene", mistake.help)
        if len(self.mistakes.found) == found:  # values of "set" that are wrong together alone
            for mistake in error.errors:
                self.mistakes.at(given.get("set", node), mistake.message, "/set", mistake.help)

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
        if not isinstance(node.value, dict):
            self.mistakes.at(node, "expected an object, or the name of a quantity", path, f"an object has one of {', '.join(words)}")
            return
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
            self.mistakes.at(node, f"{file}: {problem.strerror if isinstance(problem, OSError) else problem}", path)
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
        if len(fields) != 1:
            self.mistakes.at(node, 'expected {"lowest": MEASURE} or {"highest": MEASURE}', "/best")
            return "", True
        return self.word(fields[word], "", f"/best/{word}", measured), word == "lowest"

    def check_values(self, given: dict[str, Node], job: Job, design: Design) -> None:
        """Opens the scene with the first and the last value of every path: unknown paths, values out of range."""
        for section, variations in (("vary", design.vary), ("noise", design.noise)):
            for path, variation in variations.items():
                values = variation.values or (variation.at(0), variation.at(1 - 1e-9))
                different: dict[str, Node] = {}
                for value, place in zip(values, _places(given[section], path)):
                    different.setdefault(json.dumps(value), place)
                for value, place in itertools.islice(different.items(), _checked_values):
                    if not self.check_value(given[section], path, json.loads(value), job, f"/{section}/{path}", place):
                        break

    def check_value(self, section: Node, path: str, value: Any, job: Job, where: str, place: Node, only_override: bool = False) -> bool:
        """Opens the scene with a value, said at a place; False where another one is of no use, as the path is wrong."""
        assert isinstance(section.value, dict)
        try:
            simulation_of(job, {path: value}).close()
        except SceneError as error:
            own = [mistake for mistake in error.errors if mistake.is_override]
            if only_override and not own:
                return True
            mistake = (own or error.errors)[0]
            is_path = mistake.column <= len(path)
            self.mistakes.at(section.keys[path] if is_path else place, mistake.message, where, mistake.help)
            return not is_path
        except Error as problem:
            self.mistakes.at(section.keys[path], str(problem), where)
            return False
        return True


def _places(section: Node, path: str) -> list[Node]:
    """Where the values of a path are said: those of a list, or both ends of a range."""
    assert isinstance(section.value, dict)
    given = section.value[path].value
    return given if isinstance(given, list) else [given["from"], given["to"]] if isinstance(given, dict) else []


__all__ = ["StudyError", "StudyFile", "read"]
