"""Arguments that nobody should pass: an error that is caught, the same state as before, and no other memory."""

import copy
import gc
import os
import pickle
import signal
import threading
from concurrent.futures import ThreadPoolExecutor

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


@pytest.mark.parametrize("part", ["bob", "bob/head", "bob/*_hand"])
def test_a_misspelt_name_takes_no_value(sim, part):
    """Assigned in silence it would look as if it had moved something."""
    pin = sinew.open("ragdoll")["bob/head"].pin()
    for thing in (sim, sim[part], pin, sinew.batch("rope", 1)):
        with pytest.raises(AttributeError):
            thing.velocites = [0, 1]


@pytest.mark.parametrize("name", ["rate", "dimension", "precision", "duration", "seconds", "size", "masses", "tensions"])
def test_numbers_that_only_the_scene_sets(sim, name):
    with pytest.raises(AttributeError):
        setattr(sim, name, getattr(sim, name))


def test_areas_and_pulleys_join_any_number_of_particles():
    sim = sinew.from_arrays([[0, 0], [1, 0], [1, 1], [0, 1], [-1, 0.5]], [[0, 1]])
    corners = [int(i) for i in sim["body"].ids]
    for kind in ("area", "pulley"):
        for count in (3, 4, 5):
            assert sim.constraint(sim.add_constraint(kind, corners[:count])).error == 0
    with pytest.raises(ValueError, match="kind 'area' joins 3 particles, not 2"):
        sim.add_constraint("area", corners[:2])
    with pytest.raises(ValueError, match="compliance|number|range"):
        sim.add_constraint("area", corners, compliance=-1)


def test_a_constraint_tells_how_many_particles_its_kind_joins(sim):
    with pytest.raises(ValueError, match="kind 'distance' joins 2 particles, not 1"):
        sim.add_constraint("distance", ["bob/head"])
    with pytest.raises(ValueError, match="kind 'distance' joins 2 particles, not 3"):
        sim.add_constraint("distance", ["bob/head", "bob/left_hand", "bob/right_hand"])
    with pytest.raises(ValueError, match="did you mean 'distance'"):
        sim.add_constraint("distanc", ["bob/head", "bob/left_hand"])


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


def nested(depth):
    value = {}
    for _ in range(depth):
        value = {"a": value}
    return value


@pytest.mark.parametrize("name", ["bob\0", "bob/head\0x", "\0", "\ud800", "bob/\udfff"])
def test_names_that_no_scene_has(sim, name):
    assert name not in sim
    for use in (lambda: sim[name], lambda: sim.particle(name), lambda: sim.constraint(name), lambda: sim.move_collider(name, [0, 0]),
                lambda: sim.trace(0.1, name), lambda: sim["bob"][name]):
        with pytest.raises(sinew.NotFoundError):
            use()
    for use in (lambda: sim.set("mode", name), lambda: sim.set(name, 1), lambda: sinew.open("ragdoll", mode=name)):
        with pytest.raises(ValueError):
            use()


def test_a_path_with_a_zero_writes_no_other_file(sim, tmp_path):
    for use in (sim.save_picture, sim.save, lambda path: sim.export(path), lambda path: sim.save_film(path, 0.1)):
        for ending in ("png", "gif", "glb"):
            with pytest.raises(ValueError):
                use(str(tmp_path / f"a\0.{ending}"))
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("count", [2**32, 2**70, -1])
def test_counts_out_of_range(sim, count):
    worlds = sinew.batch("rope", 1)
    for use in (sim.step, sim.events, worlds.step):
        with pytest.raises(ValueError, match="4294967295"):
            use(count)
    for use in (sim.step, sim.events, worlds.step):
        for wrong in (1.5, "2", None, [1]):
            with pytest.raises(TypeError):
                use(wrong)


def test_scenes_without_an_end():
    endless = {"sinew": 1}
    endless["world"] = endless
    for scene in (endless, nested(100_000)):
        with pytest.raises(ValueError, match="too deep|contains itself"):
            sinew.open(scene)
        with pytest.raises(ValueError, match="too deep|contains itself"):
            sinew.open("rope", world=scene)
    for text in ('{"a":' * 5000, '{"a":' * 5000 + "1" + "}" * 5000, '{"a":' + "[" * 900 + "]" * 900 + "}"):
        with pytest.raises(sinew.SceneError):
            sinew.open(text)
    with pytest.raises(sinew.SceneError):
        sinew.open({"sinew": 1, "world": {"gravity": [0, float("nan")]}})


def test_a_batch_has_each_world_once():
    sim = sinew.open("rope")
    with pytest.raises(ValueError, match="once"):
        sinew.Batch([sim, sim])
    assert len(sinew.Batch([sim, sim.copy()])) == 2


def test_a_batch_after_a_restart_of_one_world():
    worlds = sinew.batch("rope", 2)
    worlds.apply_force("rope/end", np.zeros((2, 2)))
    worlds.worlds[1].restart()
    worlds.refresh()
    worlds.apply_force("rope/end", np.zeros((2, 2)))
    worlds.step()


