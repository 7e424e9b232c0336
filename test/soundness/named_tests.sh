#!/bin/bash
# named_tests.sh DOCUMENT FOLDER: every test that the document names as `Suite.Name` or `soundness_family` is there.
set -euo pipefail
document=$1
folder=$2

# shellcheck disable=SC2016  # these are Markdown's
mapfile -t names < <(grep -oE '`[A-Za-z0-9]+Test[A-Za-z0-9]*\.[A-Za-z0-9]+`|`soundness_[a-z]+`' "$document" | tr -d '`' | sort -u)
[[ ${#names[@]} -gt 20 ]] || { echo "finds only ${#names[@]} names in $document" && exit 1; }
status=0
for name in "${names[@]}"; do
  case $name in
    soundness_*) grep -rqE "[ (]${name#soundness_}:[0-9]+" "$folder/CMakeLists.txt" && continue ;;
    *) grep -rqE "TEST(_F|_P)?\\(${name%.*}, ${name#*.}\\)" "$folder" --include='*.cpp' && continue ;;
  esac
  echo "$document names $name, which there is not"
  status=1
done
exit $status
