#!/bin/bash
# core_without_ros.sh LIBRARY ROOT: the core includes neither ROS nor messages nor rooms above it. It links only Qhull, libccd and
# system libraries; OpenGL is loaded by name. The rviz plugins include only messages, common and geometry.
set -euo pipefail
library=$1
root=$2

files=()
for room in black_box common simd geometry detection prediction guard monitor motion interaction haptics; do
  for folder in "$root/include/sweep_guard/$room" "$root/src/$room"; do
    [[ -d $folder ]] && files+=("$folder"/*)
  done
done
[[ ${#files[@]} -gt 20 ]] || { echo "finds only ${#files[@]} files of the core in $root" && exit 1; }

status=0
above='(ros|rviz|recording|simulation|evaluation|session|benchmark)/'
foreign="#include [<\"](ros|tf2|rviz|nodelet|pluginlib|std_srvs|[a-z_]*_msgs|$above|sweep_guard/($above|[A-Z]))"
if grep -nE "$foreign" "${files[@]}"; then
  echo "the core includes what is above it"
  status=1
fi

if grep -nE '#include ([<"]sweep_guard/|")(simd|detection|prediction|guard|monitor|motion|ros|recording|simulation|evaluation|session)/' "$root"/src/rviz/*; then
  echo "a plugin for rviz includes more of this package than its messages, common and geometry"
  status=1
fi

needed=$(readelf -d "$library" | sed -n 's/.*(NEEDED).*\[\(.*\)\]/\1/p')
grep -q '^libccd\.' <<<"$needed" || { echo "$library does not link libccd: is it the core?" && status=1; }
if grep -vE '^(libccd|libqhull_r|libstdc\+\+|libm|libgcc_s|libc|libdl|libpthread|libasan|libubsan|libtsan|ld-linux-[a-z0-9-]*)\.so' <<<"$needed"; then
  echo "$library links these, which the core must not need"
  status=1
fi
exit $status
