#!/bin/bash
# demo_recording.sh SCRIPTS: a contact in the demo leaves a recording, and the report of its replay has that contact.
set -euo pipefail
# shellcheck source-path=SCRIPTDIR/../simulation
. "$(dirname "$0")/../simulation/run_demo.bash"

run demo.launch rviz:=false black_box:=true duration:=10
recordings=("$ROS_HOME"/sweep_guard/black_box/black_box_*_contact.bag)
[[ -e ${recordings[0]} ]] || wrong 'nothing was recorded'
run replay.launch "bag:=${recordings[0]}"
contacts=${recordings[0]}.report/contacts.csv
grep -q '^1,.*,workpiece,' "$contacts" || { echo 'the report has no contact:' && cat "$contacts" "$ROS_HOME/output" && exit 1; }
