# SPDX-License-Identifier: GPL-3.0-or-later
# shellcheck shell=sh
# Functions for the scripts of the project, read with `.` from the root of the tree. POSIX sh.

# say TEXT: tell the user what happens.
say() {
  printf '\n==> %s\n' "$*"
}

# seconds_since START: of `date +%s`.
seconds_since() {
  echo $(($(date +%s) - $1))
}

# packages_for USE...: the packages of cmake/debian-packages.txt for these uses, one a line.
packages_for() {
  for use in "$@"; do
    awk -v use="$use" '$1 == use { print $2 }' cmake/debian-packages.txt
  done
}

# stop_and_name USE... : ends the script with 1 after naming the packages for these uses, each with its reason.
stop_and_name() {
  echo "This is $(system_name). Plekton installs packages by itself on Debian 12 only. It needs, under Debian's names:" >&2
  for use in "$@"; do
    sed -n "s/^$use  */  /p" cmake/debian-packages.txt >&2
  done
  echo "With these installed: cmake --preset release && cmake --build --preset release" >&2
  exit 1
}

# The file that names the system; see os-release(5).
os_release=${PLEKTON_OS_RELEASE:-/etc/os-release}

# os_value KEY: the value of a key of that file, without quotes; nothing where there is none.
os_value() {
  [ -r "$os_release" ] || return 0
  awk -F= -v key="$1" '$1 == key { gsub(/["\047]/, "", $2); print $2; exit }' "$os_release"
}

# system_name: what the system calls itself.
system_name() {
  name=$(os_value PRETTY_NAME)
  echo "${name:-a system without a name in $os_release}"
}

# is_debian_12: whether packages can be installed under the names that are known here.
is_debian_12() {
  [ "$(os_value ID)" = debian ] && [ "$(os_value VERSION_ID)" = 12 ] && command -v apt-get > /dev/null
}

# missing_packages PACKAGE...: those that are not installed, one a line.
missing_packages() {
  for package in "$@"; do
    status=$(dpkg-query -W -f '${db:Status-Status}' "$package" 2> /dev/null) || status=none
    [ "$status" = installed ] || echo "$package"
  done
}

# apt_get ARGUMENTS...: apt-get without questions, as root, by sudo where needed.
apt_get() {
  if [ "$(id -u)" -eq 0 ]; then
    DEBIAN_FRONTEND=noninteractive apt-get -q "$@" < /dev/null
  elif command -v sudo > /dev/null; then
    sudo DEBIAN_FRONTEND=noninteractive apt-get -q "$@" < /dev/null
  else
    echo "Neither root nor sudo: cannot run apt-get $*" >&2
    return 1
  fi
}

# need_packages USE...: installs what is missing for these uses on Debian 12; elsewhere, or where that cannot be done,
# names it and ends with 1. A system that is made of Debian packages and has them all may go on.
need_packages() {
  if ! command -v dpkg-query > /dev/null; then
    stop_and_name "$@"
  fi
  # One word a package, here and below.
  # shellcheck disable=SC2046
  missing=$(missing_packages $(packages_for "$@") | tr '\n' ' ')
  if [ -z "$missing" ]; then
    say "All packages are installed"
    return
  fi
  is_debian_12 || stop_and_name "$@"
  say "Installing: $missing"
  # shellcheck disable=SC2086
  if ! { apt_get update && apt_get install -y --no-install-recommends $missing; }; then
    stop_and_name "$@"
  fi
}
