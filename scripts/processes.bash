# Shared by the scripts that start programs in the background: sourced before the first one, it ends them all with the script,
# whatever ends that.
# shellcheck shell=bash disable=SC2317  # takes what a trap calls for unreachable

running=()
trap clean_up EXIT
trap 'exit 130' INT
trap 'exit 143' TERM HUP

# start COMMAND... - in a process group of its own, so that Ctrl-C reaches the script alone; its pid is $!
start() {
  set -m
  "$@" &
  set +m
  running+=($!)
}

# end PID - with its group, as Ctrl-C would, and by force only where that takes longer than roslaunch gives its nodes (17 s)
end() {
  local signal i
  for signal in INT TERM KILL; do
    kill -"$signal" -- "-$1" 2>/dev/null || return 0
    for ((i = 0; i < 1000; ++i)); do
      kill -0 "$1" 2>/dev/null || return 0
      sleep 0.02
    done
  done
}

# The last one first: a master outlives its nodes.
end_all() {
  local i
  for ((i = ${#running[@]} - 1; i >= 0; --i)); do end "${running[i]}"; done
  running=()
}
clean_up() {
  trap '' INT TERM HUP
  end_all
}

# choose_master - a port of its own: whatever else runs here and what is started do not meet
choose_master() {
  port=$(python3 -c 'import socket; s = socket.socket(); s.bind(("127.0.0.1", 0)); print(s.getsockname()[1])')
  export ROS_MASTER_URI=http://127.0.0.1:$port
}
master_listens() { (: <>"/dev/tcp/127.0.0.1/$port") 2>/dev/null; }
