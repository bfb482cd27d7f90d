"""JSON whose values know their place in the file, for messages."""

from __future__ import annotations

import difflib
import json
import math
import re
from dataclasses import dataclass
from typing import Any, Iterable, Union

from ..errors import Diagnostic

_space = re.compile(r"(?:[ \t\r\n]|//[^\n]*)*")
_text = re.compile(r'"(?:[^"\\\x00-\x1f]|\\.)*"')
_word = re.compile(r"-?[0-9][0-9.eE+-]*|true|false|null")
_deepest = 100


@dataclass
class Node:
    """A value with its place: characters start to end of the text."""

    value: Union[dict[str, Node], list[Node], str, float, int, bool, None]
    start: int
    end: int
    keys: dict[str, Node]  #: of an object, the names

    def plain(self) -> Any:
        """The value as Python's own."""
        if isinstance(self.value, dict):
            return {name: node.plain() for name, node in self.value.items()}
        if isinstance(self.value, list):
            return [node.plain() for node in self.value]
        return self.value


class Syntax(Exception):
    def __init__(self, message: str, at: int):
        super().__init__(message)
        self.at = at


class Reader:
    """Reads a text as JSON with // comments."""

    def __init__(self, text: str):
        self.text, self.at = text, 0

    def document(self) -> Node:
        node = self.node(0)
        self.skip()
        if self.at < len(self.text):
            raise Syntax("more follows after the end of the study", self.at)
        return node

    def skip(self) -> None:
        match = _space.match(self.text, self.at)
        assert match
        self.at = match.end()

    def next_is(self, mark: str) -> bool:
        self.skip()
        if not self.text.startswith(mark, self.at):
            return False
        self.at += len(mark)
        return True

    def expect(self, mark: str, what: str) -> None:
        if not self.next_is(mark):
            raise Syntax(f"expected {mark} {what}", self.at)

    def node(self, depth: int) -> Node:
        self.skip()
        start = self.at
        if depth > _deepest:
            raise Syntax(f"more than {_deepest} levels of brackets", start)
        if self.next_is("{"):
            return self.object(start, depth)
        if self.next_is("["):
            return self.array(start, depth)
        match = _text.match(self.text, start) or _word.match(self.text, start)
        if not match:
            raise Syntax("expected a value", start)
        self.at = match.end()
        try:
            value = json.loads(match[0])
        except ValueError:
            raise Syntax(f"{match[0]} is no value of JSON", start) from None
        if isinstance(value, str) and any("\ud800" <= letter <= "\udfff" for letter in value):
            raise Syntax(f"{match[0]} has half of a character", start)
        if isinstance(value, float) and not math.isfinite(value):
            raise Syntax(f"the number {match[0]} is too large", start)
        return Node(value, start, self.at, {})

    def object(self, start: int, depth: int) -> Node:
        values: dict[str, Node] = {}
        keys: dict[str, Node] = {}
        while not self.next_is("}"):
            if keys:
                self.expect(",", "or } in an object")
            self.skip()
            key = self.node(depth + 1) if self.text.startswith('"', self.at) else None
            if key is None:
                raise Syntax('expected a name in "', self.at)
            name = str(key.value)
            if name in keys:
                raise Syntax(f'"{name}" is said twice', key.start)
            self.expect(":", "after a name")
            keys[name], values[name] = key, self.node(depth + 1)
        return Node(values, start, self.at, keys)

    def array(self, start: int, depth: int) -> Node:
        values: list[Node] = []
        while not self.next_is("]"):
            if values:
                self.expect(",", "or ] in a list")
            values.append(self.node(depth + 1))
        return Node(values, start, self.at, {})


def nearest(word: str, known: Iterable[str]) -> str:
    """Help for an unknown word: the nearest known one, and all."""
    names = sorted(known)
    if not names:
        return "there is none"
    near = difflib.get_close_matches(word, names, 1, 0.6)
    allowed = f"allowed here: {', '.join(names)}"
    return f'did you mean "{near[0]}"? ({allowed})' if near else allowed


class Mistakes:
    """Collects the mistakes of a file."""

    def __init__(self, source: str, text: str):
        self.source, self.text = source, text
        self.found: list[Diagnostic] = []

    def add(self, message: str, start: int, end: int, path: str = "", help: str = "") -> None:
        line = self.text.count("\n", 0, start) + 1
        begin = self.text.rfind("\n", 0, start) + 1
        stop = self.text.find("\n", begin)
        shown = self.text[begin : stop if stop >= 0 else len(self.text)].replace("\t", " ").rstrip("\r")
        column, length = start - begin + 1, max(1, min(end, begin + len(shown)) - start)
        if column > 90:  # a long line is shown around the mark
            shown, mark = "..." + shown[column - 61 :], 64
        else:
            mark = column
        shown = shown[:117] + "..." if len(shown) > 120 else shown
        where = f" at {path}" if path else ""
        text = (f"{self.source}:{line}:{column}: error: {message}{where}\n{line:5} | {shown}\n"
                f"      | {' ' * (mark - 1)}^{'~' * (min(length, max(1, len(shown) - mark + 1)) - 1)}")
        if help:
            text += f"\n      = help: {help}"
        self.found.append(Diagnostic(self.source, line, column, length, path, message, help, text, False))

    def at(self, node: Node, message: str, path: str, help: str = "") -> None:
        self.add(message, node.start, node.end, path, help)
