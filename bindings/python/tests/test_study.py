"""Studies: the file, the cases, runs that are interrupted, broken, resumed, divided."""

import csv
import json
import os
import pty
import signal
import sqlite3
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor

import pytest

import sinew
from conftest import pendulum, swing, written
from sinew.study import ResultsError, Study, command


def table(study):
    with open(study.folder / "table.csv", newline="") as file:
        return list(csv.DictReader(file))


def test_a_study_is_its_cases_one_by_one(tmp_path):
    study = Study(written(tmp_path, swing))
    assert len(study) == 12 and study.run(workers=2) == 0
    rows = table(study)
    assert [int(row["case"]) for row in rows] == list(range(12))
    for number in (0, 5, 11):
        values = study.values(number)
        sim = sinew.open(pendulum, values)
        sim.run_until(0.5)
        row = rows[number]
        assert row["hash"] == sim.hash()
        assert float(row["height"]) == sim["bob/weight"].position[1] and float(row["energy"]) == sim.energy
        assert float(row["figures.bob.particles.weight.mass"]) == values["figures.bob.particles.weight.mass"]
        assert row["torn"] == "" and row["grabs"] == "0.0" or row["grabs"] == "0"
    assert study.scene(7)["world"]["gravity"] == [0, -2]
    assert sinew.open(study.scene(7)).hash() == sinew.open(pendulum, study.values(7)).hash()


def test_a_maximum_is_over_all_steps(tmp_path):
    """The pull of a pendulum let go level is 3 m g in the lowest point."""
    only = {**swing, "vary": {"world.gravity": [[0, -9.81]]}, "until": 2}
    study = Study(written(tmp_path, only))
    study.run(workers=1)
    assert float(table(study)[0]["pull"]) == pytest.approx(3 * 9.81, rel=0.01)


def test_the_page_shows_cases_with_their_scenes(tmp_path):
    study = Study(written(tmp_path, {**swing, "about": "Swings <&> things"}))
    study.run()
    page = (study.folder / "index.html").read_text()
    assert "Swings &lt;&amp;&gt; things" in page and "12 of 12 cases, 0 failed" in page
    assert "torn = none" in page
    assert "<!-- energy -->" in page and "<!-- torn -->" not in page  # matplotlib notes its texts; nothing is torn
    shown = sorted((study.folder / "cases").glob("*.json"))
    assert len(shown) == 12
    number = int(shown[3].stem)
    assert sinew.open(shown[3]).hash() == sinew.open(pendulum, study.values(number)).hash()
    assert (study.folder / "cases" / f"{number}.png").read_bytes()[:4] == b"\x89PNG"


def test_a_second_run_does_nothing_and_an_interrupted_one_goes_on(tmp_path):
    study = Study(written(tmp_path, swing))

    class Enough(Exception):
        pass

    def stop(done, total, failed):
        if done >= 4:
            raise Enough

    with pytest.raises(Enough):
        study.run(workers=1, progress=stop)
    assert len(study.rows()) == 4
    ran = []
    study.run(workers=1, progress=lambda done, total, failed: ran.append(done))
    assert ran[0] == 5 and ran[-1] == 12
    ran.clear()
    study.run(workers=1, progress=lambda *now: ran.append(now))
    assert not ran


def test_kill_9_loses_at_most_the_running_cases(tmp_path):
    path = written(tmp_path, {**swing, "vary": {"world.damping": {"from": 0, "to": 1, "steps": 4000}}})
    process = subprocess.Popen([sys.executable, "-m", "sinew", "study", path, "-j", "2"], stdout=subprocess.DEVNULL,
                               start_new_session=True)
    base = tmp_path / "swing.study" / "results.sqlite"

    def rows():
        try:
            return sqlite3.connect(f"file:{base}?mode=ro", uri=True).execute("SELECT count(*) FROM rows").fetchone()[0]
        except sqlite3.Error:
            return 0

    while rows() < 50:
        assert process.poll() is None
        time.sleep(0.02)
    before = rows()
    os.killpg(process.pid, signal.SIGKILL)
    process.wait()
    study = Study(path)
    assert before <= len(study.rows()) < 4000
    numbers = [row.number for row in study.rows()]
    assert len(set(numbers)) == len(numbers)


