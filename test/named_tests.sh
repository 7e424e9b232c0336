#!/bin/bash
# named_tests.sh FOLDER PROGRAM... -- DOCUMENT...: every test that the documents name as Suite.Name is one of the programs',
# every soundness_family that they name one of those that ctest knows in the build folder.
set -euo pipefail
folder=$1
shift
programs=()
while [[ $1 != -- ]]; do programs+=("$1") && shift; done

known() {
  (cd "$folder" && ctest -N) | sed -n 's/^ *Test *#[0-9]*: //p'
  local program
  for program in "${programs[@]}"; do
    "$program" --gtest_list_tests | awk '/^[^ ]+\./ { suite = $1; sub(/.*\//, "", suite) } /^  / { sub(/\/.*/, "", $1); print suite $1 }'
  done
}
# shellcheck disable=SC2016  # these are Markdown's
names=$(grep -ohE '[A-Za-z0-9]+Test[A-Za-z0-9]*\.[A-Za-z0-9]+|`soundness_[a-z]+`' "${@:2}" | tr -d '`' | sort -u)
[[ $(wc -l <<<"$names") -gt 20 ]] || { echo "finds only these names: $names" && exit 1; }
unknown=$(comm -23 <(echo "$names") <(known | sort -u))
[[ -z $unknown ]] || { echo "there are no such tests: $unknown" && exit 1; }
