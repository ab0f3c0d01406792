# SPDX-License-Identifier: MIT
# Reads a layout (layout.sh), prints where it breaks a rule of abi.h by which structs grow: a struct embeds another one
# that is no value, or points to structs without struct_size and has no stride for them.
FNR == 1 { values = " dmrp_vec2 dmrp_pose dmrp_twist dmrp_segment dmrp_instance " }  # values.h; dmrp_instance is opaque
/^dmrp_/ {
  type = $1
  types[++type_count] = type
  next
}
!/^  [0-9]/ || /\(\*/ { next }  # a constant, or a function
$NF == "struct_size" { sized[type] = 1; next }
$NF ~ /stride$/ { ++strides[type]; next }
match($0, /dmrp_[a-z0-9_]+/) {
  pointed = substr($0, RSTART, RLENGTH)
  if (index(values, " " pointed " ") || type "." $NF == "dmrp_planning_robot.robot") next  # that one: of world.robots
  if (!/\*/) print type "." $NF " embeds " pointed ", which may grow"
  else pointers[type] = pointers[type] " " pointed
}
END {
  for (i = 1; i <= type_count; ++i) {
    unsized = 0
    count = split(pointers[types[i]], all, " ")
    for (k = 1; k <= count; ++k) unsized += !(all[k] in sized)
    if (unsized > strides[types[i]] + 0)
      print types[i] " points to " unsized " arrays of structs without struct_size, with " strides[types[i]] + 0 " strides"
  }
}
