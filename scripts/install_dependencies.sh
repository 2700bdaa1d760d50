#!/usr/bin/env bash
# Installs the Debian packages that are missing, and nothing when none is.
# usage: install_dependencies.sh [run|test|plots|rviz]...     (default: run)
#   run    build and run the node and the command-line tools
#   test   what the tests need as well (includes run and plots)
#   plots  scripts/analyze_bag.py and the paper's figures
#   rviz   the 3D view (about 350 MB)
# Exit status 0: all is there; 1: something is missing and cannot be installed (the message names it); 2: bad arguments.
set -euo pipefail

build_tools=(g++ make cmake)
libraries=(libeigen3-dev libyaml-cpp-dev libcli11-dev liblcm-dev liblcm-bin)
ros_build=(catkin ros-message-generation ros-std-msgs ros-geometry-msgs libroscpp-dev libtf2-ros-dev libstd-msgs-dev
  libgeometry-msgs-dev libsensor-msgs-dev libnav-msgs-dev libvisualization-msgs-dev libdiagnostic-msgs-dev
  libros-rosgraph-msgs-dev libstd-srvs-dev libdiagnostic-updater-dev librosbag-dev)
# roscore, roslaunch, rosrun, rostopic, rosservice, rosbag, and the Python messages with which they show our topics.
ros_run=(python3-roslaunch rosout rosbash python3-rospy python3-rostopic python3-rosnode python3-rosservice python3-rosbag
  ros-robot-state-publisher ros-std-srvs python3-std-srvs python3-geometry-msgs python3-sensor-msgs python3-nav-msgs
  python3-visualization-msgs python3-diagnostic-msgs python3-tf2-msgs)
network=(iproute2)
plots=(python3-numpy python3-scipy python3-matplotlib)
ros_test=(librostest-dev python3-rostest)
test_libraries=(libgtest-dev libgmock-dev libbenchmark-dev)

fail() { echo "install_dependencies: $*" >&2; exit 1; }

wanted=()
for set in "${@:-run}"; do
  case $set in
    run) wanted+=("${build_tools[@]}" "${libraries[@]}" "${network[@]}" "${ros_build[@]}" "${ros_run[@]}") ;;
    test) wanted+=("${build_tools[@]}" "${libraries[@]}" "${network[@]}" "${ros_build[@]}" "${ros_run[@]}" "${plots[@]}"
            "${ros_test[@]}" "${test_libraries[@]}") ;;
    plots) wanted+=("${plots[@]}" python3-rosbag) ;;
    rviz) wanted+=(rviz) ;;
    -h | --help) sed -n '2,8s/^# \{0,1\}//p' "$0"; exit 0 ;;
    *) echo "install_dependencies: unknown set '$set'; expected run, test, plots or rviz" >&2; exit 2 ;;
  esac
done

command -v dpkg-query >/dev/null && command -v apt-get >/dev/null || fail "this is not Debian or Ubuntu (no apt-get); please" \
  "install the equivalent of: ${wanted[*]}"

if [ -d /opt/ros ]; then  # ROS from its own packages: Debian's must not come beside them
  echo "install_dependencies: ROS in /opt/ros is used as it is (rosdep install --from-paths . completes it)" >&2
  declare -A of_ros=()
  for package in "${ros_build[@]}" "${ros_run[@]}" "${ros_test[@]}" python3-rosbag rviz; do of_ros[$package]=1; done
  for i in "${!wanted[@]}"; do [ -z "${of_ros[${wanted[i]}]:-}" ] || unset "wanted[i]"; done
fi

# dpkg-query fails when it does not know one of the names; what it prints about the others still counts.
installed=$(dpkg-query -W -f '${db:Status-Status} ${Package}\n' "${wanted[@]}" 2>/dev/null | sed -n 's/^installed //p' || true)
missing=()
for package in "${wanted[@]}"; do
  grep -qxF "$package" <<<"$installed" || missing+=("$package")
done
[ ${#missing[@]} -gt 0 ] || exit 0

as_root=()
if [ "$(id -u)" -ne 0 ]; then
  command -v sudo >/dev/null || fail "not root and no sudo here; ask an administrator for: apt-get install ${missing[*]}"
  as_root=(sudo)
fi
# env, because sudo does not pass the variable on.
apt() { "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -o DPkg::Lock::Timeout=300 -qq "$@" >&2; }

echo "installing ${#missing[@]} Debian packages: ${missing[*]}" >&2
apt update || fail "apt-get update failed; still missing: ${missing[*]}"
unknown=()
for package in "${missing[@]}"; do
  apt-cache show "$package" >/dev/null 2>&1 || unknown+=("$package")
done
[ ${#unknown[@]} -eq 0 ] || fail "this release ($(. /etc/os-release && echo "$PRETTY_NAME")) does not offer: ${unknown[*]}" \
  "(Debian 12 does; elsewhere install the equivalent and build with cmake)"
apt install -y --no-install-recommends "${missing[@]}" || fail "apt-get install failed; still missing: ${missing[*]}"
