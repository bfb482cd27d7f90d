"""What a case of a study costs beside its steps: the numbers of docs/how/studies.md. python3 bindings/python/bench/cost.py"""

import concurrent.futures
import json
import operator
import os
import pickle
import re
import resource
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from sinew.study import Study
from sinew.study.case import run_cases
from sinew.study.page import choose
from sinew.study.results import Results, write_csv

page = Path(__file__).resolve().parents[3] / "docs" / "how" / "studies.md"


def study_of(folder, seconds):
    """The study of the page, with 200,000 cases of so many seconds."""
    given = json.loads(re.search(r"<!-- bridge.study.json -->\n```json\n(.*?)```", page.read_text(), re.DOTALL)[1])
    given["until"] = seconds
    given["vary"]["figures.bridge.slack"]["steps"] = 100_000
    path = Path(folder) / f"bridge-{seconds}.study.json"
    path.write_text(json.dumps(given))
    return Study(path)


def a_second(count, work):
    start = time.perf_counter()
    work()
    return count / (time.perf_counter() - start)


def processor_time(study, count):
    values, times = study.file.design.values(), []
    for number in range(count):
        start = time.process_time()
        rows = run_cases(study.file.job, [(number, values[number])])
        times.append(time.process_time() - start)
    return 1e3 * statistics.median(times), rows[0]


def tasks_a_second(executor, count):
    def submit(number):
        concurrent.futures.wait([executor.submit(operator.add, i, 1) for i in range(number)])

    submit(50)
    return a_second(count, lambda: submit(count))


def tell(what, number, unit):
    print(f"{what:42} {number:10,.4g} {unit}", flush=True)


def main():
    with tempfile.TemporaryDirectory() as folder:
        short = study_of(folder, 0)
        tell("a case without steps", processor_time(short, 300)[0], "ms")
        milliseconds, row = processor_time(study_of(folder, 2), 20)
        tell("a case of two seconds", milliseconds, "ms")
        values = short.file.design.values()
        cases = [(number, values[number]) for number in range(100)]
        tell("a case, sent", len(pickle.dumps(cases)) / 100, "bytes")
        tell("a row, sent back", len(pickle.dumps(run_cases(short.file.job, cases))) / 100, "bytes")
        base, count = Path(folder) / "a.sqlite", 100_000
        with Results(short.file, base) as results:
            blocks = [[row._replace(number=first + i) for i in range(1000)] for first in range(0, count, 1000)]
            tell("rows in blocks of 1000", a_second(count, lambda: [results.add(block) for block in blocks]), "a second")
            singles = [[row._replace(number=count + i)] for i in range(2000)]
            tell("rows committed one by one", a_second(2000, lambda: [results.add(block) for block in singles]), "a second")
        tell("a row on disk", os.path.getsize(base) / (count + 2000), "bytes")
        with Results(short.file, Path(folder) / "b.sqlite") as results:
            tell("rows put together", a_second(count + 2000, lambda: results.merge(base)), "a second")
            tell("rows of the table written", a_second(count + 2000, lambda: write_csv(short.file, results, Path(folder) / "t.csv")), "a second")
            tell("a row of the table", os.path.getsize(Path(folder) / "t.csv") / (count + 2000), "bytes")
            tell("rows walked for the page", a_second(count + 2000, lambda: choose(short.file, results, count + 2000)), "a second")
        tell("memory of all that", resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024, "MB")
    tell("start of a worker", 1 / a_second(1, lambda: subprocess.run([sys.executable, "-c", "import sinew.study"], check=True)), "s")
    with concurrent.futures.ProcessPoolExecutor(2) as executor:
        tell("tasks through a pool of 2 processes", tasks_a_second(executor, 5000), "a second")
    try:
        import distributed
    except ImportError:
        return
    with distributed.LocalCluster(2, threads_per_worker=1, dashboard_address=None, host="127.0.0.1") as cluster:
        with distributed.Client(cluster) as client:
            tell("tasks through Dask with 2 workers", tasks_a_second(client.get_executor(), 2000), "a second")


if __name__ == "__main__":
    main()
