"""The study file: every mistake has its place."""

import json
import sys

import pytest
from hypothesis import given, strategies as st

from conftest import pendulum, swing, written
from sinew.study import Study, StudyError
from sinew.study.located import Reader, Syntax


wrong = [
    ("{", "expected a name", 1), ('{"sinew_study": 1} x', "more follows", 1), ("", "expected a value", 1), ("[1]", "expected an object", 1),
    ('{"a": 1, "a": 2}', '"a" is said twice', 1), ('{"a": tru}', "expected a value", 1), ('{"a" 1}', "expected :", 1), ("[" * 5000, "levels", 1),
    ({"scen": 1}, 'unknown property "scen"', 2), ({"scene": "ragdol"}, "did you mean 'ragdoll'", None),
    ({"scene": "missing.json"}, "there is no file", None), ({"scene": {"sinew": 1, "figuers": []}}, "figuers", None),
    ({"vary": {"world.gravty": [1]}}, 'unknown property "gravty"', None), ({"vary": {"world.damping": [0, -1]}}, "found the number -1", None),
    ({"vary": {"world.damping": []}}, "empty list", None), ({"vary": {"world.damping": {"from": 0, "to": 1}}}, "needs a number of steps", None),
    ({"vary": {"world.damping": {"from": 2, "to": 1, "steps": 2}}}, "ends before it begins", None),
    ({"vary": {"world.damping": {"from": 0, "to": 1, "steps": 2, "scale": "log"}}}, "above 0", None),
    ({"vary": {"world.damping": {"from": 0, "to": 1, "step": 2}}}, 'did you mean "steps"', None),
    ({"vary": {"world.damping": {"from": 0, "to": 1, "steps": 9e6}, "world.gravity.0": {"from": 0, "to": 1, "steps": 9e6}}}, "cases are more than", None),
    ({"sample": "sobol"}, "needs a number of cases", None), ({"sample": "sobl", "cases": 4}, 'did you mean "sobol"', None),
    ({"cases": 4}, "follow from what varies", None),
    ({"sample": "list", "vary": {"world.damping": [1, 2], "solver.substeps": [4]}}, "equal length", None),
    ({"measure": {"x": "enery"}}, 'did you mean "energy"', None), ({"measure": {"x": "bob/wieght.y"}}, "did you mean", None),
    ({"measure": {"x": "bob/weight.z"}}, "is no number of a part", None), ({"measure": {"x": {"max": 3}}}, "name of a quantity", None),
    ({"measure": {"x": {"first": "tron"}}}, 'did you mean "torn"', None), ({"measure": {"x": {"function": "no.py:f"}}}, "no.py", None),
    ({"measure": {"x": {"max": "energy", "min": "energy"}}}, "one of its words", None), ({"measure": {"x": 3}}, "expected an object", None),
    ({"until": -1}, "out of range", None), ({"until": {"event": "tron"}}, "torn", None), ({"best": "hieght"}, 'did you mean "height"', None),
    ({"vary": {"world.damping": {"from": 0, "to": 1, "steps": 2, "whole": "yes"}}}, "true or false", None),
    ({"set": {"world.gravity": [0, -1]}, "vary": {"world.gravity.1": [-2, -3]}}, '"world.gravity" in "set" is of the same value', None),
    ({"vary": {"world.damping": [1]}, "noise": {"world.damping": {"from": 0, "to": 1}}}, 'in "vary"', None),
    ({"measure": {"hash": "energy"}}, 'another column "hash"', None), ({"vary": {"world.damping": [1]}, "measure": {"world.damping": "energy"}}, "another column", None),
    ({"best": {"lowest": "height", "highest": "energy"}}, "expected {", None), ({"vary": {"mode": ["physical\0"]}}, "zero", None),
    ({"set": {"solver": {"substeps": 8, "rate": "fast"}}}, "rate", None), ({"vary": {"world.damping": {"from": 0, "to": 1, "steps": 1.5}}}, "whole number", None),
    ('{"sinew_study": 1, "scene": "rope", "vary": {}, "measure": {}, "cases": 1e999}', "the number 1e999 is too large", 1),
    ({"vary": {f"world.gravity.{i}": {"from": 0, "to": 1, "steps": 10**7} for i in range(3)}}, "1,000,000,000,000,000,000,000 cases are more", None),
    ({"vary": {"world.damping": [0]}, "repetitions": 10**8}, "out of range", None), ({"measure": {"\ud800": "energy"}}, "half of a character", None),
    ({"repetitions": 0}, "out of range", None), ({"seed": 1.5}, "whole number", None), ({"set": {"world.dampin": 1}}, "dampin", None),
]


@pytest.mark.parametrize("given, message, line", wrong, ids=range(len(wrong)))
def test_every_mistake_has_its_place(tmp_path, given, message, line):
    text = given if isinstance(given, str) else json.dumps({**swing, **given}, indent=1)
    with pytest.raises(StudyError) as caught:
        Study(written(tmp_path, text))
    assert message in str(caught.value)
    for mistake in caught.value.errors:
        place = text.split("\n")[mistake.line - 1]
        assert 1 <= mistake.column <= len(place) + 1
        assert f":{mistake.line}:{mistake.column}: error: " in mistake.text and "^" in mistake.text


