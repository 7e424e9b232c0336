#!/bin/bash
# demo_camera.sh SCRIPTS: the guard of the demo meets the workpiece though it has no mesh, but the images of a depth camera, rendered
# or from a bag; and what cannot be played is refused in words.
set -euo pipefail
here=$(dirname "$(readlink -f "$0")")
# shellcheck source-path=SCRIPTDIR
. "$here/run_demo.bash"

run_demo() { run demo.launch rviz:=false duration:=8 "$@"; }

# at_least NAME LEAST - a line of the summary
at_least() {
  local value
  value=$(sed -n "s/^$1  *\([0-9]*\)$/\1/p" "$ROS_HOME/output")
  echo "$1: $value"
  [[ -n $value && $value -ge $2 ]] || wrong "$1 is not at least $2"
}

# meets ARGUMENT... - the drill reaches the surface within 4 s
meets() {
  run_demo "$@"
  at_least 'depth images' 30
  at_least contacts 10
  grep -q '^poses lost  *0$' "$ROS_HOME/output" || wrong 'poses were lost'
  ! grep -q 'no camera_info' "$ROS_HOME/output" || wrong 'no camera_info came within 1 s'
}

# refuses WORDS COMMAND...
refuses() {
  ! "${@:2}" >"$ROS_HOME/output" 2>&1 || wrong "not refused: ${*:2}"
  grep -qF -- "$1" "$ROS_HOME/output" || wrong "it does not say '$1'"
  echo "refused: $1"
}

# plays_not WORDS ARGUMENT...
plays_not() {
  run_demo "${@:2}"
  grep -qF -- "$1" "$ROS_HOME/output" || wrong "it does not say '$1'"
  echo "refused: $1"
}

bag=$ROS_HOME/depth.bag
python3 "$here/depth_bag.py" "$bag"
meets camera:=true
meets "depth_bag:=$bag"
plays_not ' on /other; there are: /camera/depth/image_rect' "depth_bag:=$bag" depth_topic:=/other
echo 'no bag' >"$ROS_HOME/text.bag"
plays_not "$ROS_HOME/text.bag: " "depth_bag:=$ROS_HOME/text.bag"
refuses '--camera and --depth-bag go with none of --guarded' "$1/demo" --camera --guarded
refuses '--camera renders images' "$1/demo" --camera --depth-bag "$bag"
refuses "there is no readable file $ROS_HOME/none.bag" "$1/demo" --depth-bag "$ROS_HOME/none.bag"
