# Shared by run.sh and test.sh (sourced): where things are, building, and a network that stays on this machine.

repository=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd -P)
build=${HEERK_BUILD_DIR:-$repository/build}

# build_targets TARGET...: configures (Release) and builds; silent about the configuration unless it fails.
build_targets() {
  mkdir -p "$build"
  if ! cmake -S "$repository" -B "$build" -DCMAKE_BUILD_TYPE=Release -DPYTHON_EXECUTABLE=/usr/bin/python3 \
      -DPython3_EXECUTABLE=/usr/bin/python3 >"$build/configure.log" 2>&1; then
    cat "$build/configure.log" >&2
    echo "configuring failed; the log above is $build/configure.log" >&2
    return 1
  fi
  # One compiler per processor, but not more than memory allows (ROS and Eigen headers: 1 GB each).
  local jobs memory
  jobs=$(nproc)
  memory=$(awk '/^MemAvailable/ {print int($2 / 1e6)}' /proc/meminfo)
  [ "$memory" -ge 1 ] || memory=1
  [ "$jobs" -le "$memory" ] || jobs=$memory
  # What is up to date already is not worth a line.
  cmake --build "$build" -j "$jobs" --target "$@" | { grep -v 'Built target' || true; }
}

# Unless the user has said otherwise, ROS stays on this machine.
use_loopback() {
  if [ -z "${ROS_IP:-}" ] && [ -z "${ROS_HOSTNAME:-}" ]; then
    export ROS_IP=127.0.0.1
  fi
  export ROS_MASTER_URI=${ROS_MASTER_URI:-http://${ROS_IP:-$ROS_HOSTNAME}:11311}
}

# LCM needs a route for multicast; a host without any default route has none. Packets do not leave it (ttl=0).
ensure_multicast_route() {
  local probe='import socket; socket.socket(socket.AF_INET, socket.SOCK_DGRAM).connect(("239.255.76.67", 7667))'
  if ! /usr/bin/python3 -c "$probe" 2>/dev/null && [ "$(id -u)" -eq 0 ] && command -v ip >/dev/null; then
    ip link set lo up 2>/dev/null && ip route add 224.0.0.0/4 dev lo 2>/dev/null || true
  fi
}

# ROS programs look for the package in the environment; setup.bash reads unset variables.
source_devel() {
  set +u
  # shellcheck disable=SC1091
  source "$build/devel/setup.bash"
  set -u
}