@pytest.mark.parametrize("given, word, help", [
    ({"vary": {"world.damping": [0, 0.25, -7]}}, "-7", "Damping"), ({"vary": {"world.gravity": [[0, -1], [0, -2, -3]]}}, "[", "gravity"),
    ({"vary": {"world.damping": {"from": -7, "to": 1, "steps": 3}}}, "-7", "Damping"),
    ({"vary": {"solver.substeps": {"from": 1, "to": 987654, "steps": 3, "whole": True}}}, "987654", ""),
    ({"noise": {"world.damping": [0.5, -7]}}, "-7", "Damping"), ({"sinew_study": 2}, "2", "sinew_study"),
    ({"vary": {"world.damping": [1, 9e999]}}, "9e999", ""), ({"measure": {"x": "bob/weight.z"}}, '"bob/weight.z"', "vx, vy, x, y"),
    ({"measure": {" ": "energy"}}, '" "', ""), ({"measure": {"x": 3}}, "3", "function")])
def test_a_mistake_points_at_the_wrong_word(tmp_path, given, word, help):
    """Also in the middle of a list: its own line and column, once."""
    text = json.dumps({**swing, **given}, indent=1).replace("1e+999", "9e999").replace("Infinity", "9e999")
    with pytest.raises(StudyError) as caught:
        Study(written(tmp_path, text))
    [mistake] = caught.value.errors
    assert text.split("\n")[mistake.line - 1][mistake.column - 1 :].startswith(word), str(mistake.text)
    assert help in mistake.help


def test_a_study_that_measures_nothing_ranks_by_nothing(tmp_path):
    with pytest.raises(StudyError, match="there is none"):
        Study(written(tmp_path, {**swing, "measure": {}, "best": "height"}))


def test_all_mistakes_are_told_at_once_and_point_at_their_words(tmp_path):
    text = json.dumps({**swing, "scen": 1, "seed": "x", "sample": "grdi"}, indent=1)
    with pytest.raises(StudyError) as caught:
        Study(written(tmp_path, text))
    words = [text.split("\n")[m.line - 1][m.column - 1 :][: m.length] for m in caught.value.errors]
    assert words == ['"scen"', '"x"', '"grdi"']


json_values = st.recursive(st.none() | st.booleans() | st.integers(-10**6, 10**6) | st.floats(allow_nan=False, allow_infinity=False) | st.text(),
                           lambda inner: st.lists(inner, max_size=4) | st.dictionaries(st.text(), inner, max_size=4), max_leaves=20)


@given(json_values, st.sampled_from([None, 1, 4]))
def test_the_reader_reads_json(value, indent):
    text = json.dumps(value, indent=indent)
    node = Reader(text).document()
    assert node.plain() == value and json.loads(text[node.start : node.end]) == value


@given(st.text('{}[]":,truefalsn10.e-+ \n/', max_size=60))
def test_the_reader_accepts_what_json_accepts(text):
    try:
        expected = json.loads(text, object_pairs_hook=list)
    except ValueError:
        expected = Syntax
    try:
        Reader(text).document()
        assert expected is not Syntax or "//" in text
    except Syntax as error:
        assert 0 <= error.at <= len(text)
        assert expected is Syntax or "twice" in str(error)




def words_of(text, tmp_path):
    """Each mistake's message, and the words it points at."""
    text = text if isinstance(text, str) else json.dumps(text, indent=1)
    with pytest.raises(StudyError) as caught:
        Study(written(tmp_path, text))
    lines = text.split("\n")
    return [(mistake.message, lines[mistake.line - 1][mistake.column - 1 :][: mistake.length]) for mistake in caught.value.errors]


@pytest.mark.parametrize("indent", [None, 1, 3])
def test_mistakes_of_a_scene_inside_have_their_place_in_the_study(tmp_path, indent):
    scene = {**pendulum, "world": {"gravty": [0, -1], "damping": -1}}
    found = words_of(json.dumps({**swing, "scene": scene}, indent=indent), tmp_path)
    assert ('unknown property "gravty"', '"gravty"') in found and "-1" in dict(found).values() and len(found) == 2


def test_mistakes_of_what_is_set_are_at_their_path(tmp_path):
    text = json.dumps({**swing, "set": {"solver.substeps": 8, "world.dampin": 1, "mode": "clasic"}, "vary": {"world.damping": [0]}}, indent=1)
    assert {words for _, words in words_of(text, tmp_path)} == {'"world.dampin"', '"clasic"'}


def test_a_wrong_path_is_told_once(tmp_path):
    assert words_of({**swing, "vary": {"world.dampin": {"from": 0, "to": 1, "steps": 3}}}, tmp_path) == [('unknown property "dampin"', '"world.dampin"')]
    assert len(words_of({**swing, "vary": {"world.damping": [0, -1, -2]}}, tmp_path)) == 2


def test_a_sample_without_scipy_says_so(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "scipy", None)
    drawn = {**swing, "vary": {"world.damping": {"from": 0, "to": 1}}, "cases": 8}
    for sample in ("sobol", "latin_hypercube"):
        with pytest.raises(StudyError, match="needs SciPy"):
            Study(written(tmp_path, {**drawn, "sample": sample}))
    assert Study(written(tmp_path, {**drawn, "sample": "random"})).run(workers=1) == 0


def test_a_file_may_begin_with_a_byte_order_mark(tmp_path):
    assert len(Study(written(tmp_path, "\ufeff" + json.dumps(swing)))) == 12
