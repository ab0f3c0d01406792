#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# plugins_page.py DMRP_HOST LIBRARY: a reference page of a plugin library in Markdown, from `dmrp-host plugins --json`.
import json
import subprocess
import sys


def shortest(number):
    """The fewest digits that mean this number, without the .0 of a whole one."""
    return repr(number).removesuffix(".0")


def toml_text(kind, value):
    """A default as TOML writes it."""
    if kind == "double":
        return value if isinstance(value, str) else repr(value)  # a text: inf or nan, which JSON has not
    if kind == "double array":
        return "[" + ", ".join(toml_text("double", number) for number in value) + "]"
    return json.dumps(value, ensure_ascii=False)


def limits_of(parameter):
    low, high = parameter["minimum"], parameter["maximum"]
    if parameter["choices"]:
        return "one of " + ", ".join(parameter["choices"])
    if low is not None and high is not None:
        return f"{shortest(low)} to {shortest(high)}"
    if low is not None:
        return f">= {shortest(low)}"
    return "" if high is None else f"<= {shortest(high)}"


def unit_of(described):
    return "" if described["unit"] == "1" else described["unit"]


def in_brackets(parts, separator):
    given = [part for part in parts if part]
    return f" ({separator.join(given)})" if given else ""


def value_line(value):
    """Its unit, its better direction, its subjects beside the system."""
    limits = limits_of({**value, "choices": []})
    parts = [
        " ".join(part for part in (limits, unit_of(value)) if part),
        value["direction"] if value["direction"] != "none" else "",
        "robots" if "robot" in value["subjects"] else "",
        "people" if "pedestrian" in value["subjects"] else "",
        "a curve" if value["curve"] else "",
        "wall clock" if value["wall_clock"] else "",
    ]
    return f"- `{value['name']}`{in_brackets(parts, '; ')}: {value['description']}"


def parameter_line(parameter):
    default = toml_text(parameter["type"], parameter["default"])
    limits = in_brackets([limits_of(parameter), unit_of(parameter)], " ")
    return f"- `{parameter['key']} = {default}`{limits}: {parameter['doc']}"


def section(plugin):
    summary = "" if plugin["values"] else ": " + plugin["summary"]  # formulas say more
    source = f" Source: {plugin['source']}." if plugin["source"] else ""
    parts = [f"## {plugin['name']}", f"`{plugin['id']}`{summary}.{source}"]
    if plugin["values"]:
        parts.append("\n".join(map(value_line, plugin["values"])))
    if plugin["parameters"]:
        parts += ["Parameters:", "\n".join(map(parameter_line, plugin["parameters"]))]
    return "\n\n".join(parts)


def page(library, plugins):
    """Begins with a comment that names the command."""
    legend = "Parameters: `name = default` (range, unit): meaning."
    if any(plugin["values"] for plugin in plugins):
        legend = "Values: `name` (unit; better direction; whose, beside the system's): formula.\n" + legend
    parts = [f"<!-- docs/site/plugins_page.py dmrp-host {library} -->", legend]
    return "\n\n".join(parts + [section(plugin) for plugin in plugins])


host, library = sys.argv[1:]
said = subprocess.run([host, "plugins", "--json", library], check=True, stdout=subprocess.PIPE).stdout
print(page(library, json.loads(said)[0]["plugins"]))
