"""Pictures, films and tables."""

import shutil
import struct
import subprocess

import numpy as np
import pytest

import sinew
from conftest import pendulum


def size_of(png):
    assert png[:8] == b"\x89PNG\r\n\x1a\n"
    return struct.unpack(">II", png[16:24])


def test_a_simulation_shows_itself():
    sim = sinew.open("ragdoll")
    assert size_of(sim._repr_png_()) == sim.size
    assert "particles" in repr(sim)


def test_a_picture_is_an_array():
    sim = sinew.open("ragdoll")
    picture = sim.draw(320, 240)
    assert picture.shape == (240, 320, 3) and picture.dtype == np.uint8
    assert len(np.unique(picture.reshape(-1, 3), axis=0)) > 3
    assert sim.draw(height=120).shape[0] == 120
    moved = sim.copy()
    moved.run(1)
    assert (moved.draw(320, 240) != picture).any()
    assert (moved.draw(320, 240, overlays=["tension"]) != moved.draw(320, 240)).any()
    for width, height in ((0, 10), (10, -1), (20000, 10)):
        with pytest.raises(ValueError):
            sim.draw(width, height)
    with pytest.raises(ValueError, match="tension"):
        sim.draw(overlays=["tensions"])


def test_images_of_a_scene_are_painted():
    """The rope of the scene has the colours of its sprite; the same scene without its folder is drawn plainly."""
    sim = sinew.open("rope")
    plain = sinew.open(sim.scene)
    assert plain.hash() == sim.hash()
    assert (plain.draw() != sim.draw()).any()


@pytest.mark.parametrize("extension", ["png", "svg", "pdf"])
def test_pictures_are_saved(tmp_path, extension):
    path = tmp_path / f"picture.{extension}"
    sinew.open("ragdoll").save_picture(path, width=100)
    assert path.stat().st_size > 500
    with pytest.raises(ValueError, match="a film is"):
        sinew.open("ragdoll").save_film(path, 1)
    with pytest.raises(ValueError):
        sinew.open("ragdoll").save_picture(tmp_path / "picture.xyz")
    with pytest.raises(ValueError):
        sinew.open("ragdoll").save_picture(path / "inside_a_file.png")


def test_a_picture_is_that_of_the_command(tmp_path, command):
    subprocess.run([command, "render", "ragdoll", "-o", tmp_path / "command.png", "--at", "0"], check=True, capture_output=True)
    sinew.open("ragdoll").save_picture(tmp_path / "python.png")
    assert (tmp_path / "command.png").read_bytes() == (tmp_path / "python.png").read_bytes()


def test_a_trace_is_that_of_the_command(tmp_path, command):
    pandas = pytest.importorskip("pandas")
    path = tmp_path / "trace.csv"
    subprocess.run([command, "run", "ragdoll", "--seconds", "0.5", "--trace", path, "--of", "bob/head"], check=True,
                   capture_output=True)
    expected = pandas.read_csv(path, float_precision="round_trip", dtype={"time": float})
    found = sinew.open("ragdoll").trace(0.5, "bob/head")
    assert list(found.columns) == list(expected.columns)
    pandas.testing.assert_frame_equal(found.reset_index(drop=True), expected, check_exact=True)


def test_a_trace_has_a_row_a_particle_and_a_note():
    pytest.importorskip("pandas")
    sim = sinew.open(pendulum)
    frame = sim.trace(1, ["bob/weight", "bob"], every=10)
    assert len(frame) == 2 * 7 and set(frame.name) == {"bob/top", "bob/weight"}
    assert frame.time.iloc[-1] == pytest.approx(1)
    assert np.allclose(np.hypot(frame.x, frame.y)[frame.name == "bob/weight"], 1, atol=1e-9)
    with pytest.raises(sinew.NotFoundError):
        sim.trace(1, "nobody")
    with pytest.raises(ValueError):
        sim.trace(-1)
    with pytest.raises(ValueError):
        sim.trace(1, every=0)


def test_history_is_that_of_reports():
    pytest.importorskip("pandas")
    sim = sinew.open(pendulum)
    frame = sim.history(2, "energy", "stretch", "kinetic", every=6)
    assert list(frame.columns) == ["energy", "stretch", "kinetic"] and len(frame) == 21
    assert np.ptp(frame.energy) < 2e-5 * 9.81  # an undamped pendulum keeps the energy of its fall
    assert frame.kinetic.iloc[-1] == sim.report().kinetic
    with pytest.raises(ValueError, match="kinetic"):
        sim.history(1, "kinetics")


def test_frames_rendered_in_parts_are_those_of_the_whole(tmp_path):
    whole = sinew.open("ragdoll").save_frames(tmp_path / "whole", 0.5, 20, width=160)
    for part in (3, 1, 2):
        sinew.open("ragdoll").save_frames(tmp_path / "parts", 0.5, 20, (part, 3), width=160)
    names = sorted(path.name for path in (tmp_path / "parts").iterdir())
    assert names == [f"{i:06}.png" for i in range(10)] and len(whole) == 10
    for name in names:
        assert (tmp_path / "parts" / name).read_bytes() == (tmp_path / "whole" / name).read_bytes()
    for part in ((0, 3), (4, 3)):
        with pytest.raises(ValueError):
            sinew.open("ragdoll").save_frames(tmp_path, 1, 20, part)


def test_a_film_is_saved(tmp_path):
    if not shutil.which("ffmpeg"):
        pytest.skip("there is no ffmpeg")
    sinew.open("ragdoll").save_film(tmp_path / "film.gif", 0.2, width=80)
    assert (tmp_path / "film.gif").read_bytes()[:6] == b"GIF89a"
