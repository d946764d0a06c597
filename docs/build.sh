#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Builds the site, without a network and without warnings, and with Doxygen the interface in C++ as its folder api.
# Pictures of the tutorials are those that the test docs.tutorials of this build has made, if it has, or the copies that are kept.
# Usage: sh docs/build.sh [PROGRAM [FOLDER]]: of build/release/apps/plekton, to build/site
set -eu
cd "$(dirname "$0")/.."
program=${1:-build/release/apps/plekton}
site=${2:-build/site}
python=/usr/bin/python3  # Debian's, which has Debian's Sphinx
pages=$site.pages

if [ ! -x "$program" ]; then
  echo "$program is missing; build it first (sh apps/quickstart.sh), or name another" >&2
  exit 1
fi
PLEKTON_VERSION=$("$program" --version)
export PLEKTON_VERSION
"$python" -B docs/gather.py "$program" . "$pages" "$(dirname "$program")/../tutorials"
"$python" -m sphinx -W --keep-going -q -b html -d "$site.doctrees" "$pages" "$site"
if command -v doxygen > /dev/null; then
  sh docs/api.sh "$site/api" "$PLEKTON_VERSION"
else
  echo "the interface in C++ is left out: doxygen is missing" >&2
fi
# Nothing may be loaded from elsewhere; links to elsewhere may be there.
if grep -rlE '<(script|img|iframe)[^>]* src="(https?:)?//|<link[^>]* href="(https?:)?//|url\((["'"'"']?)(https?:)?//' "$site" --include='*.html' --include='*.css'; then
  echo "these pages load something from outside" >&2
  exit 1
fi
echo "wrote $site/index.html"
