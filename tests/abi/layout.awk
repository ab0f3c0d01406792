# SPDX-License-Identifier: MIT
# Reads the C headers, writes a C program that prints offset, size and declaration of every struct's fields and the
# value of every constant. A struct whose fields do not add up to its size stops the program: none can be forgotten.

function statement(text) { print "  " text }

/^typedef struct [a-z0-9_]+ \{/ || /^struct [a-z0-9_]+ \{/ {
  type = $1 == "typedef" ? $3 : $2
  kind = $1 == "typedef" ? type : "struct " type
  statement("printf(\"\\n%s %zu\\n\", \"" type "\", sizeof(" kind "));")
  statement("bytes = 0;")
  declaration = ""
  next
}
type != "" && /^}/ {
  statement("complete(\"" type "\", sizeof(" kind "), bytes);")
  type = ""
  next
}
type != "" && /^#/ { next }  # around fields of a later minor version
type != "" {
  sub(/\/\/.*/, "")
  declaration = declaration " " $0
  if (declaration !~ /;[ ]*$/) next
  sub(/^ +/, "", declaration)
  if (match(declaration, /\(\*[a-z0-9_]+\)/)) {
    field = substr(declaration, RSTART + 2, RLENGTH - 3)
  } else if (declaration !~ /,/ && match(declaration, /[a-z0-9_]+(\[[^\]]*\])?[ ]*;/)) {
    field = substr(declaration, RSTART, RLENGTH)
    sub(/[\[; ].*/, "", field)
  } else {
    print "#error \"no field found in: " declaration "\""
    field = ""
  }
  gsub(/ +/, " ", declaration)
  sub(/ ?; *$/, "", declaration)
  if (field != "") {
    statement("print_field(\"" declaration "\", offsetof(" kind ", " field "), sizeof(((" kind "*)0)->" field "));")
    statement("bytes += sizeof(((" kind "*)0)->" field ");")
  }
  declaration = ""
}
/^#define DMRP_[A-Z0-9_]+ +["0-9(]/ { constants[++constant_count] = $2 }

BEGIN {
  print "#include <dmrp/dmrp.h>\n#include <stdio.h>\n#include <stdlib.h>"
  print "#define TEXT_OF(x) #x\n#define VALUE_OF(x) TEXT_OF(x)"
  print "static void print_field(const char* declaration, size_t offset, size_t size) {"
  print "  printf(\"  %zu %zu %s\\n\", offset, size, declaration);\n}"
  print "static void complete(const char* type, size_t size, size_t bytes) {"
  print "  if (size == bytes) return;"
  print "  fprintf(stderr, \"the fields of %s have %zu bytes, it has %zu\\n\", type, bytes, size);\n  exit(1);\n}"
  print "int main(void) {\n  size_t bytes = 0;"
  statement("printf(\"# The layout of ABI v1: TYPE SIZE, then OFFSET SIZE FIELD; then the constants.\\n\");")
}
END {
  statement("printf(\"\\n\");")
  for (i = 1; i <= constant_count; ++i)
    statement("printf(\"%s = %s\\n\", \"" constants[i] "\", VALUE_OF(" constants[i] "));")
  print "  return 0;\n}"
}
