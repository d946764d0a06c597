# SPDX-License-Identifier: GPL-3.0-or-later
"""Pages of plekton view in a browser without a screen: their own check passes, pictures differ from frame to frame, picking, histories and keys
do what they say, and a page that is served shows its run. The page of the catch is below 3 MB.

Usage: python3 browser_test.py PROGRAM ROOT [--pictures FOLDER]; ends 77 where chromium is missing
"""

import argparse
import contextlib
import html
import http.server
import json
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest
import urllib.request
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "support"))
import browser

SKIPPED = 77
SCENES = {
    "catch": ["apps/examples/catch/catch.toml", "--set", "grains.gravel.count=150", "--set", "simulation.duration=300 ms"],
    "net": ["apps/examples/net/net.toml", "--set", "simulation.duration=80 ms"],
    "pull-out": ["tests/apps/viewer/pull_out.toml"],
}
LARGEST_CATCH = 3_000_000
"""Bytes of the page of the catch."""

PROBE = """<pre id="probe" hidden></pre><script>
(async () => {
  const wait = (ms) => new Promise((done) => setTimeout(done, ms));
  const told = {};
  try {
    while (document.documentElement.dataset.ready !== 'yes') await wait(50);
    const page = window.plekton, key = (key, more = {}) => window.dispatchEvent(new KeyboardEvent('keydown', { key, ...more }));
    await (async () => { %s })();
  } catch (error) { told.error = String(error); }
  document.getElementById('probe').textContent = JSON.stringify(told);
})();
</script>"""
"""Beside a page that is ready: what it does is told as JSON."""

KEYS = """
  key('End'); told.end = page.frame;
  key('ArrowLeft'); told.left = page.frame;
  key('ArrowLeft', { shiftKey: true }); told.ten = page.frame;
  key('Home'); told.home = page.frame;
  key('ArrowRight'); told.right = page.frame;
  for (const [name, press, state] of [
    ['contacts', 'c', () => page.view.settings.contacts.shown], ['slice', 'x', () => page.view.settings.slice.on],
    ['dark', 'd', () => document.documentElement.classList.contains('dark')],
    ['parallel', 'p', () => page.stage.camera === page.stage.orthographic],
    ['histories', 'g', () => !document.querySelector('footer').classList.contains('no-plot')],
    ['settings', 'h', () => !document.querySelector('main').classList.contains('no-panel')],
    ['playing', ' ', () => page.playing !== null]]) {
    const before = state();
    key(press); const pressed = state();
    key(press); told[name] = [before, pressed, state()];
  }
"""

CLICK_ON_NEAREST = """
  await page.goTo(Infinity);
  page.stage.fitCamera();
  const camera = page.stage.camera, box = document.getElementById('canvas').getBoundingClientRect();
  const places = await page.run.array(page.frame, 'grains', 'grains', 'position');
  const ids = await page.run.array(page.frame, 'grains', 'grains', 'id');
  let best = null;
  for (let i = 0; i < places.length / 3; i++) {
    const at = camera.position.clone().set(places[3 * i], places[3 * i + 1], places[3 * i + 2]);
    const distance = at.distanceTo(camera.position);
    if (!best || distance < best.distance) best = { distance, at, id: ids ? ids[i] : i };
  }
  best.at.project(camera);
  const x = box.left + (best.at.x + 1) / 2 * box.width, y = box.top + (1 - best.at.y) / 2 * box.height;
  const canvas = document.getElementById('canvas'), event = { clientX: x, clientY: y, isPrimary: true, button: 0, bubbles: true };
  canvas.dispatchEvent(new PointerEvent('pointerdown', event));
  canvas.dispatchEvent(new PointerEvent('pointerup', event));
  await wait(500);
"""
"""Picks the grain that is nearest to the camera."""

PICK = CLICK_ON_NEAREST + """
  told.nearest = best.id;
  told.picked = page.picked.innerText;
  told.legend_before = document.getElementById('plot').innerText;
  page.picked.querySelector('tr.can').click();
  await wait(3000);
  told.bar = document.getElementById('plot-bar').innerText;
  told.rows = page.histories.plot.data[0].length;
  told.values = page.histories.plot.data[1].filter((v) => v !== null).length;
  key('Escape'); await wait(200);
  told.after = page.view.selected;
"""

