"""The programs in examples/ do what they say."""

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

examples = Path(__file__).resolve().parents[3] / "examples"


def test_a_swing_learns_to_pump(monkeypatch, capsys):
    monkeypatch.syspath_prepend(examples)
    import learn_to_swing

    learn_to_swing.learn(5)
    means = [float(line.split()[4]) for line in capsys.readouterr().out.splitlines()]
    assert means[-1] > 1.8 * means[0]  # 0.13 to 0.3 rad


def test_a_swing_is_a_vector_environment(monkeypatch):
    """reset and step as Gymnasium's VectorEnv has them: worlds of a mask begin anew, the others go on."""
    monkeypatch.syspath_prepend(examples)
    import learn_to_swing

    swings = learn_to_swing.Swings(4, seconds=0.1, reward=lambda angles: 6 * np.cos(angles))
    start, info = swings.reset(seed=3)
    assert swings.num_envs == 4 and start.shape == (4, 4) and info == {}
    for i in range(4):
        moved, rewards, terminated, truncated, info = swings.step(np.array([-1, 0, 0.5, 1]))
        assert rewards == pytest.approx(np.cos(swings.angles()))
        assert rewards.shape == terminated.shape == truncated.shape == (4,) and not terminated.any() and not truncated.any()
    mask = np.array([True, False, False, True])
    again, _ = swings.reset(options={"reset_mask": mask})
    assert np.array_equal(again, np.where(mask[:, None], start, moved))
    for i in range(2):
        truncated = swings.step(np.zeros(4))[3]
    assert truncated.tolist() == [False, True, True, False]


def test_the_benchmark_runs():
    program = Path(__file__).resolve().parents[1] / "bench" / "batch.py"
    done = subprocess.run([sys.executable, program, "--worlds", "4", "--steps", "5", "--turns", "2"], capture_output=True, text=True,
                          check=True)
    assert done.stdout.count("ragdoll") == 1
