"""Figures, particles, selections; edits."""

import numpy as np
import pytest
from hypothesis import given, strategies as st

import sinew
from conftest import pendulum


def test_a_figure_is_a_slice():
    sim = sinew.open("ragdoll")
    bob = sim["bob"]
    assert isinstance(bob, sinew.Figure) and bob.prefab == "ragdoll" and bob.name == "bob"
    assert np.shares_memory(bob.positions, sim.positions)
    assert "bob/head" in bob.names and len(bob) == len(bob.positions) == len(bob.masses)
    assert list(sim.figures) == ["bob"]
    assert "head" in bob._ipython_key_completions_()
    assert "bob/head" in sim._ipython_key_completions_()


def test_a_particle_is_a_row():
    sim = sinew.open("ragdoll")
    head = sim["bob/head"]
    assert head == sim["bob"]["head"] and head.name == "bob/head"
    assert np.array_equal(head.position, sim.positions[head.row])
    view = head.position
    sim.step(10)
    assert np.array_equal(view, sim.positions[head.row])
    assert sim.particle(head.id) == head == sim.particle("bob/head")


def test_a_particle_found_by_name_lasts_over_a_restart():
    sim = sinew.open("ragdoll")
    head, number = sim["bob/head"], sim["bob/head"].id
    start = head.position.tolist()
    sim.step(10)
    sim.restart()
    assert head.position.tolist() == start
    with pytest.raises(sinew.NotFoundError):
        sim.particle(number).position


def test_a_selection_matches_names():
    sim = sinew.open("ragdoll")
    hands = sim["bob/*_hand"]
    assert sorted(hands.names) == ["bob/left_hand", "bob/right_hand"]
    assert hands.positions.shape == (2, 2)
    for row, name in zip(hands.positions, hands.names):
        assert np.array_equal(row, sim[name].position)


@pytest.mark.parametrize("name, near", [("bbo", "bob"), ("bob/haed", "bob/head"), ("bob/left_hnd", "bob/left_hand")])
def test_wrong_names_are_answered_with_the_nearest(name, near):
    sim = sinew.open("ragdoll")
    with pytest.raises(sinew.NotFoundError, match=f"did you mean.*{near}"):
        sim[name]
    assert name not in sim and near in sim
    with pytest.raises(LookupError):
        sim["nobody/*"]
    with pytest.raises(TypeError, match="positions"):
        sim[3]


def test_assigned_positions_and_velocities_are_those_of_the_next_step():
    sim = sinew.open(pendulum)
    weight = sim["bob/weight"]
    weight.position = [0, -1]
    weight.velocity = [2, 0]
    assert weight.position.tolist() == [0, -1] and weight.velocity.tolist() == [2, 0]
    assert sim.report().kinetic == pytest.approx(0.5 * 1 * 2**2)
    sim.velocities = [0, 0]
    assert (sim.velocities == 0).all()
    sim["bob"].positions = sim["bob"].positions + [1, 2]
    assert sim["bob/top"].position.tolist() == [1, 2]


def test_an_impulse_is_mass_times_a_change_of_velocity():
    sim = sinew.open({**pendulum, "world": {"gravity": [0, 0]}})
    weight = sim["bob/weight"]
    weight.mass = 4
    weight.apply_impulse([0, 8])
    assert weight.velocity[1] == pytest.approx(2)
    assert weight.mass == 4 and sim.masses.tolist() == [1, 4]
    assert sim.add_particle([3, 3], mass=np.inf).mass == np.inf


def test_a_force_acts_for_one_step():
    """Velocities are those of the middle of a substep, so that a force that ceases has given all but half a substep."""
    sim = sinew.open({"sinew": 1, "world": {"gravity": [0, 0]}, "solver": {"substeps": 64},
                      "figures": [{"name": "p", "particles": {"a": {"at": [0, 0]}}}]})
    sim["p"].apply_force([[3, 0]])
    for _ in range(2):
        sim.step()
        assert sim.velocities[0, 0] == pytest.approx(3 / sim.rate, rel=1 / 128 + 1e-9)


@pytest.mark.parametrize("shape", [(3,), (2, 2), (1,), (2, 3), (0,), ()])
def test_wrong_shapes_are_refused_with_the_right_ones(shape):
    sim = sinew.open("ragdoll")
    before = sim.hash()
    n = len(sim)
    with pytest.raises(ValueError, match=rf"\({n}, 2\) or \(2,\)"):
        sim.positions = np.zeros(shape)
    with pytest.raises(ValueError, match="2 numbers"):
        sim["bob/head"].position = np.zeros(shape)
    assert sim.hash() == before


@pytest.mark.parametrize("value", ["left", None, [[1, 2], [3]], [float("nan"), 0], [float("inf"), 0], {}])
def test_what_is_no_finite_point_is_refused(value):
    sim = sinew.open("ragdoll")
    before = sim.hash()
    for edit in (lambda: setattr(sim["bob/head"], "position", value), lambda: sim["bob/head"].apply_force(value),
                 lambda: sim.drag(value), lambda: sim.cut(value, [0, 0]), lambda: sim.add_particle(value)):
        with pytest.raises((ValueError, sinew.Error)):
            edit()
    assert sim.hash() == before


def test_a_removed_particle_is_gone_for_good():
    sim = sinew.open("ragdoll")
    head = sim["bob/head"]
    n = len(sim)
    head.remove()
    assert len(sim) == n - 1 and len(sim["bob"]) == n - 1
    for use in (lambda: head.position, lambda: head.remove(), lambda: setattr(head, "mass", 2), head.pin):
        with pytest.raises(sinew.NotFoundError):
            use()
    for number in (0xFFFFFFFFFFFFFFFF, 12345, 2**40):
        with pytest.raises(sinew.NotFoundError):
            sim.particle(number).position


