#!/bin/bash
# ratios.sh RATIOS: pairs are found by the names of columns, a ratio and its interval are right, and a limit is held.
set -euo pipefail
ratios=$1

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# figures older|newer VALUE... - one per round; the newer file has another column in front
figures() {
  local other='' value
  [[ $1 == older ]] || other=new,
  echo "${other}work,method,triangles,p50_ms,p99_ms" >"$folder/$1.csv"
  for value in "${@:2}"; do echo "${other}wait,\"select, tcpros\",1600,$value,$value" >>"$folder/$1.csv"; done
}
# expect STATUS TEXT LIMIT... - of the comparison
expect() {
  local status=0
  python3 -B "$ratios" "$folder"/{older,newer}.csv "${@:3}" >"$folder/output" 2>&1 || status=$?
  if [[ $status != "$1" ]] || ! grep -qF "$2" "$folder/output"; then
    echo "status $status instead of $1, or no '$2' in:" && cat "$folder/output" && exit 1
  fi
}

figures older 1 1 1 1 1 1
figures newer 1.1 1.1 1.1 1.1 1.1 1.1
expect 1 '| wait | select, tcpros | 1600 |  | p50_ms | 1 | 1.1 | 1.100 | 1.100 to 1.100 | 1.05 | WORSE |' p50_ms:1.05
expect 1 'FAIL: 1 of 2 ratios' p50_ms:1.05 p99_ms:1.3
expect 0 'pass: 0 of 1 ratios' p99_ms:1.3

# Of six pairs the interval goes from the least ratio to the largest. 1.06 is the median of the means of any two.
figures newer 1.16 1.00 1.02 1.08 1.04 1.10
expect 0 '| 1.060 | 1.000 to 1.160 |' p50_ms:1.05
expect 0 '1 intervals reach above the limit' p50_ms:1.05

# One disturbed pair of eight leaves the estimate as it is, but nothing is proven then: sqrt(0.5 * 1.2) = 0.775.
figures older 1 1 1 1 1 1 1 2.4
figures newer 1.2 1.2 1.2 1.2 1.2 1.2 1.2 1.2
expect 0 '| 1.200 | 0.775 to 1.200 |' p50_ms:1.05

# What slows both down in one round does not count.
figures older 1 2 3 4 5 6
figures newer 1 2 3 4 5 6
expect 0 '| 1.000 | 1.000 to 1.000 |' p50_ms:1.05

figures newer 1 2 3 4 5 nan
expect 2 '5 pairs are too few' p50_ms:1.05
figures newer 1 2 3 4 5
expect 2 '6 rows of the older build, 5 of the newer' p50_ms:1.05

PYTHONPATH=$(dirname "$ratios") python3 -B - <<'END'
import math, random
from ratios import ratio_and_interval
random.seed(7)
held = 0
for _ in range(2000):
    _, low, high = ratio_and_interval([1.3 * math.exp(random.gauss(0.0, 0.2)) for _ in range(8)])
    held += low <= 1.3 <= high
assert 0.95 <= held / 2000 <= 0.975, f'{held / 20} % of the intervals hold the truth'  # 96.1 % by theory
END
