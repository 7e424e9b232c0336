# Shared by the scripts next to it, which source it: a clean environment, the Debian packages, the build.
# shellcheck shell=bash
set -euo pipefail

root=$(dirname "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")")
build=$root/build
# shellcheck source=/dev/null
system=$(. "${SWEEP_GUARD_OS_RELEASE:-/etc/os-release}" && echo "$ID ${VERSION_ID:-}") || system=  # as in: debian 12
ros=${SWEEP_GUARD_ROS_FOLDER:-/opt/ros}/one  # of ROS-O
[[ -e $ros/setup.bash ]] || ros=${ros%/one}/noetic

say() { echo "-- $*"; }
fail() {
  echo "$(basename "$0"): $*" >&2
  exit "${status:-1}"
}
usage_error() { status=2 fail "$*: see scripts/$(basename "$0") --help"; }

# needs_value OPTION [VALUE] [...] - the rest of the command line
needs_value() { [[ -n ${2:-} ]] || usage_error "$1 needs a value"; }

# needs_seconds OPTION [VALUE] [...] - the value is a number of seconds
needs_seconds() {
  needs_value "$@"
  [[ $2 =~ ^[0-9]+(\.[0-9]+)?$ && $2 =~ [1-9] ]] || usage_error "$1 needs seconds above 0, not $2"
}

# Debian's ROS runs on Debian's python3: one of pyenv or conda in front of it lacks catkin_pkg, ament and rospy. What another
# workspace or installation has put into the environment would be built into build/, so these scripts do without it; to use
# sweep_guard together with other workspaces, build it inside one of them with catkin_make.
clean_environment() {
  export PATH="/usr/sbin:/usr/bin:/sbin:/bin:$PATH"
  unset PYTHONPATH PYTHONHOME LD_LIBRARY_PATH PKG_CONFIG_PATH CMAKE_PREFIX_PATH
  unset ROS_PACKAGE_PATH ROS_ROOT ROS_DISTRO ROS_NAMESPACE ROS_LOG_DIR
  export ROS_HOME="$build/ros"  # logs belong to the build, not to ~/.ros
  export ROS_LANG_DISABLE=genlisp  # nobody here reads messages in Lisp, and each costs a process
  export CCACHE_BASEDIR="$root" CCACHE_NOHASHDIR=1  # the copies of scripts/mutation find what is compiled here
  export CCACHE_SLOPPINESS=${CCACHE_SLOPPINESS:-pch_defines,time_macros}  # else it does without precompiled headers
  # Ninja starts two more by default. On two processors, even one more took an eighth longer: they take the caches from each other.
  export CMAKE_BUILD_PARALLEL_LEVEL=${CMAKE_BUILD_PARALLEL_LEVEL:-$(nproc)}
}

as_root() {
  if [[ $EUID == 0 ]]; then
    "$@"
  elif command -v sudo >/dev/null; then
    sudo -- "$@"
  else
    fail "needs root rights to install: run it as root once, or install sudo"
  fi
}

# missing_packages PACKAGE... - those that are not installed, one per line
missing_packages() {
  comm -23 <(printf '%s\n' "$@" | sort -u) \
    <(command -v dpkg-query >/dev/null && dpkg-query -W -f '${db:Status-Status} ${Package}\n' | sed -n 's/^installed //p' | sort -u)
}

