#!/bin/bash
# demo_elastic.sh SCRIPTS: tool, force, deformation and guard close the loop: the guard measures a force at a workpiece that
# gives way to the tool, and loses no pose.
set -euo pipefail
# shellcheck source-path=SCRIPTDIR/../../scripts
. "$1/processes.bash"
export ROS_IP=127.0.0.1
ROS_HOME=$(mktemp -d)
export ROS_HOME
trap 'clean_up; rm -rf "$ROS_HOME"' EXIT

wrong() { echo "$*:" && cat "$ROS_HOME/output" && exit 1; }

# between NAME LEAST MOST - a line of the summary
between() {
  local value
  value=$(sed -n "s/^$1  *\([0-9.]*\)$/\1/p" "$ROS_HOME/output")
  echo "${1//\\/}: $value"
  awk -v value="$value" -v least="$2" -v most="$3" 'BEGIN { exit !(value != "" && value >= least && value <= most) }' ||
    wrong "$1 is not in [$2, $3]"
}

choose_master
start timeout 100 roslaunch -p "$port" sweep_guard demo.launch rviz:=false elastic:=true loop:=false duration:=6 \
  >"$ROS_HOME/output" 2>&1
wait $! || wrong 'the demo did not end'
between 'poses lost' 0 0
between 'largest dent \[mm\]' 5 20  # the tool goes 10 mm deep
between 'largest force \[N\]' 0.2 10
