"""Studies whose cases, processes, disks and callers do what nobody should."""

import csv
import json
import math
import os
import pickle
import shutil
import signal
import subprocess
import sys
import time
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

import pytest

import sinew
from conftest import pendulum, swing, written
from sinew.study import ResultsError, Study
from sinew.study import page as study_page

many = {**swing, "vary": {"world.damping": {"from": 0, "to": 1, "steps": 4000}}}


def table(study):
    with open(study.folder / "table.csv", newline="") as file:
        return list(csv.DictReader(file))


def started(path, *words):
    return subprocess.Popen([sys.executable, "-m", "sinew", "study", path, *words], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
                            start_new_session=True)


def wait_for_rows(path, count):
    study = Study(path)
    for _ in range(3000):
        if len(study.rows()) >= count:
            return study
        time.sleep(0.02)
    raise TimeoutError


def test_kill_9_of_the_command_alone_ends_its_processes_and_frees_the_results(tmp_path):
    path = written(tmp_path, {**many, "until": 1})
    process = started(path, "-j", "2")
    study = wait_for_rows(path, 20)
    workers = [int(line) for line in Path(f"/proc/{process.pid}/task/{process.pid}/children").read_text().split()]
    assert len(workers) == 2
    os.kill(process.pid, signal.SIGKILL)
    process.wait()
    before = len(study.rows())

    def stop(done, total, failed):
        raise InterruptedError

    with pytest.raises(InterruptedError):  # at once, with all rows
        study.run(workers=1, progress=stop)
    assert len(study.rows()) >= before
    for _ in range(500):
        if not any(Path(f"/proc/{worker}").exists() for worker in workers):
            return
        time.sleep(0.02)
    pytest.fail("a worker outlived its study by ten seconds")


def test_ctrl_c_ends_a_study_with_one_line(tmp_path):
    path = written(tmp_path, many)
    process = started(path, "-j", "2")
    wait_for_rows(path, 20)
    os.killpg(process.pid, signal.SIGINT)  # as a terminal does: the workers get it, too
    said = process.communicate(timeout=60)[1]
    assert process.returncode == 130 and said.strip() == "interrupted; run it again to go on"
    assert 20 <= len(Study(path).rows()) < 4000


functions = """import sys
import numpy
def leave(sim): sys.exit(3)
def never(sim):
    while True: pass
def word(sim): return "high"
def pair(sim): return numpy.zeros(2)
def nan(sim): return float("nan") if sim.scene["world"]["damping"] == 1 else sim.energy
def nothing(sim): return None
def half(sim): raise ValueError("\\ud800" + "x" * 5000)
class Dumb(Exception):
    def __str__(self): raise KeyError
def dumb(sim): raise Dumb
def deaf(sim):
    while True:
        try:
            while True: pass
        except Exception: pass
def stubborn(sim):
    for attempt in range(2):
        try:
            while True: pass
        except BaseException:
            if attempt: raise
"""


@pytest.mark.parametrize("name, reason", [("leave", "SystemExit"), ("never", "longer than 0.3 s"), ("word", "ValueError"), ("pair", "TypeError"),
                                          ("half", "ValueError: \\ud800xxx"), ("dumb", "Dumb: without a text"),
                                          ("deaf", "longer than 0.3 s"), ("stubborn", "longer than 0.3 s")])
@pytest.mark.parametrize("workers", [1, 2])
def test_a_function_fails_its_case_alone(tmp_path, name, reason, workers):
    (tmp_path / "mine.py").write_text(functions)
    study = Study(written(tmp_path, {**swing, "vary": {"world.damping": [0, 1]}, "case_limit": 0.3 if "longer" in reason else 60,
                                     "measure": {"m": {"function": f"mine.py:{name}"}}}))
    assert study.run(workers=workers) == 2
    assert all(reason in row["failed"] for row in table(study))


