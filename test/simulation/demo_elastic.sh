#!/bin/bash
# demo_elastic.sh SCRIPTS: tool, force, deformation and guard close the loop: the guard measures a force at a workpiece that
# gives way to the tool, and loses no pose.
set -euo pipefail
# shellcheck source-path=SCRIPTDIR
. "$(dirname "$0")/run_demo.bash"

# between NAME LEAST MOST - a line of the summary
between() {
  local value
  value=$(sed -n "s/^$1  *\([0-9.]*\)$/\1/p" "$ROS_HOME/output")
  echo "${1//\\/}: $value"
  awk -v value="$value" -v least="$2" -v most="$3" 'BEGIN { exit !(value != "" && value >= least && value <= most) }' ||
    wrong "$1 is not in [$2, $3]"
}

run demo.launch rviz:=false elastic:=true loop:=false duration:=6
between 'poses lost' 0 0
between 'largest dent \[mm\]' 5 20  # the tool goes 10 mm deep
between 'largest force \[N\]' 0.2 10
