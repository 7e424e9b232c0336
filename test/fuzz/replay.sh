#!/bin/bash
# replay.sh PROGRAM CORPUS/TARGET.tar.gz FOUND: runs a target on the inputs in the archive, unpacked below the working directory,
# and on those that broke something, if there are any.
set -euo pipefail
target=$(basename "$2" .tar.gz)
inputs=corpus/$target
rm -rf "$inputs" && mkdir -p "$inputs"
tar -xzf "$2" -C "$inputs"
"$1" "$target" "$inputs" "$3"
