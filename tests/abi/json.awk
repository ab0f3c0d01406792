# SPDX-License-Identifier: MIT
# Prints v1.txt as JSON, for programs that make bindings: every struct with its fields, offsets and functions, and every
# constant.
function text(value) {
  gsub(/\\/, "\\\\", value)
  gsub(/"/, "\\\"", value)
  return "\"" value "\""
}
# {"type": ..., "name": ...} of a declaration "const char* name"
function typed(declaration,   at) {
  match(declaration, /[A-Za-z0-9_]+$/)
  at = RSTART
  return "\"name\": " text(substr(declaration, at)) ", \"type\": " text(substr(declaration, 1, at - 2))
}
function function_type(declaration,   name, count, parts, i, out) {
  match(declaration, /\(\*[a-z0-9_]+\)/)
  name = substr(declaration, RSTART + 2, RLENGTH - 3)
  out = "\"name\": " text(name) ", \"type\": \"function\", \"returns\": " text(substr(declaration, 1, RSTART - 2))
  declaration = substr(declaration, RSTART + RLENGTH + 1)
  sub(/\)$/, "", declaration)
  count = declaration == "void" ? 0 : split(declaration, parts, /, /)
  out = out ", \"arguments\": ["
  for (i = 1; i <= count; ++i) out = out (i > 1 ? ", " : "") "{" typed(parts[i]) "}"
  return out "]"
}
/^#/ || /^$/ { next }
/^[a-z]/ {
  printf "%s    {\"name\": %s, \"size\": %s, \"fields\": [", structs++ ? "]},\n" : "{\n  \"structs\": [\n", text($1), $2
  fields = 0
  next
}
/^ / {
  printf "%s\n      {\"offset\": %s, \"size\": %s, ", fields++ ? "," : "", $1, $2
  sub(/^ +[0-9]+ [0-9]+ /, "")
  printf "%s}", /\(\*/ ? function_type($0) : typed($0)
  next
}
/ = / {
  value = substr($0, index($0, " = ") + 3)
  if (value !~ /^"/) {
    gsub(/[()]|u$/, "", value)
    if (value ~ /^0x/) value = hexadecimal(value)
  }
  constants = constants (constants == "" ? "" : ",\n") "    " text($1) ": " value
}
function hexadecimal(value,   i, number) {
  value = tolower(value)
  for (i = 3; i <= length(value); ++i) number = 16 * number + index("0123456789abcdef", substr(value, i, 1)) - 1
  return number
}
END { print "]}\n  ],\n  \"constants\": {\n" constants "\n  }\n}" }
