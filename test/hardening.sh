#!/bin/bash
# hardening.sh FILE...: each program and library has read-only relocations that are bound at the start, no stack that can be
# executed, guarded stacks, and can be loaded anywhere.
set -euo pipefail

status=0
missing() { echo "$1: $2" && status=1; }
for file in "$@"; do
  headers=$(readelf --wide --file-header --program-headers --dynamic --dyn-syms "$file")
  grep -q 'Type: *DYN' <<<"$headers" || missing "$file" 'it has a fixed address'
  grep -q 'GNU_RELRO' <<<"$headers" || missing "$file" 'its relocations can be written'
  grep -qE 'BIND_NOW|FLAGS_1.*NOW' <<<"$headers" || missing "$file" 'its functions are bound while it runs'
  grep -qE 'GNU_STACK.* RW +0x' <<<"$headers" || missing "$file" 'its stack can be executed'
  grep -q '__stack_chk_fail' <<<"$headers" || missing "$file" 'its stacks are not guarded'
done
exit $status
