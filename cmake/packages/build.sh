#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Installs what is missing (Debian 12, as root or with sudo), builds, and writes the Debian packages to build/packages.
# DEBFULLNAME and DEBEMAIL in the environment say who stands for them; SOURCE_DATE_EPOCH sets their date.
set -eu
CDPATH='' cd -- "$(dirname -- "$0")/../.."
. cmake/debian.sh

need_packages build python doc package
if [ -z "${SOURCE_DATE_EPOCH:-}" ] && SOURCE_DATE_EPOCH=$(git log -1 --format=%ct 2> /dev/null); then
  export SOURCE_DATE_EPOCH  # the same commit makes the same packages
fi
say "Configuring build/package"
cmake --preset package
say "Building"
cmake --build --preset package --parallel "$(nproc)"
say "Writing the documentation"
sh docs/build.sh build/package/apps/plekton build/package/site
say "Packing"
rm -rf build/packages
cpack --config build/package/CPackConfig.cmake -B build/packages
rm -rf build/packages/_CPack_Packages
say "Written; apt-get install ./build/packages/plekton_*.deb ./build/packages/libplekton0*.deb installs the program"
ls -l build/packages
