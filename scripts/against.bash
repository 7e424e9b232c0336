# Shared by the scripts that compare this build with an older one: sourced after processes.bash.
# shellcheck shell=bash disable=SC2034,SC2154  # shares variables with who sources it

min_rounds=6  # as many pairs as an interval of 95 % takes

# needs_build OPTION [VALUE] [...] - the rest of the command line
needs_build() {
  needs_value "$@"
  [[ -f $2/devel/setup.bash ]] || usage_error "$1 needs the build directory of a checkout, not $2"
}

# needs_rounds OPTION [VALUE] [...]
needs_rounds() {
  needs_value "$@"
  [[ $2 =~ ^[0-9]+$ && $2 -ge $min_rounds ]] || usage_error "$1 needs a number of at least $min_rounds, not $2"
}

# begin_rounds FOLDER - where the figures of both builds go
begin_rounds() {
  figures=$1
  mkdir -p "$figures"
  rm -f "$figures"/{older,newer}.csv
}

# in_build BUILD PROGRAM [ARGUMENT]... - wherever that build keeps the program, and in its own environment
in_build() {
  local program
  program=$(find "$1/devel/lib" "$1" -type f -executable -name "$2" -print -quit)
  [[ -n $program ]] || status=2 fail "$1 has no program $2"
  build=$1 enter_workspace
  exec "$program" "${@:3}"
}

# end_beside PID - ends the command that ran beside, whose output must say by `beside_did` that it did something
end_beside() {
  end "$1"
  grep -Eq "$beside_did" "$figures/beside.log" ||
    status=2 fail "${beside[*]} has done nothing: $(tail -3 "$figures/beside.log")"
}

# by_turns ROUND PROGRAM [ARGUMENT]... - of both builds, one after the other; in odd rounds the older one first. What today's
# program finds wrong makes `code` 1. The command `beside`, if there is one, runs beside the newer one
by_turns() {
  local age ages=(older newer) result companion
  (($1 % 2)) || ages=(newer older)
  for age in "${ages[@]}"; do
    result=0 companion=
    if [[ $age == newer && ${beside[*]:-} ]]; then
      start in_build "$build" "${beside[@]}" >"$figures/beside.log" 2>&1
      companion=$!
    fi
    start in_build "$([[ $age == newer ]] && echo "$build" || echo "$against")" "${@:2}" --csv "$figures/$age.csv" \
      >"$figures/$age.log" 2>&1
    wait $! || result=$?
    [[ $result -le 1 ]] || status=2 fail "$2 of the $age build has failed: $(tail -3 "$figures/$age.log")"
    [[ $age == older || $result == 0 ]] || code=1
    [[ -z $companion ]] || end_beside "$companion"
  done
}

# print_ratios COLUMN:LIMIT...
print_ratios() {
  say "load $(cut -d' ' -f1-3 /proc/loadavg)"
  python3 "$root/scripts/ratios.py" "$figures"/{older,newer}.csv "$@" || code=$?
  say "figures: $figures/older.csv, $figures/newer.csv"
}
