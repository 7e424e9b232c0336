#!/bin/bash
# answers.sh ANSWERS COMPARE FOUND: each instruction set finds the same triangles at the same times, and what differs is seen.
set -euo pipefail
program=$1 compare=$2 found=$3

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
"$program" --make 40 >cases.txt
"$program" cases.txt "$found"/*.txt >best
SWEEP_GUARD_SIMD=baseline "$program" cases.txt "$found"/*.txt >plain
python3 -B "$compare" best plain

# expect STATUS SED-COMMAND - of the comparison with changed answers
expect() {
  local status=0
  sed -E "$2" best >changed
  python3 -B "$compare" best changed >output || status=$?
  [[ $status == "$1" ]] || { echo "sed '$2': wants status $1, has $status:" && cat output && exit 1; }
}
expect 0 '/ reference /d'
expect 1 '0,/ reference triangles .* [0-9]+$/s/( reference triangles .*) [0-9]+$/\1/'
expect 1 '0,/ times [0-9]+:0 /s/ times ([0-9]+):0 / times \1:1e-11 /'
expect 0 '0,/ times [0-9]+:0 /s/ times ([0-9]+):0 / times \1:1e-13 /'
expect 1 '0,/ halfspace triangles/{/ halfspace triangles/d}'
expect 2 d
