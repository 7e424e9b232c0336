#!/bin/bash
# headers.sh alone|together FOLDER ROOM... -- COMPILER OPTION...: the headers in these rooms of the include folder compile, each
# alone, or all together in one file.
set -euo pipefail
how=$1
cd "$2"
shift 2
rooms=()
while [[ $1 != -- ]]; do rooms+=("$1") && shift; done
mapfile -t compile < <(printf '%s\n' "${@:2}" | sed '/^$/d')  # CMake 3.31 gives an empty option, too
compile+=(-fsyntax-only -x c++ -I .)

mapfile -t headers < <(find "${rooms[@]}" -name '*.h' | sort)
echo "${#headers[@]} headers"
[[ ${#headers[@]} -gt 0 ]]
if [[ $how == alone ]]; then
  printf '%s\n' "${headers[@]}" | xargs -P "$(nproc)" -I '{}' "${compile[@]}" -include '{}' /dev/null
else
  printf '#include "%s"\n' "${headers[@]}" | "${compile[@]}" -
fi
