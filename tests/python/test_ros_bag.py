# SPDX-License-Identifier: MIT
"""A bag read back by an own decoder of MCAP's channel and CDR gives every pose."""

from __future__ import annotations

import math
import struct
from pathlib import Path

from dmrp import trace
from dmrp.mcap import Channel
from dmrp.ros_bag import write_ros_bag


class Cdr:
    def __init__(self, message: memoryview) -> None:
        assert bytes(message[:4]) == b"\0\1\0\0"
        self.body, self.at = message[4:], 0

    def number(self, code: str) -> float:
        size = struct.calcsize(code)
        self.at = (self.at + size - 1) // size * size
        value: float = struct.unpack_from("<" + code, self.body, self.at)[0]
        self.at += size
        return value

    def text(self) -> str:
        size = int(self.number("I"))
        self.at += size
        return bytes(self.body[self.at - size : self.at - 1]).decode()


def test_the_decoder_returns_every_pose(trace_file: Path, tmp_path: Path) -> None:
    read = trace.read(trace_file)
    write_ros_bag(read, tmp_path / "bag.mcap")
    channel = Channel(tmp_path / "bag.mcap", "/tf")
    messages = list(channel)
    assert channel.is_whole and channel.schema.startswith("geometry_msgs/TransformStamped[] transforms")
    assert len(messages) == len(read.t_ns)
    for message, t_ns, poses in zip(messages, read.t_ns.tolist(), read.robots["pose"].tolist()):
        cdr = Cdr(message)
        assert cdr.number("I") == len(poses)
        for robot, (x, y, theta) in enumerate(poses):
            assert int(cdr.number("i")) * 1_000_000_000 + int(cdr.number("I")) == t_ns
            assert (cdr.text(), cdr.text()) == ("map", f"robot_{robot}")
            found = [cdr.number("d") for _ in range(7)]
            assert found[:2] == [x, y]
            assert math.isclose(2 * math.atan2(found[5], found[6]), theta, abs_tol=1e-12)
        assert cdr.at == len(cdr.body)
