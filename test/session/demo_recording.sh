#!/bin/bash
# demo_recording.sh SCRIPTS: a contact in the demo leaves a recording, and the report of its replay has that contact.
set -euo pipefail
# shellcheck source-path=SCRIPTDIR/../../scripts
. "$1/processes.bash"
export ROS_IP=127.0.0.1
ROS_HOME=$(mktemp -d)
export ROS_HOME
trap 'clean_up; rm -rf "$ROS_HOME"' EXIT

# run LAUNCH_FILE ARGUMENT... - at a master of its own, to its end
run() {
  choose_master
  start timeout 100 roslaunch -p "$port" sweep_guard "$@" >"$ROS_HOME/output" 2>&1
  wait $! || { cat "$ROS_HOME/output" && exit 1; }
}

run demo.launch rviz:=false black_box:=true duration:=10
recordings=("$ROS_HOME"/sweep_guard/black_box/black_box_*_contact.bag)
[[ -e ${recordings[0]} ]] || { echo 'nothing was recorded:' && cat "$ROS_HOME/output" && exit 1; }
run replay.launch "bag:=${recordings[0]}"
contacts=${recordings[0]}.report/contacts.csv
grep -q '^1,.*,workpiece,' "$contacts" || { echo 'the report has no contact:' && cat "$contacts" "$ROS_HOME/output" && exit 1; }
