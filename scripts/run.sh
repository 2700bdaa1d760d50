#!/usr/bin/env bash
# Installs what is missing, builds, and runs the rotor or shaft in real time with a live status line; Ctrl-C ends it.
# usage: run.sh [CONFIG] [--duration S] [--headless] [NAME:=VALUE]...
#   CONFIG        configuration file, or the name of one in config/ (default: bo105)
#   --duration S  end after S seconds
#   --headless    no rviz, even when there is a display
#   NAME:=VALUE   argument of launch/rotor.launch, e.g. record:=true, real_time_factor:=0.5, lcm:=false
#   --help        this text
# ROS stays on this machine unless ROS_IP or ROS_HOSTNAME is set. Exit status: 0 when the node ran and ended well, that of the
# node when it failed, 2 for bad arguments.
set -euo pipefail
# shellcheck source-path=SCRIPTDIR
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

usage() { sed -n '2,10s/^# \{0,1\}//p' "${BASH_SOURCE[0]}"; }
refuse() { echo "run.sh: $*; see run.sh --help" >&2; exit 2; }

# --- command line
config=bo105 duration="" headless=false arguments=() config_given=false
while [ $# -gt 0 ]; do
  case $1 in
    -h | --help) usage; exit 0 ;;
    --headless) headless=true ;;
    --duration) [ $# -ge 2 ] || refuse "--duration needs a number of seconds"; duration=$2; shift ;;
    --duration=*) duration=${1#*=} ;;
    -*) refuse "unknown option '$1'" ;;
    *:=*) arguments+=("$1") ;;
    *) [ "$config_given" = false ] || refuse "two configurations: '$config' and '$1'"; config=$1; config_given=true ;;
  esac
  shift
done
[[ -z $duration || $duration =~ ^([0-9]+\.?[0-9]*|\.[0-9]+)$ ]] || refuse "--duration '$duration': expected a number of seconds"
for candidate in "$config" "$repository/config/$config" "$repository/config/$config.yaml"; do
  if [ -f "$candidate" ]; then config_file=$(realpath "$candidate"); break; fi
done
[ -n "${config_file:-}" ] || refuse "no such configuration: '$config'; config/ has: $(cd "$repository/config" && echo *.yaml)"

# --- programs
"$repository/scripts/install_dependencies.sh" run
rviz=false
if [ "$headless" = false ] && [ -n "${DISPLAY:-}" ]; then
  if "$repository/scripts/install_dependencies.sh" rviz; then rviz=true; else echo "going on without rviz" >&2; fi
fi
build_targets all
source_devel
use_loopback
ensure_multicast_route

already_running() {
  /usr/bin/python3 - <<'PYTHON' >/dev/null 2>&1
import sys
import rosgraph
import rosnode
sys.exit(not (rosgraph.is_master_online() and rosnode.rosnode_ping("/rotor", max_count=1)))
PYTHON
}

if already_running; then
  echo "run.sh: a node /rotor runs already at $ROS_MASTER_URI" >&2
  exit 1
fi

# --- launch; roslaunch starts a master when none answers, and ends it with the rest. It has a session of its own, so that
# Ctrl-C reaches this script only, which then ends everything in order.
work=$(mktemp -d "${TMPDIR:-/tmp}/heerk_rotor_run.XXXXXX")
log=$build/run.log
exit_file=$work/exit_status
launch="" status=""

finish() {  # ends what was started, once
  trap '' INT TERM HUP
  trap - EXIT
  [ -z "$status" ] || kill -TERM "$status" 2>/dev/null || true
  [ -z "$status" ] || wait "$status" 2>/dev/null || true
  if [ -n "$launch" ] && kill -0 "$launch" 2>/dev/null; then
    kill -INT "$launch" 2>/dev/null || true
    wait "$launch" 2>/dev/null || true
  fi
  local result=1
  [ ! -s "$exit_file" ] || result=$(cat "$exit_file")
  rm -rf "$work"
  if [ "$result" -ne 0 ]; then
    # What the node said, without roslaunch's own lines; all of the log where it never started.
    local said
    said=$(sed -n '/process\[rotor-/,$p' "$log" | grep -vaE 'process\[|killing on exit|shutting down|\[1mdone|^\.\.\.|^=+|^log file' || true)
    if [ -n "$said" ]; then head -n 60 <<<"$said" >&2; else tail -n 40 "$log" >&2; fi
    echo "run.sh: the node failed (exit status $result); complete log: $log" >&2
  fi
  exit "$result"
}
trap finish EXIT INT TERM HUP

echo "rotor: ${config_file#"$repository"/}; ROS master $ROS_MASTER_URI; log $log"
echo "for rostopic, rosservice, rosbag in another terminal first paste:"
echo "  export ${ROS_IP:+ROS_IP=$ROS_IP }${ROS_HOSTNAME:+ROS_HOSTNAME=$ROS_HOSTNAME }ROS_MASTER_URI=$ROS_MASTER_URI;" \
  "source '$build/devel/setup.bash'"
setsid roslaunch heerk_rotor rotor.launch config:="$config_file" rviz:="$rviz" bag:="$PWD/rotor" \
  launch_prefix:="/usr/bin/python3 '$repository/scripts/report_exit.py' '$exit_file'" "${arguments[@]}" >"$log" 2>&1 &
launch=$!

# --- status line, as soon as a master answers
until /usr/bin/python3 -c 'import rosgraph, sys; sys.exit(not rosgraph.is_master_online())'; do
  kill -0 "$launch" 2>/dev/null || finish
  sleep 0.2
done
/usr/bin/python3 "$repository/scripts/status_line.py" ${duration:+--duration "$duration"} &
status=$!

# Whichever ends first ends the run: the status line after the duration, roslaunch when the node has ended.
wait -n "$launch" "$status" || true
finish