def test_what_fails_is_a_row_with_its_reason(tmp_path):
    (tmp_path / "mine.py").write_text("def odd(sim):\n    return 1 / (sim.dimension - 2)\n\ndef seconds(sim):\n    return sim.seconds\n")
    study = Study(written(tmp_path, {**swing, "measure": {"odd": {"function": "mine.py:odd"}, "t": {"function": "mine.py:seconds"}}}))
    assert study.run(workers=1) == 12
    assert all("ZeroDivisionError" in row["failed"] for row in table(study))
    assert "ZeroDivisionError" in (study.folder / "index.html").read_text()
    slow = Study(written(tmp_path, {**swing, "until": 1000, "case_limit": 0.01, "vary": {"world.damping": [0]}}, "slow.study.json"))
    assert slow.run(workers=1) == 1 and "longer than 0.01 s" in table(slow)[0]["failed"]
    good = Study(written(tmp_path, {**swing, "measure": {"t": {"function": "mine.py:seconds"}}}, "good.study.json"))
    assert good.run(workers=2) == 0 and float(table(good)[0]["t"]) == pytest.approx(0.5)


def test_a_case_that_ends_its_process_fails_alone(tmp_path):
    (tmp_path / "mine.py").write_text("import os\n\ndef end(sim):\n    if sim.scene['world'].get('damping') == 2:\n        os._exit(1)\n    return 1\n")
    study = Study(written(tmp_path, {**swing, "vary": {"world.damping": [0, 1, 2, 3, 4, 5]}, "measure": {"end": {"function": "mine.py:end"}}}))
    assert study.run(workers=2) == 1
    assert ["process ended" in row["failed"] for row in table(study)] == [False, False, True, False, False, False]


def test_an_event_ends_a_case(tmp_path):
    study = Study(written(tmp_path, {**swing, "scene": {**pendulum, "events": [{"at": 0.2, "impulse": "bob/weight", "by": [0, 1]}]},
                                     "vary": {"world.damping": [0]}, "until": {"seconds": 3, "event": "impulse"},
                                     "measure": {"end": "seconds", "when": {"first": "impulse"}}}))
    study.run(workers=1)
    [row] = table(study)
    assert float(row["end"]) < 0.3 and float(row["when"]) == pytest.approx(0.2, abs=0.02)


def test_two_runs_on_one_file_are_refused(tmp_path):
    study = Study(written(tmp_path, swing))
    other = Study(study.file.path)

    def beside(done, total, failed):
        with pytest.raises(ResultsError, match="another run"):
            other.run()

    study.run(workers=1, progress=beside)
    assert len(other.rows()) == 12


def test_results_of_another_study_are_not_mixed(tmp_path):
    path = written(tmp_path, swing)
    Study(path).run(workers=1)
    written(tmp_path, {**swing, "until": 0.6})
    with pytest.raises(ResultsError, match="another study.*--fresh"):
        Study(path).run()
    assert len(Study(path, tmp_path / "elsewhere")) == 12
    assert Study(path).run(workers=1, fresh=True) == 0


def test_a_full_disk_loses_nothing_that_was_there(tmp_path):
    """/dev/full takes no byte; a base limited to a few pages is a disk that fills."""
    study = Study(written(tmp_path, {**swing, "vary": {"world.damping": {"from": 0, "to": 1, "steps": 300}}}))
    from sinew.study.results import Results

    done = []
    with pytest.raises(ResultsError, match="full.*kept"):
        with Results(study.file, study.folder / "results.sqlite") as results:
            results._base.execute("PRAGMA max_page_count = 8")
            for rows in study._rows(list(range(300)), None, 1):
                results.add(rows)
                done += [row.number for row in rows]
    assert [row.number for row in study.rows()] == done and 0 < len(done) < 300
    assert study.run(workers=2) == 0 and len(study.rows()) == 300


