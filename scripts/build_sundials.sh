#!/usr/bin/env bash
# Builds SUNDIALS from Debian's (or Ubuntu's) own source package, optimised for this machine and static: the peers of bench/work_precision.
# The distribution's binary is compiled without optimisation of the loops that matter here; a comparison with it would be unfair to SUNDIALS.
# usage: build_sundials.sh [PREFIX]      (default: build/sundials; then cmake -DSUNDIALS_DIR=PREFIX/lib/cmake/sundials)
# Environment: JOBS (default 1), CC. The system's package sources stay as they are: the source entry lives in a temporary directory.
# Exit status 0: built, or there already; 1: something is missing (the message says what).
set -euo pipefail

fail() { echo "build_sundials: $*" >&2; exit 1; }
case ${1:-} in -h | --help) sed -n '2,6s/^# \{0,1\}//p' "$0"; exit 0 ;; esac

root=$(cd "$(dirname "$0")/.." && pwd)
prefix=$(realpath -m "${1:-$root/build/sundials}")
if [ -e "$prefix/lib/cmake/sundials/SUNDIALSConfig.cmake" ]; then
  echo "build_sundials: $prefix is there already; remove it to build anew" >&2
  exit 0
fi
for tool in apt-get dpkg-source cmake cc; do command -v $tool >/dev/null || fail "needs $tool (packages: apt dpkg-dev cmake gcc)"; done

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
chmod 755 "$work"

# The same archives as the binaries come from, as source entries. Fields that are not set come out as their own names.
apt-get indextargets --format '$(ORIGIN)|$(REPO_URI)|$(RELEASE)|$(COMPONENT)|$(SIGNED_BY)' 'Created-By: Packages' | sort -u |
  while IFS='|' read -r origin uri release component key; do
    case $origin in Debian | Ubuntu) ;; *) continue ;; esac
    case $key in /*) options="[signed-by=$key] " ;; *) options= ;; esac
    echo "deb-src $options$uri $release $component"
  done >"$work/sources.list"
[ -s "$work/sources.list" ] || fail "no Debian or Ubuntu archive among the package sources (run apt-get update?)"

mkdir -p "$work/lists/partial" "$work/cache/archives/partial"
apt=(apt-get -qq -o Dir::Etc::SourceList="$work/sources.list" -o Dir::Etc::SourceParts=/dev/null -o Dir::State::Lists="$work/lists"
  -o Dir::Cache="$work/cache" -o APT::Get::List-Cleanup=0 -o APT::Sandbox::User=root)
"${apt[@]}" update || fail "the lists of source packages cannot be fetched"
(cd "$work" && "${apt[@]}" source sundials) || fail "the source package sundials cannot be fetched or unpacked"
source=$(find "$work" -maxdepth 1 -type d -name 'sundials-*' | head -n 1)
[ -n "$source" ] || fail "no source directory in what was unpacked"

flags="-O3 -march=native -DNDEBUG"
cmake -S "$source" -B "$work/build" -DCMAKE_BUILD_TYPE=Release -DCMAKE_C_FLAGS_RELEASE="$flags" -DCMAKE_INSTALL_PREFIX="$prefix" -DCMAKE_INSTALL_LIBDIR=lib \
  -DBUILD_SHARED_LIBS=OFF -DBUILD_STATIC_LIBS=ON -DCMAKE_POSITION_INDEPENDENT_CODE=ON -DEXAMPLES_ENABLE_C=OFF -DEXAMPLES_ENABLE_CXX=OFF -DEXAMPLES_INSTALL=OFF \
  -DBUILD_CVODES=OFF -DBUILD_IDAS=OFF -DBUILD_KINSOL=OFF -DSUNDIALS_LOGGING_LEVEL=0 >"$work/configure.log" 2>&1 ||
  { tail -n 20 "$work/configure.log" >&2; fail "cmake failed"; }
cmake --build "$work/build" --target install -- -j"${JOBS:-1}" >"$work/build.log" 2>&1 || { tail -n 20 "$work/build.log" >&2; fail "the build failed"; }
echo "$(basename "$source") $flags" >"$prefix/BUILD_FLAGS"
echo "build_sundials: $(basename "$source") with $flags in $prefix"
