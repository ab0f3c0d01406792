# SPDX-License-Identifier: MIT
"""python3 as a guest: dmrp-host runs `python3 -m dmrp.guest ...` for a plugin library that is a Python file. The guest's
program is libdmrp_guest.so, the same as that of other libraries; here are the functions of the file's entry."""

from __future__ import annotations

import ctypes
import importlib.util
import inspect
import os
import platform
import sys
import traceback
from types import ModuleType
from typing import Any, Callable

if sys.path and sys.path[0] in ("", os.getcwd()):
    del sys.path[0]  # Python before 3.11

Kept = list[Any]  # what a C pointer leads to


class _Functions(ctypes.Structure):
    _fields_ = [("open", ctypes.c_void_p), ("error", ctypes.c_void_p), ("modules", ctypes.c_void_p), ("versions", ctypes.c_void_p)]


class Guest:
    """The file, and what the guest's program asks of it."""

    def __init__(self) -> None:
        self.file = ""
        self.text = b""
        self.entry: Any = None

    def open(self, file: bytes) -> int | None:
        self.file = os.fsdecode(file)
        try:
            module = self._import()
            from dmrp._instances import Entry

            self.entry = Entry(module, self)
            return int(self.entry.address)
        except BaseException as error:  # nothing may leave a callback
            self.text = self.describe(error).encode()
            return None

    def _import(self) -> ModuleType:
        folder, name = os.path.split(self.file)
        sys.path.insert(0, folder)
        spec = importlib.util.spec_from_file_location(name[: -len(".py")], self.file)
        if spec is None or spec.loader is None:
            raise ImportError("cannot be imported")
        module = importlib.util.module_from_spec(spec)
        sys.modules[spec.name] = module
        import numpy  # noqa: F401  that it is missing is not the fault of the file

        spec.loader.exec_module(module)
        return module

    def describe(self, error: BaseException, place: str = "") -> str:
        """An exception in one line: "policy.py:12: ValueError: text", by the innermost line of the file's folder; `place` if
        there is none."""
        if isinstance(error, SyntaxError) and error.filename:
            place = f"{os.path.basename(error.filename)}:{error.lineno}: "
        else:
            own = [frame for frame in traceback.extract_tb(error.__traceback__) if self._is_own(frame.filename)]
            if own:
                place = f"{os.path.basename(own[-1].filename)}:{own[-1].lineno}: "
        what = error.msg if isinstance(error, SyntaxError) else str(error)
        if isinstance(error, PluginMistake):
            return " ".join(what.split())
        if isinstance(error, ImportError):
            what += f" (by {sys.executable})"
        return " ".join(f"{place}{type(error).__name__}: {what}".split())

    def _is_own(self, file: str) -> bool:
        return os.path.dirname(os.path.abspath(file)) == os.path.dirname(self.file)

    def modules(self) -> bytes:
        files = {getattr(module, "__file__", None) or "" for module in list(sys.modules.values())}
        return "\n".join(sorted(file for file in files if file != self.file and self._is_own(file))).encode()

    def versions(self) -> bytes:
        lines = [f"Python {platform.python_version()}"]
        for name in ("numpy", "scipy", "torch"):
            if name in sys.modules:
                lines.append(f"{name} {getattr(sys.modules[name], '__version__', 'unknown')}")
        return "\n".join(lines).encode()

    def functions(self, kept: Kept) -> _Functions:
        text: Callable[..., Any] = ctypes.CFUNCTYPE(ctypes.c_void_p)

        def answer(function: Callable[[], bytes]) -> int:
            def ask() -> int | None:
                try:
                    self.buffer = ctypes.create_string_buffer(function())
                    return ctypes.addressof(self.buffer)
                except BaseException:
                    return None

            callback = text(ask)
            kept.append(callback)
            return ctypes.cast(callback, ctypes.c_void_p).value or 0

        opened = ctypes.CFUNCTYPE(ctypes.c_void_p, ctypes.c_char_p)(self.open)
        kept.append(opened)
        return _Functions(ctypes.cast(opened, ctypes.c_void_p).value, answer(lambda: self.text), answer(self.modules), answer(self.versions))


class PluginMistake(Exception):
    """A mistake in what the file declares, whose text has its place."""


def place_of(kind: type, file: str) -> str:
    """The place of a class: "policy.py:12"."""
    try:
        line = inspect.getsourcelines(kind)[1]
        return f"{os.path.basename(file)}:{line}"
    except (OSError, TypeError):
        return os.path.basename(file)


def main() -> int:
    sys.modules.setdefault("dmrp.guest", sys.modules[__name__])
    here = os.path.dirname(os.path.abspath(__file__))
    program = ctypes.CDLL(os.path.join(here, "..", "..", "libdmrp_guest.so"))
    descriptors, words = int(sys.argv[1]), [os.fsencode(word) for word in sys.argv[2:]]
    arguments = (ctypes.c_char_p * len(words))(*words)
    kept: Kept = []
    functions = Guest().functions(kept)
    return program.dmrp_run_guest(ctypes.byref(functions), descriptors, arguments, len(words))  # type: ignore[no-any-return]


if __name__ == "__main__":
    sys.exit(main())
