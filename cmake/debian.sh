# SPDX-License-Identifier: GPL-3.0-or-later
# Functions for the scripts of the project, read with `.` from the root of the tree. POSIX sh.

# say TEXT: tell the user what happens.
say() {
  printf '\n==> %s\n' "$*"
}

# packages_for USE...: the packages of cmake/debian-packages.txt for these uses, one a line.
packages_for() {
  for use in "$@"; do
    awk -v use="$use" '$1 == use { print $2 }' cmake/debian-packages.txt
  done
}

# stop_and_name USE... : ends the script with 1 after naming the packages for these uses, each with its reason.
stop_and_name() {
  echo "Plekton installs packages by itself on Debian 12 only. It needs, under Debian's names:" >&2
  for use in "$@"; do
    sed -n "s/^$use  */  /p" cmake/debian-packages.txt >&2
  done
  echo "With these installed: cmake --preset release && cmake --build --preset release" >&2
  exit 1
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

# need_packages USE...: installs what is missing for these uses; where that cannot be done, names it and ends with 1.
need_packages() {
  if ! command -v apt-get > /dev/null || ! command -v dpkg-query > /dev/null; then
    stop_and_name "$@"
  fi
  # One word a package, here and below.
  # shellcheck disable=SC2046
  missing=$(missing_packages $(packages_for "$@") | tr '\n' ' ')
  if [ -z "$missing" ]; then
    say "All packages are installed"
    return
  fi
  say "Installing: $missing"
  # shellcheck disable=SC2086
  if ! { apt_get update && apt_get install -y --no-install-recommends $missing; }; then
    stop_and_name "$@"
  fi
}
