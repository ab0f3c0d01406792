# SPDX-License-Identifier: MIT
"""The plugin contract as ctypes structures and numpy dtypes, made from the layout file that dmrp's build writes
(`abi.json`, of share/dmrp/abi/dmrp-abi.json): no field is typed twice."""

from __future__ import annotations

import ctypes
import json
import os
import shutil
from typing import Any

import numpy as np

_SCALARS: dict[str, tuple[Any, str]] = {
    "uint8_t": (ctypes.c_uint8, "<u1"),
    "uint16_t": (ctypes.c_uint16, "<u2"),
    "uint32_t": (ctypes.c_uint32, "<u4"),
    "int32_t": (ctypes.c_int32, "<i4"),
    "uint64_t": (ctypes.c_uint64, "<u8"),
    "int64_t": (ctypes.c_int64, "<i8"),
    "float": (ctypes.c_float, "<f4"),
    "double": (ctypes.c_double, "<f8"),
}
_POINTER_DTYPE = "<u8"


def _layout_file() -> str:
    """Beside this module where it is installed or dmrp-host starts it; of a source tree, that of DMRP_ROOT, of the tree's
    build, or of the dmrp-host in PATH."""
    here = os.path.dirname(os.path.abspath(__file__))
    roots = [os.environ.get("DMRP_ROOT"), os.path.join(here, "..", "..", "..", "build", "release")]
    roots += [os.path.join(os.path.dirname(shutil.which("dmrp-host") or "."), "..")]
    files = [os.path.join(here, "abi.json")]
    files += [os.path.join(root, "share", "dmrp", "abi", "dmrp-abi.json") for root in roots if root]
    for file in files:
        if os.path.exists(file):
            return file
    raise ImportError("dmrp.plugin needs dmrp's layout file: install the package, set DMRP_ROOT, or have dmrp-host in PATH")


with open(_layout_file(), encoding="utf-8") as _file:
    _layout = json.load(_file)

constants: dict[str, Any] = {
    name: entry["value"] if isinstance(entry, dict) else entry for name, entry in _layout["constants"].items()
}
structs: dict[str, Any] = {}  # ctypes.Structure by name
dtypes: dict[str, np.dtype[Any]] = {}  # of the same bytes
functions: dict[tuple[str, str], Any] = {}  # the ctypes prototype of a field of a table


def _scalar(declared: str) -> Any:
    if declared.endswith("*"):
        return ctypes.c_char_p if declared == "const char*" else ctypes.c_void_p
    return None if declared == "void" else _SCALARS[declared][0]


def _add(struct: dict[str, Any]) -> None:
    name = struct["name"]
    fields: list[tuple[str, Any]] = []
    formats: list[Any] = []
    for field in struct["fields"]:
        declared = field["type"]
        if declared == "function":
            arguments = [_scalar(argument["type"]) for argument in field["arguments"]]
            functions[name, field["name"]] = ctypes.CFUNCTYPE(_scalar(field["returns"]), *arguments)
            fields.append((field["name"], ctypes.c_void_p))
            formats.append(_POINTER_DTYPE)
        elif declared.endswith("*"):
            fields.append((field["name"], ctypes.c_void_p))
            formats.append(_POINTER_DTYPE)
        elif declared in structs:
            fields.append((field["name"], structs[declared]))
            formats.append(dtypes[declared])
        else:
            fields.append((field["name"], _SCALARS[declared][0]))
            formats.append(_SCALARS[declared][1])
    structs[name] = type(name, (ctypes.Structure,), {"_fields_": fields})
    names = [field["name"] for field in struct["fields"]]
    offsets = [field["offset"] for field in struct["fields"]]
    dtypes[name] = np.dtype({"names": names, "formats": formats, "offsets": offsets, "itemsize": struct["size"]})
    if ctypes.sizeof(structs[name]) != struct["size"]:
        raise ImportError(f"{name} has another size here than in the contract")


for _struct in _layout["structs"]:
    _add(_struct)


def new(struct: str, **values: Any) -> Any:
    """A zeroed struct that says its size."""
    made = structs[struct](**values)
    if hasattr(made, "struct_size"):
        made.struct_size = ctypes.sizeof(made)
    return made


def at(name: str, address: int) -> Any:
    """The struct at an address."""
    return structs[name].from_address(address)


def function(name: str, field: str, table: Any) -> Any:
    """A function of a table, to be called."""
    return functions[name, field](getattr(table, field))


def address_of(callback: Any) -> int:
    """The address of a callback that the caller keeps."""
    return ctypes.cast(callback, ctypes.c_void_p).value or 0


def array(address: int | None, count: int, dtype: Any, stride: int = 0) -> np.ndarray[Any, Any]:
    """A read-only view of `count` elements in the shared memory, valid until the call returns: copy what you keep."""
    kind = np.dtype(dtype)
    if count == 0 or not address:
        return np.empty(0, kind)
    step = stride or kind.itemsize
    memory: Any = (ctypes.c_char * ((count - 1) * step + kind.itemsize)).from_address(address)
    view: np.ndarray[Any, Any] = np.ndarray((count,), kind, memory, 0, (step,))
    view.flags.writeable = False
    return view


def text(address: int | None) -> str:
    """The text at an address."""
    return ctypes.string_at(address).decode("utf-8", "replace") if address else ""
