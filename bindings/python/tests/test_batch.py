"""Many worlds at once."""

import numpy as np
import pytest
from hypothesis import given, strategies as st

import sinew
from conftest import pendulum


def test_a_world_has_the_bits_of_a_simulation_by_itself():
    worlds = sinew.batch("ragdoll", 12)
    alone = sinew.open("ragdoll")
    for _ in range(5):
        worlds.step(7)
        alone.step(7)
        assert set(worlds.hashes) == {alone.hash()}
        assert (worlds.positions == alone.positions).all() and (worlds.velocities == alone.velocities).all()


@given(st.integers(1, 9), st.integers(1, 5), st.integers(0, 1000))
def test_results_depend_on_the_seed_alone(n, threads, seed):
    vary = {"figures.bob.height": (100, 200)}
    one = sinew.batch("ragdoll", n, vary=vary, seed=seed, threads=threads)
    other = sinew.batch("ragdoll", n, vary=vary, seed=seed, threads=1)
    one.step(20)
    other.step(20)
    assert one.hashes == other.hashes and len(set(one.hashes)) == n
    single = sinew.open("ragdoll", {"figures.bob.height": one.values["figures.bob.height"][-1]})
    single.step(20)
    assert single.hash() == one.hashes[-1]


def test_reset_returns_the_masked_worlds_to_their_start():
    worlds = sinew.batch(pendulum, 4, vary={"world.gravity": [[0, -1], [0, -2], [0, -3], [0, -4]]})
    start, start_hashes = worlds.positions.copy(), worlds.hashes
    worlds.step(30)
    moved = worlds.positions.copy()
    mask = np.array([True, False, True, False])
    worlds.reset(mask)
    assert np.array_equal(worlds.positions, np.where(mask[:, None, None], start, moved))
    assert [hash_ == start_ for hash_, start_ in zip(worlds.hashes, start_hashes)] == mask.tolist()
    worlds.reset()
    assert worlds.hashes == start_hashes
    worlds.step(30)
    assert np.array_equal(worlds.positions, moved)


def test_a_mask_may_lie_in_any_order_in_memory():
    whole = np.array([True, False, False, False, True, False, False, True])
    for mask in (whole[::2], whole[4:][::-1], np.broadcast_to(np.True_, 4), np.array([whole, whole]).T[:4, 1]):
        worlds = sinew.batch("rope", 4)
        worlds.step()
        worlds.reset(mask)
        assert [world.steps for world in worlds.worlds] == [0 if is_on else 1 for is_on in mask]


def test_forces_and_pins_act_world_by_world():
    worlds = sinew.batch({**pendulum, "world": {"gravity": [0, 0]}}, 3)
    forces = np.array([[0, 1], [0, 2], [0, -3]])
    worlds.apply_force("bob/weight", forces)
    worlds.step(2)
    speeds = worlds.velocities[:, worlds.row("bob/weight"), 1]
    assert speeds / forces[:, 1] == pytest.approx([speeds[0]] * 3, rel=1e-2)
    pins = worlds.pin("bob/weight")
    targets = np.array([[0.8, 0.6], [0.6, 0.8], [0, 1]])
    for _ in range(30):
        pins.move(targets)
        worlds.step()
    assert worlds.positions[:, worlds.row("bob/weight")] == pytest.approx(targets, abs=1e-2)


def test_forces_act_after_a_reset():
    worlds = sinew.batch(pendulum, 2)
    for _ in range(2):
        worlds.reset([True, False])
        worlds.apply_force("bob/weight", [[0, 0], [0, 0]])
        worlds.step()
    assert worlds.worlds[0].steps == 1 and worlds.worlds[1].steps == 2


def test_what_does_not_fit_is_refused():
    worlds = sinew.batch(pendulum, 3)
    for wrong in (np.zeros((2, 2)), np.zeros((3, 3)), np.zeros(3)):
        with pytest.raises(ValueError, match=r"\(3, 2\)"):
            worlds.apply_force("bob/weight", wrong)
    with pytest.raises(ValueError, match="truth"):
        worlds.reset([1, 0, 1])
    with pytest.raises(ValueError, match="world 1: a number"):
        worlds.apply_force("bob/weight", [[0, 0], [np.nan, 0], [0, 0]])
    with pytest.raises(LookupError):
        worlds.row("bob/wieght")
    with pytest.raises(ValueError, match="3 values"):
        sinew.batch(pendulum, 3, vary={"world.damping": [1, 2, 3, 4]})
    with pytest.raises(ValueError, match="world.damping: the range ends before it begins: 0 < 1"):
        sinew.batch(pendulum, 3, vary={"world.damping": (1, 0)})
    with pytest.raises(MemoryError, match="4096 at most"):  # at once, before any is opened
        sinew.batch(pendulum, 10**12)
    with pytest.raises(ValueError):
        sinew.batch(pendulum, 0)
    with pytest.raises(sinew.SceneError, match="damping"):
        sinew.batch(pendulum, 3, vary={"world.dampin": (0, 1)})
    with pytest.raises(ValueError, match="equal particles"):
        sinew.batch("rope", 2, vary={"figures.rope.segments": [20, 21]})
    worlds.worlds[2].close()
    with pytest.raises(sinew.ClosedError):
        worlds.step()


def test_a_world_that_loses_particles_says_so():
    worlds = sinew.batch("ragdoll", 2)
    worlds.worlds[1]["bob/head"].remove()
    with pytest.raises(LookupError, match="world 1"):
        worlds.step()
