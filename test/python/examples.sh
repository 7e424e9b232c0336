#!/bin/bash
# examples.sh SCRIPTS devel DEVEL_SPACE | examples.sh SCRIPTS install BUILD PREFIX: the package in this devel space, or as it is
# installed from this build, runs the examples of doc/connect.md without anything of another space.
set -euo pipefail
# shellcheck source-path=SCRIPTDIR/../../scripts
. "$1/processes.bash"
export ROS_IP=127.0.0.1 PYTHONDONTWRITEBYTECODE=1
patience=60  # [s]
output='' status=0

files=$(mktemp -d)
trap 'clean_up; rm -rf "$files"' EXIT
fail() { echo "$*" && exit 1; }

if [[ $2 == devel ]]; then
  space=$3
else  # what Python installs goes to the configured prefix, whatever cmake --install is told; DESTDIR moves all
  DESTDIR=$files cmake --install "$3" >"$files/log" 2>&1 || fail "$(cat "$files/log")"
  space=$files$4
fi

unset PYTHONPATH LD_LIBRARY_PATH PKG_CONFIG_PATH CMAKE_PREFIX_PATH ROS_PACKAGE_PATH
set +u
# shellcheck source=/dev/null
. "$space/setup.bash"
set -u

imported=$(python3 -c 'import sweep_guard, sweep_guard.msg, sweep_guard.srv; print(sweep_guard.MeshPublisher and sweep_guard.__file__)')
[[ $imported == "$space"/* ]] || fail "imports $imported, not what is in $space"

choose_master
echo '{timing: {mesh_timeout: 60.0, pose_timeout: 1.0, min_rate: 1.0}, check_sweep: {deadline: 60.0}}' >"$files/config.yaml"
start roslaunch -p "$port" sweep_guard sweep_guard.launch config:="$files/config.yaml" respawn:=false >/dev/null
start rosrun sweep_guard publish_mesh.py >/dev/null

check_path() {
  status=0
  output=$(timeout $((2 * patience)) rosrun sweep_guard check_path.py --deadline $patience "$@" 2>&1) || status=$?
}
# expect STATUS TEXT ARGUMENT... - what check_path.py ends with, once the guard knows the sheet
expect() {
  check_path "${@:3}"
  while [[ $output == *'no workpiece yet'* ]] && ((SECONDS < patience)); do check_path "${@:3}"; done
  [[ $status == "$1" && $output == *"$2"* ]] || fail "expected status $1 and '$2' of ${*:3}: status $status, $output"
}

expect 1 'meets sheet: '
expect 0 'free' --to 0 0 0.4
expect 2 'not known: not clear within 0.5 s: ' --to 0 0 0.4 --wait-for-clear 0.5
start rostopic pub -s -r 50 /tool_pose geometry_msgs/PoseStamped \
  '{header: {stamp: now, frame_id: world}, pose: {position: {z: 0.5}, orientation: {x: 1.0}}}' >/dev/null
expect 0 'free' --to 0 0 0.4 --wait-for-clear $patience
