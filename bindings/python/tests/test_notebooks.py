"""The notebooks in examples/notebooks run from top to bottom, and what a notebook shows."""

import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import sinew
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


def test_an_animation_needs_no_other_file(page):
    text = page.read_text()
    assert "http" not in text.replace("http://www.w3.org", "")
    assert len(text) < 4_000_000
    with pytest.raises(ValueError):
        sinew.open("rope").play(0)


def test_an_animation_moves_in_a_browser(page):
    browser = shutil.which("chromium")
    if not browser:
        pytest.skip("there is no browser")
    done = subprocess.run([browser, "--headless", "--no-sandbox", "--disable-gpu", "--no-first-run", "--disable-background-networking",
                           "--disable-component-update", "--disable-sync", f"--user-data-dir={page.parent / 'profile'}",
                           "--virtual-time-budget=4000", "--dump-dom", page.as_uri()], capture_output=True, text=True, timeout=120)
    step = done.stdout.split('data-step="')[1].split('"')[0]
    assert float(step) > 10 and "data-problem" not in done.stdout