# install_packages PACKAGE... - asks for root rights only where one is missing
install_packages() {
  local missing quiet=() output=/dev/stdout
  mapfile -t missing < <(missing_packages "$@")
  [[ ${#missing[@]} -gt 0 ]] || return 0
  if ! names_here >/dev/null; then
    go_on_without "${missing[@]}"
    return
  fi
  say "installing ${missing[*]}"
  [[ -t 1 ]] || { quiet=(-qq) && output=/dev/null; }
  local apt=(env DEBIAN_FRONTEND=noninteractive apt-get "${quiet[@]}" -o DPkg::Lock::Timeout=300)
  as_root "${apt[@]}" update >$output || say "going on with the package lists that are there"
  as_root "${apt[@]}" install --yes --no-install-recommends "${missing[@]}" >$output || fail_to_install
  enter_ros
}

# go_on_without PACKAGE... - on a system that these scripts do not know: it may have the same in another way
go_on_without() {
  local command
  say "this is ${system:-an unknown system}: install what Debian 12 has in these packages: $*"
  for command in cmake ninja c++ pkg-config python3; do
    command -v $command >/dev/null || fail "there is no $command: install what is listed above"
  done
}

fail_to_install() {
  local where=wiki.ros.org/noetic/Installation/Ubuntu
  [[ $system == ubuntu* ]] || fail "the packages could not be installed"
  [[ $ros != */one ]] || where=github.com/ros-o/ros-o
  fail "the packages could not be installed. Those named ros-${ros##*/}-* need the package source of ROS: see $where"
}

# install_listed FILE... - the packages listed in files of this folder, by their names on this system
install_listed() {
  local packages
  mapfile -t packages < <(cd "$root/scripts" && sed 's/#.*//' "$@" | grep -oE '[^ ]+' | packages_here)
  install_packages "${packages[@]}"
}

# names_here - the file with the names that packages have only on this system; fails where they are unknown
names_here() {
  case "$system, ${ros##*/}" in
    debian\ 1[12],*) echo /dev/null ;;
    debian\ 13,*) echo "$root/scripts/packages-trixie.txt" ;;
    ubuntu\ 20.04,\ noetic | ubuntu\ 2[24].04,\ one) echo "$root/scripts/packages-ubuntu.txt" ;;
    *) return 1 ;;
  esac
}

# packages_here - the names on this system of the Debian packages on standard input
packages_here() {
  local names
  names=$(names_here || echo /dev/null)
  awk -v names="$names" '
    BEGIN { while ((getline line <names) > 0) if (line !~ /^#/) { split(line, pair); here[pair[1]] = pair[2] } }
    { print ($1 in here) ? here[$1] : $1 }' | sed "s/^ros-noetic-/ros-${ros##*/}-/" | sort -u
}

# show_progress - of Ninja: each line on a terminal; elsewhere one line for each twentieth, and whatever else it says
show_progress() {
  local line shown=0
  while IFS= read -r line; do
    if [[ ! $line =~ ^\[([0-9]+)/([0-9]+)\] ]]; then
      echo "$line"
    elif ((20 * BASH_REMATCH[1] / BASH_REMATCH[2] > shown)); then
      shown=$((20 * BASH_REMATCH[1] / BASH_REMATCH[2]))
      say "${BASH_REMATCH[1]} of ${BASH_REMATCH[2]} steps, $SECONDS s"
    fi
  done
}

# build_targets [-DOPTION=VALUE...] TARGET...
build_targets() {
  local options=()
  while [[ $1 == -D* ]]; do options+=("$1") && shift; done
  mkdir -p "$build"
  say "configuring $build"
  cmake -S "$root" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=RelWithDebInfo \
    -DPYTHON_EXECUTABLE=/usr/bin/python3 -DPython3_EXECUTABLE=/usr/bin/python3 \
    -DCMAKE_CXX_COMPILER_LAUNCHER="$(command -v ccache || true)" -DSWEEP_GUARD_WERROR=ON -DSWEEP_GUARD_UNITY=ON "${options[@]}" >"$build/configure.log" 2>&1 || {
    cat "$build/configure.log" >&2
    fail "configuring failed. If something other than these scripts made $build, remove it and try again"
  }
  say "building $*"
  if [[ -t 1 ]]; then
    cmake --build "$build" --target "$@" || fail "the build failed"
  else
    cmake --build "$build" --target "$@" | show_progress || fail "the build failed"
  fi
}

# enter FOLDER - a workspace or an installation of ROS
enter() {
  set +u  # catkin's file reads unset variables
  # shellcheck source=/dev/null
  . "$1/setup.bash"
  set -u
}

enter_workspace() { enter "$build/devel"; }

# enter_ros - Debian's ROS is in /usr
enter_ros() { [[ $system == debian* || ! -e $ros/setup.bash ]] || enter "$ros"; }

# What is started here talks over the loopback, so that the host's own name need not resolve. localhost must:
# roslaunch looks it up in any case, and a bare system has no /etc/hosts.
use_loopback() {
  unset ROS_HOSTNAME ROS_IPV6
  export ROS_IP=127.0.0.1
  python3 -c 'import socket; socket.gethostbyname("localhost")' 2>/dev/null || install_packages libnss-myhostname
}

clean_environment
enter_ros
