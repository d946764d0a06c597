#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Lints the Debian packages and tries each by itself in a fresh Debian 12: the program, a C++ program that is built against
# the library, the Python module, the manual page, the documentation; and that nothing is left when they are removed.
# Run on request, as root, after cmake/packages/build.sh; needs mmdebstrap, lintian, dpkg-dev, and a mirror of Debian.
# Usage: sh tests/packages/check.sh [FOLDER], of build/packages
set -eu
CDPATH='' cd -- "$(dirname -- "$0")/../.."
. cmake/debian.sh
packages=${1:-build/packages}

# stop TEXT: ends the check.
stop() {
  echo "$*" >&2
  exit 1
}

[ "$(id -u)" -eq 0 ] || stop "run it as root: it changes into a root of its own"
for tool in mmdebstrap lintian dpkg-scanpackages; do
  command -v "$tool" > /dev/null || stop "$tool is missing (Debian: mmdebstrap lintian dpkg-dev)"
done
ls "$packages"/plekton_*.deb > /dev/null 2>&1 || stop "$packages has no packages; run sh cmake/packages/build.sh first"

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
base=build/debian-12.tar

say "Linting"
lintian --allow-root --fail-on error "$packages"/*.deb

if [ ! -e "$base" ]; then
  say "Making a Debian 12, once: $base"
  mmdebstrap --quiet --variant=apt bookworm "$folder/base.tar" http://deb.debian.org/debian
  mv "$folder/base.tar" "$base"
fi
mkdir "$folder/packages" "$folder/archives"
cp "$packages"/*.deb "$folder/packages"
(cd "$folder/packages" && dpkg-scanpackages --multiversion . 2> /dev/null > Packages)

# in_root COMMAND...: runs it in the root, with a /proc that is gone with it; its words only if it fails.
in_root() {
  if ! LC_ALL=C.UTF-8 DEBIAN_FRONTEND=noninteractive unshare --mount --pid --fork --mount-proc="$root/proc" \
      chroot "$root" "$@" > "$folder/said" 2>&1 < /dev/null; then
    tail -n 40 "$folder/said" >&2
    stop "failed: $*"
  fi
}

# fresh_root PACKAGE...: a new root with these installed, and what they ask for.
fresh_root() {
  root=$folder/root
  rm -rf "$root"
  mkdir "$root"
  tar -xf "$base" -C "$root"
  cp -r "$folder/packages" "$root/packages"
  echo 'deb [trusted=yes] file:/packages ./' > "$root/etc/apt/sources.list.d/plekton.list"
  cp "$folder"/archives/*.deb "$root/var/cache/apt/archives" 2> /dev/null || true
  echo 'APT::Keep-Downloaded-Packages "true";' > "$root/etc/apt/apt.conf.d/keep"
  in_root apt-get -q update
  in_root apt-get -q install -y --no-install-recommends "$@"
  cp "$root"/var/cache/apt/archives/*.deb "$folder/archives"
}

# expect_nothing_left: after all packages of ours are removed no file of them is there.
expect_nothing_left() {
  in_root sh -c 'apt-get -q purge -y $(dpkg-query -W -f "\${Package}\n" | grep plekton)'
  left=$(find "$root/usr" "$root/etc" -name '*plekton*' ! -path '*/apt/*')
  [ -z "$left" ] || stop "left after the packages were removed: $left"
}

say "plekton"
fresh_root plekton man-db
in_root plekton --version
in_root sh -c 'cd /tmp && plekton new first.toml && plekton check first.toml && plekton run first.toml --out out --set simulation.duration="20 ms"'
in_root sh -c 'cd /tmp && test -s out/run.json && plekton view out && test -s out/view.html'
in_root sh -c 'plekton examples | grep catch && cd /tmp && plekton examples net && plekton check net/net.toml'
in_root sh -c 'man plekton | grep "PLEKTON(1)"'
in_root bash -c '. /usr/share/bash-completion/completions/plekton && complete -p plekton'
expect_nothing_left

say "libplekton-dev"
fresh_root libplekton-dev cmake make g++ pkg-config
mkdir "$root/tmp/user"
cp apps/examples/first_steps.cpp "$root/tmp/user"
cat > "$root/tmp/user/CMakeLists.txt" << 'END'
cmake_minimum_required(VERSION 3.24)
project(user CXX)
find_package(plekton CONFIG REQUIRED COMPONENTS dynamics)
add_executable(first_steps first_steps.cpp)
target_link_libraries(first_steps PRIVATE plekton::dynamics)
END
in_root sh -c 'cd /tmp/user && cmake -B build && cmake --build build && build/first_steps | tee said && grep "height" said'
in_root sh -c 'cd /tmp/user && g++ first_steps.cpp $(pkg-config --cflags --libs plekton) -o by_pkg_config && ./by_pkg_config | cmp - said'
expect_nothing_left

say "python3-plekton"
fresh_root python3-plekton
cp apps/examples/catch/catch.toml apps/examples/catch/hammock.stl "$root/tmp"
in_root python3 -c 'import plekton; sim = plekton.load("/tmp/catch.toml"); sim.run(until=1e-3); assert sim.positions.shape[1] == 3 and sim.time >= 1e-3'
expect_nothing_left

say "plekton-doc"
fresh_root plekton-doc
for page in index.html tutorials/01-first-run.html reference/scenario.html api/index.html; do
  [ -s "$root/usr/share/doc/plekton-doc/html/$page" ] || stop "plekton-doc has no $page"
done
in_root sh -c 'test -z "$(find /usr/share/doc/plekton-doc -xtype l | tee /dev/stderr)"'
expect_nothing_left

say "All packages are sound"
