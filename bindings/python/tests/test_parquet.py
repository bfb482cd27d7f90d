"""The tables of studies as Parquet, read by a reader that knows the format's specification alone. DuckDB and hyparquet read them, too."""

import io
import json
import struct
import subprocess
import sys

import pytest
from hypothesis import given, strategies as st

from conftest import swing, written
from sinew.study import Study, parquet


class Reader:
    """Values of Thrift's compact protocol: structures as dicts by field number."""

    def __init__(self, data, at=0):
        self.data, self.at = data, at

    def byte(self):
        self.at += 1
        return self.data[self.at - 1]

    def varint(self):
        byte = self.byte()
        return byte if byte < 128 else byte - 128 + 128 * self.varint()

    def value(self, kind):
        if kind in (5, 6):
            number = self.varint()
            return number >> 1 ^ -(number & 1)
        if kind == 8:
            size = self.varint()
            self.at += size
            return self.data[self.at - size : self.at].decode()
        if kind == 9:
            head = self.byte()
            size = head >> 4 if head >> 4 < 15 else self.varint()
            return [self.value(head & 15) for _ in range(size)]
        assert kind == 12
        return self.struct()

    def struct(self):
        found, number = {}, 0
        while head := self.byte():
            assert head >> 4 > 0
            number += head >> 4
            found[number] = self.value(head & 15)
        return found


def column_of(data, chunk):
    """The values of a column in a group of rows."""
    meta = chunk[3]
    assert (meta[4], meta[6]) == (0, meta[7])  # uncompressed
    reader = Reader(data, meta[9])
    header = reader.struct()
    body, count = data[reader.at : reader.at + header[3]], header[5][1]
    assert (header[1], header[2], count) == (0, header[3], meta[5]) and reader.at + header[3] == meta[9] + meta[7]
    size = struct.unpack_from("<I", body)[0]
    levels, values = Reader(body, 4), body[4 + size :]
    groups = levels.varint()
    assert groups % 2 == 1 and groups >> 1 == -(-count // 8) and levels.at + (groups >> 1) == 4 + size
    present = [body[levels.at + i // 8] >> i % 8 & 1 == 1 for i in range(count)]
    left = iter(decoded(values, meta[1], sum(present)))
    found = [next(left) if there else None for there in present]
    assert not list(left)
    return found


def decoded(values, kind, count):
    if kind == 0:
        assert len(values) == -(-count // 8)
        return [values[i // 8] >> i % 8 & 1 == 1 for i in range(count)]
    if kind in (2, 5):
        assert len(values) == 8 * count
        return struct.unpack(f"<{count}{'q' if kind == 2 else 'd'}", values)
    found, at = [], 0
    while at < len(values):
        size = struct.unpack_from("<I", values, at)[0]
        found.append(values[at + 4 : at + 4 + size].decode())
        at += 4 + size
    return found


def read(data):
    """Names, types and rows."""
    assert data[:4] == data[-4:] == b"PAR1"
    size = struct.unpack("<I", data[-8:-4])[0]
    reader = Reader(data, len(data) - 8 - size)
    footer = reader.struct()
    assert reader.at == len(data) - 8 and footer[1] == 1
    root, *fields = footer[2]
    assert root[5] == len(fields) and all(field[3] == 1 and (field.get(6) == 0) == (field[1] == 6) for field in fields)
    rows = []
    for group in footer[4]:
        columns = [column_of(data, chunk) for chunk in group[1]]
        assert [chunk[3][3] for chunk in group[1]] == [[field[4]] for field in fields] and group[3] == len(columns[0])
        rows += map(list, zip(*columns))
    assert footer[3] == len(rows)
    return [field[4] for field in fields], [{0: bool, 2: int, 5: float, 6: str}[field[1]] for field in fields], rows


values_of = {bool: st.booleans(), int: st.integers(-(2**63), 2**63 - 1), float: st.floats(allow_nan=False), str: st.text()}


@given(st.data(), st.lists(st.sampled_from(list(values_of)), min_size=1, max_size=20), st.integers(1, 9))
def test_rows_are_read_as_they_were_written(data, kinds, rows_of_group):
    rows = data.draw(st.lists(st.tuples(*(st.none() | values_of[kind] for kind in kinds)).map(list), max_size=30))
    names = [f"column {i}" for i in range(len(kinds))]
    file, usual = io.BytesIO(), parquet._rows_of_group
    parquet._rows_of_group = rows_of_group
    try:
        parquet.write(file, list(zip(names, kinds)), rows)
    finally:
        parquet._rows_of_group = usual
    assert read(file.getvalue()) == (names, kinds, rows)


@pytest.mark.parametrize("values, kind, seen", [
    ([1, 2], int, [1, 2]), ([1, 2.5], float, [1.0, 2.5]), ([10**12, 1.5], float, [1e12, 1.5]), ({"from": 1, "to": 2, "steps": 2}, float, [1.0, 2.0]),
    ({"from": 1, "to": 2, "steps": 2, "whole": True}, int, [1, 2])])
def test_numbers_that_vary_have_one_type(tmp_path, values, kind, seen):
    study = Study(written(tmp_path, {**swing, "vary": {"figures.bob.particles.weight.mass": values}, "until": 0.01}))
    study.run(workers=1)
    names, kinds, rows = read((study.folder / "table.parquet").read_bytes())
    assert (names[2], kinds[2]) == ("figures.bob.particles.weight.mass", kind) and [row[2] for row in rows] == seen


def test_a_table_of_parquet_has_the_values_of_that_of_csv(tmp_path):
    """Failures, empty measures and lists among them."""
    mine = "def half(sim):\n    return None if sim.energy < -1 else 1 / (sim.energy > -0.4)\n"
    (tmp_path / "mine.py").write_text(mine)
    path = written(tmp_path, {**swing, "vary": {"world.gravity": [[0, -1], [0, -0.1]], "view.plain": [True, False], "units.length": ["m"]},
                              "measure": {"energy": "energy", "half": {"function": "mine.py:half"}, "torn": {"first": "torn"}}})
    done = subprocess.run([sys.executable, "-m", "sinew", "study", path], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    study = Study(path)
    names, kinds, rows = read((study.folder / "table.parquet").read_bytes())
    assert names == list(study.frame().columns)
    for name, row in zip(names, zip(*rows)):
        shown = [None if value != value else value for value in study.frame()[name].tolist()]
        assert list(row) == shown, name
    assert {kind for name, kind in zip(names, kinds) if name in ("hash", "failed", "world.gravity", "units.length")} == {str}
    assert json.loads(rows[0][names.index("world.gravity")]) == [0, -1]
