#!/usr/bin/env bash
# Installs what is missing, builds everything (Release) and runs every test.
# usage: test.sh [CTEST ARGUMENTS]      e.g. test.sh -R integrate
# Exit status: that of ctest; of the installation or the build when these fail.
set -euo pipefail
# shellcheck source-path=SCRIPTDIR
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

case ${1:-} in
  -h | --help) sed -n '2,4s/^# \{0,1\}//p' "$0"; exit 0 ;;
esac

"$repository/scripts/install_dependencies.sh" test
build_targets all tests
use_loopback
ensure_multicast_route
cd "$build"
exec ctest --output-on-failure --no-tests=error "$@"