NARROW = CLICK_ON_NEAREST + """
  const main = document.querySelector('main'), shown = () => !main.classList.contains('no-panel');
  const row = page.picked.getBoundingClientRect();
  told.width = window.innerWidth;
  told.picked = [shown(), page.picked.innerText.includes('Grain ' + best.id), row.top >= 0 && row.top < window.innerHeight];
  document.getElementById('close-panel').click();
  told.closed = shown();
  document.getElementById('open-panel').click();
  told.opened = shown();
"""

SHORTER = """
  const { header } = page.run;
  await page.goTo(10);
  const lists = [header.frames.filter((_, k) => k % 2 === 0), header.frames.slice(0, 3)];
  told.shown = [];
  page.run.refresh = async () => {
    if (!lists.length) return false;
    page.run.header = { ...header, generation: lists.length, frames: lists.shift() };
    return true;
  };
  while (lists.length) { await page.follow(); told.shown.push([page.frame, page.view.frame, page.run.frames.length]); }
  told.message = document.getElementById('message').textContent;
"""

FOLLOWED = """<script>
(async () => {
  const wait = (ms) => new Promise((done) => setTimeout(done, ms));
  const told = { frames: [], shown: [], histories: [], live: [] };
  try {
    while (document.documentElement.dataset.ready !== 'yes') await wait(50);
    const page = window.plekton, frames = () => page.run.frames.length;
    for (const from = performance.now(); told.frames.length < 3 && performance.now() - from < 60000; await wait(50)) {
      if (told.frames.length && frames() <= told.frames.at(-1)) continue;
      await wait(1000);  // until it is shown, on a busy machine later
      const isShown = () => page.frame === frames() - 1;
      // Histories go on with the frames, and may be ahead of them: rows after the frame before the last one.
      const reach = () => page.histories.plot.data[0].at(-1) > (page.run.frames.at(-2)?.time ?? 0);
      for (const grown = performance.now(); !(isShown() && reach()) && performance.now() - grown < 20000;) await wait(50);
      told.frames.push(frames()); told.shown.push(isShown()); told.histories.push(reach());
      told.live.push(page.run.live);
    }
    told.message = document.getElementById('message').textContent;
  } catch (error) { told.error = String(error); }
  await fetch('/told', { method: 'POST', body: JSON.stringify(told) });
})();
</script>"""
"""Beside a page that follows a run: how many frames it has had, three times as they grow, is told to the server."""

WRONG_SETTINGS = {
    "frame=abc": "frame=abc, expected a number or last",
    "slice=1": "slice=1, expected x, y or z",
    "look=1,2": "look=1,2, expected a direction, three numbers",
    "zoom=0": "zoom=0, expected a number above 0",
    "pick=5": "pick=5, expected two numbers",
    "log=colours": "log=colours, expected some of grains, membranes, contacts",
    "grains=solid": "grains=solid, expected a number from 0 to 1",
    "grains-by=colour": "grains-by=colour, expected one of ",
}
"""Settings in an address that no page has, and what it says of each."""

arguments = None
folder = None


def browse(address, *options):
    """What the browser says of a page."""
    return browser.browse(arguments.browser, address, *options)


def coloured_share(file):
    """The share of the scene (left and top of the page) that is clearly coloured."""
    _, size, rows = browser.pixels(file)
    count = total = 0
    for line in rows[60:440:4]:
        for x in range(120 * size, 700 * size, 4 * size):
            rgb = line[x : x + 3]
            total += 1
            count += max(rgb) - min(rgb) > 40
    return count / total


def told_by(said, name):
    """What a page that was dumped has in a <pre>, as JSON."""
    found = re.search(rf'<pre id="{name}"[^>]*>(.*?)</pre>', said, re.DOTALL)
    return json.loads(html.unescape(found[1]) or "{}")


@contextlib.contextmanager
def started(*command, **more):
    """A program that is asked to end, as Ctrl-C does, when it is not needed any more."""
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, **more)
    try:
        yield process
    finally:
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=60)


def address_of(server):
    """Where plekton view --serve says that it serves; nothing if it cannot."""
    said = ""
    while not (address := re.search(r"http://127\.0\.0\.1:\d+/", said)):
        line = server.stdout.readline()
        said += line
        if "cpp-httplib" in said:
            return None
        assert line, said
    return address[0]


class Between(http.server.ThreadingHTTPServer):
    """Hands on what another server says, with a script at the end of its page, and keeps what that tells."""

    def __init__(self, server, script):
        super().__init__(("127.0.0.1", 0), Handler)
        self.server, self.script, self.told, self.has_told = server, script, None, threading.Event()


