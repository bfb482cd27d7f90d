"""Studies on several machines, by engines that exist: Dask, MPI, GNU parallel, Slurm. Each is skipped where it is not installed."""

import os
import shutil
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from conftest import swing, written
from sinew.study import Study

root = Path(__file__).resolve().parents[3]


@pytest.fixture(scope="module")
def expected(tmp_path_factory):
    """Hashes of the cases, run in this process."""
    study = Study(written(tmp_path_factory.mktemp("alone"), swing))
    study.run(workers=1)
    return hashes(study)


def hashes(study):
    rows = study.rows()
    assert [row.number for row in rows] == list(range(len(study)))  # none lost, none double
    return [row.hash for row in rows]


def test_dask_runs_a_study(tmp_path, expected):
    distributed = pytest.importorskip("distributed")
    with distributed.LocalCluster(2, threads_per_worker=1, dashboard_address=None, host="127.0.0.1") as cluster:
        with distributed.Client(cluster) as client:
            study = Study(written(tmp_path, swing))
            study.run(client.get_executor(), workers=2)
    assert hashes(study) == expected


def test_a_dask_worker_that_is_killed_loses_no_case(tmp_path):
    distributed = pytest.importorskip("distributed")
    more = {**swing, "vary": {"world.damping": {"from": 0, "to": 1, "steps": 60}}, "until": 20}
    study = Study(written(tmp_path, more))
    with distributed.LocalCluster(2, threads_per_worker=1, dashboard_address=None, host="127.0.0.1") as cluster:
        with distributed.Client(cluster) as client:
            victim = next(iter(client.run(os.getpid).values()))
            killed = []

            def kill(done, total, failed):
                if done > 3 and not killed:
                    os.kill(victim, signal.SIGKILL)
                    killed.append(done)

            assert study.run(client.get_executor(), workers=2, progress=kill) == 0
    assert killed
    assert len(set(hashes(study))) == 60 and study.verify(5) == []


def test_mpi_runs_a_study(tmp_path, expected):
    pytest.importorskip("mpi4py")
    if not shutil.which("mpiexec"):
        pytest.skip("there is no mpiexec")
    study = Study(written(tmp_path, swing))
    program = tmp_path / "run.py"
    program.write_text("import sys\nfrom mpi4py.futures import MPIPoolExecutor\nfrom sinew.study import Study\n\n"
                       "if __name__ == '__main__':\n    with MPIPoolExecutor() as executor:\n"
                       "        Study(sys.argv[1]).run(executor, workers=2)\n")
    environment = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
    subprocess.run(["mpiexec", "-n", "3", "--oversubscribe", sys.executable, "-m", "mpi4py.futures", program, study.file.path], check=True,
                   env=environment, timeout=240)
    assert hashes(study) == expected


def test_gnu_parallel_runs_the_parts(tmp_path, expected):
    if not shutil.which("parallel"):
        pytest.skip("GNU parallel is not installed")
    study = Study(written(tmp_path, swing))
    subprocess.run(["parallel", "-j", "2", sys.executable, "-m", "sinew", "study", study.file.path, "-j", "1", "--part", "{}/5", ":::",
                    *"12345"], check=True, env={**os.environ, "HOME": str(tmp_path)}, timeout=240)
    assert study.collect() == 0
    assert hashes(study) == expected


def test_slurm_runs_the_parts(tmp_path, expected):
    tool = root / "tools" / "cluster_here"
    if subprocess.run([tool, "--check"], capture_output=True).returncode:
        pytest.skip("Slurm cannot run here: tools/cluster_here --check tells why")
    study = Study(written(tmp_path, swing))
    folder = tmp_path / "cluster"
    environment = {**os.environ, "SINEW_PYTHON": sys.executable}
    subprocess.run([tool, folder, "sbatch", "--wait", "--array=1-4", root / "examples" / "study.sbatch", study.file.path], check=True,
                   cwd=tmp_path, env=environment, timeout=240)
    assert study.collect() == 0
    assert hashes(study) == expected
