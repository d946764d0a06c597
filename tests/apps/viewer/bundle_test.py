# SPDX-License-Identifier: GPL-3.0-or-later
"""The page that is compiled in is what its sources make: apps/viewer/web/dist against a fresh build.

Usage: python3 bundle_test.py ROOT; ends 77 where node or what npm installs is missing
"""

import filecmp
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

SKIPPED = 77


def main():
    web = Path(sys.argv[1]) / "apps" / "viewer" / "web"
    node = shutil.which("node")
    if node is None or not (web / "node_modules" / "esbuild").is_dir():
        print(f"skipped: needs node, and the packages of {web} (npm ci there)")
        return SKIPPED
    with tempfile.TemporaryDirectory() as fresh:
        subprocess.run([node, "build.mjs", fresh], cwd=web, check=True)
        names = sorted(path.name for path in Path(fresh).iterdir())
        committed = sorted(path.name for path in (web / "dist").iterdir())
        _, differ, missing = filecmp.cmpfiles(fresh, web / "dist", names, shallow=False)
    for name in differ + missing:
        print(f"{web}/dist/{name} is not what the sources make: run npm ci && npm run build there")
    if names != committed:
        print(f"{web}/dist holds {committed}, expected {names}")
    return 1 if differ or missing or names != committed else 0


if __name__ == "__main__":
    sys.exit(main())