@pytest.mark.parametrize("name", [b"b\xfe", "höhe 🦆".encode()])
def test_a_folder_has_any_name(tmp_path, name):
    folder = tmp_path / os.fsdecode(name)
    folder.mkdir()
    path = written(folder, {**swing, "vary": {"world.damping": [0, 1]}}, os.fsdecode(name + b".study.json"))
    for encoding in ("utf-8", "ascii"):
        done = subprocess.run([sys.executable, "-m", "sinew", "study", path, "-j", "1"], capture_output=True, env={**os.environ, "PYTHONIOENCODING": encoding})
        assert done.returncode == 0 and not done.stderr and done.stdout.startswith(b"2 cases, 0 failed: ")
    assert "case 1" in (Study(path).folder / "index.html").read_text()


def test_a_process_is_sent_no_points(tmp_path):
    """A million points would go along with every picture."""
    path = written(tmp_path, {**swing, "sample": "random", "cases": 10**6, "vary": {"world.damping": {"from": 0, "to": 1}}})
    design = Study(path).file.design
    again = pickle.loads(pickle.dumps(design))
    assert design.values()[999_999] == again.values()[999_999] and design.values() is design.values()
    assert len(pickle.dumps(design)) < 1000


def test_a_measure_may_be_nothing_or_no_number(tmp_path):
    (tmp_path / "mine.py").write_text(functions)
    study = Study(written(tmp_path, {**swing, "vary": {"world.damping": [0, 1, 2]}, "best": "nan",
                                     "measure": {"nan": {"function": "mine.py:nan"}, "nothing": {"function": "mine.py:nothing"}}}))
    assert study.run(workers=1) == 0
    assert [math.isnan(row.measures["nan"]) for row in study.rows()] == [False, True, False]
    page = (study.folder / "index.html").read_text()
    assert "case 0" in page and "case 2" in page and "case 1" not in page


def test_the_page_of_slow_cases_is_not_slower(tmp_path):
    """A case that ran out of time is shown as it is when the page runs out of its own."""
    study = Study(written(tmp_path, {**swing, "until": 1e6, "case_limit": 0.2, "vary": {"world.damping": [0, 1, 2, 3]}}))
    start = time.monotonic()
    assert study.run(workers=2) == 4
    assert time.monotonic() - start < 30
    assert len(list((study.folder / "cases").glob("*.png"))) == 4


def end_of_two(study, number, values, folder):
    if number == 2:
        os._exit(1)
    return picture_case(study, number, values, folder)


picture_case = study_page.picture_case


def test_a_picture_that_ends_its_process_is_left_out(tmp_path, monkeypatch):
    monkeypatch.setattr(study_page, "picture_case", end_of_two)
    study = Study(written(tmp_path, {**swing, "vary": {"world.damping": [0, 1, 2, 3]}}))
    assert study.run(workers=1) == 0
    page = (study.folder / "index.html").read_text()
    assert all(f"case {number}" in page for number in range(4))
    assert [number for number in range(4) if f"cases/{number}.png" in page] == [0, 1, 3]


@pytest.mark.parametrize("name, path", [("rope", "figures.rope.weight"), ("dress", "world.damping")])
def test_a_case_of_the_page_has_the_images_and_models_of_its_scene(tmp_path, name, path):
    study = Study(written(tmp_path, {"sinew_study": 1, "scene": name, "vary": {path: [2]}, "until": 0.1, "measure": {"e": "energy"}}))
    assert study.run(workers=1) == 0
    shutil.move(study.folder / "cases", tmp_path / "elsewhere")
    shown, meant = sinew.open(tmp_path / "elsewhere" / "0.json"), sinew.open(name, {path: 2})
    assert shown.hash() == meant.hash() and (shown.draw() == meant.draw()).all()


def test_results_are_found_from_any_folder(tmp_path, monkeypatch):
    (tmp_path / "scene.json").write_text(json.dumps(pendulum))
    (tmp_path / "other").mkdir()
    written(tmp_path, {**swing, "scene": "scene.json", "vary": {"world.damping": [0]}})
    Study(tmp_path / "swing.study.json").run(workers=1)
    for folder, name in ((tmp_path, "swing.study.json"), (tmp_path / "other", "../swing.study.json")):
        monkeypatch.chdir(folder)
        ran = []
        assert Study(name).run(workers=1, progress=lambda *now: ran.append(now)) == 0
        assert not ran


