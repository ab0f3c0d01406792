# SPDX-License-Identifier: MIT
"""An experiment, written in Python instead of TOML."""

from __future__ import annotations

import json
import math
import os
import tempfile
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .host import InputError

if TYPE_CHECKING:
    from .run import Run

LIBRARIES = ("libdmrp_planners.so", "libdmrp_controllers.so", "libdmrp_pedestrians.so", "libdmrp_metrics.so")


def use(name: str | None = None, **keys: Any) -> dict[str, Any]:
    """An entry of a list of an experiment: `use = name` and the keys that TOML has for it.

    Without a name, plans that are read in place of a planner: use(file="plans.csv")."""
    return keys if name is None else {"use": name, **keys}


class Experiment:
    """An experiment, with TOML's names: keys of [experiment] (`seed=1`), tables as dictionaries
    (`simulation={"step_s": 0.02}`) and lists of use() (`scenario=[dmrp.use("mall", robots=[2, 4])]`).

    Without `plugins` the built-in libraries are loaded; those that are given are added to them.
    Paths are relative to the working directory."""

    def __init__(self, *, name: str, plugins: Sequence[str] = (), **keys: Any) -> None:
        self.name = name
        self.plugins = [*LIBRARIES, *(library for library in plugins if library not in LIBRARIES)]
        self.keys = keys

    def toml(self) -> str:
        """The experiment file."""
        tables = {key: value for key, value in self.keys.items() if _is_table(value) or _is_list_of_tables(value)}
        head = {key: value for key, value in self.keys.items() if key not in tables}
        lines = _table("[experiment]", {"name": self.name, **head, "plugins": self.plugins})
        for key, value in tables.items():
            if _is_table(value):
                lines += _table(f"[{key}]", value)
            else:
                for entry in value:
                    lines += _table(f"[[{key}]]", entry)
        return "\n".join(lines)

    def run(self, out: str | os.PathLike[str] | None = None, **options: Any) -> Run:
        """Runs it; the options are those of dmrp.run()."""
        from .run import run

        directory = Path.cwd()
        with tempfile.NamedTemporaryFile("w", suffix=".toml", prefix=f".{self.name}-", dir=directory) as file:
            file.write(self.toml())
            file.flush()
            return run(file.name, out, **options)

    def __repr__(self) -> str:
        return f"<Experiment {self.name}>"


def _is_table(value: Any) -> bool:
    return isinstance(value, Mapping)


def _is_list_of_tables(value: Any) -> bool:
    return isinstance(value, list | tuple) and len(value) > 0 and all(isinstance(entry, Mapping) for entry in value)


def _table(head: str, content: Mapping[str, Any]) -> list[str]:
    return [head, *(f"{_key(key)} = {_value(value)}" for key, value in content.items()), ""]


def _key(key: str) -> str:
    return key if key.replace("_", "a").replace("-", "a").isalnum() and key.isascii() else json.dumps(key)


def _value(value: Any) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str | os.PathLike):
        return json.dumps(os.fspath(value), ensure_ascii=False)
    if isinstance(value, Mapping):
        return "{ " + ", ".join(f"{_key(key)} = {_value(content)}" for key, content in value.items()) + " }"
    if isinstance(value, Sequence) or hasattr(value, "tolist"):
        content = value.tolist() if hasattr(value, "tolist") else value
        return _value(content) if not isinstance(content, Sequence) else f"[{', '.join(map(_value, content))}]"
    if isinstance(value, int):
        return str(value)
    if isinstance(value, float):
        return repr(value) if math.isfinite(value) else str(value)
    raise InputError(f"TOML has no value like {value!r}")
