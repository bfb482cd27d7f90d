"""What varies in a study file: checked, and made a design."""

from __future__ import annotations

import importlib.util

from .design import Design, Variation, samples
from .located import Node
from .pieces import Pieces

max_cases = 10_000_000
#: Names of the table's own columns, which no measure can have.
columns = ("case", "repetition", "hash", "failed", "took")


class Variations(Pieces):
    def design(self, given: dict[str, Node]) -> Design:
        sample = self.word(given.get("sample"), "grid", "/sample", samples)
        vary = self.variations(given.get("vary"), "/vary", sample)
        noise = self.variations(given.get("noise"), "/noise", "random")
        drawn = sample not in ("grid", "list")
        if sample in ("latin_hypercube", "sobol") and importlib.util.find_spec("scipy") is None:
            self.mistakes.at(given["sample"], f'a sample "{sample}" needs SciPy, which is not installed', "/sample",
                             'install python3-scipy, or "sample": "random"')
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
        elif design.total() > max_cases and "vary" in given:
            self.mistakes.at(given["vary"], f"{design.total():,} cases are more than {max_cases:,}", "/vary",
                             'fewer steps, or a "sample" with a number of cases')
        return design

    def disjoint(self, given: dict[str, Node]) -> None:
        """A value is set, varied or drawn as noise, never two of these: the last would win, whatever the others say."""
        seen: dict[str, str] = {}
        for section in ("set", "vary", "noise"):
            node = given.get(section)
            for name in node.value if node and isinstance(node.value, dict) else ():
                for other, where in seen.items():
                    if name == other or name.startswith(other + ".") or other.startswith(name + "."):
                        assert node
                        self.mistakes.at(node.keys[name], f'"{other}" in "{where}" is of the same value', f"/{section}/{name}",
                                         "leave one of them out")
                seen.setdefault(name, section)
        node = given.get("measure")
        for name in node.value if node and isinstance(node.value, dict) else ():
            assert node
            if not name.strip():
                self.mistakes.at(node.keys[name], "a measure has a name", "/measure")
            if name in columns or name in seen:
                self.mistakes.at(node.keys[name], f'the table has another column "{name}"', f"/measure/{name}", "give the measure another name")

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
        is_whole = bool(whole and whole.value is True)
        if whole and not isinstance(whole.value, bool):
            self.mistakes.at(whole, "expected true or false", path + "/whole")
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
