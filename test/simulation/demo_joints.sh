#!/bin/bash
# demo_joints.sh SCRIPTS: robots made by others move by recorded joints. The demo meets the workpiece with the link that it
# should, and loses no state; and refuses what does not fit.
set -euo pipefail
# shellcheck source-path=SCRIPTDIR/../../scripts
. "$1/processes.bash"
here=$(dirname "$(readlink -f "$0")")
data=${SWEEP_GUARD_DATA:-$1/../../shared/data}
[[ -e $data/urdf/expanded ]] || { echo "SKIPPED: $data/urdf/expanded is missing: it is no part of the repository; SWEEP_GUARD_DATA names the folder of such inputs" && exit 77; }
data=$(realpath "$data")
export ROS_IP=127.0.0.1 ROS_PACKAGE_PATH=$ROS_PACKAGE_PATH:$data/urdf
folder=$(mktemp -d)
export ROS_HOME=$folder
trap 'clean_up; rm -rf "$folder"' EXIT

# wrong LOG WHAT...
wrong() {
  echo "${*:2}:" && cat "$1"
  exit 1
}

# launch_demo LOG SCENE ARGUMENT... - at a master of its own
launch_demo() {
  local log=$1 scene=$2
  shift 2
  choose_master
  start timeout 200 roslaunch -p "$port" sweep_guard demo.launch rviz:=false "tool_urdf:=$folder/$scene.urdf" \
    "joints:=$folder/$scene.bag" "$@" >"$log" 2>&1
  launch=$!
}

# play NAME SCENE LINKS ARGUMENT... - begins a demo of it, in which these links touch: a pattern, separated by blanks
names=()
declare -A launches expected
play() {
  names+=("$1")
  expected[$1]=$3
  launch_demo "$folder/$1.log" "$2" loop:=false duration:=6 "${@:4}"
  launches[$1]=$launch
}

# all_meet - when those that were begun have ended, what touched is what was expected
all_meet() {
  local name log touched
  for name in "${names[@]}"; do
    log=$folder/$name.log
    wait "${launches[$name]}" || wrong "$log" "$name did not end"
    sed -n '/^poses in/,/^poses lost/p' "$log" | sed "s/^/$name: /"
    grep -q '^poses in  *401$' "$log" || wrong "$log" "$name: not every state came"
    grep -q '^poses lost  *0$' "$log" || wrong "$log" "$name: states were lost"
    touched=$(sed -n 's/^  of \([^ ]*\) .*/\1/p' "$log" | xargs)
    # shellcheck disable=SC2053  # a pattern
    [[ $touched == ${expected[$name]} ]] || wrong "$log" "$name: '$touched' touched, not '${expected[$name]}'"
  done
  names=()
}

# refuses WHAT SCENE - the line that says so
refuses() {
  local log=$folder/refused.log
  launch_demo "$log" "$2"
  start timeout 100 grep -qm1 'process has died' <(tail -n +1 -f --pid="$launch" "$log")
  wait $! || wrong "$log" "$2 was not refused"
  end "$launch"
  grep -qF "$1" "$log" || wrong "$log" "it does not say '$1'"
  echo "refused: $1"
}

python3 "$here/joint_bags.py" "$data" "$folder"
panda_links=panda_link5,panda_link6,panda_link7,panda_hand,panda_leftfinger,panda_rightfinger
elbow_place=(size:=0.2 "place:=[0.068,0.394,0.363]")

# The workpiece is where the last link meets it.
play ur5 ur5 '*wrist_3_link*'
play panda panda '*panda_leftfinger*' "tool_links:=$panda_links"
all_meet
play psm psm '*PSM1_jaw_1_link*' "tool_links:=PSM1_housing_link,PSM1_roll_link,PSM1_jaw_1_link,PSM1_jaw_2_link"

# The tube of a torus is between the fingers, nearer to the right one, which closes on it.
play jaws jaws panda_rightfinger "mesh:=$data/mesh/sofa_torus.obj" size:=0.2 "place:=[0,-0.008,0.165]" \
  tool_links:=panda_hand,panda_leftfinger,panda_rightfinger

# The arm turns, and its elbow meets what the last link passes by.
all_meet
play elbow elbow 'forearm_link upper_arm_link' "${elbow_place[@]}"
play 'wrist alone' elbow '' "${elbow_place[@]}" tool_links:=wrist_3_link
all_meet

refuses 'choose one topic (joints_topic:=TOPIC); there are: /joint_states, /other/joint_states' two_topics
refuses 'no sensor_msgs/JointState in the bag' no_joints
refuses "it has no position of 'shoulder_lift_joint', 'elbow_joint'" few_joints
