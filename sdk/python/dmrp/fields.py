# SPDX-License-Identifier: MIT
"""The field list that stands in a trace, and records read by it. Its grammar: core/trace/trace_schema.hpp."""

from __future__ import annotations

import struct
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from .mcap import TraceError

NUMBERS = {"u8": "<u1", "u16": "<u2", "u32": "<u4", "u64": "<u8"}
NUMBERS |= {"i32": "<i4", "i64": "<i8", "clock": "<i8", "f32": "<f4", "f64": "<f8"}

Record = dict[str, Any]
_u32 = struct.Struct("<I")
_two_u32 = struct.Struct("<II")


@dataclass(slots=True)
class Elements:
    """Elements of a record as they stand in the file, with what they were appended to by a later contract."""

    data: memoryview
    count: int
    stride: int
    dtype: np.dtype[Any]


def array_of(parts: list[Elements], dtype: np.dtype[Any]) -> np.ndarray[Any, Any]:
    """All elements of `parts` in one structured array, without the fields that `dtype` does not have."""
    parts = [part for part in parts if part.count > 0]
    if not parts:
        return np.empty(0, dtype)
    strides = {part.stride for part in parts}
    if len(strides) > 1:
        return np.concatenate([array_of([part], dtype) for part in parts])
    stride = strides.pop()
    if stride < dtype.itemsize:
        raise TraceError(f"elements of {stride} bytes, which the field list says have {dtype.itemsize}")
    joined = bytearray().join(part.data for part in parts)
    if stride == dtype.itemsize:
        return np.frombuffer(joined, dtype)
    rows = np.frombuffer(joined, np.uint8).reshape(-1, stride)
    return np.ascontiguousarray(rows[:, : dtype.itemsize]).view(dtype).reshape(-1)


Reader = Callable[[memoryview, int, Record], int]


@dataclass
class _Struct:
    dtype: np.dtype[Any] | None  # of structs that are numbers alone
    readers: list[Reader]

    def read(self, data: memoryview, position: int) -> tuple[Record, int]:
        record: Record = {}
        for reader in self.readers:
            position = reader(data, position, record)
        return record, position


class FieldList:
    """The structs and records that the text of a schema lists."""

    def __init__(self, text: str) -> None:
        if not text:
            raise TraceError("the trace has no list of its fields: an older dmrp-host wrote it; run the experiment again")
        self._structs: dict[str, _Struct] = {}
        self._records: dict[int, tuple[str, _Struct]] = {}
        for line in text.splitlines():
            head, _, fields = line.partition(":")
            name, _, kind = (part.strip() for part in head.partition("="))
            made = self._struct([field.split() for field in fields.split(",")])
            self._structs[name] = made
            if kind:
                self._records[int(kind)] = (name, made)

    def dtype(self, name: str) -> np.dtype[Any]:
        """The numpy type of a number or of a struct of numbers."""
        if name in NUMBERS:
            return np.dtype(NUMBERS[name])
        known = self._structs.get(name)
        if known is None or known.dtype is None:
            raise TraceError(f"the field list names {name}, which is no list of numbers")
        return known.dtype

    def read(self, message: memoryview) -> tuple[str, Record]:
        """The name and the fields of a record; ("", {}) for one of a kind that the list does not have."""
        if len(message) < 5 or _u32.unpack_from(message)[0] != len(message) - 5:
            raise TraceError("a record is not as long as it says")
        name, content = self._records.get(message[4], ("", None))
        try:
            return (name, content.read(message, 5)[0]) if content else ("", {})
        except (struct.error, ValueError) as error:
            raise TraceError(f"a record {name} is damaged: {error}") from None

    def _struct(self, fields: list[list[str]]) -> _Struct:
        if all(len(field) == 2 and field[0] != "text" for field in fields):
            dtype = np.dtype([(name, self.dtype(kind)) for kind, name in fields])
            return _Struct(dtype, [self._values(fields)])
        readers: list[Reader] = []
        plain: list[list[str]] = []
        for field in fields:
            if len(field) == 2 and field[0] != "text":
                plain.append(field)
                continue
            if plain:
                readers.append(self._values(plain))
                plain = []
            readers.append(self._reader(field))
        if plain:
            readers.append(self._values(plain))
        return _Struct(None, readers)

    def _values(self, fields: list[list[str]]) -> Reader:
        """Reads neighbouring numbers at once; a struct of numbers becomes a tuple of its numbers."""
        dtypes = [(name, self.dtype(kind)) for kind, name in fields]
        packed = struct.Struct("<" + "".join(_codes(dtype) for _, dtype in dtypes))
        counts = [(name, len(_codes(dtype)), dtype.names is None) for name, dtype in dtypes]

        def read(data: memoryview, position: int, record: Record) -> int:
            values = packed.unpack_from(data, position)
            at = 0
            for name, count, is_number in counts:
                record[name] = values[at] if is_number else values[at : at + count]
                at += count
            return position + packed.size

        return read

    def _reader(self, field: list[str]) -> Reader:
        if field[0] == "text":
            return _text_reader(field[1])
        if field[0] == "array":
            return _array_reader(field[2], self.dtype(field[1]))
        if field[0] == "elements":
            return _elements_reader(field[2], self.dtype(field[1]))
        if field[0] == "blocks":
            return _blocks_reader(field[2], self._structs[field[1]])
        if field[0] == "block":
            return _block_reader(field[2], self._structs[field[1]])
        if field[:2] == ["optional", "block"]:
            return _optional_reader(field[3], _block_reader(field[3], self._structs[field[2]]))
        if field[0] == "optional":
            name, *factors = field[2].split("*")
            return _optional_reader(name, _product_reader(name, factors, self.dtype(field[1])))
        raise TraceError(f"the field list has a field of an unknown kind: {' '.join(field)}")


