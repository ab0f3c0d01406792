# SPDX-License-Identifier: MIT
"""Runs the code cells of notebooks as Jupyter does, in a folder of their own, without Jupyter.

`python3 tests/python/notebook.py FILE...` writes the outputs into the files; test_documents.py compares their text."""

from __future__ import annotations

import ast
import base64
import contextlib
import io
import json
import os
import sys
import tempfile
from pathlib import Path
from typing import Any

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt


def outputs_of(notebook: dict[str, Any]) -> list[list[dict[str, Any]]]:
    """The outputs of each code cell."""
    names: dict[str, Any] = {"__name__": "__main__"}
    return [_run("".join(cell["source"]), names) for cell in notebook["cells"] if cell["cell_type"] == "code"]


def texts_of(outputs: list[dict[str, Any]]) -> list[Any]:
    """What does not depend on fonts: printed text, the plain text of values, and that there are pictures."""
    return [output.get("text") or output["data"].get("text/plain") or sorted(output["data"]) for output in outputs]


def _run(code: str, names: dict[str, Any]) -> list[dict[str, Any]]:
    body = ast.parse(code).body
    last = body.pop() if body and isinstance(body[-1], ast.Expr) else None
    printed = io.StringIO()
    with contextlib.redirect_stdout(printed):
        exec(compile(ast.Module(body, []), "<cell>", "exec"), names)
        value = eval(compile(ast.Expression(last.value), "<cell>", "eval"), names) if last else None
    outputs: list[dict[str, Any]] = []
    if printed.getvalue():
        outputs.append({"output_type": "stream", "name": "stdout", "text": printed.getvalue().splitlines(True)})
    pictures = [_picture(plt.figure(number)) for number in plt.get_fignums()]
    is_shown = value is not None and not pictures and not code.rstrip().endswith(";")
    if is_shown:
        data = {"text/plain": repr(value).splitlines(True)}
        if hasattr(value, "_repr_html_"):
            data["text/html"] = value._repr_html_().splitlines(True)
        outputs.append({"output_type": "execute_result", "data": data, "metadata": {}})
    return outputs + pictures


def _picture(figure: Any) -> dict[str, Any]:
    png = io.BytesIO()
    figure.savefig(png, dpi=110, bbox_inches="tight", metadata={"Software": None})
    plt.close(figure)
    data = {"image/png": base64.b64encode(png.getvalue()).decode()}
    return {"output_type": "display_data", "data": data, "metadata": {}}


def _write(file: Path) -> None:
    notebook = json.loads(file.read_text())
    with tempfile.TemporaryDirectory() as folder, contextlib.chdir(folder):
        outputs = iter(outputs_of(notebook))
    count = 0
    for cell in notebook["cells"]:
        if cell["cell_type"] != "code":
            continue
        count += 1
        cell["execution_count"] = count
        cell["outputs"] = next(outputs)
        for output in cell["outputs"]:
            if output["output_type"] == "execute_result":
                output["execution_count"] = count
    file.write_text(json.dumps(notebook, indent=1, ensure_ascii=False) + "\n")


if __name__ == "__main__":
    for name in sys.argv[1:]:
        _write(Path(os.path.abspath(name)))
