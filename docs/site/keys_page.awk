# SPDX-License-Identifier: MIT
# keys_page.awk KEYS.txt LISTED: joins the meanings with what `dmrp-host keys FORMAT` listed, as tables in Markdown. A key
# without a meaning goes to standard error, with exit status 1; `used` is a file for the meanings that were used.
FNR == NR {
  if (/^#/ || NF < 3) next
  key = $1 " " $2
  sub(/^[^ ]+ +[^ ]+ +/, "")
  meaning[key] = $0
  next
}
# the name in keys.txt: `[[box]]` is [box], `[robot_type.NAME.lidar]` is robot.lidar
/^\[/ {
  table = substr($0, 2, length($0) - 2)
  sub(/^robot_type.NAME/, "robot", table)
  if (table ~ /^\[(global_planner|local_controller|pedestrian_model|metric)\]$/) table = "plugin"
  print "\n## `" $0 "`\n\n| key | default | values | meaning |\n| --- | --- | --- | --- |"
  next
}
{
  key = table " " $1
  values = index($0, "  # ") ? substr($0, index($0, "  # ") + 4) : ""
  sub(/  # .*/, "")
  default_value = index($0, " = ") ? substr($0, index($0, " = ") + 3) : ""
  if (!(key in meaning)) {
    print "docs/site/keys.txt has no meaning of " key > "/dev/stderr"
    failed = 1
  }
  print key >>used
  gsub(/\|/, "\\|", default_value)
  gsub(/"[a-z_]+"/, "`&`", values)
  print "| `" $1 "` | " (default_value == "" ? "" : "`" default_value "`") " | " values " | " meaning[key] " |"
}
END { exit failed }
