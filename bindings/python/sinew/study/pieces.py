"""What a checker of study files is made of: values of a kind, each with its place."""

from __future__ import annotations

from pathlib import Path

from .located import Mistakes, Node, nearest


class Pieces:
    def __init__(self, path: Path, text: str):
        self.path, self.text = path, text
        self.mistakes = Mistakes(str(path), text)

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
        elif not low <= value <= high:
            self.mistakes.at(node, f"{value} is out of range", path, f"from {low:g} to {high:g}")
        elif whole and value != int(value):
            self.mistakes.at(node, "expected a whole number", path)
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