def test_parts_are_the_whole(tmp_path):
    path = written(tmp_path, swing)
    whole = Study(path, tmp_path / "whole")
    whole.run(workers=1)
    parts = Study(path, tmp_path / "parts")
    with pytest.raises(ResultsError, match="part"):
        parts.collect()
    for i in (2, 1):
        parts.run(workers=1, part=(i, 3))
    assert parts.collect() == 4
    parts.run(workers=1, part=(3, 3))
    assert parts.collect() == 0
    keys = ("case", "height", "stretch", "energy", "hash")
    assert [[row[key] for key in keys] for row in table(parts)] == [[row[key] for key in keys] for row in table(whole)]
    assert parts.verify(5) == []


def test_a_part_tells_how_many_cases_it_has(tmp_path, capfd):
    assert command.main([str(written(tmp_path, swing)), "--part", "2/5", "-j", "1"]) == 0
    assert capfd.readouterr().out.startswith("3 of 12 cases, 0 failed: ")  # 1, 6 and 11


@pytest.mark.parametrize("two", [["--part", "1/2", "--collect"], ["--check", "--verify", "3"], ["--collect", "--verify", "3"]])
def test_a_study_does_one_thing_at_a_time(tmp_path, two, capfd):
    with pytest.raises(SystemExit) as ended:
        command.main([str(written(tmp_path, swing)), *two])
    assert ended.value.code == 2 and "not allowed with argument" in capfd.readouterr().err


def test_a_wrong_row_is_found_out(tmp_path):
    study = Study(written(tmp_path, swing))
    study.run(workers=1)
    base = sqlite3.connect(study.folder / "results.sqlite")
    base.execute("UPDATE rows SET hash = '0123456789abcdef' WHERE number = 3")
    base.commit()
    base.close()
    assert study.verify(12) == [3]


def test_a_terminal_sees_a_bar_and_a_pipe_none(tmp_path):
    path = written(tmp_path, swing)
    terminal, end = pty.openpty()
    subprocess.run([sys.executable, "-m", "sinew", "study", path, "-j", "1"], check=True, stdout=subprocess.DEVNULL, stderr=end)
    os.close(end)
    shown = os.read(terminal, 100_000).decode()
    os.close(terminal)
    assert f"[{'#' * 30}] 12 of 12, 0 failed" in shown and "Traceback" not in shown


def test_any_executor_runs_a_study(tmp_path):
    study = Study(written(tmp_path, swing))
    with ThreadPoolExecutor(3) as pool:
        assert study.run(pool, workers=3) == 0
    assert len(study.rows()) == 12


def test_the_command_tells_mistakes_and_exit_codes(tmp_path):
    def run(*words):
        return subprocess.run([sys.executable, "-m", "sinew", "study", *words], capture_output=True, text=True)

    path = written(tmp_path, swing)
    assert run(path, "--check").stdout == "12 cases\n"
    done = run(path, "-j", "1")
    assert done.returncode == 0 and "12 cases, 0 failed" in done.stdout and done.stderr == ""
    assert run(path, "--verify", "3").stdout == "the same hashes\n"
    bad = run(written(tmp_path, {**swing, "sed": 1}, "bad.study.json"))
    assert bad.returncode == 1 and 'did you mean "seed"' in bad.stderr and "Traceback" not in bad.stderr
    for words, code in ((("nothing.json",), 1), ((tmp_path,), 1), ((), 2), ((path, "--part", "4/3"), 2), ((path, "--collect"), 1)):
        done = run(*words)
        assert done.returncode == code and done.stderr and "Traceback" not in done.stderr
    assert subprocess.run([sys.executable, "-m", "sinew"], capture_output=True).returncode == 2
