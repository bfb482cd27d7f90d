"""The command: sinew study FILE."""

from __future__ import annotations

import argparse
import sys
from typing import Sequence

from ..errors import Error
from .run import Bar, Study

_about = """Runs the cases of a study file on all cores. Run again, it goes on where it was: kill it as you like. Results are in a
folder beside the file, bridge.study/ for bridge.study.json: table.csv, table.parquet where pyarrow is, index.html with
plots and pictures, results.sqlite with the state. docs/how/studies.md tells the format of the file."""


def _part(text: str) -> tuple[int, int]:
    try:
        number, count = map(int, text.split("/"))
    except ValueError:
        raise argparse.ArgumentTypeError(f"a part is I/N, as 3/10, not {text!r}") from None
    if not 1 <= number <= count:
        raise argparse.ArgumentTypeError(f"the parts of {count} are 1 to {count}, not {number}")
    return number, count


def _count(text: str) -> int:
    if not text.isdecimal() or int(text) < 1:
        raise argparse.ArgumentTypeError(f"a number from 1 on is expected, not {text!r}")
    return int(text)


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser("sinew study", description=_about, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("file", help="a study file")
    parser.add_argument("-o", "--output", metavar="FOLDER", help="folder of the results")
    parser.add_argument("-j", "--workers", type=_count, metavar="N", help="processes; the number of cores if left out")
    parser.add_argument("--fresh", action="store_true", help="throw earlier results away")
    instead = parser.add_mutually_exclusive_group()
    instead.add_argument("--check", action="store_true", help="only check the file, and tell the number of cases")
    instead.add_argument("--part", type=_part, metavar="I/N", help="run the I-th of N parts, into a file of its own")
    instead.add_argument("--collect", action="store_true", help="put the parts together")
    parser.add_argument("--parquet", action="store_true", default=None, help="refuse to run where table.parquet cannot be written")
    instead.add_argument("--verify", type=_count, metavar="N", help="run N of the cases again, and compare their hashes")
    return parser


def main(arguments: Sequence[str]) -> int:
    """Exit code: 0 done, 1 the input was bad or a hash differs, 2 wrong usage, 130 interrupted."""
    parser = _parser()
    options = parser.parse_args(arguments)
    if options.parquet and (options.check or options.part or options.verify):
        parser.error("--parquet: a table is written by a whole run and by --collect")
    try:
        return _run(Study(options.file, options.output), options)
    except (Error, OSError) as problem:
        where = options.file if not isinstance(problem, OSError) or problem.filename is None else problem.filename
        print(problem if isinstance(problem, Error) else f"{where}: {problem.strerror or problem}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        print("\ninterrupted; run it again to go on", file=sys.stderr)
        return 130


def _run(study: Study, options: argparse.Namespace) -> int:
    if options.check:
        _tell(f"{len(study):,} cases")
        return 0
    if options.verify is not None:
        wrong = study.verify(options.verify)
        _tell(f"other hashes: cases {', '.join(map(str, wrong))}" if wrong else "the same hashes")
        return 1 if wrong else 0
    if options.collect:
        missing = study.collect(options.parquet)
        _tell(f"{len(study) - missing:,} of {len(study):,} cases: {study.folder / 'index.html'}")
        return 0
    bar = Bar()
    try:
        failed = study.run(workers=options.workers, part=options.part, fresh=options.fresh, progress=bar, parquet=options.parquet)
    finally:
        bar.end()
    where = study._base(options.part) if options.part else study.folder / "index.html"
    number, parts = options.part or (1, 1)
    share = f"{len(range(number - 1, len(study), parts)):,} of " if options.part else ""
    _tell(f"{share}{len(study):,} cases, {failed:,} failed: {where}")
    return 0


def _tell(text: str) -> None:
    """A line of output; names of files may have characters that the terminal has not."""
    encoding = sys.stdout.encoding or "utf-8"
    print(text.encode(encoding, "backslashreplace").decode(encoding))
