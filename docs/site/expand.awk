# SPDX-License-Identifier: MIT
# expand.awk -v root=SOURCE_DIR PAGE.md: replaces a line that ends with `<!-- source: FILE NAME -->` (before it stands a
# link, for those who read the Markdown) by the function NAME of FILE, with the comments above it, as code. Fails where
# there is no such function.
function source(file, name,   line, held, indent, inside, found, out, at) {
  while ((getline line < (root "/" file)) > 0) {
    if (!inside && line ~ ("^[ ]*[A-Za-z].*[ :*&>]" name "\\(.*") && line !~ /;$/ && line !~ /^ *(return|if|for)/) {
      inside = found = 1
      match(line, /[^ ]/)
      indent = RSTART - 1
      out = held
    }
    if (inside) {
      out = out substr(line, indent + 1) "\n"
      at = substr(line, 1, indent + 1)
      if (line ~ /\{.*\}$/ || (substr(line, indent + 1) == "}")) break
      continue
    }
    held = line ~ /^ *\/\// ? held without_indent(line) "\n" : ""
  }
  close(root "/" file)
  if (!found) {
    print FILENAME ":" FNR ": there is no function " name " in " file > "/dev/stderr"
    failed = 1
  }
  return out
}
function without_indent(line) { sub(/^ +/, "", line); return line }
/<!-- source: .* -->$/ {
  printf "```cpp\n%s```\n", source($(NF - 2), $(NF - 1))
  next
}
{ print }
END { exit failed }
