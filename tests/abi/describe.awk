# SPDX-License-Identifier: MIT
# Reads the C headers, prints a line for each struct, field, constant, macro and text of its own:
#
#   NAME <tab> HEADER <tab> SINCE <tab> THREAD <tab> COMMENT <tab> GROUP
#
# NAME: dmrp_robot, dmrp_robot.goals, DMRP_OK, or the header itself. SINCE: the minor version, n within
# `#if DMRP_TARGET_MINOR >= n`. THREAD: a function's tag. GROUP: the comment above a run of constants. Lines of a
# comment are joined by "\n", as JSON writes it.
function text_of(line) {
  sub(/^ *\/\/ ?/, "", line)
  gsub(/[\\"]/, "\\\\&", line)
  return line
}
function joined(first, second) { return first == "" ? second : second == "" ? first : first "\\n" second }
function emit(name, comment, group) { print name "\t" header "\t" since "\t" thread "\t" comment "\t" group }
# What stands alone belongs to the header.
function flush_above() {
  thread = ""
  if (above != "") emit(header, above, "")
  above = ""
}
# Prints what waits for further lines of its comment.
function flush_item() {
  if (item == "") return
  thread = item_thread
  emit(item, item_comment, item_group)
  item = ""
}
function begin_item(name, comment, group, tag) {
  flush_item()
  item = name
  item_comment = comment
  item_group = group
  item_thread = tag
}
function trailing(line) { return match(line, /[^ ] *\/\/ /) ? text_of(substr(line, RSTART + 1)) : "" }

FNR == 1 {
  flush_item()
  flush_above()
  header = FILENAME
  sub(/.*\/dmrp\//, "", header)
  since = 0
  type = group = function_comment = tag = ""
}
/^\/\* SPDX/ { next }
/^ *$/ {
  flush_item()
  if (type == "") flush_above()
  group = function_comment = tag = ""
  next
}
/^#if DMRP_TARGET_MINOR >= [0-9]+/ { flush_item(); since = $4; next }
/^#else/ || /^#endif/ { flush_item(); since = 0; next }
/^     *\/\// && item != "" { item_comment = joined(item_comment, text_of($0)); next }
/^ *\/\/ *\[(main|step|any)\]$/ { tag = $2; gsub(/[\[\]]/, "", tag); next }
/^ *\/\// { flush_item(); above = joined(above, text_of($0)); next }

/^#define DMRP_[A-Z0-9_]+(\(| |$)/ {
  name = $2
  sub(/\(.*/, "", name)
  if (name ~ /_H$/) next
  if (above != "") group = above
  above = ""
  begin_item(name, trailing($0), group, "")
  next
}
/^typedef struct [a-z0-9_]+ [a-z0-9_]+;/ {
  if (above != "") begin_item($2 == "struct" ? $3 : $2, above, "", "")
  above_of_table = above
  above = ""
  next
}
/^typedef struct [a-z0-9_]+ \{/ || /^struct [a-z0-9_]+ \{/ {
  flush_item()
  type = $1 == "typedef" ? $3 : $2
  thread = ""
  if ($1 == "typedef") emit(type, above, "")
  else if (above_of_table == "") emit(type, "", "")
  above = above_of_table = ""
  next
}
type != "" && /^}/ { flush_item(); type = group = above = function_comment = tag = ""; next }
type != "" {
  flush_item()
  beside = trailing($0)
  line = $0
  sub(/ *\/\/.*/, "", line)
  comment = comment_so_far(beside)
  declaration = declaration line
  if (declaration !~ /; *$/) next
  if (match(declaration, /\(\*[a-z0-9_]+\)/)) {
    field = substr(declaration, RSTART + 2, RLENGTH - 3)
    if (comment != "") function_comment = comment
    begin_item(type "." field, function_comment, "", tag)
  } else {
    match(declaration, /[a-z0-9_]+(\[[^\]]*\])? *; *$/)
    field = substr(declaration, RSTART)
    sub(/[\[; ].*/, "", field)
    begin_item(type "." field, comment, "", "")
  }
  declaration = waiting = ""
  next
}
# Of a declaration that may go over several lines.
function comment_so_far(beside) {
  waiting = joined(joined(waiting, above), beside)
  above = ""
  return waiting
}
END { flush_item(); flush_above() }
