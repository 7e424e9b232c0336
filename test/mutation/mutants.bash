# Reads the list of mutants and plants them: sourced by scripts/mutation and by the test of the list.
# shellcheck shell=bash

# next_mutant - sets name, file, test, before and after to the next mutant's on standard input; fails where there is none
next_mutant() {
  name=
  while [[ -z $name || $name == '#'* ]]; do read -r name || return 1; done
  IFS= read -r file && IFS= read -r test && IFS= read -r before && IFS= read -r after || return 1
  before=${before#- } after=${after#+ }
}

# mutated FOLDER - prints the folder's $file with the mutant in it; fails where that would not change exactly one line
mutated() {
  local text rest
  text=$(<"$1/$file") && rest=${text#*"$before"} || return 1
  [[ $rest != "$text" && $rest != *"$before"* && $before != "$after" ]] || return 1
  printf '%s\n' "${text%%"$before"*}$after$rest"
}
