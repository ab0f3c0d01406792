#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Writes the manual page and the completions of bash and zsh, all from what `dmrp-host COMMAND --help` prints.
# Called as: manual.sh DMRP_HOST OUT_DIR. Writes OUT_DIR/{dmrp-host.1,dmrp-host.bash,_dmrp-host}.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
host=$1 out=$2
mkdir -p "$out"
export LC_ALL=C

entries=$("$host" --help | awk -v command= -f "$here/help_entries.awk")
mapfile -t commands < <(awk -F'\t' '$1 == "command" { print $3 }' <<<"$entries")
for command in "${commands[@]}"; do
  entries+=$'\n'$("$host" "$command" --help | awk -v command="$command" -f "$here/help_entries.awk")
done

version=$("$host" --version | awk 'NR == 1 { print $2 }')
closing=$("$host" --help | sed -n '/^Exit status/,$p' | tr '\n' ' ')
awk -F'\t' -v version="$version" -v closing="$closing" '
  function roff(text) { gsub(/\\/, "\\\\", text); gsub(/-/, "\\-", text); sub(/^[.'\'']/, "\\\\\\&&", text); return text }
  BEGIN {
    print ".\\\" SPDX-License-Identifier: MIT"
    print ".TH DMRP\\-HOST 1 \"\" \"dmrp " version "\" \"User Commands\"\n.SH NAME"
  }
  $1 == "about" && $2 == "" { print "dmrp\\-host \\- " roff($3) "\n.SH SYNOPSIS"; next }
  $1 == "about" { about[$2] = $3; next }
  $1 == "usage" { in_example = 0 }
  $1 == "usage" && $2 == "" { print ".B " roff($3); section = ".SH OPTIONS"; next }
  $1 == "usage" { print (commands++ ? "" : ".SH COMMANDS\n") ".SS " roff($3) "\n" roff(about[$2]) "."; next }
  $1 == "command" { next }
  $1 == "example" { print (in_example++ ? "" : ".PP\nExample:\n") ".EX\n" roff($3) "\n.EE"; next }
  { in_example = 0 }
  section != "" { print section; section = "" }
  { print ".TP\n.B " roff($3) "\n" roff($4) }
  END { sub(/^Exit status: /, "", closing); print ".SH EXIT STATUS\n" roff(closing) }
' <<<"$entries" >"$out/dmrp-host.1"

# "COMMAND --a --b", a line each; the program itself is "-"
words=$(awk -F'\t' '
  $1 == "about" { name[++count] = $2 == "" ? "-" : $2; next }
  $1 == "option" {
    split($3, parts, " ")
    pieces = split(parts[1], alternatives, ",")
    for (i = 1; i <= pieces; ++i) options[count] = options[count] " " alternatives[i]
  }
  END { for (i = 1; i <= count; ++i) print name[i] options[i] }' <<<"$entries")

{
  echo "# SPDX-License-Identifier: MIT"
  echo "# bash completion of dmrp-host, written from its help."
  echo "_dmrp_host() {"
  echo "  local word=\${COMP_WORDS[COMP_CWORD]} command=\${COMP_WORDS[1]} words="
  echo "  case \$command in"
  awk '$1 != "-" { command = $1; $1 = ""; print "    " command ") words=\"" substr($0, 2) "\" ;;" }' <<<"$words"
  awk '$1 == "-" { $1 = ""; print "    *) words=\"" substr($0, 2) "\" ;;" }' <<<"$words"
  echo "  esac"
  echo "  if ((COMP_CWORD == 1)); then words+=\" ${commands[*]}\"; fi"
  echo "  mapfile -t COMPREPLY < <(compgen -W \"\$words\" -- \"\$word\")"
  echo "}"
  echo "complete -o default -F _dmrp_host dmrp-host"
} >"$out/dmrp-host.bash"

{
  echo "#compdef dmrp-host"
  echo "# SPDX-License-Identifier: MIT"
  echo "# zsh completion of dmrp-host, written from its help."
  echo "local -a commands options"
  awk -F'\t' 'function quoted(text) { gsub(/'\''/, "'\'\\\\\'\''", text); gsub(/:/, "\\:", text); return text }
    $1 == "command" { print "commands+=('\''" $3 ":" quoted($4) "'\'')" }' <<<"$entries"
  echo "if ((CURRENT == 2)); then _describe command commands; fi"
  echo "case \$words[2] in"
  awk -F'\t' 'function quoted(text) { gsub(/'\''/, "'\'\\\\\'\''", text); gsub(/:/, "\\:", text); return text }
    $1 == "about" { if (open++) print "    ;;"; print "  " ($2 == "" ? "-*" : $2) ")" }
    $1 == "option" {
      split($3, parts, " ")
      pieces = split(parts[1], alternatives, ",")
      for (i = 1; i <= pieces; ++i) print "    options+=('\''" alternatives[i] ":" quoted($4) "'\'')"
    }
    END { print "    ;;\nesac" }' <<<"$entries"
  echo "_describe -o option options"
  echo "_files"
} >"$out/_dmrp-host"
