"""Scenes: where they come from, and what is said of mistakes."""

import json
import os
import subprocess
from pathlib import Path

import numpy as np
import pytest

import sinew
from conftest import pendulum

#: State of every scene after two seconds, in modes and precisions. A sample, and all of it with SINEW_THOROUGH.
golden = [line.split() for line in (Path(__file__).resolve().parents[3] / "tests/golden/scenes.txt").read_text().splitlines()
          if line and not line.startswith("#")]
slow = ("hammock", "folding_cloth")
sample = golden if os.environ.get("SINEW_THOROUGH") else [row for row in golden if row[0] not in slow][::3]


def test_a_scene_is_a_dict_a_text_a_path_or_a_name(tmp_path):
    path = tmp_path / "swing.json"
    path.write_text(json.dumps(pendulum))
    hashes = {sinew.open(scene).hash() for scene in (pendulum, json.dumps(pendulum), path, str(path))}
    assert len(hashes) == 1
    assert len(sinew.open("ragdoll")) > 10


@pytest.mark.parametrize("name, mode, precision, expected", sample)
def test_every_scene_has_the_bits_of_the_native_library(name, mode, precision, expected):
    with sinew.open(name, mode=mode, precision=precision) as sim:
        sim.run_until(2)
        assert sim.hash() == expected


def test_values_are_set_by_keyword_and_by_path():
    base = sinew.open(pendulum)
    assert sinew.open(pendulum, world={"gravity": [0, -1.62]}).hash() != base.hash()
    assert (sinew.open(pendulum, {"world.gravity": [0, -1.62]}).hash()
            == sinew.open(pendulum, world={"gravity": np.array([0, -1.62])}).hash())
    assert sinew.open(pendulum, solver={"rate": 120}).rate == 120
    assert sinew.open("ragdoll", mode="classic").is_classic
    assert sinew.open("ragdoll", precision="float").positions.dtype == np.float32


def test_a_mistake_has_its_place_and_what_was_meant():
    with pytest.raises(sinew.SceneError) as caught:
        sinew.open('{"sinew": 1,\n "figures": [{"prefab": "ragdoll", "masss": 80}]}')
    [error] = caught.value.errors
    assert (error.line, error.column, error.length) == (2, 36, 7)
    assert error.path == "/figures/0"
    assert 'did you mean "mass"?' in error.help
    assert "^~~~~~~" in str(caught.value)
    assert not error.is_override


def test_an_error_reads_as_the_command_prints_it(tmp_path, command):
    path = tmp_path / "wrong.json"
    path.write_text('{"sinew": 1, "figuers": [],\n "world": {"gravity": 3, "damping": -1}}')
    printed = subprocess.run([command, "check", path], capture_output=True, text=True).stderr
    with pytest.raises(sinew.SceneError) as caught:
        sinew.open(path)
    assert len(caught.value.errors) == 3
    for error in caught.value.errors:
        assert error.text.rstrip() in printed


def test_all_mistakes_are_told_also_those_of_overrides():
    mistakes = sinew.check(pendulum, solver={"substep": 3})
    assert mistakes[0].is_override and "substeps" in mistakes[0].help
    assert sinew.check(pendulum) == []
    assert sinew.check("{") != []


def test_names_that_are_wrong_are_answered_with_the_nearest():
    with pytest.raises(sinew.NotFoundError, match="did you mean 'ragdoll'"):
        sinew.open("ragdol")
    with pytest.raises(FileNotFoundError, match="the catalogue has 'ragdoll'"):
        sinew.open("scenes/ragdol.json")
    with pytest.raises(IsADirectoryError):
        sinew.open("..")
    with pytest.raises(sinew.Error, match="the name of a scene is empty"):
        sinew.open("")


@pytest.mark.parametrize("path", ["nothere.json", "./dir"])
def test_a_file_that_is_not_there_is_not_likened_to_just_any_scene(path):
    with pytest.raises(FileNotFoundError) as caught:
        sinew.open(path)
    assert "catalogue" not in str(caught.value)


def test_overrides_are_a_dict():
    with pytest.raises(TypeError, match="overrides are a dict of paths and values, not list"):
        sinew.open("ragdoll", ["world.gravity=[0, 1]"])


@pytest.mark.parametrize("scene", [3, None, ["rope"], {"sinew": object()}, {"sinew": 1, "figures": {1, 2}}])
def test_what_is_no_scene_is_refused_by_its_type(scene):
    with pytest.raises(TypeError):
        sinew.open(scene)


@pytest.mark.parametrize("scene", ["{}", "{\0}", '{"sinew": 1e999}', '{"sinew": 1} x', "{" * 5000, '{"sinew": 1, "about": "\\ud800"}'])
def test_hostile_texts_are_errors(scene):
    with pytest.raises(sinew.Error):
        sinew.open(scene)


def test_a_file_may_hold_any_bytes(tmp_path):
    path = tmp_path / "bytes.json"
    path.write_bytes(b'{"sinew": 1, "about": "\xff\xfe"}')
    with pytest.raises(sinew.SceneError):
        sinew.open(path)
    path.write_bytes(b"\xef\xbb\xbf" + json.dumps(pendulum).encode())
    sinew.check(path)


def test_the_catalogue_and_the_descriptions():
    assert {"ragdoll", "rope", "cloth3d"} <= set(sinew.catalogue())
    assert sinew.schema()["type"] == "object"
    assert "rope" in {prefab["name"] for prefab in sinew.prefabs()}


def test_the_scene_of_a_simulation_opens_again():
    sim = sinew.open("ragdoll", {"figures.bob.height": 150})
    again = sinew.open(sim.scene)
    assert again.hash() == sim.hash()


def test_values_of_a_running_scene():
    sim = sinew.open(pendulum)
    sim.step(10)
    before = sim.positions.copy()
    sim.set("world.gravity", [0, -1.62])
    assert (sim.positions == before).all()
    with pytest.raises(sinew.SceneError):
        sim.set("world.gravty", 3)
    gravity = next(p for p in sim.parameters if p["path"] == "world.gravity")
    assert gravity["value"][1] == -1.62
