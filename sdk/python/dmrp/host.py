# SPDX-License-Identifier: MIT
"""Finds and calls the program dmrp-host."""

from __future__ import annotations

import os
import shutil
import signal
import subprocess
import tempfile
from collections.abc import Callable, Sequence
from pathlib import Path

BAD_INPUT = 2
MACHINE_FAILED = 3
INTERRUPTED = 130


class InputError(ValueError):
    """What was given is not valid; the text is the line of dmrp-host."""


class HostError(RuntimeError):
    """dmrp-host is missing, or failed for another reason than its input."""


def host_program() -> Path:
    """dmrp-host in DMRP_ROOT, in the source tree that this package stands in, or on the PATH."""
    root = os.environ.get("DMRP_ROOT")
    if root:
        program = Path(root) / "bin" / "dmrp-host"
        if not program.is_file():
            raise HostError(f"DMRP_ROOT={root}: has no bin/dmrp-host")
        return program
    tree = Path(__file__).resolve().parents[3]
    built = tree / "build" / "release" / "bin" / "dmrp-host"
    if built.is_file():
        return built
    found = shutil.which("dmrp-host")
    if not found:
        raise HostError("dmrp-host is not found: set DMRP_ROOT to its installation, or add its folder to PATH")
    return Path(found)


def call_host(
    arguments: Sequence[str | os.PathLike[str]], statuses: Sequence[int] = (0,), on_line: Callable[[str], None] | None = None
) -> str:
    """What dmrp-host prints. InputError and HostError have its last line where the status is none of `statuses`.

    An interrupt goes to dmrp-host, which keeps what is finished and ends; then KeyboardInterrupt is raised."""
    with tempfile.TemporaryFile("w+") as errors:  # a pipe could fill while standard output is read
        process = subprocess.Popen(
            [host_program(), *arguments],
            stdout=subprocess.PIPE,
            stderr=errors,
            text=True,
            start_new_session=True,  # so that the terminal's interrupt comes once, by this process
        )
        assert process.stdout is not None
        lines = []
        try:
            for line in process.stdout:
                lines.append(line)
                if on_line:
                    on_line(line.rstrip("\n"))
            process.wait()
        except BaseException:
            process.send_signal(signal.SIGINT)
            process.communicate()
            raise
        errors.seek(0)
        complaints = errors.read().rstrip().splitlines()
    if process.returncode in statuses:
        return "".join(lines)
    if len(complaints) > 1 and complaints[-1].endswith(("mistake", "mistakes")):
        complaints.pop()  # their number
    message = complaints[-1] if complaints else f"dmrp-host ended with status {process.returncode}"
    if process.returncode == BAD_INPUT:
        raise InputError("\n".join(line for line in complaints if not line.startswith(("warning: ", " "))))
    if process.returncode == INTERRUPTED:
        raise KeyboardInterrupt
    raise HostError(message)
