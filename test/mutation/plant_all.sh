#!/bin/bash
# plant_all.sh FOLDER: every mutant changes exactly one line of the sources in the folder.
# shellcheck source-path=SCRIPTDIR
set -euo pipefail
. "$(dirname "$(readlink -f "$0")")/mutants.bash"
planted=0
status=0
while next_mutant; do
  planted=$((planted + 1))
  mutated "$1" >/dev/null || { echo "the mutant '$name' does not change exactly one line of $file: '$before'" && status=1; }
done <"$1/test/mutation/mutants.txt"
echo "$planted mutants"
[[ $planted -ge 60 && $status == 0 ]]
