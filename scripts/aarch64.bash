#!/bin/bash
# aarch64.bash build|test|answers: run by scripts/portability in its chroot. Builds the core for this processor and for aarch64,
# runs the tests of aarch64 under qemu, and compares what both find.
set -euo pipefail
root=$(dirname "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")")
here=$root/build/here there=$root/build/aarch64
arch=aarch64-linux-gnu
qemu=/usr/bin/qemu-aarch64-static

# configure FOLDER [-DOPTION=VALUE...]
configure() {
  cmake -S "$root" -B "$1" -G Ninja -DCMAKE_BUILD_TYPE=RelWithDebInfo -DSWEEP_GUARD_CORE_ONLY=ON -DSWEEP_GUARD_WERROR=ON \
    -DCMAKE_CXX_COMPILER_LAUNCHER=ccache "${@:2}"
}

build() {
  configure "$here"
  cmake --build "$here" --target answers
  PKG_CONFIG_LIBDIR=/usr/lib/$arch/pkgconfig:/usr/share/pkgconfig configure "$there" -DCMAKE_SYSTEM_NAME=Linux \
    -DCMAKE_SYSTEM_PROCESSOR=aarch64 -DCMAKE_CXX_COMPILER=$arch-g++ -DCMAKE_LIBRARY_ARCHITECTURE=$arch \
    -DCMAKE_CROSSCOMPILING_EMULATOR=$qemu
  cmake --build "$there" --target tests
}

# Those that are scripts look into the programs with the tools of this processor.
test_core() {
  cd "$there"
  SWEEP_GUARD_SCENES=1 SWEEP_GUARD_SLOWER=20 ctest --no-tests=error --output-on-failure -j2 -F -R '_test$|^soundness_'
}

program() { find "$1" -name answers -type f -executable; }

# With the loops for any processor of its kind: what others leave in doubt differs, and a search then begins elsewhere.
answers() {
  local files
  cd "$root/build"
  export SWEEP_GUARD_SIMD=baseline
  "$(program "$here")" --make 1000 >cases.txt
  mapfile -t files < <(find "$root/build/cases.txt" "$root/test/soundness/found" "${SWEEP_GUARD_DATA:-$root/test/soundness/found}/ccd" \
    -name '*.txt' -o -name '*.csv' | sort)
  "$(program "$here")" "${files[@]}" >answers.here
  $qemu "$(program "$there")" "${files[@]}" >answers.aarch64
  python3 -B "$root/test/soundness/compare_answers.py" answers.here answers.aarch64
}

case ${1:-} in
  build) build ;;
  test) test_core ;;
  answers) answers ;;
  *) echo "usage: scripts/aarch64.bash build|test|answers" >&2 && exit 2 ;;
esac
