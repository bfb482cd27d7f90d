"""The programs of the pages in docs/ do what the pages say."""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import sinew
from sinew.study import Study

root = Path(__file__).resolve().parents[3]
pages = ["bindings/python/README.md", "docs/how/python.md", "docs/how/studies.md"]


def files_of(page):
    """Text by name of the files that a page shows."""
    return dict(re.findall(r"<!-- (\S+) -->\n```\w+\n(.*?)```", (root / page).read_text(), re.DOTALL))


def program_of(page):
    """The pieces of a page, one below the other; lines keep their numbers, for messages."""
    program, inside, before = [], False, ""
    for line in (root / page).read_text().splitlines():
        if line.startswith("```"):
            inside = line == "```python" and not before.startswith("<!--")
            program.append("")
        else:
            program.append(line if inside else "")
        before = line
    assert re.search(r"\S", "\n".join(program))
    return "\n".join(program)


def blocks_of(page):
    """Lines of each block without a language: what is typed, and what is shown."""
    blocks, inside = [], None
    for line in (root / page).read_text().splitlines():
        if line.startswith("```"):
            inside = None if inside is not None else line
            if inside == "```":
                blocks.append([])
        elif inside == "```":
            blocks[-1].append(line)
    return blocks


def commands_of(page, word):
    """Lines of shell that begin with a word, without their comments."""
    return [line.split(" #")[0].strip() for block in blocks_of(page) for line in block if line.startswith(word + " ")]


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """A folder to work in, with the command `sinew` of the package first on the path."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "bin").mkdir()
    command = tmp_path / "bin" / "sinew"
    command.write_text(f'#!/bin/sh\nexec "{sys.executable}" -m sinew "$@"\n')
    command.chmod(0o755)
    (tmp_path / "examples").symlink_to(root / "examples")
    monkeypatch.setenv("PATH", f"{tmp_path / 'bin'}:{os.environ['PATH']}")
    monkeypatch.setenv("SINEW_PYTHON", sys.executable)
    for name, text in files_of("docs/how/studies.md").items():
        (tmp_path / name).write_text(text)
    return tmp_path


@pytest.mark.parametrize("page", pages)
def test_the_program_of_a_page_runs(page, folder):
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    exec(compile(program_of(page), root / page, "exec"), {"__name__": "__main__"})


def said(command):
    done = subprocess.run(command, shell=True, capture_output=True, text=True, timeout=240)
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_the_commands_of_the_page_of_studies_run(folder, monkeypatch):
    run, check, verify, collect = commands_of("docs/how/studies.md", "sinew study")
    assert said(check) == "8 cases\n"
    assert said(run).startswith("8 cases, 0 failed: bridge.study/index.html")
    assert said(verify) == "the same hashes\n"
    [line] = commands_of("docs/how/studies.md", "parallel")
    if not shutil.which("parallel"):
        pytest.skip("GNU parallel is not installed")
    whole = [row.hash for row in Study("bridge.study.json").rows()]
    shutil.rmtree("bridge.study")
    monkeypatch.setenv("HOME", str(folder))  # where GNU parallel keeps its own
    said(line.replace("32", "4"))
    assert said(collect).startswith("8 of 8 cases")
    assert [row.hash for row in Study("bridge.study.json").rows()] == whole


def test_the_mistakes_of_the_pages_are_told_as_they_are_shown(folder):
    """The message of the page of studies, for the study of the page with that mistake."""
    text = Path("bridge.study.json").read_text().replace('"figures.bridge.slack"', '"figures.bridge.slak"')
    Path("bridge.study.json").write_text(text)
    found = subprocess.run(["sinew", "study", "bridge.study.json"], capture_output=True, text=True).stderr.splitlines()
    [shown] = [block for block in blocks_of("docs/how/studies.md") if block[0].startswith("bridge.study.json:")]
    assert [line.split("(allowed")[0] for line in found] == [line.split("(allowed")[0] for line in shown]


def test_the_mistake_of_the_page_of_python_is_told_as_it_is_shown():
    [shown] = [block for block in blocks_of("docs/how/python.md") if block[0].startswith("<command line>")]
    [mistake] = sinew.check("ragdoll", solver={"substep": 8})
    assert [line.split("(allowed")[0] for line in mistake.text.splitlines()] == [line.split("(allowed")[0] for line in shown]


def test_dask_runs_the_program_of_the_page(folder):
    distributed = pytest.importorskip("distributed")
    with distributed.LocalCluster(2, threads_per_worker=1, dashboard_address=None, host="127.0.0.1") as cluster:
        assert "8 cases, 0 failed, 0 with other hashes elsewhere" in said(f"'{sys.executable}' run_dask.py {cluster.scheduler_address}")


def test_mpi_runs_the_program_of_the_page(folder, monkeypatch):
    pytest.importorskip("mpi4py")
    if not shutil.which("mpiexec"):
        pytest.skip("there is no mpiexec")
    for name in ("OMPI_ALLOW_RUN_AS_ROOT", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM"):
        monkeypatch.setenv(name, "1")
    said(f"mpiexec -n 3 --oversubscribe '{sys.executable}' -m mpi4py.futures run_mpi.py")
    assert len(Study("bridge.study.json").rows()) == 8


def test_slurm_runs_the_command_of_the_page(folder):
    tool = root / "tools" / "cluster_here"
    if subprocess.run([tool, "--check"], capture_output=True).returncode:
        pytest.skip("Slurm cannot run here: tools/cluster_here --check tells why")
    [line] = commands_of("docs/how/studies.md", "sbatch")
    said(f"'{tool}' '{folder}/cluster' {line.replace('sbatch', 'sbatch --wait', 1).replace('1-32', '1-3')}")
    assert Study("bridge.study.json").collect() == 0
