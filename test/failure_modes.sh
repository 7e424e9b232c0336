#!/bin/bash
# failure_modes.sh SOURCE: doc/failure-modes.md has the rows 1 to 164, each with a test, and every test that it, doc/safety.md or
# doc/reliability.md names as file.cpp:Suite.Name, file.py or file.sh is there.
set -euo pipefail
cd "$1"
document=doc/failure-modes.md
# shellcheck disable=SC2016  # the backquotes are those of the document
a_test='([a-z_]+\.cpp:[A-Za-z]+\.[A-Za-z0-9]+|[a-z_]+\.(py|sh)|`scripts/[a-z]+`)'

numbers=$(sed -nE 's/^\| ([0-9]+) \|.*/\1/p' $document | sort -n)
[[ $numbers == "$(seq 164)" ]] || { echo "the rows are not 1 to 164: $(xargs <<<"$numbers")" && exit 1; }
without=$(grep -E '^\| [0-9]+ \|' $document | grep -vE "$a_test" || true)
[[ -z $without ]] || { echo "no test: $without" && exit 1; }

status=0
# tests - every one as file.cpp:Suite.Name
tests() {
  grep -rzoE --include='*.cpp' 'TEST(_F|_P)?\([A-Za-z]+,\s+[A-Za-z0-9]+\)' test | tr -s ' \n' ' ' | tr '\0' '\n' |
    sed -E 's|.*/([a-z_]+\.cpp):TEST(_F\|_P)?\(([A-Za-z]+), ([A-Za-z0-9]+)\)|\1:\3.\4|' | sort -u
}
missing=$(comm -13 <(tests) <(grep -ohE '[a-z_]+\.cpp:[A-Za-z]+\.[A-Za-z0-9]+' $document doc/safety.md doc/reliability.md | sort -u))
[[ -z $missing ]] || { echo "there is no $missing" && status=1; }
while read -r file; do
  [[ -n $(find test -name "$file") ]] || { echo "there is no $file" && status=1; }
done < <(grep -ohE '[a-z_]+\.(py|sh)\b' $document doc/safety.md doc/reliability.md | sort -u)
exit $status
