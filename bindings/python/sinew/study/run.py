"""Running a study: on this machine, or with any executor."""

from __future__ import annotations

import concurrent.futures
import os
import random
import sys
import time
from concurrent.futures import Executor, Future
from concurrent.futures.process import BrokenProcessPool
from pathlib import Path
from typing import Any, Callable, Iterable, Iterator

from .._core import hardware_threads
from ..errors import ArgumentError, Error, NotFoundError
from .case import Row, run_cases
from .file import read
from .page import write_page
from .processes import processes
from .results import Results, ResultsError, check_pyarrow, has_pyarrow, rows_in, write_csv, write_parquet
from .spec import StudyFile

#: Real seconds that a block of cases should take: long beside the way to another process, short beside what kill -9 loses.
_block_seconds = 0.5
_max_block = 256
_outstanding = 4  #: blocks a worker

Values = dict[str, Any]
Progress = Callable[[int, int, int], None]


class Study:
    """A study file and its results.

    ``run()`` runs what is not done yet, on this machine's cores or with any ``concurrent.futures`` executor: that of Dask's
    ``Client.get_executor()``, mpi4py's ``MPIPoolExecutor``. The folder of results is beside the file: ``bridge.study/``
    for ``bridge.study.json``.

    Raises StudyError for a file with mistakes, ResultsError for results that are another study's or in use.
    """

    def __init__(self, path: str | os.PathLike[str], folder: str | os.PathLike[str] | None = None):
        self.file: StudyFile = read(Path(path))
        stem = Path(path).name.removesuffix(".json").removesuffix(".study")
        self.folder = Path(folder) if folder else Path(path).parent / f"{stem}.study"

    def __len__(self) -> int:
        """Number of cases."""
        return len(self.file.design)

    def values(self, number: int) -> Values:
        """What varies, of a case, from 0."""
        if not 0 <= number < len(self):
            raise NotFoundError(f"there is no case {number}; the cases are 0 to {len(self) - 1}")
        return self.file.design.values()[number]

    def scene(self, number: int) -> dict[str, Any]:
        """The scene of a case, for ``sinew.open`` or a file."""
        from .case import simulation_of

        with simulation_of(self.file.job, self.values(number)) as simulation:
            return simulation.scene

    def run(self, executor: Executor | None = None, *, workers: int | None = None, part: tuple[int, int] | None = None,
            fresh: bool = False, progress: Progress | None = None, parquet: bool | None = None) -> int:
        """Runs the cases that have no row yet, and writes the tables and the page. Returns the number of failed cases.

        ``part`` (i, n) runs the i-th of n parts only, i from 1, into a file of its own: see ``collect``. ``workers`` is the
        number of processes here, or those of the executor. ``parquet`` True writes table.parquet beside table.csv, and raises
        ResultsError before the first case where pyarrow is missing; None writes it where pyarrow is there.
        """
        if parquet:
            check_pyarrow()
        if part is not None and not 1 <= part[0] <= part[1]:
            raise ArgumentError(f"a part is (i, n) with i from 1 to n, not {part}")
        if workers is not None and workers < 1:
            raise ArgumentError(f"a study has at least one worker, not {workers}")
        with Results(self.file, self._base(part), fresh) as results:
            done = results.done()
            first, stride = (part[0] - 1, part[1]) if part else (0, 1)
            pending = [number for number in range(first, len(self), stride) if number not in done]
            total, before = len(range(first, len(self), stride)), len(done)
            failed = results.count()[1]
            for rows in self._rows(pending, executor, workers):
                results.add(rows)
                before += len(rows)
                failed += sum(bool(row.reason) for row in rows)
                if progress:
                    progress(before, total, failed)
            if part is None:
                self._write(results, parquet)
            return failed

    def collect(self, parquet: bool | None = None) -> int:
        """Puts the parts together, and writes the tables and the page, as ``run`` does. Returns the number of cases without a row."""
        if parquet:
            check_pyarrow()
        parts = sorted(self.folder.glob("part-*.sqlite"))
        if not parts:
            raise ResultsError(f"{self.folder} has no part-*.sqlite; --part I/N makes them")
        with Results(self.file, self._base(None)) as results:
            for part in parts:
                results.merge(part)
            self._write(results, parquet)
            return len(self) - results.count()[0]

    def verify(self, sample: int = 20, seed: int = 1, executor: Executor | None = None) -> list[int]:
        """Runs a sample of the cases again, here or by an executor elsewhere, and returns those whose hash differs: none, on
        any machine. Raises ResultsError where no case has a hash yet."""
        if sample < 1:
            raise ArgumentError(f"a sample has at least one case, not {sample}")
        hashes = {row.number: row.hash for row in rows_in(self.file, self._base(None)) if row.hash}
        if not hashes:
            raise ResultsError(f"{self._base(None)} has no case to verify yet")
        chosen = random.Random(seed).sample(sorted(hashes), min(sample, len(hashes)))
        cases = self.file.design.values()
        given = [[(number, cases[number])] for number in chosen]
        if executor is None:
            again = [run_cases(self.file.job, case) for case in given]
        else:
            again = [future.result() for future in [executor.submit(run_cases, self.file.job, case) for case in given]]
        return [row.number for [row] in again if row.hash != hashes[row.number]]

    def rows(self) -> list[Row]:
        """The rows so far, also while the study runs."""
        return list(rows_in(self.file, self._base(None))) if self._base(None).exists() else []

    def frame(self) -> Any:
        """The table as a pandas frame."""
        import pandas

        from .results import table

        names, lines = table(self.file, self.rows())
        return pandas.DataFrame(list(lines), columns=names)

    def _base(self, part: tuple[int, int] | None) -> Path:
        return self.folder / (f"part-{part[0]}-of-{part[1]}.sqlite" if part else "results.sqlite")

    def _write(self, results: Results, parquet: bool | None) -> None:
        write_csv(self.file, results, self.folder / "table.csv")
        if parquet or (parquet is None and has_pyarrow()):
            write_parquet(self.file, results, self.folder / "table.parquet")
        else:
            (self.folder / "table.parquet").unlink(missing_ok=True)  # of an earlier run, with other rows
        try:
            write_page(self.file, results, self.folder)
        except (OSError, Error) as problem:
            raise ResultsError(f"{self.folder}: the page could not be written: {problem}; the results are kept in results.sqlite") from None

    # --- workers ------------------------------------------------------------------------------------------------------

    def _rows(self, pending: list[int], executor: Executor | None, workers: int | None) -> Iterator[list[Row]]:
        if executor is not None:
            yield from self._submit(pending, executor, workers or 16)
            return
        count = min(workers or hardware_threads(), max(1, len(pending)))
        if count == 1:
            cases = self.file.design.values()
            for number in pending:
                yield run_cases(self.file.job, [(number, cases[number])])
            return
        yield from self._in_processes(pending, count)

    def _in_processes(self, pending: list[int], workers: int) -> Iterator[list[Row]]:
        """In processes of this machine. If one ends (for want of memory, say), its cases run again one by one, and the
        case that ends a process twice has failed."""
        left, suspects = set(pending), set[int]()
        while left:
            try:
                with processes(workers) as pool:
                    for rows in self._submit(sorted(left - suspects), pool, workers, cancels=False):
                        left -= {row.number for row in rows}
                        yield rows
            except BrokenProcessPool:
                suspects = left & self._running
            for number in sorted(suspects & left):
                yield [self._alone(number)]
                left.discard(number)
            suspects.clear()

    def _alone(self, number: int) -> Row:
        """Runs a case in a process of its own."""
        try:
            with processes(1) as pool:
                return pool.submit(run_cases, self.file.job, [(number, self.values(number))]).result()[0]
        except BrokenProcessPool:
            return Row(number, {}, "", "its process ended, perhaps for want of memory", 0)

    def _submit(self, pending: Iterable[int], executor: Executor, workers: int, cancels: bool = True) -> Iterator[list[Row]]:
        """Submits blocks of cases, a few a worker at a time, and yields rows as they come. Cancels those left at an early end,
        unless the executor ends, too."""
        cases, queue = self.file.design.values(), iter(pending)
        futures: dict[Future[list[Row]], list[int]] = {}
        self._running: set[int] = set()
        block = 1

        def submit() -> bool:
            numbers = [number for _, number in zip(range(block), queue)]
            if not numbers:
                return False
            futures[executor.submit(run_cases, self.file.job, [(number, cases[number]) for number in numbers])] = numbers
            self._running |= set(numbers)
            return True

        try:
            while futures or submit():
                while len(futures) < _outstanding * workers and submit():
                    pass
                for future in concurrent.futures.wait(futures, return_when=concurrent.futures.FIRST_COMPLETED).done:
                    rows = future.result()
                    self._running -= set(futures.pop(future))
                    yield rows
                    took = sum(row.took for row in rows) / len(rows)
                    block = max(1, min(_max_block, int(_block_seconds / max(took, 1e-6))))
        finally:
            for future in futures if cancels else ():
                future.cancel()


class Bar:
    """A progress bar on a terminal, and nothing in a pipe."""

    def __init__(self) -> None:
        self.begin, self.shown = time.monotonic(), 0.0
        self.is_on = sys.stderr.isatty()
        self.already: int | None = None

    def __call__(self, done: int, total: int, failed: int) -> None:
        now = time.monotonic()
        self.already = done if self.already is None else self.already
        if not self.is_on or (now - self.shown < 0.1 and done < total):
            return
        self.shown = now
        rate = (done - self.already) / max(now - self.begin, 1e-9)
        left = f", {(total - done) / rate:,.0f} s left" if rate > 0 and done < total else ""
        filled = round(30 * done / total)
        print(f"\r\033[K[{'#' * filled}{'.' * (30 - filled)}] {done:,} of {total:,}, {failed} failed{left}", end="", file=sys.stderr,
              flush=True)

    def end(self) -> None:
        if self.is_on and self.shown:
            print(file=sys.stderr)


__all__ = ["Bar", "Study"]
