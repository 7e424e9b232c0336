#!/bin/bash
# planning_scene_random.sh PROGRAM [SEED...]: a planning scene and the changes that it tells are those of the oracle after each of 1000
# random steps, for objects with and without a pose of their own.
set -euo pipefail
program=$1
shift
steps=$(mktemp)
trap 'rm -f "$steps"' EXIT
for seed in "${@:-1}"; do
  for version in '' --old; do
    # shellcheck disable=SC2086  # no argument if it is empty
    python3 "$(dirname "$0")/planning_scene_oracle.py" 1000 "$seed" $version >"$steps"
    SWEEP_GUARD_SCENE_STEPS=$steps "$program" --gtest_filter='PlanningSceneRandomTest.*' | tee /dev/stderr | grep -q 'PASSED  \] 1 test'
  done
done
