"""Running states are saved, restored and pickled, and go on with the same bits."""

import pickle
import subprocess

import pytest
from hypothesis import given, strategies as st

import sinew
from conftest import pendulum, root, tearing


@pytest.mark.parametrize("scene", [pendulum, tearing, "ragdoll", "dress", "cloth_on_sphere"])
def test_a_saved_state_goes_on_with_the_same_bits(scene, tmp_path):
    sim = sinew.open(scene)
    sim.step(5)
    saved = sim.save(tmp_path / "at.sinew")
    assert (tmp_path / "at.sinew").read_bytes() == saved
    sim.step(5)
    others = [sinew.open(saved), sinew.open(tmp_path / "at.sinew"), sinew.open(str(tmp_path / "at.sinew"))]
    for other in others:
        assert other.steps == 5
        other.step(5)
        assert other.hash() == sim.hash()
    sim.restore(saved)
    sim.step(5)
    assert sim.hash() == others[0].hash()


def test_restoring_brings_back_ids_grabs_and_edits():
    sim = sinew.open(pendulum)
    extra = sim.add_particle([3, 0])
    sim.add_constraint("distance", ["bob/weight", extra])
    sim.grab("bob/weight")
    saved = sim.save()
    view, links = sim.positions, sim.tensions
    extra.remove()
    sim.let_go()
    assert len(links) == 2 and len(sim.tensions) == 1
    sim.restore(saved)
    assert extra.position == pytest.approx([3, 0]) and len(sim) == 3
    assert len(view) == 3 and len(links) == 2  # of the memory before
    sim.drag([1, 1])
    sim.restart()
    assert len(sim) == 2


def test_a_simulation_can_be_pickled():
    sim = sinew.open("ragdoll")
    sim.step(10)
    again = pickle.loads(pickle.dumps(sim))
    for one in (sim, again):
        one.step(10)
    assert again.hash() == sim.hash()


def test_what_is_no_snapshot_is_refused_and_changes_nothing():
    sim = sinew.open("ragdoll")
    sim.step(3)
    before, saved = sim.hash(), sinew.open("ragdoll").save()
    for wrong in (b"", b"SINEWSNP", saved[:-1], saved[:100], saved.replace(b"ragdoll", b"radgoll"), sinew.open("cloth3d").save(),
                  sinew.open("ragdoll", precision="float").save(), root / "scenes" / "ragdoll.json", '{"sinew": 1}', 3, None):
        with pytest.raises(ValueError):
            sim.restore(wrong)
    for name in ("nowhere.sinew", "ragdoll"):
        with pytest.raises(FileNotFoundError):
            sim.restore(name)
    with pytest.raises(ValueError, match="as it was saved"):
        sinew.open(saved, mode="classic")
    assert sim.hash() == before
    sim.close()
    for use in (sim.save, lambda: sim.restore(saved)):
        with pytest.raises(sinew.ClosedError):
            use()


@given(st.data())
def test_bytes_may_come_from_anybody(data):
    saved = bytearray(sinew.open(pendulum).save())
    for _ in range(data.draw(st.integers(1, 4))):
        saved[data.draw(st.integers(0, len(saved) - 1))] = data.draw(st.integers(0, 255))
    try:
        sinew.open(bytes(saved)).step(2)
    except (ValueError, sinew.Error):
        pass


def test_the_command_goes_on_from_it(tmp_path, command):
    sim = sinew.open("ragdoll")
    sim.run_until(1)
    sim.save(tmp_path / "at.sinew")
    subprocess.run([command, "run", tmp_path / "at.sinew", "--seconds", "2", "--save", tmp_path / "later.sinew"], check=True)
    sim.run(1)
    assert sinew.open(tmp_path / "later.sinew").hash() == sim.hash()


@pytest.mark.parametrize("name", ["rope", "nowhere"])
def test_a_state_is_restored_from_a_file_and_not_from_the_catalogue(tmp_path, monkeypatch, name):
    monkeypatch.chdir(tmp_path)
    sim = sinew.open("rope")
    with pytest.raises(FileNotFoundError) as caught:
        sim.restore(name)
    assert caught.value.filename == name


def test_a_state_that_cannot_be_written_names_its_own_file(tmp_path):
    path = tmp_path / "missing" / "state.sinew"
    with pytest.raises(FileNotFoundError) as caught:
        sinew.open("rope").save(path)
    assert caught.value.filename == str(path)
