# SPDX-License-Identifier: GPL-3.0-or-later
"""Says which lines of some folders the tests have run, and names those that they have not.

    python3 tests/coverage/report.py BUILD FOLDER... [--least PERCENT]

BUILD is a build with `--coverage` (preset `coverage`) whose tests have run. A line that is compiled in several places, as those of headers and
templates are, has run if it has run in one of them. Lines of FOLDER that no object of BUILD knows, as of a header that nobody includes, do not
count. Ends with 1 where a folder has less than --least percent.
"""

import argparse
import json
import os
import subprocess
import sys
from collections import defaultdict
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def counts_of(note, root, folders):
    """Runs by line, by file relative to the root, of one object (its .gcno)."""
    text = subprocess.run(["gcov", "--json-format", "--stdout", str(note)], cwd=note.parent, check=True, capture_output=True).stdout
    counts = {}
    for line in text.splitlines():
        report = json.loads(line)
        for file in report["files"]:
            path = Path(os.path.normpath(Path(report["current_working_directory"]) / file["file"]))
            if not path.is_relative_to(root) or path.relative_to(root).parts[0] not in folders:
                continue
            lines = counts.setdefault(str(path.relative_to(root)), defaultdict(int))
            for entry in file["lines"]:
                lines[entry["line_number"]] += entry["count"]
    return counts


def merged(build, root, folders):
    """The same of all objects of a build together."""
    notes = sorted(build.rglob("*.gcno"))
    if not notes:
        sys.exit(f"{build}: no object was compiled with --coverage; expected some: cmake --preset coverage makes such a build")
    total = defaultdict(lambda: defaultdict(int))
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        for counts in pool.map(lambda note: counts_of(note, root, folders), notes):
            for file, lines in counts.items():
                for line, count in lines.items():
                    total[file][line] += count
    return total


def ranges(lines):
    """[3, 4, 5, 9] as "3-5, 9"."""
    parts = []
    for line in sorted(lines):
        if parts and parts[-1][1] == line - 1:
            parts[-1][1] = line
        else:
            parts.append([line, line])
    return ", ".join(str(a) if a == b else f"{a}-{b}" for a, b in parts)


def share(lines):
    return 100.0 * sum(count > 0 for count in lines) / len(lines) if lines else 100.0


def report(total, folders, least):
    """The text, and the folders with less than that many percent."""
    text, poor = [], []
    for folder in folders:
        files = {file: lines for file, lines in total.items() if Path(file).parts[0] == folder}
        percent = share([count for lines in files.values() for count in lines.values()])
        number = sum(len(lines) for lines in files.values())
        text.append(f"{folder}: {percent:.1f} % of {number} lines in {len(files)} files")
        if percent < least or not number:
            poor.append(folder)
        for file, lines in sorted(files.items(), key=lambda entry: (share(entry[1].values()), entry[0])):
            missing = [line for line, count in lines.items() if count == 0]
            if missing:
                text.append(f"  {share(lines.values()):5.1f} %  {file}: not run: {ranges(missing)}")
    return "\n".join(text), poor


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("build", type=Path)
    parser.add_argument("folders", nargs="+")
    parser.add_argument("--least", type=float, default=0.0, help="percent of the lines of each folder")
    parser.add_argument("--root", type=Path, default=ROOT, help="of the sources")
    arguments = parser.parse_args()
    root = arguments.root.resolve()
    text, poor = report(merged(arguments.build.resolve(), root, arguments.folders), arguments.folders, arguments.least)
    print(text)
    if poor:
        sys.exit(f"less than {arguments.least:g} % of the lines have run: {', '.join(poor)}")


if __name__ == "__main__":
    main()
