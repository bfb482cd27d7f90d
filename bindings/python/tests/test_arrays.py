"""Simulations from arrays."""

import numpy as np
import pytest
from hypothesis import given, strategies as st
from hypothesis.extra import numpy as hnp

import sinew


def chain(n, **more):
    return sinew.from_arrays(np.c_[np.arange(n), np.zeros(n)], np.c_[np.arange(n - 1), np.arange(1, n)], **more)


def test_row_i_is_point_i():
    places = np.random.default_rng(1).normal(size=(50, 3))
    sim = sinew.from_arrays(places)
    assert sim.dimension == 3 and np.array_equal(sim.positions, places)
    assert sim["body/7"].row == 7


@given(hnp.arrays(np.float64, st.tuples(st.integers(1, 12), st.sampled_from([2, 3])), elements=st.floats(-1e3, 1e3)))
def test_points_arrive_to_the_last_bit(places):
    assert np.array_equal(sinew.from_arrays(places).positions, places)


def test_columns_arrive():
    rng = np.random.default_rng(2)
    masses, radii, speeds = rng.uniform(1, 2, 6), rng.uniform(0, 1, 6), rng.normal(size=(6, 2))
    sim = chain(6, masses=masses, radii=radii, velocities=speeds, pinned=[0, 5], world={"gravity": [0, -1]})
    assert sim.masses == pytest.approx(masses) and np.array_equal(sim.radii, radii)
    assert np.array_equal(sim.velocities[1:5], speeds[1:5])
    assert (sim.mobilities == 0).tolist() == [True, False, False, False, False, True]
    assert np.array_equal(np.sort(sim.ends, axis=1), np.c_[np.arange(5), np.arange(1, 6)])


def test_pinned_is_a_mask_or_rows_and_infinite_masses_stay():
    mask = np.arange(4) == 2
    assert chain(4, pinned=mask).hash() == chain(4, pinned=[2]).hash()
    sim = chain(3, masses=[np.inf, 1, 1])
    sim.run(1)
    assert sim.positions[0].tolist() == [0, 0]


def test_rest_lengths_and_springs():
    sim = chain(2, pinned=[0], lengths=0.5, world={"gravity": [0, -9.81], "damping": 5})
    sim.run(5)
    assert sim.positions[1] == pytest.approx([0, -0.5], abs=1e-5)
    spring = chain(2, pinned=[0], compliance=[0.01], world={"gravity": [0, -10], "damping": 5})
    spring.run(20)
    assert spring.positions[1] == pytest.approx([0, -1 - 0.1], abs=1e-4)


def test_a_catenary():
    """A chain of fine links between two pins hangs as a cosh: sag of length s over span d solves 2a sinh(d/2a) = s."""
    n, span, length = 65, 8.0, 10.0
    x = np.linspace(0, span, n)
    sim = sinew.from_arrays(np.c_[x, 0 * x], np.c_[np.arange(n - 1), np.arange(1, n)], lengths=length / (n - 1), pinned=[0, n - 1],
                            world={"gravity": [0, -9.81], "damping": 3})
    sim.run(20)
    low, high = 0.1, 100.0
    for _ in range(100):
        a = (low + high) / 2
        low, high = (a, high) if 2 * a * np.sinh(span / 2 / a) > length else (low, a)
    sag = a * (np.cosh(span / 2 / a) - 1)
    assert -sim.positions[n // 2, 1] == pytest.approx(sag, rel=2e-3)


@pytest.mark.parametrize("arguments, message", [
    (dict(points=np.zeros((3, 4))), r"\(n, 2\) or \(n, 3\), not \(3, 4\)"),
    (dict(points=np.zeros(4)), r"not \(4,\)"),
    (dict(points="abc"), "numbers"),
    (dict(points=[[0, float("nan")]]), "nan in row 0"),
    (dict(points=np.zeros((3, 2)), links=[[0, 3]]), "row 3; rows are 0 to 2"),
    (dict(points=np.zeros((3, 2)), links=[[0, -1]]), "row -1"),
    (dict(points=np.zeros((3, 2)), links=[[0, 1, 2]]), r"\(m, 2\)"),
    (dict(points=np.zeros((3, 2)), links=[[0.0, 1.0]]), "integers"),
    (dict(points=np.zeros((3, 2)), masses=[1, 2]), r"\(3,\) or \(\), not \(2,\)"),
    (dict(points=np.zeros((3, 2)), pinned=[True, False]), r"\(3,\)"),
    (dict(points=np.zeros((3, 2)), velocities=[1, 2, 3]), "velocities"),
])
def test_wrong_arrays_are_refused(arguments, message):
    with pytest.raises(ValueError, match=message):
        sinew.from_arrays(**arguments)


def test_mistakes_in_values_have_their_path():
    with pytest.raises(sinew.SceneError, match="mass"):
        chain(3, masses=-1)
    with pytest.raises(sinew.SceneError, match="substeps"):
        chain(3, solver={"substep": 3})


def test_no_points_and_many():
    assert len(sinew.from_arrays(np.zeros((0, 2)))) == 0
    assert sinew.from_arrays(np.zeros((0, 2))).positions.shape == (0, 2)
    sim = chain(3000)
    assert len(sim) == 3000