def _codes(dtype: np.dtype[Any]) -> str:
    if dtype.names is None:
        return {"u1": "B", "u2": "H", "u4": "I", "u8": "Q", "i4": "i", "i8": "q", "f4": "f", "f8": "d"}[dtype.str[1:]]
    return "".join(_codes(dtype[name]) for name in dtype.names)


def _slice(data: memoryview, position: int, size: int) -> memoryview:
    if position + size > len(data):
        raise TraceError("a record ends within a field")
    return data[position : position + size]


def _text_reader(name: str) -> Reader:
    def read(data: memoryview, position: int, record: Record) -> int:
        size = _u32.unpack_from(data, position)[0]
        record[name] = str(_slice(data, position + 4, size), "utf-8")
        return int(position + 4 + size)

    return read


def _array_reader(name: str, dtype: np.dtype[Any]) -> Reader:
    def read(data: memoryview, position: int, record: Record) -> int:
        size = _u32.unpack_from(data, position)[0] * dtype.itemsize
        record[name] = np.frombuffer(bytes(_slice(data, position + 4, size)), dtype)
        return int(position + 4 + size)

    return read


def _elements_reader(name: str, dtype: np.dtype[Any]) -> Reader:
    def read(data: memoryview, position: int, record: Record) -> int:
        count, stride = _two_u32.unpack_from(data, position)
        size = count * stride
        record[name] = Elements(_slice(data, position + 8, size), count, stride, dtype)
        return int(position + 8 + size)

    return read


def _block_reader(name: str, content: _Struct) -> Reader:
    def read(data: memoryview, position: int, record: Record) -> int:
        size = _u32.unpack_from(data, position)[0]
        record[name] = content.read(_slice(data, position + 4, size), 0)[0]
        return int(position + 4 + size)

    return read


def _blocks_reader(name: str, content: _Struct) -> Reader:
    read_one = _block_reader(name, content)

    def read(data: memoryview, position: int, record: Record) -> int:
        count = _u32.unpack_from(data, position)[0]
        position += 4
        blocks = []
        for _ in range(count):
            one: Record = {}
            position = read_one(data, position, one)
            blocks.append(one[name])
        record[name] = blocks
        return position

    return read


def _optional_reader(name: str, reader: Reader) -> Reader:
    def read(data: memoryview, position: int, record: Record) -> int:
        record[name] = None
        return reader(data, position + 1, record) if data[position] else position + 1

    return read


def _product_reader(name: str, factors: list[str], dtype: np.dtype[Any]) -> Reader:
    def read(data: memoryview, position: int, record: Record) -> int:
        count = 1
        for factor in factors:
            count *= int(factor) if factor.isdigit() else record[factor]
        size = count * dtype.itemsize
        record[name] = np.frombuffer(bytes(_slice(data, position, size)), dtype)
        return position + size

    return read
