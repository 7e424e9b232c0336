# Shared by tests that run a launch file, which source it: a ROS_HOME of their own, with the output of the last run.
# shellcheck shell=bash source-path=SCRIPTDIR/../../scripts
. "$1/processes.bash"
export ROS_IP=127.0.0.1
ROS_HOME=$(mktemp -d)
export ROS_HOME
trap 'clean_up; rm -rf "$ROS_HOME"' EXIT

wrong() { echo "$*:" && cat "$ROS_HOME/output" && exit 1; }

# run LAUNCH_FILE ARGUMENT... - at a master of its own, to its end
run() {
  choose_master
  start timeout 100 roslaunch -p "$port" sweep_guard "$@" >"$ROS_HOME/output" 2>&1
  wait $! || wrong "$1 did not end well"
}
