"""The page of a study: what was measured over what varied, and pictures of cases, each with its scene."""

from __future__ import annotations

import html
import itertools
import json
import math
from concurrent.futures.process import BrokenProcessPool
from pathlib import Path
from typing import Any, Iterator, NamedTuple, Sequence

from .._core import hardware_threads
from .case import Row
from .picture import picture_case
from .processes import processes
from .results import Results
from .spec import StudyFile

_shown = 6  #: cases of a kind with a picture
_max_points = 20_000  #: of a plot

_style = """body { font: 15px sans-serif; max-width: 1100px; margin: 2em auto; padding: 0 1em; color: #222; }
figure { display: inline-block; margin: 0 12px 12px 0; width: 320px; vertical-align: top; }
figure img { width: 100%; border: 1px solid #ddd; } figcaption { font-size: 13px; } .plot { max-width: 100%; }
code { background: #f4f4f4; }"""


class Chosen(NamedTuple):
    """The cases that the page shows, and a sample of all for the plots."""

    best: list[Row]
    worst: list[Row]
    failed: list[Row]
    sample: list[Row]


def write_page(study: StudyFile, results: Results, folder: Path) -> None:
    """Writes index.html, and cases/ with a scene, a picture and, where the engine for the browser is, a page of each case
    shown."""
    count, failed = results.count()
    chosen = choose(study, results, count)
    parts = [f"<h1>{html.escape(study.path.name)}</h1><p>{html.escape(study.about)}</p>",
             f"<p>{count:,} of {len(study.design):,} cases, {failed:,} failed. "
             'All rows: <a href="table.csv">table.csv</a></p>', _plot(study, chosen.sample)]
    links = _pictures(study, [*chosen.best, *chosen.worst, *chosen.failed], folder)
    best = f"Best: {'lowest' if study.wants_low else 'highest'} {html.escape(study.best)}"
    for title, rows in ((best, chosen.best), ("Worst", chosen.worst), ("Failed", chosen.failed)):
        if rows:
            parts.append(f"<h2>{title}</h2>" + "".join(_figure(study, row, links[row.number], folder) for row in rows))
    text = (f"<!DOCTYPE html><meta charset='utf-8'><title>{html.escape(study.path.name)}</title><style>{_style}</style>"
            + "\n".join(parts))
    (folder / "index.html").write_text(text, encoding="utf-8", errors="replace")


def choose(study: StudyFile, rows: Results, count: int) -> Chosen:
    """One walk over the rows, of which few are kept."""
    every = max(1, -(-count // _max_points))
    best: list[Row] = []
    worst: list[Row] = []
    failed: list[Row] = []
    sample: list[Row] = []

    def rank(row: Row) -> tuple[float, int]:
        value = row.measures[study.best]
        assert value is not None
        return value if study.wants_low else -value, row.number

    for block in _blocks(iter(rows)):
        measured = [row for row in block if not row.reason and _is_number(row.measures.get(study.best))]
        best = sorted(best + measured, key=rank)[:_shown]
        worst = sorted(worst + measured, key=rank, reverse=True)[:_shown]
        failed = [*failed, *(row for row in block if row.reason)][:_shown]
        sample += [row for row in block if row.number % every == 0]
    shown = {row.number for row in best}
    return Chosen(best, [row for row in worst if row.number not in shown], failed, sample)


def _blocks(rows: Iterator[Row]) -> Iterator[list[Row]]:
    while block := list(itertools.islice(rows, 4096)):
        yield block


def _is_number(value: Any) -> bool:
    return value is not None and not math.isnan(value)


def _pictures(study: StudyFile, rows: Sequence[Row], folder: Path) -> dict[int, str]:
    """Writes the pictures of cases, in processes that their scenes may end, and returns the link of each; "" for none."""
    links: dict[int, str] = {}
    left = list(dict.fromkeys(row.number for row in rows))
    cases = study.design.values()
    (folder / "cases").mkdir(exist_ok=True)
    try:
        with processes(max(1, min(hardware_threads(), len(left)))) as pool:
            futures = {number: pool.submit(picture_case, study, number, cases[number], folder / "cases") for number in left}
            for number, future in futures.items():
                links[number] = future.result()
    except BrokenProcessPool:
        for number in [number for number in left if number not in links]:
            try:
                with processes(1) as pool:
                    links[number] = pool.submit(picture_case, study, number, cases[number], folder / "cases").result()
            except BrokenProcessPool:
                links[number] = ""
    return links


def _figure(study: StudyFile, row: Row, link: str, folder: Path) -> str:
    values = study.design.values()[row.number]
    caption = f"<b>case {row.number}</b> " + html.escape(", ".join(f"{path} = {_short(value)}" for path, value in values.items()))
    measured = ", ".join(f"{name} = {_short(value)}" for name, value in row.measures.items())
    caption += "<br>" + html.escape(row.reason or measured)
    if not link:
        return f"<figure><figcaption>{caption}</figcaption></figure>"
    scene = html.escape(f"sinew play {folder.name}/cases/{row.number}.json")
    return (f'<figure><a href="cases/{link}"><img src="cases/{row.number}.png" alt="case {row.number}"></a>'
            f"<figcaption>{caption}<br><code>{scene}</code></figcaption></figure>")


def _short(value: Any) -> str:
    return "none" if value is None else f"{value:.6g}" if isinstance(value, float) else json.dumps(value)


def _plot(study: StudyFile, rows: Sequence[Row]) -> str:
    """Every measure over every number that varies, as SVG; empty without matplotlib."""
    try:
        from matplotlib.backends.backend_svg import FigureCanvasSVG
        from matplotlib.figure import Figure
    except ImportError:
        return "<p>Plots need matplotlib.</p>"
    import io

    cases = study.design.values()
    values = [cases[row.number] for row in rows]
    paths = [path for path in study.design.vary if all(isinstance(value[path], (int, float)) for value in values)][:6]
    names = [name for name in study.job.measure if any(_is_number(row.measures.get(name)) for row in rows)][:6]
    if not paths or not names or not rows:
        return ""
    figure = Figure(figsize=(3.4 * len(paths), 2.4 * len(names)))
    axes = figure.subplots(len(names), len(paths), squeeze=False)
    for across, path in enumerate(paths):
        for down, name in enumerate(names):
            points = [(value[path], row.measures[name]) for value, row in zip(values, rows) if _is_number(row.measures.get(name))]
            plot = axes[down][across]
            plot.scatter([x for x, _ in points], [y for _, y in points], s=6, rasterized=len(points) > 2000)
            plot.set_xlabel(path.split(".")[-1])
            plot.set_ylabel(name)
            if study.design.vary[path].is_log:
                plot.set_xscale("log")
    figure.tight_layout()
    text = io.StringIO()
    FigureCanvasSVG(figure).print_svg(text)
    svg = text.getvalue()
    return svg[svg.index("<svg") :].replace("<svg", '<svg class="plot"', 1)
