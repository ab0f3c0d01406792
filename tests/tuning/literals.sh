#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# literals.sh: lists the fixed distances, times, angles and speeds of each controller, by their names' units: what a search
# cannot tune. A first column of numbers counts them by controller.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../../plugins/controllers"
for controller in dwa teb mpc e3mop mppi motion; do
  found=$(grep -rnoE 'constexpr [a-z:_0-9]+ [a-z_]+_(m|s|ns|rad|m_s|rad_s) = [^;]+' "$controller" | sed -E 's/constexpr [a-z:_0-9]+ //')
  printf '%s: %s\n' "$controller" "$(wc -l <<<"$found")"
  echo "  ${found//$'\n'/$'\n'  }"
done