class Handler(http.server.BaseHTTPRequestHandler):
    def do_GET(self):
        try:
            with urllib.request.urlopen(self.server.server + self.path.lstrip("/")) as answer:
                code, kind, body = answer.status, answer.headers["Content-Type"], answer.read()
        except urllib.error.HTTPError as error:
            code, kind, body = error.code, error.headers["Content-Type"], error.read()
        if self.path == "/":
            body = body.replace(b"</body>", self.server.script.encode() + b"</body>")
        self.send_response(code)
        self.send_header("Content-Type", kind or "text/plain")
        self.send_header("Content-Length", str(len(body)))
        self.end_headers()
        self.wfile.write(body)

    def do_POST(self):
        self.server.told = json.loads(self.rfile.read(int(self.headers["Content-Length"])))
        self.send_response(204)
        self.end_headers()
        self.server.has_told.set()

    def log_message(self, *_):
        pass


class Pages(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        for name, scenario in SCENES.items():
            cls.view_of_run(name, *scenario)

    @staticmethod
    def view_of_run(name, scenario, *options):
        out = folder / name
        command = [arguments.program, "run", Path(arguments.root) / scenario, "--out", out, "--quiet", *options]
        subprocess.run(command, check=True)
        subprocess.run([arguments.program, "view", out], check=True, stdout=subprocess.DEVNULL)

    def page(self, name):
        return (folder / name / "view.html").as_uri()

    def picture(self, name, address):
        file = folder / f"{name}.png"
        browse(address, "--virtual-time-budget=3000", f"--screenshot={file}")
        if arguments.pictures:
            Path(arguments.pictures).mkdir(parents=True, exist_ok=True)
            shutil.copy(file, arguments.pictures)
        return file

    def probed(self, name, script, *options):
        """What a script tells that runs beside a page."""
        page = folder / name / "probed.html"
        text = (folder / name / "view.html").read_text(encoding="utf-8")
        page.write_text(text.replace("</body>", PROBE % script + "</body>"), encoding="utf-8")
        told = told_by(browse(page.as_uri(), *options, "--virtual-time-budget=20000", "--dump-dom"), "probe")
        self.assertNotIn("error", told)
        return told

    def frames(self, name):
        return json.loads((folder / name / "run.json").read_text())["counts"]["frames"]

    def test_a_page_finds_nothing_wrong_with_itself(self):
        for name in SCENES:
            said = browse(self.page(name) + "#self-check", "--virtual-time-budget=20000", "--dump-dom")
            result = told_by(said, "self-check")
            self.assertTrue(result.get("ok"), result)
            self.assertEqual(result["frames"], self.frames(name))
            self.assertGreater(result["drawn"], 0.005)
            self.assertIn(f"Self-check: all is in order; {self.frames(name)} frames, ", said)

    def test_the_page_of_the_catch_is_small(self):
        self.view_of_run("whole catch", "apps/examples/catch/catch.toml")
        self.assertLess((folder / "whole catch" / "view.html").stat().st_size, LARGEST_CATCH)

    def test_grains_are_seen_where_they_are_shown_only(self):
        shown = coloured_share(self.picture("catch", self.page("catch") + "#frame=3&membranes=0"))
        hidden = coloured_share(self.picture("catch-hidden", self.page("catch") + "#frame=3&membranes=0&grains=0"))
        self.assertGreater(shown, 0.02)
        self.assertLess(hidden, 0.002)

    def test_times_differ(self):
        files = [self.picture(f"net-{frame}", self.page("net") + f"#frame={frame}") for frame in (0, 20, "last")]
        self.assertEqual(len({file.read_bytes() for file in files}), 3)

    def test_keys_do_what_the_help_says(self):
        told = self.probed("pull-out", KEYS)
        last = self.frames("pull-out") - 1
        self.assertEqual([told[k] for k in ("end", "left", "ten", "home", "right")], [last, last - 1, last - 11, 0, 1])
        for name in ("contacts", "slice", "dark", "parallel", "histories", "settings", "playing"):
            before, pressed, again = told[name]
            self.assertNotEqual(before, pressed, name)
            self.assertEqual(before, again, name)

    def test_a_click_picks_a_grain_whose_numbers_have_histories(self):
        told = self.probed("pull-out", PICK)
        self.assertIn(f"Grain {told['nearest']}\n", told["picked"])
        self.assertIn("velocity", told["picked"])
        self.assertIn(f"Grain {told['nearest']}", told["bar"])
        self.assertEqual(told["rows"], self.frames("pull-out"))
        self.assertEqual(told["values"], told["rows"])
        self.assertIsNone(told["after"])

    def test_on_a_narrow_screen_what_is_picked_shows_its_numbers_which_close_without_a_key(self):
        told = self.probed("pull-out", NARROW, "--window-size=500,800")

        self.assertEqual(told["width"], 500)
        self.assertEqual(told["picked"], [True, True, True])
        self.assertFalse(told["closed"])
        self.assertTrue(told["opened"])

    def test_histories_of_measures_can_be_chosen(self):
        told = self.probed("pull-out", "told.files = page.files.map((f) => f.file);")
        self.assertEqual(told["files"], ["energy.csv", "reactions.csv", "planes.csv", "measures/sample.csv"])

    def test_a_page_that_follows_keeps_to_frames_that_are_there(self):
        told = self.probed("pull-out", SHORTER)
        self.assertEqual(told["shown"], [[5, 5, (self.frames("pull-out") + 1) // 2], [2, 2, 3]])
        self.assertEqual(told["message"], "")

    def test_a_served_page_shows_the_run(self):
        with started(arguments.program, "view", folder / "net", "--serve", "0") as server:
            if not (address := address_of(server)):
                self.skipTest("compiled without cpp-httplib")
            dumped = browse(address + "#self-check", "--virtual-time-budget=20000", "--dump-dom")
        result = told_by(dumped, "self-check")
        self.assertTrue(result.get("ok"), result)
        self.assertEqual(result["frames"], self.frames("net"))

    def test_a_served_page_that_stays_open_grows_with_the_run(self):
        out = folder / "growing"
        catch = [Path(arguments.root) / SCENES["catch"][0], "--set", "grains.gravel.count=60", "--set", "output.interval=5 ms"]
        with contextlib.ExitStack() as stack:
            stack.enter_context(started(arguments.program, "run", *catch, "--out", out, "--quiet", "--threads", "1"))
            for _ in range(600):
                if (out / "grains.pvd").exists():
                    break
                time.sleep(0.1)
            if not (address := address_of(stack.enter_context(started(arguments.program, "view", out, "--serve", "0")))):
                self.skipTest("compiled without cpp-httplib")
            between = stack.enter_context(Between(address, FOLLOWED))
            stack.callback(between.shutdown)
            threading.Thread(target=between.serve_forever, daemon=True).start()
            profile = stack.enter_context(tempfile.TemporaryDirectory(ignore_cleanup_errors=True))
            stack.enter_context(started(*browser.command(arguments.browser, profile), "--remote-debugging-port=0",
                                        f"http://127.0.0.1:{between.server_port}/"))
            self.assertTrue(between.has_told.wait(120), "the page tells nothing")
        told = between.told
        self.assertNotIn("error", told)
        self.assertEqual(len(told["frames"]), 3, told)
        self.assertEqual(sorted(set(told["frames"])), told["frames"])
        for claim in "shown", "histories", "live":
            self.assertEqual(told[claim], [True] * 3, claim)
        self.assertEqual(told["message"], "")

    def test_settings_in_the_address_that_are_none_are_told_and_left_out(self):
        address = self.page("pull-out") + "#" + "&".join(WRONG_SETTINGS)

        said = html.unescape(browse(address, "--virtual-time-budget=10000", "--dump-dom"))

        self.assertIn('data-ready="yes"', said)
        for told in WRONG_SETTINGS.values():
            self.assertIn("The address says " + told, said)

    def test_a_page_that_is_cut_off_says_so(self):
        whole = (folder / "net" / "view.html").read_bytes()
        # The beginning with the code of the page, and a block less.
        at = whole.index(b'<script type="text/plain" id="block-3"')
        (folder / "net" / "cut.html").write_bytes(whole[:at] + whole[whole.index(b"</script>", at) + 9 :])
        said = browse(
            (folder / "net" / "cut.html").as_uri() + "#frame=3", "--virtual-time-budget=5000", "--dump-dom"
        )
        self.assertIn("The run cannot be shown: block 3 is missing", said)


def main():
    global arguments, folder
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("root")
    parser.add_argument("--pictures", help="folder to keep the pictures in")
    arguments = parser.parse_args()
    arguments.browser = shutil.which("chromium")
    if arguments.browser is None:
        print("skipped: needs chromium (Debian: chromium)")
        return SKIPPED
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        return 0 if unittest.main(argv=sys.argv[:1], exit=False).result.wasSuccessful() else 1


if __name__ == "__main__":
    sys.exit(main())
