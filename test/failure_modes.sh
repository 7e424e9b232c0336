#!/bin/bash
# failure_modes.sh SOURCE: doc/failure-modes.md has the rows 1 to 110, each with a test, and every test that it, doc/threats.md or
# doc/reliability.md names as file.cpp:Suite.Name or file.sh is there.
set -euo pipefail
cd "$1"
document=doc/failure-modes.md
# shellcheck disable=SC2016  # the backquotes are those of the document
a_test='([a-z_]+\.cpp:[A-Za-z]+\.[A-Za-z]+|[a-z_]+\.sh|`scripts/[a-z]+`)'

numbers=$(sed -nE 's/^\| ([0-9]+) \|.*/\1/p' $document | sort -n)
[[ $numbers == "$(seq 110)" ]] || { echo "the rows are not 1 to 110: $(xargs <<<"$numbers")" && exit 1; }
without=$(grep -E '^\| [0-9]+ \|' $document | grep -vE "$a_test" || true)
[[ -z $without ]] || { echo "no test: $without" && exit 1; }

status=0
while IFS=:. read -r file _ suite name; do
  mapfile -t sources < <(find test -name "$file.cpp")
  if ! cat "${sources[@]}" /dev/null | tr '\n' ' ' | grep -qE "TEST(_F|_P)?\($suite, +$name\)"; then
    echo "there is no $file.cpp:$suite.$name" && status=1
  fi
done < <(grep -ohE '[a-z_]+\.cpp:[A-Za-z]+\.[A-Za-z]+' $document doc/threats.md doc/reliability.md | sort -u)
while read -r file; do
  [[ -n $(find test -name "$file") ]] || { echo "there is no $file" && status=1; }
done < <(grep -ohE '[a-z_]+\.sh\b' $document doc/threats.md doc/reliability.md | sort -u)
exit $status
