"""Results of a study on disk: SQLite while it runs, tables at the end."""

from __future__ import annotations

import contextlib
import csv
import fcntl
import itertools
import json
import os
import sqlite3
import weakref
from pathlib import Path
from typing import Any, Iterable, Iterator

from ..errors import Error
from .case import Row
from .design import Variation
from .spec import StudyFile


_rows_of_group = 1 << 16  #: of a file of Parquet


class ResultsError(Error):
    """Results that are not this study's, are being written, or cannot be."""


class Results:
    """Rows by the number of a case. A row that was added is on disk; another process cannot open the same file."""

    def __init__(self, study: StudyFile, path: Path, fresh: bool = False):
        self.study, self.path = study, path
        self._lock = _locked(path)
        if fresh:
            for ending in ("", "-wal", "-shm"):
                Path(f"{path}{ending}").unlink(missing_ok=True)
        try:
            self._base = sqlite3.connect(path, isolation_level=None, timeout=30, check_same_thread=False)
            # The log survives the end of the process at any moment; a power cut may lose the last rows.
            self._base.execute("PRAGMA journal_mode = WAL")
            self._base.execute("PRAGMA synchronous = NORMAL")
            self._base.execute("BEGIN IMMEDIATE")  # readers see all of this or nothing
            self._base.execute("CREATE TABLE IF NOT EXISTS study (key TEXT, cases INTEGER)")
            self._base.execute("CREATE TABLE IF NOT EXISTS rows (number INTEGER PRIMARY KEY, measures TEXT, hash TEXT, reason TEXT, took REAL)")
            self._check_key()
            self._base.execute("COMMIT")
        except sqlite3.Error as problem:
            self._lock.close()
            raise ResultsError(f"{path}: {problem}") from None
        except ResultsError:
            self.close()
            raise

    def _check_key(self) -> None:
        found = self._base.execute("SELECT key FROM study").fetchone()
        if found is None:
            self._base.execute("INSERT INTO study VALUES (?, ?)", (self.study.key, len(self.study.design)))
        elif found[0] != self.study.key:
            raise ResultsError(f"{self.path} holds results of another study: the file, its scene or the engine has changed since; "
                               "--fresh throws them away, -o FOLDER keeps them")

    def add(self, rows: Iterable[Row]) -> None:
        try:
            self._base.execute("BEGIN")
            self._base.executemany("INSERT OR REPLACE INTO rows VALUES (?, ?, ?, ?, ?)",
                                   [(row.number, json.dumps(row.measures), row.hash, row.reason, row.took) for row in rows])
            self._base.execute("COMMIT")
        except sqlite3.Error as problem:
            if self._base.in_transaction:
                self._base.execute("ROLLBACK")
            raise ResultsError(f"{self.path}: {problem}; all rows before are kept, and the study goes on from there when it is run again") from None

    def done(self) -> set[int]:
        return {number for number, in self._base.execute("SELECT number FROM rows")}

    def count(self) -> tuple[int, int]:
        """Rows, and those of cases that failed."""
        rows, failed = self._base.execute("SELECT count(*), count(nullif(reason, '')) FROM rows").fetchone()
        return rows, failed

    def __iter__(self) -> Iterator[Row]:
        return _rows_of(self._base)

    def merge(self, other: Path) -> None:
        """Takes over the rows of another file of the same study."""
        self.add(rows_in(self.study, other))

    def close(self) -> None:
        self._base.close()
        self._lock.close()

    def __enter__(self) -> Results:
        return self

    def __exit__(self, *reason: Any) -> None:
        self.close()


def _rows_of(base: sqlite3.Connection) -> Iterator[Row]:
    for number, measures, hash_, reason, took in base.execute("SELECT * FROM rows ORDER BY number"):
        yield Row(number, json.loads(measures), hash_, reason, took)


def rows_in(study: StudyFile, path: Path) -> Iterator[Row]:
    """The rows in a file of results, also while a run writes it; none where it has just begun. Raises ResultsError for a file
    that is missing, or holds something else."""
    if not path.exists():
        raise ResultsError(f"{path} is not there yet: run the study first")
    base = sqlite3.connect(path.absolute().as_uri() + "?mode=ro", uri=True, timeout=30)
    try:
        if not base.execute("SELECT 1 FROM sqlite_master WHERE name = 'study'").fetchone():
            return
        [key] = base.execute("SELECT key FROM study").fetchone() or [None]
        if key != study.key:
            raise ResultsError(f"{path} holds results of another study")
        yield from _rows_of(base)
    except (sqlite3.Error, ValueError, TypeError) as problem:
        raise ResultsError(f"{path}: {problem}") from None
    finally:
        base.close()


