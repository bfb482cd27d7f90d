"""Which cases a study has."""

import math

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from sinew.study.design import Design, Variation


@pytest.mark.parametrize("sample", ["random", "latin_hypercube", "sobol"])
@given(cases=st.integers(1, 200), dimensions=st.integers(1, 5), seed=st.integers(0, 2**32))
@settings(max_examples=15)
def test_samples_stay_in_their_range_and_follow_the_seed(sample, cases, dimensions, seed):
    if sample != "random":
        pytest.importorskip("scipy")
    vary = {f"p{i}": Variation(low=1, high=100, is_log=i % 2 == 1, is_integer=i == 2) for i in range(dimensions)}
    values, again = Design(vary, {}, sample, cases, 1, seed).values(), Design(vary, {}, sample, cases, 1, seed).values()
    for number in range(cases):
        assert values[number] == again[number]
        assert all(1 <= value <= 100 * (1 + 1e-12) for value in values[number].values())
        assert dimensions < 3 or isinstance(values[number]["p2"], int)


def test_a_latin_hypercube_has_one_case_in_every_slice():
    pytest.importorskip("scipy")
    values = Design({"a": Variation(low=0, high=1), "b": Variation(low=0, high=1)}, {}, "latin_hypercube", 50, 1, 3).values()
    for name in "ab":
        assert sorted(int(values[number][name] * 50) for number in range(50)) == list(range(50))


def test_sobol_points_fill_boxes_evenly():
    """Of 64 points every dyadic box of area 1/16 has 4."""
    pytest.importorskip("scipy")
    values = Design({"a": Variation(low=0, high=1), "b": Variation(low=0, high=1)}, {}, "sobol", 64, 1, 3).values()
    boxes = np.zeros((4, 4))
    for number in range(64):
        boxes[int(values[number]["a"] * 4), int(values[number]["b"] * 4)] += 1
    assert (boxes == 4).all()


@given(st.lists(st.integers(1, 5), min_size=0, max_size=4), st.integers(1, 3))
def test_a_grid_has_every_combination_once(lengths, repetitions):
    vary = {f"p{i}": Variation(values=tuple(range(n))) for i, n in enumerate(lengths)}
    design = Design(vary, {}, "grid", 0, repetitions)
    assert len(design) == math.prod(lengths) * repetitions
    values = design.values()
    assert len({tuple(values[number].values()) for number in range(0, len(design), repetitions)}) == math.prod(lengths)


def test_repetitions_differ_in_the_noise_alone():
    design = Design({"a": Variation(values=(1, 2))}, {"n": Variation(low=0, high=1)}, "grid", 0, 3, 5)
    rows = [design.values()[number] for number in range(6)]
    assert [row["a"] for row in rows] == [1, 1, 1, 2, 2, 2]
    assert len({row["n"] for row in rows}) == 6
