# SPDX-License-Identifier: MIT
# links.awk FILE.md...: prints what the files refer to and what they offer, a line each, separated by tabs:
#   link    FILE  LINE  TARGET   a link, an image or a link definition, outside code
#   path    FILE  LINE  TEXT     text in backticks with a slash in it
#   anchor  FILE  LINE  ANCHOR   a heading, by the anchor that GitHub gives it

function emit(kind, text) { print kind "\t" FILENAME "\t" FNR "\t" text }

# The heading in lower case, without punctuation, with hyphens for spaces; the second of the same name gets "-1".
function heading_anchor(text) {
  while (match(text, /\]\([^)]*\)/)) text = substr(text, 1, RSTART) substr(text, RSTART + RLENGTH)
  text = tolower(text)
  gsub(/[!-,.\/:-@[-^`{-~]/, "", text)
  gsub(/ /, "-", text)
  return seen[text]++ ? text "-" (seen[text] - 1) : text
}

# Emits the code spans of the line and returns the line without them.
function without_code(line,   rest, ticks, close_at) {
  rest = ""
  while (match(line, /`+/)) {
    ticks = substr(line, RSTART, RLENGTH)
    rest = rest substr(line, 1, RSTART - 1)
    line = substr(line, RSTART + RLENGTH)
    close_at = index(line, ticks)
    if (!close_at) return rest ticks line
    if (substr(line, 1, close_at - 1) ~ /\//) emit("path", substr(line, 1, close_at - 1))
    line = substr(line, close_at + length(ticks))
    rest = rest "code"
  }
  return rest line
}

function emit_links(line,   target) {
  if (match(line, /^ *\[[^]]+\]: +[^ ]+/)) {
    target = substr(line, RSTART, RLENGTH)
    sub(/^ *\[[^]]+\]: +/, "", target)
    emit("link", target)
  }
  while (match(line, /\]\([^) ]+/) || match(line, /(src|href)="[^"]+/)) {
    target = substr(line, RSTART, RLENGTH)
    line = substr(line, RSTART + RLENGTH)
    sub(/^\]\(|^(src|href)="/, "", target)
    emit("link", target)
  }
}

FNR == 1 { fenced = 0; split("", seen) }
/^ *(```|~~~)/ { fenced = !fenced; next }
fenced { next }
/^#+ / { heading = $0; sub(/^#+ +/, "", heading); sub(/ +#* *$/, "", heading); emit("anchor", heading_anchor(heading)) }
{ emit_links(without_code($0)) }
