"""Which cases a study has: from variations to values, by number."""

from __future__ import annotations

import math
from dataclasses import dataclass, fields
from functools import cached_property
from typing import Any, Mapping, Sequence

import numpy as np
import numpy.typing as npt

samples = ("grid", "list", "random", "latin_hypercube", "sobol")


@dataclass(frozen=True)
class Variation:
    """What one parameter goes through: listed values, or a range."""

    values: tuple[Any, ...] = ()
    low: float = 0
    high: float = 0
    steps: int = 0
    is_log: bool = False
    is_integer: bool = False

    def at(self, share: float) -> Any:
        """The value at a share of the range, [0, 1)."""
        if self.values:
            return self.values[min(int(share * len(self.values)), len(self.values) - 1)]
        if self.is_integer:
            return int(self.low) + min(int(share * (self.high - self.low + 1)), int(self.high - self.low))
        if self.is_log:
            return math.exp(math.log(self.low) + share * (math.log(self.high) - math.log(self.low)))
        return self.low + share * (self.high - self.low)

    def levels(self) -> list[Any]:
        """The values of a grid: those listed, or `steps` of the range with both ends."""
        if self.values:
            return list(self.values)
        steps = np.linspace(0, 1, self.steps) if self.steps > 1 else np.array([0.0])
        if self.is_integer:
            return [round(self.low + float(share) * (self.high - self.low)) for share in steps]
        return [self.low if share == 0 else self.high if share == 1 else self.at(float(share)) for share in steps]


@dataclass(frozen=True)
class Design:
    """The cases of a study: a sample of the variations, each repeated."""

    vary: Mapping[str, Variation]
    noise: Mapping[str, Variation]
    sample: str = "grid"
    cases: int = 0
    repetitions: int = 1
    seed: int = 1

    def points(self) -> int:
        """Number of points of the sample, before repetitions."""
        if self.sample == "grid":
            return math.prod(len(v.values) or v.steps for v in self.vary.values())
        if self.sample == "list":
            return max((len(v.values) for v in self.vary.values()), default=1)
        return self.cases

    def total(self) -> int:
        """Number of cases, of any size: len() has 63 bits."""
        return self.points() * self.repetitions

    def __len__(self) -> int:
        return self.total()

    def values(self) -> Cases:
        return self._cases

    @cached_property
    def _cases(self) -> Cases:
        return Cases(self)

    def __getstate__(self) -> dict[str, Any]:
        """The fields alone: a process draws the points again, or a million of them would go along with each picture."""
        return {field.name: getattr(self, field.name) for field in fields(self)}


class Cases:
    """Values by the number of a case. Numbers count repetitions first: case 0 and 1 are the same point, twice."""

    def __init__(self, design: Design):
        self._design = design
        self._levels = [variation.levels() for variation in design.vary.values()] if design.sample == "grid" else []
        self._shares = None if design.sample in ("grid", "list") else _shares(design.sample, design.cases, len(design.vary), design.seed)

    def __getitem__(self, number: int) -> dict[str, Any]:
        design = self._design
        point, repetition = divmod(number, design.repetitions)
        found = dict(zip(design.vary, self._point(point)))
        if design.noise:
            random = np.random.default_rng([design.seed, point, repetition])
            for path, variation in design.noise.items():
                found[path] = variation.at(random.random())
        return found

    def _point(self, point: int) -> Sequence[Any]:
        variations = self._design.vary.values()
        if self._shares is not None:
            return [variation.at(float(share)) for variation, share in zip(variations, self._shares[point])]
        if self._design.sample == "list":
            return [variation.values[point] for variation in variations]
        picked = []
        for levels in reversed(self._levels):  # the last parameter changes fastest
            point, place = divmod(point, len(levels))
            picked.append(levels[place])
        return picked[::-1]


def _shares(sample: str, cases: int, dimensions: int, seed: int) -> npt.NDArray[np.float64]:
    """Points of the unit cube, (cases, dimensions)."""
    if dimensions == 0:
        return np.empty((cases, 0))
    if sample == "random":
        return np.random.default_rng(seed).random((cases, dimensions))
    from scipy.stats import qmc

    if sample == "latin_hypercube":
        return np.asarray(qmc.LatinHypercube(dimensions, seed=seed).random(cases))
    # Any number of points, the first of a power of two of them: those alone are balanced.
    return np.asarray(qmc.Sobol(dimensions, seed=seed).random_base2(max(1, cases - 1).bit_length())[:cases])