def _locked(path: Path) -> Any:
    """An open file that holds the lock of the results; it ends with the process, however that ends."""
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        lock = open(f"{path}.lock", "a+", encoding="ascii")
    except OSError as problem:
        raise ResultsError(f"{path}: {problem.strerror}") from None
    _locks.add(lock)
    try:
        fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        lock.seek(0)
        owner = lock.read().strip()
        lock.close()
        raise ResultsError(f"another run{f' (process {owner})' if owner else ''} writes {path}; let it end, or give another folder: -o FOLDER") from None
    with contextlib.suppress(OSError):  # a full disk: the number is for messages alone
        lock.truncate(0)
        os.write(lock.fileno(), str(os.getpid()).encode())
    return lock


#: Open locks. A forked process closes its copies, or a worker that outlives its parent would keep the results locked.
_locks: weakref.WeakSet[Any] = weakref.WeakSet()


def _forget_locks() -> None:
    for lock in list(_locks):
        lock.close()


os.register_at_fork(after_in_child=_forget_locks)


def table(study: StudyFile, rows: Iterable[Row]) -> tuple[list[str], Iterator[list[Any]]]:
    """Names of the columns, and the rows: number, what varies, what was measured, hash, reason, seconds."""
    paths, measures = [*study.design.vary, *study.design.noise], list(study.job.measure)
    cases = study.design.values()

    def each() -> Iterator[list[Any]]:
        for row in rows:
            values = cases[row.number]
            yield [row.number, row.number % study.design.repetitions, *(_cell(values[path]) for path in paths),
                   *(row.measures.get(name) for name in measures), row.hash, row.reason, row.took]

    return ["case", "repetition", *paths, *measures, "hash", "failed", "took"], each()


def _cell(value: Any) -> Any:
    return value if isinstance(value, (int, float, str)) or value is None else json.dumps(value)


def write_csv(study: StudyFile, rows: Iterable[Row], path: Path) -> None:
    names, lines = table(study, rows)
    with _replacing(path) as partial, open(partial, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(names)
        writer.writerows(lines)


def has_pyarrow() -> bool:
    try:
        import pyarrow.parquet
    except ImportError:
        return False
    return True


def check_pyarrow() -> None:
    """Raises ResultsError where Parquet cannot be written."""
    if not has_pyarrow():
        raise ResultsError("Parquet needs pyarrow, which this Python has not: install it, or read table.csv or results.sqlite, "
                           "which are written without it")


def write_parquet(study: StudyFile, rows: Iterable[Row], path: Path) -> None:
    """The table by pyarrow, a group of rows at a time."""
    import pyarrow
    import pyarrow.parquet

    names, lines = table(study, rows)
    varied = [kind_of(variation) for variation in [*study.design.vary.values(), *study.design.noise.values()]]
    kinds = [int, int, *varied, *[float] * len(study.job.measure), str, str, float]
    types = {bool: pyarrow.bool_(), int: pyarrow.int64(), float: pyarrow.float64(), str: pyarrow.string()}
    schema = pyarrow.schema([pyarrow.field(name, types[kind]) for name, kind in zip(names, kinds)])
    with _replacing(path) as partial, open(partial, "wb") as file, pyarrow.parquet.ParquetWriter(file, schema) as writer:
        while group := [_uniform(line, kinds) for line in itertools.islice(lines, _rows_of_group)]:
            columns = [pyarrow.array(list(column), types[kind]) for column, kind in zip(zip(*group), kinds)]
            writer.write_table(pyarrow.Table.from_arrays(columns, schema=schema))


@contextlib.contextmanager
def _replacing(path: Path) -> Iterator[Path]:
    """A file to write, which takes the place of another one when it is whole."""
    partial = path.with_suffix(".partial")
    try:
        yield partial
        partial.replace(path)
    except OSError as problem:
        raise ResultsError(f"{path}: {problem.strerror or problem}; the results are kept in results.sqlite") from None
    finally:
        partial.unlink(missing_ok=True)


def kind_of(variation: Variation) -> type:
    """The one type that a column of Parquet has: a number's, or else text."""
    if not variation.values:
        return int if variation.is_integer else float
    kinds = {type(value) for value in variation.values if value is not None}
    if kinds == {bool}:
        return bool
    if kinds <= {int, float}:
        is_whole = kinds == {int} and all(-(2**63) <= value < 2**63 for value in variation.values if value is not None)
        return int if is_whole else float
    return str


def _uniform(line: list[Any], kinds: list[type]) -> list[Any]:
    return [value if value is None or type(value) is kind else json.dumps(value) if kind is str else kind(value)
            for value, kind in zip(line, kinds)]
