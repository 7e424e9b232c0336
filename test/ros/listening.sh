#!/bin/bash
# listening.sh SCRIPTS: the demo listens on the loopback interface alone, except for programs of others: each roscpp node has a
# server that listens everywhere, which only our nodes keep to the loopback.
set -euo pipefail
# shellcheck source-path=SCRIPTDIR/../../scripts
. "$1/processes.bash"
export ROS_IP=127.0.0.1
choose_master

start roslaunch -p "$port" sweep_guard demo.launch rviz:=false >/dev/null 2>&1
launch=$!
answers() { rosservice call --wait /sweep_guard/enable true >/dev/null 2>&1; }
timeout 60 bash -c "$(declare -f answers); until answers; do :; done" || { echo 'the demo does not start' && exit 1; }

sockets=$(ss --tcp --listening --numeric --processes --no-header | grep -E "pid=($(pgrep -d '|' -P "$launch"))," || true)
elsewhere=$(awk '$4 !~ /^(127\.|\[::1\])/ && $4 !~ /%lo:/' <<<"$sockets")

for program in sweep_guard_nod operator deformable_work; do
  grep -q "\"$program\"" <<<"$sockets" || { echo "$program does not listen at all: $sockets" && exit 1; }
done
others=$(grep -v '"rosout"' <<<"$elsewhere" || true)
[[ -z $others ]] || { echo "these listen to other hosts: $others" && exit 1; }
