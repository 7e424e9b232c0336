#!/bin/bash
# compare.sh COMPARE REPORT: a short comparison ends well, the detectors are right in it, and its results are as documented.
set -euo pipefail
compare=$1
report=$2

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
csv=$folder/results.csv
"$compare" --triangles 400 --peers scalar --frames 5 --deformations 5 --csv "$csv"

columns=work,method,triangles,queries,median_us,p10_us,p90_us,ratio_median,ratio_p10,misses,extras
[[ $(head -1 "$csv") == "$columns" ]] || { echo "the columns are not $columns" && exit 1; }
for method in halfspace select reference scalar; do
  for queries in 1 20; do
    grep -qE "^ordered,$method,400,$queries,([^,]+,){5}0,0$" "$csv" ||
      { echo "no line of $method without misses and extras for $queries queries" && exit 1; }
  done
done
python3 -B "$report" "$csv" >"$folder/report"
for method in halfspace select reference; do
  for wrong in 1,0 0,1; do
    sed "0,/^ordered,$method,\(.*\),0,0\$/s//ordered,$method,\1,$wrong/" "$csv" >"$folder/wrong.csv"
    status=0
    python3 -B "$report" "$folder/wrong.csv" >"$folder/report" || status=$?
    if [[ $status != 1 ]] || ! grep -q "^WRONG: $method: ordered, 400 triangles" "$folder/report"; then
      echo "an error of $method goes unpunished"
      exit 1
    fi
  done
done
sed '0,/^ordered,scalar,\(.*\),0,0$/s//ordered,scalar,\1,1,0/' "$csv" >"$folder/peer.csv"
python3 -B "$report" "$folder/peer.csv" | grep -qx 'our detectors: no misses, no extras'
