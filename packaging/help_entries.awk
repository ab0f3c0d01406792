# SPDX-License-Identifier: MIT
# help_entries.awk -v command=NAME: reads what `dmrp-host NAME --help` prints (NAME "" for the program), and prints its
# entries, with tabs between the fields:
#   about       COMMAND  TEXT               the first line
#   usage       COMMAND  TEXT
#   positional  COMMAND  NAMES     TEXT     "folder DIR REQUIRED"
#   option      COMMAND  NAMES     TEXT     "--id ID REQUIRED"
#   command     COMMAND  NAME      TEXT
#   example     COMMAND  LINE
function finish() {
  # no space to spare before the text, which begins in a fixed column
  if (names != "" && text == "" && length(names) > text_column) {
    text = substr(names, text_column + 1)
    names = substr(names, 1, text_column - 1)
  }
  if (names != "") print kind "\t" command "\t" names "\t" text
  names = text = ""
}
BEGIN { text_column = 28 }
NR == 1 { print "about\t" command "\t" $0; next }
/^Usage: / { print "usage\t" command "\t" substr($0, 8); next }
/^Positionals:/ { finish(); kind = "positional"; next }
/^ *Options:/ { finish(); kind = "option"; next }
/^Subcommands:/ { finish(); kind = "command"; next }
/^Example:/ { finish(); kind = "example"; next }
/^  / && kind == "example" { print kind "\t" command "\t" substr($0, 3); next }
# an entry: indented by two, or by four in a group of options; its text follows after two spaces or on the next line
/^ +[^ \[]/ && kind != "" {
  indent = match($0, /[^ ]/) - 1
  line = substr($0, indent + 1)
  if (indent > 8) {
    text = text (text == "" ? "" : " ") line
    next
  }
  finish()
  names = line
  if (match(line, /  +/)) {
    names = substr(line, 1, RSTART - 1)
    text = substr(line, RSTART + RLENGTH)
  }
  next
}
/^$/ || /^[^ ]/ { finish(); kind = "" }
END { finish() }
