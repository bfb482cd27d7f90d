"""Apache Parquet, as much of it as a table of numbers, texts and truths needs: format version 1, plain and uncompressed."""

from __future__ import annotations

import itertools
import struct
from typing import Any, BinaryIO, Iterable, Sequence, Union

import numpy as np

#: A value of Thrift's compact protocol: an integer of 32 bits, one of 64 bits, text, a structure by field numbers, a list.
Thrift = Union["I32", int, str, "dict[int, Thrift]", "list[Thrift]"]

_mark = b"PAR1"
_rows_of_group = 1 << 16
_types = {bool: 0, int: 2, float: 5, str: 6}  # BOOLEAN, INT64, DOUBLE, BYTE_ARRAY
_plain, _rle = 0, 3
_utf8 = 0


class I32(int):
    """An integer that the format has in 32 bits."""


def write(file: BinaryIO, columns: Sequence[tuple[str, type]], rows: Iterable[Sequence[Any]]) -> None:
    """Writes rows of values; each column has a name and one type of bool, int, float and str. None is no value."""
    at = file.write(_mark)
    total, groups, left = 0, list[Thrift](), iter(rows)
    while group := list(itertools.islice(left, _rows_of_group)):
        start, chunks = at, list[Thrift]()
        for (name, kind), values in zip(columns, zip(*group)):
            page = _page(values, kind)
            header = _struct({1: I32(0), 2: I32(len(page)), 3: I32(len(page)),
                              5: {1: I32(len(values)), 2: I32(_plain), 3: I32(_rle), 4: I32(_rle)}})
            size = file.write(header + page)
            chunks.append({2: at, 3: {1: I32(_types[kind]), 2: [I32(_plain), I32(_rle)], 3: [name], 4: I32(0), 5: len(values),
                                      6: size, 7: size, 9: at}})
            at += size
        groups.append({1: chunks, 2: at - start, 3: len(group)})
        total += len(group)
    schema: list[Thrift] = [{4: "rows", 5: I32(len(columns))}]
    for name, kind in columns:
        optional: dict[int, Thrift] = {1: I32(_types[kind]), 3: I32(1), 4: name}
        schema.append({**optional, 6: I32(_utf8)} if kind is str else optional)
    footer = _struct({1: I32(1), 2: schema, 3: total, 4: groups, 6: "sinew"})
    file.write(footer + struct.pack("<I", len(footer)) + _mark)


def _page(values: Sequence[Any], kind: type) -> bytes:
    """Which values there are, a bit each, and those values."""
    present = np.array([value is not None for value in values])
    bits = np.packbits(present, bitorder="little").tobytes()
    levels = _varint(len(bits) << 1 | 1) + bits
    return struct.pack("<I", len(levels)) + levels + _plainly([value for value in values if value is not None], kind)


def _plainly(values: list[Any], kind: type) -> bytes:
    if kind is str:
        texts = [value.encode("utf-8", "replace") for value in values]
        return b"".join(struct.pack("<I", len(text)) + text for text in texts)
    if kind is bool:
        return np.packbits(np.array(values, bool), bitorder="little").tobytes()
    return np.array(values, "<i8" if kind is int else "<f8").tobytes()


# --- Thrift's compact protocol ------------------------------------------------------------------------------------


def _varint(number: int) -> bytes:
    found = bytearray()
    while number >= 0x80:
        found.append(number & 0x7F | 0x80)
        number >>= 7
    return bytes([*found, number])


def _code(value: Thrift) -> int:
    """Number of a value's type."""
    return 5 if isinstance(value, I32) else 6 if isinstance(value, int) else 8 if isinstance(value, str) else 12 if isinstance(value, dict) else 9


def _struct(fields: dict[int, Thrift]) -> bytes:
    """Fields less than 16 numbers apart, and the mark of the end."""
    found, before = [], 0
    for number, value in fields.items():
        found += [bytes([number - before << 4 | _code(value)]), _value(value)]
        before = number
    return b"".join(found) + b"\0"


def _value(value: Thrift) -> bytes:
    if isinstance(value, int):
        return _varint(value << 1 ^ value >> 63)
    if isinstance(value, str):
        text = value.encode("utf-8", "replace")
        return _varint(len(text)) + text
    if isinstance(value, dict):
        return _struct(value)
    kind = _code(value[0]) if value else 12
    head = bytes([len(value) << 4 | kind]) if len(value) < 15 else bytes([0xF0 | kind]) + _varint(len(value))
    return head + b"".join(map(_value, value))
