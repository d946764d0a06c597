#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# On a system that is not Debian 12 both commands end with 1, name every package that they need, and install nothing; with
# all packages there they go on, and on Debian 12 they install what is missing.
# Usage: sh other_system_test.sh ROOT
set -eu
root=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
bin=$folder/bin
mkdir "$bin"
for tool in awk date dirname sed tr; do
  ln -s "$(command -v "$tool")" "$bin/$tool"
done
shell=$(command -v sh)

fail() {
  echo "$*"
  exit 1
}

# add_tool NAME LINE...: a program that says that it was called, and does these lines of shell.
add_tool() {
  name=$1
  shift
  {
    echo "#!$shell"
    echo "echo called $name \"\$@\" >> $folder/calls"
    printf '%s\n' "$@"
  } > "$bin/$name"
  chmod +x "$bin/$name"
}

# run SCRIPT SYSTEM: the script from another folder, with nothing but these tools; its words in $said, its end in $status.
run() {
  status=0
  : > "$folder/calls"
  said=$(cd / && PATH=$bin PLEKTON_OS_RELEASE=$folder/$2 "$shell" "$root/$1" 2>&1) || status=$?
}

# expect_names SCRIPT USES: it ended with 1 after naming the packages for these uses.
expect_names() {
  [ "$status" -eq 1 ] || fail "$1 ended with $status, expected 1: $said"
  for package in $(awk -v uses="$2" 'index(uses, $1) && $1 !~ /^#/ { print $2 }' "$root/cmake/debian-packages.txt"); do
    case $said in
      *"  $package "*) ;;
      *) fail "$1 does not name $package: $said" ;;
    esac
  done
  if grep -q "called apt-get" "$folder/calls"; then fail "$1 called apt-get: $(cat "$folder/calls")"; fi
}

# expect_call SCRIPT PATTERN: a tool was called like this.
expect_call() {
  grep -q "called $2" "$folder/calls" || fail "$1 did not call $2, but: $(cat "$folder/calls"); it said: $said"
}

printf 'PRETTY_NAME="Fedora Linux 40"\nID=fedora\nVERSION_ID=40\n' > "$folder/fedora"
printf 'PRETTY_NAME="Ubuntu 24.04"\nID=ubuntu\nID_LIKE=debian\nVERSION_ID="24.04"\n' > "$folder/ubuntu"
printf 'PRETTY_NAME="Debian 13"\nID=debian\nVERSION_ID="13"\n' > "$folder/debian13"
printf 'PRETTY_NAME="Debian 12"\nID=debian\nVERSION_ID="12"\n' > "$folder/debian12"

check() {
  rm -f "$bin/dpkg-query" "$bin/apt-get"
  run "$1" fedora
  expect_names "$1" "$2"
  case $said in
    *"Fedora Linux 40"*) ;;
    *) fail "$1 does not name the system: $said" ;;
  esac

  add_tool apt-get "exit 3"
  add_tool dpkg-query "exit 1"  # nothing is installed
  for system in ubuntu debian13 nowhere; do
    run "$1" "$system"
    expect_names "$1" "$2"
  done
  run "$1" debian12
  expect_call "$1" "apt-get -q update"

  add_tool dpkg-query "echo installed"
  run "$1" ubuntu
  expect_call "$1" "cmake --preset release"
}

ln -s "$(command -v id)" "$bin/id"
add_tool sudo 'while [ "${1#*=}" != "$1" ]; do shift; done; exec "$@"'
add_tool cmake "exit 7"
check apps/quickstart.sh "build"
check tests/run.sh "build python test"
echo "both commands name their packages and end with 1 where they cannot install them"
