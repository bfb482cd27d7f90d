"""The tables of studies as Parquet, by pyarrow; and a Python without it."""

import json
import subprocess
import sys

import pytest

from conftest import swing, written
from sinew.study import ResultsError, Study, command, results


@pytest.fixture
def pyarrow():
    return pytest.importorskip("pyarrow.parquet", reason="pyarrow is not installed: Debian 12 has no package of it")


@pytest.fixture
def without(monkeypatch):
    """A Python that has no pyarrow."""
    monkeypatch.setitem(sys.modules, "pyarrow", None)
    monkeypatch.setitem(sys.modules, "pyarrow.parquet", None)


# --- with pyarrow -------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("values, kind, seen", [
    ([1, 2], "int64", [1, 2]), ([1, 2.5], "double", [1.0, 2.5]), ([10**12, 1.5], "double", [1e12, 1.5]),
    ({"from": 1, "to": 2, "steps": 2}, "double", [1.0, 2.0]), ({"from": 1, "to": 2, "steps": 2, "whole": True}, "int64", [1, 2])])
def test_numbers_that_vary_have_one_type(tmp_path, pyarrow, values, kind, seen):
    study = Study(written(tmp_path, {**swing, "vary": {"figures.bob.particles.weight.mass": values}, "until": 0.01}))
    study.run(workers=1)
    column = pyarrow.read_table(study.folder / "table.parquet")["figures.bob.particles.weight.mass"]
    assert str(column.type) == kind and column.to_pylist() == seen


def test_a_table_of_parquet_has_the_values_of_that_of_csv(tmp_path, pyarrow, monkeypatch):
    """Failures, empty measures and lists among them, in more than one group of rows."""
    mine = "def half(sim):\n    return None if sim.energy < -1 else 1 / (sim.energy > -0.4)\n"
    (tmp_path / "mine.py").write_text(mine)
    monkeypatch.setattr(results, "_rows_of_group", 3)
    study = Study(written(tmp_path, {
        **swing, "vary": {"world.gravity": [[0, -1], [0, -0.1]], "view.plain": [True, False], "units.length": ["m"]},
        "measure": {"energy": "energy", "half": {"function": "mine.py:half"}, "torn": {"first": "torn"}}}))
    study.run(workers=1, parquet=True)
    written_table = pyarrow.read_table(study.folder / "table.parquet")
    assert written_table.column_names == list(study.frame().columns)
    for name in written_table.column_names:
        shown = [None if value != value else value for value in study.frame()[name].tolist()]
        assert written_table[name].to_pylist() == shown, name
    kinds = {name: str(written_table[name].type) for name in ("hash", "failed", "world.gravity", "units.length", "view.plain")}
    assert kinds.pop("view.plain") == "bool" and set(kinds.values()) == {"string"}
    assert json.loads(written_table["world.gravity"][0].as_py()) == [0, -1]
    assert not list(study.folder.glob("*.partial"))


# --- without ------------------------------------------------------------------------------------------------------


def test_without_pyarrow_the_table_is_that_of_csv_and_nothing_is_said(tmp_path, without, capfd):
    path = written(tmp_path, swing)
    stale = Study(path).folder / "table.parquet"
    stale.parent.mkdir()
    stale.write_bytes(b"rows of an earlier run, by a Python with pyarrow")
    assert command.main([str(path), "-j", "1"]) == 0
    said = capfd.readouterr()
    assert said.err == "" and "parquet" not in said.out.lower()
    assert (stale.parent / "table.csv").exists() and not stale.exists()


def test_parquet_by_name_needs_pyarrow_and_is_refused_before_the_first_case(tmp_path, without, capfd):
    path = written(tmp_path, swing)
    assert command.main([str(path), "--parquet"]) == 1
    said = capfd.readouterr()
    assert said.out == "" and len(said.err.splitlines()) == 1
    assert all(word in said.err for word in ("pyarrow", "table.csv", "results.sqlite"))
    study = Study(path)
    assert not study.folder.exists()
    for call in (study.run, study.collect):
        with pytest.raises(ResultsError, match="needs pyarrow"):
            call(parquet=True)
    assert not study.folder.exists()


@pytest.mark.parametrize("other", [["--check"], ["--verify", "3"], ["--part", "1/2"]])
def test_parquet_goes_with_what_writes_a_table(tmp_path, other):
    done = subprocess.run([sys.executable, "-m", "sinew", "study", written(tmp_path, swing), "--parquet", *other], capture_output=True, text=True)
    assert done.returncode == 2 and "--collect" in done.stderr
