#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Writes the interface in C++ from the headers with Doxygen; a warning is an error.
# Usage: sh docs/api.sh [FOLDER [VERSION]], to build/site/api
set -eu
cd "$(dirname "$0")/.."
folder=${1:-build/site/api}
mkdir -p "$folder"
sed -e "s|@VERSION@|${2:-}|" -e "s|@OUTPUT@|$folder|" docs/Doxyfile.in | doxygen -
