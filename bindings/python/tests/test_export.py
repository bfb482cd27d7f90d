"""Files of other programs."""

import json
import struct

import numpy as np
import pytest

import sinew
from conftest import pendulum


def test_a_cache_has_the_positions_of_every_frame(tmp_path):
    sim = sinew.open("cloth3d")
    silk, seen = sim["silk"], []
    other = sim.copy()
    done = sim.export(tmp_path / "silk.pc2", seconds=0.2, fps=30, figures=["silk"])
    assert sorted(path.rsplit(".", 1)[1] for path in done.files) == ["mtl", "obj", "pc2"]
    for frame in range(6):
        other.run_until(frame / 30)
        seen.append(np.array(other["silk"].positions, np.float32))
    data = (tmp_path / "silk.pc2").read_bytes()
    count, _, _, frames = struct.unpack_from("<IffI", data, 16)
    assert (count, frames) == (len(silk.positions), 6)
    np.testing.assert_allclose(np.frombuffer(data, "<f4", offset=32).reshape(6, count, 3), seen, atol=1e-6)


def test_a_lottie_and_a_moment(tmp_path):
    sim = sinew.open(pendulum)
    done = sim.export(tmp_path / "p.json", seconds=0.1, fps=20, width=64, height=48)
    assert json.loads((tmp_path / "p.json").read_text())["op"] == 2
    assert any("px" in note for note in done.notes)
    assert sim.export(tmp_path / "p.png", background="none").files == [str(tmp_path / "p.png")]


def test_wishes_that_cannot_be(tmp_path):
    sim = sinew.open(pendulum)
    for path, more in (("a.xyz", {}), ("a-%d-%d.obj", {}), ("a-%d.glb", {}), ("a.obj", {"seconds": 1}),
                       ("a.svg", {"background": "blurple"}), ("a.glb", {"fps": -1}), ("a.glb", {"fps": 1e300}), ("a.glb", {"seconds": float("nan")})):
        with pytest.raises(ValueError):
            sim.export(tmp_path / path, **more)
    with pytest.raises(sinew.NotFoundError, match="nobody"):
        sim.export(tmp_path / "a.glb", seconds=0.1, figures=["nobody"])
    assert list(tmp_path.iterdir()) == []
