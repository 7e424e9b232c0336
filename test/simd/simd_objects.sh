#!/bin/bash
# The loops compiled for one instruction set define nothing that another file may define, too: the linker could take it
# from them, and the program would not run on other machines.
#   simd_objects.sh OBJECT...
set -euo pipefail
[[ $# -gt 0 ]]
shared=$(nm --defined-only --extern-only --demangle "$@" | grep -E ' [A-Z] ' | grep -vE '::kKernels$|DW\.ref\.__gxx_personality' || true)
if [[ -n $shared ]]; then
  echo "defined for one instruction set, and visible to all:"
  echo "$shared"
  exit 1
fi
