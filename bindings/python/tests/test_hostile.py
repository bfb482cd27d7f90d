"""Arguments that nobody should pass: an error that is caught, the same state as before, and no other memory."""

import numpy as np
import pytest

import sinew

n = len(sinew.open("ragdoll"))
points = [np.zeros((n, 3)), np.zeros((n + 1, 2)), np.zeros((n, 2), complex), np.full((n, 2), np.nan), np.zeros((n, 2), "M8[s]"), "x",
          np.array([["a", "b"]] * n), [[1, 2], [3]], None, {}, [[None, 0]] * n]
no_time = [-1, float("nan"), float("inf")]
two = [[0, 0], [1, 0]]


@pytest.fixture
def sim():
    sim = sinew.open("ragdoll")
    before = sim.hash()
    yield sim
    assert sim.hash() == before


@pytest.mark.parametrize("value", points, ids=range(len(points)))
def test_arrays_of_points(sim, value):
    for name in ("positions", "velocities"):
        for part in (sim, sim["bob"]):
            with pytest.raises(ValueError):
                setattr(part, name, value)
    with pytest.raises(ValueError):
        sim["bob"].apply_force(value)


@pytest.mark.parametrize("which", [0, -1, 2**64, 2**70, -(2**63), 1.5, float("nan"), None, b"x", (), "", "*", "[", "bob/nobody"])
def test_ids_and_names(sim, which):
    for use in (sim.particle, sim.constraint, sim.remove_constraint, lambda which: sim.add_constraint("distance", ["bob/head", which])):
        with pytest.raises((sinew.NotFoundError, TypeError, ValueError)):
            use(which)


def test_numbers_out_of_range(sim):
    link, both = sim.add_constraint, ["bob/head", "bob/left_hand"]
    uses = [lambda m=m: setattr(sim["bob/head"], "mass", m) for m in (0, -1, float("nan"), 1e-320)]
    uses += [lambda m=m: sim.add_particle([0, 0], mass=m) for m in (0, -1, float("nan"), 1e-320)]
    uses += [lambda r=r: sim.add_particle([0, 0], radius=r) for r in (-1, float("nan"), float("inf"))]
    uses += [lambda k=k, v=v: link("distance", both, **{k: v}) for k in ("compliance", "max_force", "breaking_strain")
             for v in (-1, float("nan"))]
    uses += [lambda t=t: use(t) for t in no_time for use in (sim.trace, sim.history, sim.play, lambda t: sim.save_frames("no", t),
                                                            lambda t: sim.save_film("no.gif", t))]
    uses += [lambda f=f: sim.save_frames("no", 1, fps=f) for f in (0, -1, float("nan"), float("inf"))]
    uses += [lambda: sim.step(-1), lambda: sim.run_until(float("nan")), lambda: sim.trace(1, every=0), lambda: sim.draw(0, 0),
             lambda: sim.draw(10**6, 10**6), lambda: sim.particles_in([0, 0], radius=-1), lambda: sim.cast_ray([0, 0], [np.nan, 1])]
    for number, use in enumerate(uses):
        with pytest.raises(ValueError):
            use()
            pytest.fail(str(number))


@pytest.mark.parametrize("given", [{"points": []}, {"points": [[0, 0, 0, 0]]}, {"points": "x"}, {"points": [[0, 1j]]}, {"links": [[0, 2]]},
                                   {"links": [[0, -1]]}, {"links": [[0, 0]]}, {"links": [[0, 1.5]]}, {"links": [[True, False]]},
                                   {"links": [[0, 2**70]]}, {"masses": -1}, {"masses": [1, 2, 3]}, {"pinned": [5]}, {"lengths": [-1]},
                                   {"lengths": [np.inf]}, {"compliance": np.nan}, {"compliance": [np.nan]}])
def test_scenes_of_arrays(given):
    with pytest.raises(ValueError):
        sinew.from_arrays(**{"points": two, "links": [[0, 1]], **given})


def test_a_batch_writes_into_its_own_arrays_alone():
    worlds = sinew.batch("rope", 3)
    for name in ("positions", "velocities"):
        with pytest.raises(AttributeError):
            setattr(worlds, name, np.zeros((1, 1, 1)))
    worlds.positions.resize((3, 2, 2), refcheck=False)
    with pytest.raises(sinew.Error, match="another size"):
        worlds.step()
    for wrong in ({"n": 0}, {"n": -1}, {"n": 5000}, {"threads": -1}, {"threads": 10**6}, {"seed": -1}, {"vary": {"nothing": [1, 2]}},
                  {"vary": {"figures.rope.weight": [1]}}, {"vary": {"figures.rope.segments": [5, 9]}}):
        with pytest.raises((ValueError, MemoryError)):
            sinew.batch("rope", **{"n": 2, **wrong})
    with pytest.raises(ValueError):
        sinew.Batch([])
    others = sinew.batch("rope", 2)
    for forces in (np.zeros((2, 3)), np.zeros((2, 2), complex), np.full((2, 2), np.nan), None, 0):
        with pytest.raises(ValueError):
            others.apply_force("rope/end", forces)
    others.worlds[1].close()
    with pytest.raises(sinew.ClosedError):
        others.step()
