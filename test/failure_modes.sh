#!/bin/bash
# failure_modes.sh SOURCE: doc/failure-modes.md has the rows 1 to 45 and later ones in their order, each with a test, and
# every test that it names as file.cpp:Suite.Name is there.
set -euo pipefail
cd "$1"
document=doc/failure-modes.md

numbers=$(sed -nE 's/^\| ([0-9]+) \|.*/\1/p' $document)
[[ $(head -n 45 <<<"$numbers") == "$(seq 45)" ]] || { echo "the rows do not begin with 1 to 45: $numbers" && exit 1; }
[[ $numbers == "$(sort -nu <<<"$numbers")" ]] || { echo "the rows are not in order: $numbers" && exit 1; }
without=$(grep -E '^\| [0-9]+ \|' $document | grep -vE '[a-z_]+\.cpp:[A-Za-z]+\.[A-Za-z]+' || true)
[[ -z $without ]] || { echo "no test: $without" && exit 1; }

status=0
while IFS=:. read -r file _ suite name; do
  mapfile -t sources < <(find test -name "$file.cpp")
  if ! cat "${sources[@]}" /dev/null | tr '\n' ' ' | grep -qE "TEST(_F|_P)?\($suite, +$name\)"; then
    echo "there is no $file.cpp:$suite.$name" && status=1
  fi
done < <(grep -oE '[a-z_]+\.cpp:[A-Za-z]+\.[A-Za-z]+' $document | sort -u)
exit $status
