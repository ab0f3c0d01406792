# SPDX-License-Identifier: MIT
# Prints each breach of what is frozen. Called with two layouts and two descriptions (layout.sh, describe.awk):
#   awk -f superset.awk part=frozen_layout A part=layout B part=frozen_described C part=described D
function breach(text) { print text }

part ~ /layout$/ && /^[a-z]/ {
  type = $1
  size[part, type] = $2
  if (part == "frozen_layout") frozen_types[++frozen_type_count] = type
  next
}
part ~ /layout$/ && /^ / {
  $1 = $1
  i = ++fields[part, type]
  field[part, type, i] = $0
  next
}
part ~ /layout$/ && / = / {
  value = $0
  sub(/^[^=]* = /, "", value)
  constant[part, $1] = value
  if (part == "frozen_layout") frozen_constants[++frozen_constant_count] = $1
  next
}
part ~ /described$/ {
  split($0, column, "\t")
  known[part, column[1]] = 1
  if (part == "frozen_described") frozen_names[column[1]] = 1
  else since[column[1]] = column[3]
}

# "8 4 uint32_t reserved" may get a name, and with it a meaning in which zero is as before.
function is_kept(frozen, now) {
  if (frozen == now) return 1
  if (frozen !~ / reserved$/) return 0
  sub(/ reserved$/, "", frozen)
  sub(/ [a-z0-9_]+$/, "", now)
  return frozen == now
}
function name_of(it) {
  if (match(it, /\(\*[a-z0-9_]+\)/)) return substr(it, RSTART + 2, RLENGTH - 3)
  sub(/\[.*/, "", it)
  sub(/.* /, "", it)
  return it
}
function check_struct(it,   i, before, now, count) {
  if (!(("layout", it) in size)) return breach(it " is gone")
  count = fields["frozen_layout", it]
  for (i = 1; i <= count; ++i) {
    before = field["frozen_layout", it, i]
    now = field["layout", it, i]
    if (now == "") breach(it "." name_of(before) " is gone")
    else if (!is_kept(before, now)) breach(it ": '" before "' has become '" now "'")
    if (!is_kept(before, now)) return
  }
  if (fields["layout", it] == count) return
  if (is_value(it)) return breach(it " is a value, and has grown")
  for (i = count + 1; i <= fields["layout", it]; ++i) check_new(it "." name_of(field["layout", it, i]))
}
# Values are embedded, so that they never grow.
function is_value(it) { return it ~ /^dmrp_(vec2|pose|twist|segment)$/ }
function check_new(name) {
  if (since[name] == 0) breach(name " is new, and not in #if DMRP_TARGET_MINOR >= n")
  else if (since[name] + 0 > constant["layout", "DMRP_ABI_MINOR"] + 0) breach(name " is newer than DMRP_ABI_MINOR")
}
END {
  for (i = 1; i <= frozen_type_count; ++i) check_struct(frozen_types[i])
  for (i = 1; i <= frozen_constant_count; ++i) {
    name = frozen_constants[i]
    if (!(("layout", name) in constant)) {
      breach(name " is gone")
    } else if (name == "DMRP_ABI_MINOR") {
      if (constant["layout", name] + 0 < constant["frozen_layout", name] + 0) breach(name " has become smaller")
    } else if (constant["layout", name] != constant["frozen_layout", name]) {
      breach(name " was " constant["frozen_layout", name] " and is " constant["layout", name])
    }
  }
  for (name in frozen_names)
    if (!(("described", name) in known) && !(("frozen_layout", name) in constant) && name !~ /\./) breach(name " is gone")
  for (key in constant) {
    split(key, half, SUBSEP)
    if (half[1] == "layout" && !(("frozen_layout", half[2]) in constant)) check_new(half[2])
  }
  for (key in size) {
    split(key, half, SUBSEP)
    if (half[1] == "layout" && !(("frozen_layout", half[2]) in size)) check_new(half[2])
  }
}