@given(st.integers(0, 2**64 - 1))
def test_no_number_is_mistaken_for_an_id(number):
    sim = sinew.open(pendulum)
    if number not in sim.ids:
        with pytest.raises(sinew.NotFoundError):
            sim.particle(number).position
    if number not in sim.constraints():
        with pytest.raises(sinew.NotFoundError):
            sim.constraint(number)


def test_added_constraints_hold():
    sim = sinew.open({**pendulum, "world": {"gravity": [0, -9.81], "damping": 5}})
    extra = sim.add_particle([2, 0], mass=3)
    link = sim.add_constraint("distance", ["bob/weight", extra])
    rope = sim.add_constraint("distance", ["bob/top", extra], high=1.5)
    sim.run(10)
    assert sim.constraint(link).measure == pytest.approx(1, rel=1e-6)
    assert sim.constraint(rope).measure <= 1.5 * (1 + 1e-6)
    sim.remove_constraint(link)
    with pytest.raises(sinew.NotFoundError):
        sim.constraint(link)
    with pytest.raises(ValueError, match="distance, angle"):
        sim.add_constraint("distanz", ["bob/weight", extra])
    with pytest.raises(ValueError):
        sim.add_constraint("distance", ["bob/weight"])
    with pytest.raises(ValueError, match="above"):
        sim.add_constraint("distance", ["bob/weight", extra], low=2, high=1)
    with pytest.raises(sinew.NotFoundError):
        sim.add_constraint("distance", ["bob/weight", "bob/weight"])


def test_a_hanging_weight_pulls_with_its_weight():
    sim = sinew.open({**pendulum, "world": {"gravity": [0, -9.81], "damping": 10}})
    sim.run(20)
    assert sim.constraint("bob/rod").tension == pytest.approx(9.81, rel=1e-6)
    assert sim.tensions == pytest.approx([9.81], rel=1e-6)
    assert abs(sim.strains[0]) < 1e-9


def test_a_pin_leads_a_particle():
    sim = sinew.open(pendulum)
    pin = sim["bob/weight"].pin()
    for i in range(60):
        pin.move([1 - i / 60, -i / 60])
        sim.step()
    assert sim["bob/weight"].position == pytest.approx([1 / 60, -59 / 60], abs=1e-3)
    pin.remove()
    with pytest.raises(sinew.NotFoundError):
        pin.move([0, 0])


def test_a_grab_drags_and_lets_go():
    sim = sinew.open(pendulum)
    assert sim.grab("bob/weight")
    for _ in range(120):
        sim.drag([0.6, -0.8])
        sim.step()
    assert sim["bob/weight"].position == pytest.approx([0.6, -0.8], abs=0.02)
    sim.let_go()
    assert sim.grab([0.6, -0.8], 0.1)
    assert not sim.grab([50, 50], 0.1)
    sim.let_go()


def test_a_cut_parts_what_it_crosses():
    sim = sinew.open(pendulum)
    assert sim.cut([0.5, -1], [0.5, 1]) == 1
    sim.run(1)
    assert sim["bob/weight"].position[1] == pytest.approx(-9.81 / 2, rel=0.02)
    assert sim.cut([0.5, -1], [0.5, 1]) == 0


def test_queries_find_what_is_there():
    sim = sinew.open(pendulum)
    weight = sim["bob/weight"]
    near = sim.nearest_particle([1.1, 0])
    assert near.particle == weight.id and near.distance == pytest.approx(0.1)
    assert sim.nearest_particle([9, 9], 0.1) is None
    link = sim.nearest_link([0.25, 0.5])
    assert link.t == pytest.approx(0.25) and link.distance == pytest.approx(0.5)
    assert sim.particles_in([1, 0], radius=0.1).ids.tolist() == [weight.id]
    assert len(sim.particles_in([0.5, 0], half=[1, 1])) == 2
    assert len(sim.links_in([0.5, 0], radius=0.1)) == 1
    assert len(sim.links_in([5, 5], radius=0.1)) == 0
    assert sim.cast_ray([5, 5], [6, 6]) is None
    with pytest.raises(ValueError):
        sim.particles_in([0, 0], radius=-1)


def test_contacts_carry_the_weight_of_what_rests():
    sim = sinew.open({"sinew": 1, "world": {"gravity": [0, -10]},
                      "colliders": [{"shape": "half_space", "name": "floor", "at": [0, 0]}],
                      "figures": [{"name": "p", "particles": {"ball": {"at": [0, 1], "mass": 2, "radius": 0.1}}}]})
    phases = []
    for _ in range(300):
        sim.step()
        phases += [contact.phase for contact in sim.contacts()]
    assert phases[0] == "begin" and phases[-1] == "persist"
    [contact] = sim.contacts()
    assert contact.impulse == pytest.approx(2 * 10 / sim.rate, rel=1e-3)
    assert contact.particle == sim["p/ball"].id and contact.figure == "p" and contact.collider_name == "floor"
    hit = sim.cast_ray([3, 2], [3, -2])
    assert hit.point == pytest.approx([3, 0], abs=1e-9) and hit.normal == pytest.approx([0, 1]) and hit.share == pytest.approx(0.5)


def test_events_tell_when():
    sim = sinew.open("rope")
    sim.run_until(6)
    whats = [event.what for event in sim.events()]
    assert "grab" in whats and "impulse" in whats
    assert sim.events(since=len(whats)) == []
    assert all(0 <= event.seconds <= 6 for event in sim.events())