def test_batches_and_parts_are_copied_and_pickled():
    worlds = sinew.batch("ragdoll", 3, vary={"figures.bob.height": (100, 200)}, threads=2)
    worlds.step(5)
    for again in (pickle.loads(pickle.dumps(worlds)), copy.deepcopy(worlds)):
        assert again.hashes == worlds.hashes and np.array_equal(again.positions, worlds.positions)
        assert again.threads == 2 and list(again.values) == ["figures.bob.height"]
        again.step(3)
        assert again.worlds[0].steps == 8 and worlds.worlds[0].steps == 5
    head = pickle.loads(pickle.dumps(worlds.worlds[0]["bob/head"]))
    assert head.name == "bob/head" and np.array_equal(head.position, worlds.worlds[0]["bob/head"].position)
    with pytest.raises(sinew.SceneError) as caught:
        sinew.open("rope", solver={"substep": 1})
    assert str(pickle.loads(pickle.dumps(caught.value))) == str(caught.value)


def test_ctrl_c_ends_a_batch_between_two_steps():
    worlds = sinew.batch("ragdoll", 4)
    timer = threading.Timer(0.3, lambda: os.kill(os.getpid(), signal.SIGINT))
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        worlds.step(10**6)
    timer.join()
    assert 0 < worlds.worlds[0].steps < 10**6 and len({world.steps for world in worlds.worlds}) == 1
    assert np.array_equal(worlds.positions[2], worlds.worlds[2].positions)


def test_many_threads_use_two_batches_of_the_same_worlds():
    """Neither deadlock nor lost steps, whatever the order of the worlds."""
    sims = [sinew.open("rope") for _ in range(4)]
    one, other = sinew.Batch(sims, threads=2), sinew.Batch(sims[::-1], threads=2)
    with ThreadPoolExecutor(4) as pool:
        list(pool.map(lambda i: (one, other)[i % 2].step(2), range(40)))
    assert {sim.steps for sim in sims} == {80}
    alone = sinew.open("rope")
    alone.step(80)
    assert set(one.hashes) == {alone.hash()}


def test_views_after_the_end_and_huge_arrays():
    sim = sinew.open("ragdoll")
    views = [getattr(sim, name) for name in ("positions", "velocities", "previous", "tensions", "ends", "radii")]
    parts = [sim["bob"].positions, sim["bob/head"].position, sim["bob/*_hand"].velocities]
    kept = [np.array(view) for view in views + parts]
    sim.close()
    del sim
    gc.collect()
    for view, before in zip(views + parts, kept):
        assert np.array_equal(view, before) and np.array_equal(pickle.loads(pickle.dumps(view)), before)
    points = np.zeros((100_000, 2))
    points[:, 0] = np.arange(100_000)
    big = sinew.from_arrays(points)
    big.positions = big.positions + [0, 1]
    big.step()
    for other in (big.copy(), sinew.open(big.save())):
        assert other.hash() == big.hash()
    assert big.positions.shape == (100_000, 2) and np.isfinite(big.positions).all()
    with pytest.raises((ValueError, MemoryError)):
        sinew.from_arrays(np.zeros((10**7, 2)), np.zeros((1, 3), int))


def test_ranges_and_limits_without_an_end(sim):
    weight = "figures.rope.weight"
    for given in ((np.nan, 1), (0, np.inf), ("a", "b"), (None, 1)):
        with pytest.raises(ValueError, match="range has two"):
            sinew.batch("rope", 2, vary={weight: given})
    for wrong in ({"vary": [weight]}, {"vary": weight}, {"threads": 1.5}, {"n": "2"}, {"n": 1.5}):
        with pytest.raises(TypeError):
            sinew.batch("rope", **{"n": 2, **wrong})
    for limits in ({"low": np.inf}, {"high": -np.inf}, {"low": np.inf, "high": np.inf}):
        with pytest.raises(ValueError, match="no measure"):
            sim.add_constraint("distance", ["bob/head", "bob/left_hand"], **limits)


def test_checks_take_values_as_open_does():
    assert sinew.check("ragdoll", {"figures.bob.height": 150}, mode="classic") == []
    assert sinew.check("ragdoll", {"figures.bob.height": -1})


@pytest.mark.parametrize("precision, number", [("double", np.nan), ("double", -np.inf), ("float", 1e39)])
def test_one_wrong_number_changes_no_other(precision, number):
    """Neither the rows before it, nor the worlds, nor forces that wait for the next step."""
    sim, alone = sinew.open("ragdoll", precision=precision), sinew.open("ragdoll", precision=precision)
    worlds = sinew.batch("rope", 3, precision=precision)
    wrong, forces = np.ones((n, 2)), np.ones((3, 2))
    wrong[-1, 1] = forces[-1, 1] = number
    uses = [lambda: setattr(sim, "positions", wrong), lambda: setattr(sim["bob"], "velocities", wrong), lambda: sim["bob"].apply_force(wrong),
            lambda: sim["bob"].apply_impulse(wrong), lambda: worlds.apply_force("rope/end", forces)]
    for use in uses:
        with pytest.raises(ValueError):
            use()
    for world in (sim, alone, worlds):
        world.step()
    assert sim.hash() == alone.hash() and len(set(worlds.hashes)) == 1


def test_a_removed_particle_of_a_selection_changes_no_other(sim):
    hands = sim.copy()["bob/*_hand"]
    other = hands.simulation
    other.particle(int(hands.ids[1])).remove()
    before = other.hash()
    for use in (lambda: setattr(hands, "positions", [0, 0]), lambda: setattr(hands, "velocities", [1, 1]), lambda: hands.apply_impulse([9, 9])):
        with pytest.raises(sinew.NotFoundError):
            use()
    assert other.hash() == before
