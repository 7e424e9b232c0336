#!/bin/bash
# where_decided.sh SOURCE: each row of "Where it is decided" in doc/architecture.md names one file in its last cell, as `file`
# or `file: symbol`. That file and every other that the table names are there, and the file has the symbol in it.
set -euo pipefail
cd "$1"

rows=$(sed -n '/^## Where it is decided$/,/^## Decisions$/s/^| \(.*\) |$/\1/p' doc/architecture.md | tail -n +2)
[[ $(wc -l <<<"$rows") -ge 40 ]] || { echo "finds only these rows: $rows" && exit 1; }

# find_file FILE - one of the places that the document names has it
find_file() {
  local paths=()
  for path in "src/$1" "include/sweep_guard/$1" "$1"; do [[ ! -e $path ]] || paths+=("$path"); done
  path=${paths[*]}
  [[ -f $path ]]
}

status=0
complain() { echo "$*" && status=1; }
while IFS= read -r row; do
  place=${row##* | }
  [[ $place =~ ^\`([A-Za-z0-9_./-]+)(: ([A-Za-z0-9_]+))?\`$ ]] || { complain "names no file: $row" && continue; }
  file=${BASH_REMATCH[1]} symbol=${BASH_REMATCH[3]}
  find_file "$file" || { complain "there is not one $file: $path" && continue; }
  [[ -z $symbol ]] || grep -qw -- "$symbol" "$path" || complain "$path has no $symbol"
done <<<"$rows"

while IFS= read -r file; do
  find_file "$file" || complain "there is no $file"
done < <(grep -oE '`[a-z_/]+\.[a-z]+' <<<"$rows" | tr -d '`' | sort -u)
exit $status
