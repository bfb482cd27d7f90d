"""Arrays are views of the simulation's memory, and safe whatever happens to it."""

import gc
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, strategies as st

import sinew
from conftest import pendulum, tearing

memory = ["positions", "previous", "velocities", "inverse_masses", "radii", "figure_indices", "mobilities"]
columns = [*memory, "tensions", "strains", "ends"]


@pytest.mark.parametrize("name", columns)
def test_a_column_is_not_copied(name):
    sim = sinew.open("ragdoll")
    first, second = getattr(sim, name), getattr(sim, name)
    assert np.shares_memory(first, second)
    assert len(first) == len(sim.constraints() if name in ("tensions", "strains", "ends") else sim)
    assert first.base is not None


@pytest.mark.parametrize("name", columns)
def test_a_column_cannot_be_written_to(name):
    column = getattr(sinew.open("ragdoll"), name)
    with pytest.raises(ValueError):
        column[0] = 1
    with pytest.raises(ValueError):
        column.flags.writeable = True


def test_shapes():
    for name, dimension in (("ragdoll", 2), ("cloth3d", 3)):
        sim = sinew.open(name)
        n = len(sim)
        assert sim.dimension == dimension
        assert sim.positions.shape == sim.velocities.shape == sim.previous.shape == (n, dimension)
        assert sim.masses.shape == sim.radii.shape == sim.asleep.shape == sim.ids.shape == (n,)
        assert sim.ends.shape == (len(sim.tensions), 2) and sim.ends.max() < n
        assert len(sim.strains) == len(sim.constraints()) == len(sim.tensions)


@pytest.mark.parametrize("name", ["ragdoll", "rope", "cloth3d", "tetrahedron", "pile", "chains"])
@pytest.mark.parametrize("mode", ["physical", "classic"])
def test_views_follow_the_simulation(name, mode):
    sim = sinew.open(name, mode=mode)
    views = {column: getattr(sim, column) for column in columns}
    for _ in range(20):
        sim.step(3)
        for column, view in views.items():
            now = getattr(sim, column)
            if len(now) == len(view):
                assert np.array_equal(now, view), column


@pytest.mark.parametrize("end", [lambda sim: sim.close(), lambda sim: None])
def test_a_view_outlives_its_simulation(end):
    sim = sinew.open("cloth3d")
    sim.step(5)
    view, expected = sim.positions, np.array(sim.positions)
    part = view[3:7, 0]
    end(sim)
    del sim, view
    gc.collect()
    others = [sinew.open("cloth3d") for _ in range(5)]  # would take the freed memory
    assert np.array_equal(part, expected[3:7, 0])
    del others


def test_the_sanitizer_sees_what_numpy_reads():
    """The other tests of this file mean more where it does: `./dev check python` loads it."""
    if "libasan" not in Path("/proc/self/maps").read_text():
        pytest.skip("the address sanitizer is not loaded")
    program = """if True:
        import ctypes, gc, numpy, sinew
        view = (sim := sinew.open("cloth3d")).positions
        memory = (ctypes.c_char * view.nbytes).from_address(view.ctypes.data)  # without a pin
        sim.close()
        del sim, view
        numpy.array(numpy.frombuffer(memory, numpy.uint8))"""
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    assert done.returncode != 0 and "heap-use-after-free" in done.stderr


def test_a_view_survives_growth():
    sim = sinew.open(pendulum)
    view, expected = sim.positions, np.array(sim.positions)
    for i in range(5000):
        sim.add_particle([i, 1])
    sim.step()
    assert np.array_equal(view, expected)
    assert len(sim.positions) == 5002


def test_a_view_survives_tearing():
    sim = sinew.open(tearing)
    kept = []
    for _ in range(60):
        kept.append((sim.positions, sim.velocities, sim.inverse_masses))
        sim.step()
        if sim.events():
            break
    for views in kept:
        for view in views:
            assert np.isfinite(view[: len(view)]).all()


def test_computed_columns_are_computed_after_each_step():
    """Nobody has to ask again: an array of tensions follows, as one of positions does."""
    sim, other = sinew.open("bridge"), sinew.open("bridge")
    tensions, start = sim.tensions, np.array(sim.tensions)
    for step in range(1, 6):
        sim.step()
        other.step()
        assert np.array_equal(tensions, other.tensions)
    assert not np.array_equal(tensions, start)
    last = np.array(tensions)
    sim.restart()  # another world: its arrays are taken again
    sim.step(50)
    assert np.array_equal(tensions, last)
    worlds = sinew.batch("bridge", 3)
    tensions = worlds.worlds[2].tensions
    worlds.step(5)
    assert np.array_equal(tensions, other.tensions)


def test_a_copy_has_memory_of_its_own():
    sim = sinew.open(pendulum)
    copy = sim.copy()
    assert not np.shares_memory(sim.positions, copy.positions)
    sim.step(10)
    assert copy.steps == 0
    copy.step(10)
    assert copy.hash() == sim.hash()


def test_restart_returns_to_the_start():
    sim = sinew.open("ragdoll")
    start = sim.hash()
    view = sim.positions
    sim.step(50)
    sim.restart()
    assert sim.hash() == start
    assert view.shape == sim.positions.shape


def test_a_closed_simulation_says_so():
    sim = sinew.open(pendulum)
    sim.close()
    for use in (sim.step, sim.hash, sim.report, lambda: sim.positions, lambda: sim["bob"], sim.copy, sim.close, sim.draw,
                lambda: sim.cut([0, 0], [1, 1])):
        with pytest.raises(sinew.ClosedError):
            use()
    assert "closed" in repr(sim)
    with sinew.open(pendulum) as other:
        other.step()
    with pytest.raises(sinew.ClosedError):
        other.step()


actions = st.lists(st.sampled_from(["step", "add", "remove", "cut", "restart", "view", "drop", "copy", "set", "close"]),
                   min_size=5, max_size=40)


@given(actions, st.integers(0, 2**32 - 1))
def test_views_are_safe_whatever_happens(actions, seed):
    """Every view ever taken keeps finite numbers, in any order of edits and of forgetting."""
    random = np.random.default_rng(seed)
    sim = sinew.open(tearing)
    views = []
    for action in actions:
        if action == "step":
            sim.step(int(random.integers(1, 5)))
        elif action == "add":
            for _ in range(int(random.integers(1, 200))):
                sim.add_particle(random.normal(size=2))
        elif action == "remove" and len(sim) > 20:
            for number in random.choice(sim.ids, 5, replace=False).tolist():
                sim.particle(number).remove()
        elif action == "cut":
            sim.cut(random.normal(size=2), random.normal(size=2))
        elif action == "restart":
            sim.restart()
        elif action == "view":
            views.append(getattr(sim, columns[random.integers(len(columns))]))
        elif action == "drop" and views:
            views.pop(random.integers(len(views)))
        elif action == "copy":
            sim = sim.copy()
        elif action == "set":
            sim.set("world.gravity", random.normal(size=2).tolist())
        elif action == "close":
            sim.close()
            sim = sinew.open(tearing)
        for view in views:
            assert np.isfinite(view.astype(float)).all()
