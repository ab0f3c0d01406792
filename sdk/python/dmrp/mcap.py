# SPDX-License-Identifier: MIT
"""Reads the messages of one channel of an MCAP file (https://mcap.dev/spec), also of one that is cut."""

from __future__ import annotations

import ctypes
import ctypes.util
import struct
from collections.abc import Iterator
from pathlib import Path

MAGIC = b"\x89MCAP0\r\n"
SCHEMA, CHANNEL, MESSAGE, CHUNK, DATA_END = 0x03, 0x04, 0x05, 0x06, 0x0F

_prefix = struct.Struct("<BQ")  # opcode, length
_message = struct.Struct("<HIQQ")  # channel, sequence, log time, publish time
_u16 = struct.Struct("<H")
_u32 = struct.Struct("<I")


class TraceError(ValueError):
    """A trace that is damaged or of another format."""


def decompressed(data: bytes, size: int) -> bytes:
    """`data`, a zstd frame, as `size` bytes; by the package zstandard, else by the system's libzstd."""
    try:
        import zstandard
    except ImportError:
        return _decompressed_by_library(data, size)
    try:
        return bytes(zstandard.ZstdDecompressor().decompress(data, max_output_size=size))
    except zstandard.ZstdError as error:
        raise TraceError(f"a chunk is damaged: {error}") from None


def _decompressed_by_library(data: bytes, size: int) -> bytes:
    try:
        library = ctypes.CDLL(ctypes.util.find_library("zstd") or "libzstd.so.1")
    except OSError:
        raise TraceError("zstd is needed: install the package zstandard or libzstd1") from None
    library.ZSTD_decompress.restype = ctypes.c_size_t
    library.ZSTD_decompress.argtypes = [ctypes.c_char_p, ctypes.c_size_t, ctypes.c_char_p, ctypes.c_size_t]
    out = ctypes.create_string_buffer(size)
    if library.ZSTD_decompress(out, size, data, len(data)) != size:
        raise TraceError("a chunk is damaged: zstd cannot decompress it")
    return out.raw


class Channel:
    """The channel `topic` of a file: iterate over it for its messages; `schema` is known after the first."""

    def __init__(self, file: Path, topic: str) -> None:
        self.file = file
        self.topic = topic
        self.schema = ""
        self.is_whole = False  # after iteration: whether the file was closed by its writer
        self._schemas: dict[int, str] = {}
        self._id: int | None = None

    def __iter__(self) -> Iterator[memoryview]:
        data = self.file.read_bytes()
        if not data.startswith(MAGIC):
            raise TraceError(f"{self.file}: is no MCAP file")
        self.is_whole = data.endswith(MAGIC) and len(data) > 2 * len(MAGIC)
        yield from self._records(memoryview(data), len(MAGIC))

    def _records(self, data: memoryview, position: int) -> Iterator[memoryview]:
        end = len(data)
        while position + _prefix.size <= end:
            opcode, length = _prefix.unpack_from(data, position)
            begin = position + _prefix.size
            position = begin + length
            if position > end or opcode == DATA_END:
                return  # the rest was not written, or is the summary
            if opcode == MESSAGE:
                if _u16.unpack_from(data, begin)[0] == self._id:
                    yield data[begin + _message.size : position]
            elif opcode == CHUNK:
                yield from self._records(memoryview(self._chunk(data[begin:position])), 0)
            elif opcode == SCHEMA:
                self._read_schema(data[begin:position])
            elif opcode == CHANNEL:
                self._read_channel(data[begin:position])

    def _chunk(self, data: memoryview) -> bytes:
        size = struct.unpack_from("<Q", data, 16)[0]
        compression, position = _text(data, 28)
        content = bytes(data[position + 8 :])
        if compression == "":
            return content
        if compression != "zstd":
            raise TraceError(f"{self.file}: is compressed by {compression}, not by zstd")
        return decompressed(content, size)

    def _read_schema(self, data: memoryview) -> None:
        _, position = _text(data, 2)
        _, position = _text(data, position)
        text, _ = _text(data, position)
        self._schemas[_u16.unpack_from(data)[0]] = text

    def _read_channel(self, data: memoryview) -> None:
        identity, schema = struct.unpack_from("<HH", data)
        topic, _ = _text(data, 4)
        if topic == self.topic:
            self._id = identity
            self.schema = self._schemas.get(schema, "")


def _text(data: memoryview, position: int) -> tuple[str, int]:
    begin = position + 4
    end = begin + int(_u32.unpack_from(data, position)[0])
    return str(data[begin:end], "utf-8"), end
