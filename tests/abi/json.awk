# SPDX-License-Identifier: MIT
# Prints the contract as JSON, for programs that make bindings. Called as: awk -f json.awk DESCRIBED LAYOUT, what
# describe.awk says of the headers and what layout.awk's program says of the structs (v1.txt). A struct comes after all
# that it contains or points to.
BEGIN { FS = "\t" }

FNR == NR {
  if ($1 == $2) {
    if (!($1 in header_text)) headers[++header_count] = $1
    header_text[$1] = header_text[$1] (header_text[$1] == "" ? "" : "\\n\\n") $5
  } else if (!($1 in header_of)) {
    header_of[$1] = $2
    since[$1] = $3
    thread[$1] = $4
    comment[$1] = $5
    group[$1] = $6
  }
  next
}
/^#/ || /^$/ { next }
/^[a-z]/ {
  split($0, words, " ")
  type = words[1]
  types[++type_count] = type
  size[type] = words[2]
  next
}
/^ / {
  split($0, words, " ")
  sub(/^ +[0-9]+ [0-9]+ /, "")
  i = ++field_count[type]
  field[type, i] = "\"offset\": " words[1] ", \"size\": " words[2] ", " declared($0)
  declaration[type, i] = $0
  next
}
/ = / { constant[++constant_count] = $0 }

function text(value) {
  gsub(/[\\"]/, "\\\\&", value)
  return "\"" value "\""
}
# name and type of a declaration "const char* name"
function typed(it,   at) {
  match(it, /[A-Za-z0-9_]+(\[[^\]]*\])?$/)
  at = RSTART
  return "\"name\": " text(substr(it, at)) ", \"type\": " text(substr(it, 1, at - 2))
}
# the same of a field, which may be a function
function declared(it,   name, count, parts, i, out) {
  name = name_of(it)
  if (it !~ /\(\*/) return typed(it)
  match(it, /\(\*[a-z0-9_]+\)/)
  out = "\"name\": " text(name) ", \"type\": \"function\", \"returns\": " text(substr(it, 1, RSTART - 2))
  out = out ", \"thread\": " text(thread[type "." name]) ", \"arguments\": ["
  it = substr(it, RSTART + RLENGTH + 1)
  sub(/\)$/, "", it)
  count = it == "void" ? 0 : split(it, parts, /, /)
  for (i = 1; i <= count; ++i) out = out (i > 1 ? ", " : "") "{" typed(parts[i]) "}"
  return out "]"
}
function name_of(it) {
  if (match(it, /\(\*[a-z0-9_]+\)/)) return substr(it, RSTART + 2, RLENGTH - 3)
  match(it, /[A-Za-z0-9_]+(\[[^\]]*\])?$/)
  return substr(it, RSTART)
}
function kind_of(it) {
  if (declaration[it, 1] == "uint32_t struct_size") return "growable"
  return comment[it] ~ /Array element/ ? "element" : "value"
}
function described(name) {
  if (!(name in since)) {
    print "the headers have no " name ", the layout has: is v1.txt up to date?" >"/dev/stderr"
    failed = 1
  }
  return "\"since\": " since[name] ", \"comment\": \"" comment[name] "\""
}
# Prints what the struct needs, then the struct.
function print_struct(it,   i, rest, needed, name) {
  if (it in begun) return
  begun[it] = 1
  for (i = 1; i <= field_count[it]; ++i) {
    rest = declaration[it, i]
    while (match(rest, /dmrp_[a-z0-9_]+/)) {
      needed = substr(rest, RSTART, RLENGTH)
      rest = substr(rest, RSTART + RLENGTH)
      if (needed in size) print_struct(needed)
      else if (needed in header_of) opaque[needed] = 1
    }
  }
  printf "%s\n    {\"name\": %s, \"kind\": \"%s\", \"header\": \"%s\", \"size\": %s, %s, \"fields\": [", separator,
    text(it), kind_of(it), header_of[it], size[it], described(it)
  for (i = 1; i <= field_count[it]; ++i) {
    name = name_of(declaration[it, i])
    sub(/\[.*/, "", name)
    printf "%s\n      {%s, %s}", (i > 1 ? "," : ""), field[it, i], described(it "." name)
  }
  printf "]}"
  separator = ","
}
# A number in decimal, or a text, and its type.
function valued(value) {
  if (value ~ /^"/) return "\"value\": " value ", \"type\": \"text\""
  gsub(/[()]/, "", value)
  kind = sub(/u$/, "", value) ? "uint32_t" : "int32_t"
  return "\"value\": " (value ~ /^0x/ ? hexadecimal(value) : value) ", \"type\": \"" kind "\""
}
function hexadecimal(value,   i, number) {
  value = tolower(value)
  for (i = 3; i <= length(value); ++i) number = 16 * number + index("0123456789abcdef", substr(value, i, 1)) - 1
  return sprintf("%.0f", number)
}
END {
  printf "{\n  \"headers\": ["
  for (i = 1; i <= header_count; ++i)
    printf "%s\n    {\"name\": \"%s\", \"comment\": \"%s\"}", (i > 1 ? "," : ""), headers[i], header_text[headers[i]]
  printf "\n  ],\n  \"structs\": ["
  for (i = 1; i <= type_count; ++i) print_struct(types[i])
  printf "\n  ],\n  \"opaque\": ["
  separator = ""
  for (name in opaque) {
    printf "%s\n    {\"name\": \"%s\", %s}", separator, name, described(name)
    separator = ","
  }
  printf "\n  ],\n  \"constants\": {"
  for (i = 1; i <= constant_count; ++i) {
    name = substr(constant[i], 1, index(constant[i], " ") - 1)
    printf "%s\n    \"%s\": {%s, \"header\": \"%s\", %s, \"group\": \"%s\"}", (i > 1 ? "," : ""), name,
      valued(substr(constant[i], index(constant[i], " = ") + 3)), header_of[name], described(name), group[name]
  }
  print "\n  }\n}"
  exit failed
}
