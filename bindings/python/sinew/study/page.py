"""The page of a study: what was measured over what varied, and pictures of cases, each with its scene."""

from __future__ import annotations

import html
import json
from pathlib import Path
from typing import Any, Sequence

from ..errors import Error
from .case import Row, simulation_of
from .spec import StudyFile
from .results import Results

_shown = 6  #: cases of a kind with a picture
_max_points = 20_000  #: of a plot

_style = """body { font: 15px sans-serif; max-width: 1100px; margin: 2em auto; color: #222; }
figure { display: inline-block; margin: 0 12px 12px 0; width: 320px; vertical-align: top; }
figure img { width: 100%; border: 1px solid #ddd; } figcaption { font-size: 13px; } .plot { max-width: 100%; }
code { background: #f4f4f4; }"""


def write_page(study: StudyFile, results: Results, folder: Path) -> None:
    """Writes index.html, and cases/ with a scene, a picture and, where the engine for the browser is, a page of each case
    shown."""
    rows = list(results)
    parts = [f"<h1>{html.escape(study.path.name)}</h1><p>{html.escape(study.about)}</p>",
             f"<p>{len(rows):,} of {len(study.design):,} cases, {sum(bool(row.reason) for row in rows):,} failed. "
             'All rows: <a href="table.csv">table.csv</a></p>', _plot(study, rows)]
    for title, chosen in _chosen(study, rows):
        figures = [_figure(study, row, folder) for row in chosen]
        if figures:
            parts.append(f"<h2>{title}</h2>" + "".join(figures))
    text = (f"<!DOCTYPE html><meta charset='utf-8'><title>{html.escape(study.path.name)}</title><style>{_style}</style>"
            + "\n".join(parts))
    (folder / "index.html").write_text(text, encoding="utf-8")


def _chosen(study: StudyFile, rows: Sequence[Row]) -> list[tuple[str, list[Row]]]:
    failed = [row for row in rows if row.reason][:_shown]
    measured = [row for row in rows if not row.reason and row.measures.get(study.best) is not None]
    measured.sort(key=lambda row: row.measures[study.best], reverse=not study.wants_low)  # type: ignore[arg-type, return-value]
    word = f"{'lowest' if study.wants_low else 'highest'} {html.escape(study.best)}"
    worst = measured[_shown:][-_shown:][::-1]
    return [(f"Best: {word}", measured[:_shown]), ("Worst", worst), ("Failed", failed)]


def _figure(study: StudyFile, row: Row, folder: Path) -> str:
    cases = folder / "cases"
    cases.mkdir(exist_ok=True)
    values = study.design.values()[row.number]
    caption = f"<b>case {row.number}</b> " + html.escape(", ".join(f"{path} = {_short(value)}" for path, value in values.items()))
    measured = ", ".join(f"{name} = {_short(value)}" for name, value in row.measures.items())
    caption += "<br>" + html.escape(row.reason or measured)
    try:
        simulation = simulation_of(study.job, values)
    except Error:
        return f"<figure><figcaption>{caption}</figcaption></figure>"
    with simulation:
        (cases / f"{row.number}.json").write_text(json.dumps(simulation.scene, indent=1), encoding="utf-8")
        link = f"cases/{row.number}.json"
        try:
            simulation.play(study.job.seconds or 1).save(cases / f"{row.number}.html")
            link = f"cases/{row.number}.html"
        except Error:
            pass  # without the engine for the browser the link is the scene itself
        simulation.run_until(study.job.seconds)
        simulation.save_picture(cases / f"{row.number}.png", width=320)
    scene = html.escape(f"sinew play {folder.name}/cases/{row.number}.json")
    return (f'<figure><a href="{link}"><img src="cases/{row.number}.png" alt="case {row.number}"></a>'
            f"<figcaption>{caption}<br><code>{scene}</code></figcaption></figure>")


def _short(value: Any) -> str:
    return f"{value:.6g}" if isinstance(value, float) else json.dumps(value)


def _plot(study: StudyFile, rows: Sequence[Row]) -> str:
    """Every measure over every number that varies, as SVG; empty without matplotlib."""
    try:
        from matplotlib.backends.backend_svg import FigureCanvasSVG
        from matplotlib.figure import Figure
    except ImportError:
        return "<p>Plots need matplotlib.</p>"
    import io

    cases = study.design.values()
    shown = rows[:: max(1, -(-len(rows) // _max_points))]
    values = [cases[row.number] for row in shown]
    paths = [path for path in study.design.vary if all(isinstance(value[path], (int, float)) for value in values)][:6]
    names = list(study.job.measure)[:6]
    if not paths or not names or not shown:
        return ""
    figure = Figure(figsize=(3.4 * len(paths), 2.4 * len(names)))
    axes = figure.subplots(len(names), len(paths), squeeze=False)
    for across, path in enumerate(paths):
        for down, name in enumerate(names):
            points = [(value[path], row.measures[name]) for value, row in zip(values, shown) if row.measures.get(name) is not None]
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
