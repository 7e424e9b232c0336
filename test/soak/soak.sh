#!/bin/bash
# soak.sh PYTHON DEVEL_SPACE LOGS: a short soak of the guard in this devel space.
set -euo pipefail
set +u
# shellcheck source=/dev/null
. "$2/setup.bash"
set -u
export ROS_IP=127.0.0.1 PYTHONDONTWRITEBYTECODE=1
unset ROS_HOSTNAME ROS_IPV6
exec "$1" "$(dirname "$0")/soak.py" --folder "$3" --seconds 30 --period 15 --gap 1.2 --seed 5
