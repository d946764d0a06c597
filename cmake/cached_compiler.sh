#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Calls a compiler through ccache: sh cached_compiler.sh CCACHE COMPILER ARGUMENTS...
#
# ccache takes what is precompiled already, where it is there, for the headers that it was made of, also when it is to be made anew
# because these have changed: it is removed before.
set -eu
export CCACHE_SLOPPINESS=pch_defines,time_macros
made=
before=
for argument; do
  if [ "$before" = -o ]; then
    made=$argument
  fi
  before=$argument
done
case $made in
  *.gch | *.pch) rm -f -- "$made" ;;
esac
exec "$@"
