"""The programs in examples/ do what they say."""

import subprocess
import sys
from pathlib import Path

examples = Path(__file__).resolve().parents[3] / "examples"


def test_a_swing_learns_to_pump(monkeypatch, capsys):
    monkeypatch.syspath_prepend(examples)
    import learn_to_swing

    learn_to_swing.learn(5)
    means = [float(line.split()[4]) for line in capsys.readouterr().out.splitlines()]
    assert means[-1] > 1.8 * means[0]  # 0.13 to 0.3 rad


def test_the_benchmark_runs():
    program = Path(__file__).resolve().parents[1] / "bench" / "batch.py"
    done = subprocess.run([sys.executable, program, "--worlds", "4", "--steps", "5", "--turns", "2"], capture_output=True, text=True,
                          check=True)
    assert done.stdout.count("ragdoll") == 1
