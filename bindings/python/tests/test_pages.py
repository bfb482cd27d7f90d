"""The programs of the pages in docs/ do what the pages say."""

import re
from pathlib import Path

import pytest

root = Path(__file__).resolve().parents[3]


@pytest.mark.parametrize("page", ["bindings/python/README.md", "docs/how/python.md", "docs/how/studies.md"])
def test_the_program_of_a_page_runs(page, tmp_path, monkeypatch):
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    monkeypatch.chdir(tmp_path)
    text = (root / page).read_text()
    for name, block in re.findall(r"<!-- (\S+) -->\n```json\n(.*?)```", text, re.DOTALL):
        (tmp_path / name).write_text(block)
    # Lines keep their numbers, for messages.
    program, inside = [], False
    for line in text.splitlines():
        if line.startswith("```"):
            inside = line == "```python"
            program.append("")
        else:
            program.append(line if inside else "")
    assert re.search(r"\S", "\n".join(program))
    exec(compile("\n".join(program), root / page, "exec"), {"__name__": "__main__"})