def test_rows_are_read_while_a_run_writes_them(tmp_path):
    study = Study(written(tmp_path, swing))
    seen = []
    study.run(workers=1, progress=lambda done, total, failed: seen.append((done, len(Study(study.file.path).rows()))))
    assert seen == [(i, i) for i in range(1, 13)]


def test_nothing_is_verified_where_there_is_nothing(tmp_path):
    path = written(tmp_path, swing)
    with pytest.raises(ResultsError, match="run the study first"):
        Study(path).verify()
    done = subprocess.run([sys.executable, "-m", "sinew", "study", path, "--verify", "3"], capture_output=True, text=True)
    assert done.returncode == 1 and "run the study first" in done.stderr
    assert not (tmp_path / "swing.study").exists() and Study(path).rows() == []


def test_verification_runs_elsewhere(tmp_path):
    study = Study(written(tmp_path, swing))
    study.run(workers=1)
    with ProcessPoolExecutor(2) as pool:
        assert study.verify(5, executor=pool) == []


def test_what_a_study_has_not_is_refused(tmp_path):
    study = Study(written(tmp_path, swing))
    for use in (lambda: study.values(12), lambda: study.values(-1), lambda: study.scene(99)):
        with pytest.raises(LookupError, match="0 to 11"):
            use()
    for use in (lambda: study.run(part=(0, 3)), lambda: study.run(part=(4, 3)), lambda: study.run(workers=0), lambda: study.run(workers=-1),
                lambda: study.verify(0)):
        with pytest.raises(ValueError):
            use()
    for words in (("-j", "0"), ("-j", "-2"), ("--verify", "0"), ("--verify", "x"), ("--part", "1/x"), ("--part", "0/0")):
        done = subprocess.run([sys.executable, "-m", "sinew", "study", study.file.path, *words], capture_output=True, text=True)
        assert done.returncode == 2 and "Traceback" not in done.stderr


@pytest.mark.parametrize("bytes_", [b"", b"no base", b"SQLite format 3\0" + b"x" * 5000])
def test_a_broken_file_of_results_is_told(tmp_path, bytes_):
    study = Study(written(tmp_path, {**swing, "vary": {"world.damping": [0]}}))
    study.folder.mkdir()
    (study.folder / "results.sqlite").write_bytes(bytes_)
    if bytes_:
        with pytest.raises(ResultsError, match="results.sqlite"):
            study.run(workers=1)
        with pytest.raises(ResultsError):
            study.rows()
    else:
        assert study.rows() == []
    assert study.run(workers=1, fresh=True) == 0


def test_a_disk_that_fills_is_told_and_the_study_goes_on(tmp_path):
    """A disk of 200 KB, then of 20 MB."""
    disk = tmp_path / "disk"
    disk.mkdir()
    if subprocess.run(["mount", "-t", "tmpfs", "-o", "size=200k", "none", disk], capture_output=True).returncode:
        pytest.skip("no disk can be mounted here")
    try:
        path = written(tmp_path, {**swing, "vary": {"world.damping": {"from": 0, "to": 1, "steps": 1500}}, "until": 0.05})
        words = [sys.executable, "-m", "sinew", "study", path, "-o", disk / "results", "-j", "2"]
        full = subprocess.run(words, capture_output=True, text=True)
        assert full.returncode == 1 and "full" in full.stderr and "kept" in full.stderr and "Traceback" not in full.stderr
        subprocess.run(["mount", "-o", "remount,size=20m", disk], check=True)
        kept = len(Study(path, disk / "results").rows())
        assert 0 < kept < 1500
        subprocess.run(words, check=True, capture_output=True)
        assert [row.number for row in Study(path, disk / "results").rows()] == list(range(1500))
    finally:
        subprocess.run(["umount", disk])
