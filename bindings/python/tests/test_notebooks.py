"""The notebooks in examples/notebooks run from top to bottom, and what a notebook shows."""

import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import sinew
from browser import Browser
from conftest import pendulum
from sinew import notebook
from sinew.notebook import modules_of, web_folder

notebooks = sorted((Path(__file__).resolve().parents[3] / "examples" / "notebooks").glob("*.ipynb"))


@pytest.fixture(scope="session")
def kernel(tmp_path_factory):
    """A folder whose kernel "python3" is this interpreter."""
    pytest.importorskip("nbconvert")
    pytest.importorskip("ipykernel")
    folder = tmp_path_factory.mktemp("jupyter")
    target = folder / "kernels" / "python3"
    target.mkdir(parents=True)
    command = [sys.executable, "-Xfrozen_modules=off", "-m", "ipykernel_launcher", "-f", "{connection_file}"]
    (target / "kernel.json").write_text(json.dumps({"argv": command, "display_name": "Python 3", "language": "python"}))
    return folder


@pytest.mark.parametrize("path", notebooks, ids=lambda path: path.stem)
def test_a_notebook_runs(path, kernel, tmp_path):
    inherited = {name: value for name, value in os.environ.items() if name != "MPLBACKEND"}  # the notebook shows its figures
    environment = {**inherited, "JUPYTER_PATH": str(kernel), "HOME": str(tmp_path)}
    subprocess.run([sys.executable, "-m", "nbconvert", "--to", "notebook", "--execute", "--output-dir", tmp_path, path], check=True,
                   env=environment, cwd=tmp_path, timeout=280)
    cells = json.loads((tmp_path / path.name).read_text())["cells"]
    shown = [output for cell in cells for output in cell.get("outputs", [])]
    assert any("image/png" in output.get("data", {}) for output in shown)


@pytest.mark.parametrize("path", notebooks, ids=lambda path: path.stem)
def test_notebooks_are_kept_without_outputs(path):
    cells = json.loads(path.read_text())["cells"]
    assert all(not cell.get("outputs") for cell in cells)


def test_the_player_has_every_module_that_a_module_imports():
    """Also where the engine for the browser is not built."""
    modules = modules_of(Path(__file__).resolve().parents[3] / "web" / "sinew")
    imported = {name for text in modules.values() for name in re.findall(r'from "([^"]+)"', text)}
    assert imported and imported <= {f"sinew/{name}" for name in modules}


@pytest.fixture
def page(tmp_path):
    if web_folder() is None:
        pytest.skip("the engine for the browser is not built: ./dev web")
    path = tmp_path / "page.html"
    sinew.open("rope").play(5).save(path)
    return path


def test_without_the_engine_for_the_browser_playing_is_refused_at_once(monkeypatch):
    """Before a notebook asks for the HTML: it would show a traceback of its own machinery, and then the object."""
    monkeypatch.setattr(notebook, "web_folder", lambda: None)
    with pytest.raises(sinew.Error, match="no engine for the browser; in a source tree ./dev web builds it"):
        sinew.open("rope").play(5)


def test_an_animation_needs_no_other_file(page):
    text = page.read_text()
    assert "http" not in text.replace("http://www.w3.org", "")
    assert len(text) < 4_000_000
    with pytest.raises(ValueError):
        sinew.open("rope").play(0)


@pytest.fixture
def browser(tmp_path):
    if not shutil.which("chromium"):
        pytest.skip("there is no browser")
    with Browser(tmp_path / "profile") as browser:
        yield browser


def test_an_animation_moves_in_a_browser(page, browser):
    tab = browser.visit(page.as_uri())
    tab.wait_for("document.body.dataset.step > 10")
    assert tab.value("document.body.dataset.problem") is None


#: The picture of this scene is 200 pixels a metre, with the origin in the middle.
hanging = {**pendulum, "view": {"size": [600, 600], "height": 3, "center": [0, 0]}, "world": {"gravity": [0, -9.81], "damping": 2}}
still = {"figures.bob.particles.weight.at": [0, -1]}


def test_an_animation_is_dragged_in_a_browser(tmp_path, browser):
    """The weight follows the pointer that pressed on it, and falls when it is let go."""
    if web_folder() is None:
        pytest.skip("the engine for the browser is not built: ./dev web")
    sinew.open(hanging, still).play(60).save(tmp_path / "page.html")
    tab = browser.visit((tmp_path / "page.html").as_uri())
    place = "sinew.player.simulation.stateOf('bob/weight').position"
    tab.wait_for("document.body.dataset.step > 10")
    tab.mouse("mouseMoved", 300, 500)
    tab.mouse("mousePressed", 300, 500)
    tab.mouse("mouseMoved", 420, 460)
    tab.wait_for(f"sinew.player.state().isHolding && Math.hypot({place}[0] - 0.6, {place}[1] + 0.8) < 0.02")
    tab.mouse("mouseReleased", 420, 460)
    tab.wait_for(f"!sinew.player.state().isHolding && {place}[0] < 0.3")


def test_an_animation_in_a_notebook_is_seen_and_dragged(tmp_path, browser):
    """In the frame that a notebook shows, of a page that asks nobody for anything."""
    if web_folder() is None:
        pytest.skip("the engine for the browser is not built: ./dev web")
    (tmp_path / "notebook.html").write_text("<!DOCTYPE html><style>body, iframe { margin: 0; }</style>" + sinew.open(hanging, still).play(60)._repr_html_())
    tab = browser.visit((tmp_path / "notebook.html").as_uri())
    there = slice(None), slice(380, 600)  # of a pendulum that hangs, nothing is on the right

    def is_empty():
        return len(np.unique(tab.picture()[:600][there].reshape(-1, 3), axis=0)) == 1

    tab.wait_until(lambda: len(np.unique(tab.picture()[:600].reshape(-1, 3), axis=0)) > 3 and is_empty())
    tab.mouse("mouseMoved", 300, 500)
    tab.mouse("mousePressed", 300, 500)
    tab.mouse("mouseMoved", 480, 340)
    tab.wait_until(lambda: not is_empty())
    tab.mouse("mouseReleased", 480, 340)
    assert tab.asked_for == []
