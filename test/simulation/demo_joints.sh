#!/bin/bash
# demo_joints.sh SCRIPTS: robots made by others move by recorded joints. The demo meets the workpiece with the link that it
# should, and loses no state; and refuses what does not fit.
set -euo pipefail
# shellcheck source-path=SCRIPTDIR/../../scripts
. "$1/processes.bash"
here=$(dirname "$(readlink -f "$0")")
data=${SWEEP_GUARD_DATA:-$1/../../shared/data}
[[ -e $data/urdf/expanded ]] || { echo "SKIPPED: $data/urdf/expanded is missing; set SWEEP_GUARD_DATA" && exit 77; }
data=$(realpath "$data")
export ROS_IP=127.0.0.1 ROS_PACKAGE_PATH=$ROS_PACKAGE_PATH:$data/urdf
folder=$(mktemp -d)
export ROS_HOME=$folder
trap 'clean_up; rm -rf "$folder"' EXIT

wrong() {
  echo "$*:" && cat "$folder/output"
  exit 1
}

# play SCENE ARGUMENT... - a demo of it at a master of its own, to its end
play() {
  local scene=$1
  shift
  choose_master
  start timeout 200 roslaunch -p "$port" sweep_guard demo.launch rviz:=false "tool_urdf:=$folder/$scene.urdf" \
    "joints:=$folder/$scene.bag" "$@" >"$folder/output" 2>&1
  wait $! || wrong "$scene did not end"
}

# meets NAME SCENE LINKS_THAT_TOUCH ARGUMENT... - separated by blanks
meets() {
  local name=$1 scene=$2 expected=$3 touched
  shift 3
  play "$scene" loop:=false duration:=6 "$@"
  sed -n '/^poses in/,/^poses lost/p' "$folder/output" | sed "s/^/$name: /"
  grep -q '^poses in  *401$' "$folder/output" || wrong "$name: not every state came"
  grep -q '^poses lost  *0$' "$folder/output" || wrong "$name: states were lost"
  touched=$(sed -n 's/^  of \([^ ]*\) .*/\1/p' "$folder/output" | xargs)
  [[ $touched == "$expected" ]] || wrong "$name: '$touched' touched, not '$expected'"
}

# refuses WHAT SCENE ARGUMENT... - the line that says so
refuses() {
  local what=$1 scene=$2
  shift 2
  choose_master
  start timeout 200 roslaunch -p "$port" sweep_guard demo.launch rviz:=false "tool_urdf:=$folder/$scene.urdf" \
    "joints:=$folder/$scene.bag" "$@" >"$folder/output" 2>&1
  local launch=$!
  start timeout 100 grep -qm1 'process has died' <(tail -n +1 -f --pid="$launch" "$folder/output")
  wait $! || wrong "nothing was refused that should be"
  end "$launch"
  grep -qF "$what" "$folder/output" || wrong "it does not say '$what'"
  echo "refused: $what"
}

for scene in ur5 elbow panda jaws psm; do python3 "$here/joint_bags.py" $scene "$data" "$folder"; done
