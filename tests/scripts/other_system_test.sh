#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# On a system without apt-get both commands end with 1 and name every package that they need.
# Usage: sh other_system_test.sh ROOT
set -eu
root=$1
bin=$(mktemp -d)
trap 'rm -rf "$bin"' EXIT
for tool in awk dirname sed tr; do
  ln -s "$(command -v "$tool")" "$bin/$tool"
done
shell=$(command -v sh)

# check SCRIPT USES: the script, run from another folder, with nothing but the tools above.
check() {
  status=0
  said=$(cd / && PATH=$bin "$shell" "$root/$1" 2>&1) || status=$?
  [ "$status" -eq 1 ] || { echo "$1 ended with $status, expected 1: $said"; exit 1; }
  for package in $(awk -v uses="$2" 'index(uses, $1) && $1 !~ /^#/ { print $2 }' "$root/cmake/debian-packages.txt"); do
    case $said in
      *"  $package "*) ;;
      *) echo "$1 does not name $package: $said"; exit 1 ;;
    esac
  done
}

check apps/quickstart.sh "build"
check tests/run.sh "build test"
echo "both commands name their packages and end with 1"
