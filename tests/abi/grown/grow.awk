# SPDX-License-Identifier: MIT
# Prints a C header as the next minor version might have it: a field at the end of every struct but values, a function
# at the end of every table, an agent kind, a parameter type, a status, an extension.
# Called as: awk -v minor=N -f grow.awk HEADER, N: the next minor version.
BEGIN { later = "#if DMRP_TARGET_MINOR >= " minor "\n" }

/^#define DMRP_ABI_MINOR / { print "#define DMRP_ABI_MINOR " minor; next }
/^#define DMRP_AGENT_PERSON / { print $0 "\n" later "#define DMRP_AGENT_GROWN 61u  // an animal\n#endif"; next }
/^#define DMRP_PARAM_STRING_ARRAY / { print $0 "\n" later "#define DMRP_PARAM_GROWN 61u  // a colour\n#endif"; next }
/^#define DMRP_FATAL / { print $0 "\n" later "#define DMRP_GROWN_STATUS 31\n#endif"; next }
/^#include "ext\/annotate.h"/ { print $0 "\n#include \"ext/grown.h\""; next }

/^(typedef )?struct [a-z0-9_]+ \{/ {
  type = $1 == "typedef" ? $3 : $2
  is_table = 0
}
type != "" && /\(\*/ { is_table = 1 }
type != "" && /^}/ {
  if (type !~ /^dmrp_(vec2|pose|twist|segment)$/) {
    printf "%s  %s\n#endif\n", later, is_table ? "// [any]\n  void (*grown)(void);" : "double grown;  // absent: 0"
    grown[type] = 1
  }
  type = ""
}
/^DMRP_ASSERT_SIZE\(/ {
  split($0, part, /[(,]/)
  if (part[2] in grown) sub(/\);/, " + 8 * (DMRP_TARGET_MINOR >= " minor "));")
}
{ print }
