"""What the tests share."""

import json
import os
import shutil
import signal
from pathlib import Path

import pytest
from hypothesis import HealthCheck, settings

root = Path(__file__).resolve().parents[3]

# A shell starts what runs in the background with SIGINT ignored, and so would every test of Ctrl-C and its processes.
signal.signal(signal.SIGINT, signal.default_int_handler)

settings.register_profile("sinew", deadline=None, derandomize=True, suppress_health_check=[HealthCheck.too_slow],
                          max_examples=int(os.environ.get("SINEW_EXAMPLES", "30")))
settings.load_profile("sinew")


@pytest.fixture(scope="session")
def command():
    """The command `sinew`; tests that compare with it are skipped where it is not built."""
    found = os.environ.get("SINEW") or shutil.which("sinew") or str(root / "build" / "bin" / "sinew")
    if not os.access(found, os.X_OK):
        pytest.skip("the command is not built")
    return found


#: A pendulum: one rod, one weight, no damping; SI units.
pendulum = {
    "sinew": 1,
    "world": {"gravity": [0, -9.81], "damping": 0},
    "figures": [{"name": "bob", "particles": {"top": {"at": [0, 0], "pinned": True}, "weight": {"at": [1, 0]}},
                 "constraints": [{"between": ["top", "weight"], "name": "rod"}]}],
}

#: A cloth that tears: rows come and go.
tearing = {
    "sinew": 1,
    "world": {"gravity": [0, -9.81]},
    "figures": [{"prefab": "cloth", "name": "cloth", "breaking_strain": 0.05}],
}

#: A study of pendulums: 12 cases.
swing = {
    "sinew_study": 1,
    "scene": pendulum,
    "vary": {"world.gravity": [[0, -1], [0, -2], [0, -4]], "figures.bob.particles.weight.mass": {"from": 1, "to": 8, "steps": 4, "scale": "log"}},
    "until": 0.5,
    "measure": {"height": "bob/weight.y", "stretch": {"max": "stretch"}, "energy": "energy", "pull": {"max": "bob/rod.tension"},
                "torn": {"first": "torn"}, "grabs": {"count": "grab"}},
}


def written(folder, study, name="swing.study.json"):
    path = folder / name
    path.write_text(study if isinstance(study, str) else json.dumps(study, indent=1))
    return path
