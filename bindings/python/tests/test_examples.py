"""The programs in examples/ do what they say."""

from pathlib import Path

examples = Path(__file__).resolve().parents[3] / "examples"


def test_a_swing_learns_to_pump(monkeypatch, capsys):
    monkeypatch.syspath_prepend(examples)
    import learn_to_swing

    learn_to_swing.learn(5)
    means = [float(line.split()[4]) for line in capsys.readouterr().out.splitlines()]
    assert means[-1] > 1.8 * means[0]  # 0.13 to 0.3 rad


def test_the_benchmark_runs(monkeypatch, capsys):
    monkeypatch.syspath_prepend(Path(__file__).resolve().parents[1])
    import bench

    bench.main(["--worlds", "4", "--steps", "5", "--turns", "2"])
    assert capsys.readouterr().out.count("ragdoll") == 1
