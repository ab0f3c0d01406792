# SPDX-License-Identifier: MIT
"""A trace as a ROS 2 bag: an MCAP file of the profile ros2 with messages in CDR, for `ros2 bag play -s mcap FILE`."""

from __future__ import annotations

import math
import os
import struct
from pathlib import Path

from .host import InputError
from .mcap import MAGIC
from .trace import Trace

_TRANSFORMS = "tf2_msgs/msg/TFMessage"
_SEPARATOR = "\n" + "=" * 80 + "\n"
_DEFINITION = _SEPARATOR.join(
    (
        "geometry_msgs/TransformStamped[] transforms",
        "MSG: geometry_msgs/TransformStamped\nstd_msgs/Header header\nstring child_frame_id\nTransform transform",
        "MSG: std_msgs/Header\nbuiltin_interfaces/Time stamp\nstring frame_id",
        "MSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec",
        "MSG: geometry_msgs/Transform\nVector3 translation\nQuaternion rotation",
        "MSG: geometry_msgs/Vector3\nfloat64 x\nfloat64 y\nfloat64 z",
        "MSG: geometry_msgs/Quaternion\nfloat64 x\nfloat64 y\nfloat64 z\nfloat64 w",
    )
)
_QOS = (
    "- history: 3\n  depth: 0\n  reliability: 1\n  durability: 2\n  deadline:\n    sec: 9223372036\n    nsec: 854775807\n"
    "  lifespan:\n    sec: 9223372036\n    nsec: 854775807\n  liveliness: 1\n  liveliness_lease_duration:\n"
    "    sec: 9223372036\n    nsec: 854775807\n  avoid_ros_namespace_conventions: false"
)


class _Cdr:
    """A little-endian CDR message: numbers stand at multiples of their size."""

    def __init__(self) -> None:
        self._body = bytearray()

    def number(self, code: str, value: float) -> None:
        size = struct.calcsize(code)
        self._body += bytes(-len(self._body) % size) + struct.pack("<" + code, value)

    def text(self, value: str) -> None:
        content = value.encode() + b"\0"
        self.number("I", len(content))
        self._body += content

    def message(self) -> bytes:
        return b"\0\1\0\0" + bytes(self._body)


def write_ros_bag(trace: Trace, file: str | os.PathLike[str]) -> None:
    """Robots' poses as the topic /tf, from `map` to `robot_0`, `robot_1`, ...: a message a sample, in metres and radians."""
    path = Path(file)
    if path.exists():
        raise InputError(f"{path}: exists")
    with path.open("wb") as out:
        out.write(MAGIC + _record(0x01, _text("ros2") + _text("dmrp")))
        out.write(_record(0x03, struct.pack("<H", 1) + _text(_TRANSFORMS) + _text("ros2msg") + _text(_DEFINITION)))
        metadata = _text("offered_qos_profiles") + _text(_QOS)
        channel = struct.pack("<HH", 1, 1) + _text("/tf") + _text("cdr")
        out.write(_record(0x04, channel + struct.pack("<I", len(metadata)) + metadata))
        for number, t_ns in enumerate(trace.t_ns.tolist()):
            head = struct.pack("<HIQQ", 1, number, t_ns, t_ns)
            out.write(_record(0x05, head + _transforms(t_ns, trace.robots["pose"][number].tolist())))
        out.write(_record(0x0F, struct.pack("<I", 0)) + _record(0x02, struct.pack("<QQI", 0, 0, 0)) + MAGIC)


def _transforms(t_ns: int, poses: list[tuple[float, float, float]]) -> bytes:
    out = _Cdr()
    out.number("I", len(poses))
    for robot, (x, y, theta) in enumerate(poses):
        out.number("i", t_ns // 1_000_000_000)
        out.number("I", t_ns % 1_000_000_000)
        out.text("map")
        out.text(f"robot_{robot}")
        for value in (x, y, 0.0, 0.0, 0.0, math.sin(theta / 2), math.cos(theta / 2)):
            out.number("d", value)
    return out.message()


def _record(opcode: int, content: bytes) -> bytes:
    return struct.pack("<BQ", opcode, len(content)) + content


def _text(value: str) -> bytes:
    content = value.encode()
    return struct.pack("<I", len(content)) + content
