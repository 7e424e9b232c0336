#!/bin/bash
# setup.sh SOURCE: scripts/setup.bash asks each system for what is missing there, by the names that it has there, and elsewhere
# says what is needed and goes on as far as there are commands. It enters the ROS that is in /opt.
set -euo pipefail
source=$1

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cat >"$folder/installs" <<'END'
. "$1/scripts/setup.bash"
dpkg-query() { printf 'installed %s\n' cmake g++ rviz; }  # what is said to be here
as_root() { echo "as root: $*" >&2 && [[ -z ${refuses:-} || $* != *install* ]]; }
[[ -z ${without:-} ]] || command() { [[ ${*: -1} != "$without" ]] && builtin command "$@"; }
install_listed packages-node.txt packages-rviz.txt
END

status=0
# expect STATUS WITH|WITHOUT TEXT SYSTEM - the variables that are set go on to the script
expect() {
  local result=0 has=0
  echo "ID=${4% *} VERSION_ID=\"${4#* }\"" | tr ' ' '\n' >"$folder/os-release"
  SWEEP_GUARD_OS_RELEASE=$folder/os-release SWEEP_GUARD_ROS_FOLDER=$folder/opt \
    bash -e "$folder/installs" "$source" >"$folder/output" 2>&1 || result=$?
  grep -qE -- "$3" "$folder/output" || has=1
  [[ $result == "$1" && $has == "$([[ $2 == WITH ]] && echo 0 || echo 1)" ]] && return
  echo "$4: wants status $1, $2 '$3', but has $result:" && cat "$folder/output" && status=1
}

# has_ros NAME - from here on there is one more ROS
has_ros() {
  mkdir -p "$folder/opt/$1"
  echo "echo entered $folder/opt/$1" >"$folder/opt/$1/setup.bash"
}

for system in 'debian 11' 'debian 12' 'debian 13'; do
  expect 0 WITH '^as root: .* install .* libassimp-dev .*libroscpp-dev' "$system"
  expect 0 WITHOUT ' install .*(ros-noetic|cmake|rviz |g\+\+)' "$system"
done
expect 0 WITH ' install .* qtbase5-dev' 'debian 12'
expect 0 WITH ' install .* qt6-base-dev' 'debian 13'  # as its rviz
expect 0 WITH '^as root: .* install .* libassimp-dev .*ros-noetic-roscpp' 'ubuntu 20.04'
expect 0 WITH ' install .*ros-noetic-rviz ' 'ubuntu 20.04'
expect 0 WITHOUT ' install .*(libroscpp-dev|ros-noetic-roscpp .*ros-noetic-roscpp )' 'ubuntu 20.04'
refuses=1 expect 1 WITH 'ros-noetic-\*.* the package source of ROS' 'ubuntu 20.04'
refuses=1 expect 1 WITHOUT 'the package source of ROS' 'debian 12'
expect 0 WITH '^-- this is fedora 40: .* libassimp-dev .*libroscpp-dev' 'fedora 40'
expect 0 WITHOUT '^as root' 'fedora 40'
without=ninja expect 1 WITH 'there is no ninja' 'fedora 40'

has_ros noetic
expect 0 WITH '^entered .*/opt/noetic$' 'ubuntu 20.04'
expect 0 WITH '^as root: .* ros-noetic-roscpp' 'ubuntu 20.04'
expect 0 WITHOUT '^entered' 'debian 12'  # its own is in /usr
for system in 'ubuntu 22.04' 'ubuntu 24.04' 'fedora 40'; do  # somebody has built it, and knows how
  expect 0 WITH '^entered .*/opt/noetic$' "$system"
  expect 0 WITHOUT '^as root' "$system"
done

has_ros one
for system in 'ubuntu 22.04' 'ubuntu 24.04'; do
  expect 0 WITH '^entered .*/opt/one$' "$system"
  expect 0 WITH '^as root: .* install .* libassimp-dev .*ros-one-roscpp .*ros-one-rviz ' "$system"
  expect 0 WITHOUT ' install .*(ros-noetic|libroscpp-dev)' "$system"
  refuses=1 expect 1 WITH 'ros-one-\*.* the package source of ROS: .*/ros-o$' "$system"
done
expect 0 WITH '^entered .*/opt/one$' 'fedora 40'
expect 0 WITHOUT '^entered' 'debian 12'
expect 0 WITH '^as root: .* libroscpp-dev' 'debian 12'

# What other systems have other names for is on the lists, and only once.
lists=$(cat "$source"/scripts/packages-{node,tools,rviz,test}.txt)
for others in packages-ubuntu.txt packages-trixie.txt; do
  while read -r name _; do
    grep -qxF -- "$name" <<<"$lists" || { echo "$others: $name is on no list" && status=1; }
  done < <(grep -v '^#' "$source/scripts/$others")
  twice=$(grep -v '^#' "$source/scripts/$others" | cut -d' ' -f1 | sort | uniq -d)
  [[ -z $twice ]] || { echo "$others: twice: $twice" && status=1; }
done
# Each package of ROS has another name there: those whose name in Debian says that they are.
while read -r name; do
  grep -q "^$name " "$source/scripts/packages-ubuntu.txt" || { echo "packages-ubuntu.txt: no name for $name" && status=1; }
done < <(grep -E '^[^#]*(ros|-msgs|tf2|nodelet|srvs|rviz|catkin$|pluginlib|topic-tools|reconfigure|updater|markers|urdf-)' <<<"$lists")
if grep -vE '^#|^[^ ]+ ros-noetic-[a-z0-9-]+$' "$source/scripts/packages-ubuntu.txt"; then
  echo "packages-ubuntu.txt: these are no names of ROS" && status=1
fi
exit $status
