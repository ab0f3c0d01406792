#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Reads a layout (v1.txt), writes a C header with a function mix_TYPE(mixed* all, const dmrp_TYPE* it) for each struct of
data, which mixes all of its fields: none can be forgotten. Left out are sizes, strides, reserved fields, and structs of
functions. Called as: mix.py LAYOUT > mixed_fields.h"""

import re
import sys


def singular(name):
    return {"people": "person", "vertices": "vertex"}.get(name, name.removesuffix("s"))


def first(fields, *names):
    return next((f"it->{name}" for name in names if name in fields), "")


def count_of(name, fields):
    """What says how many elements an array has; "" where it is a pointer to one thing."""
    if "width" in fields and "height" in fields:
        return "it->width * it->height"
    is_array = singular(name) != name or name == "in_force"
    return first(fields, f"{singular(name)}_count", f"{name}_count", "count") if is_array else ""


def lines_of(name, fields):
    kind = fields[name]
    if name in ("struct_size", "reserved") or name.endswith("stride") or "void" in kind:
        return []
    if kind.startswith("dmrp_") and "*" not in kind:
        return [f"mix_{kind[5:]}(all, &it->{name});"]
    if kind == "const char*":
        return [f"mix_text(all, it->{name});"]
    if "*" not in kind:
        return [f"mix_time(all, it->{name});" if name.endswith("_ns") else f"mix(all, (double)it->{name});"]
    element = kind.removeprefix("const ").removesuffix("*").strip()
    count = count_of(name, fields)
    each = f"for (uint32_t i = 0; i < {count}; ++i) "
    if element == "char* const":
        return [f"{each}mix_text(all, it->{name}[i]);"] if count else []
    if not element.startswith("dmrp_"):
        return [f"{each}mix(all, (double)it->{name}[i]);"]
    if not count:
        return [f"if (it->{name}) mix_{element[5:]}(all, it->{name});"]
    stride = first(fields, f"{singular(name)}_stride", f"{name}_stride", "stride")
    at = f"DMRP_AT({element}, it->{name}, {stride}, i)" if stride else f"&it->{name}[i]"
    return [f"{each}mix_{element[5:]}(all, {at});"]


structs = {}
for line in open(sys.argv[1], encoding="utf-8"):
    if begins := re.match(r"(dmrp_\w+) \d+$", line):
        structs[begins[1]] = fields = {}
    elif field := re.match(r"  \d+ \d+ (.*\(\*.*|(.*?) ?(\w+))$", line):
        fields[field[3] or field[1]] = field[2]  # None: a function

data = {name: fields for name, fields in structs.items() if None not in fields.values() and name != "dmrp_plugin"}
print('#include <dmrp/dmrp.h>\n\n#include "tests/abi/old_plugins/mixed.h"\n')
for name in data:
    print(f"static inline void mix_{name[5:]}(mixed* all, const {name}* it);")
for name, fields in data.items():
    print(f"\nstatic inline void mix_{name[5:]}(mixed* all, const {name}* it) {{\n  (void)all, (void)it;")
    print("".join(f"  {line}\n" for field in fields for line in lines_of(field, fields)) + "}")
