"""A page in headless Chromium: a script at its end says what it finds, and errors of the page are part of that."""

import json
import re
import shutil
import subprocess

CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
WATCH = "<script>window.faults = []; addEventListener('error', (e) => faults.push(String(e.message))); " \
        "console.error = (...a) => faults.push(a.join(' '));</script>"
# `picture(name, changes)` keeps the canvas as base64, the top row first; `out` is what is found.
SCRIPT = """<script>
tilepackView.started.then(async () => {
  const { state, gl, draw, placeAt } = tilepackView, canvas = gl.canvas, out = { pictures: {} };
  if (gl.getError()) faults.push('an error of WebGL while the page opened');
  canvas.style.width = canvas.style.height = 'SIDEpx';
  const picture = (name, changes) => {
    Object.assign(state, changes);
    draw();
    const pixels = new Uint8Array(4 * SIDE * SIDE);
    gl.readPixels(0, 0, SIDE, SIDE, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
    let text = '';
    for (let y = SIDE - 1; y >= 0; --y) text += String.fromCharCode(...pixels.subarray(4 * SIDE * y, 4 * SIDE * (y + 1)));
    out.pictures[name] = btoa(text);
  };
  BODY
  if (gl.getError()) faults.push('an error of WebGL');
  out.wide = document.documentElement.scrollWidth > innerWidth;
  out.faults = faults;
  document.body.textContent = 'RESULT' + JSON.stringify(out) + 'END';
}).catch((e) => { document.body.textContent = 'RESULT' + JSON.stringify({ faults: [String(e)] }) + 'END'; });
</script>"""


def found_in_page(case, name, side, body):
    """What `body` found in the page `name` of a test's folder, whose canvas is `side` pixels wide and high."""
    with open(case.path(name), encoding="utf-8") as file:
        page = file.read().replace("<style>", WATCH + "<style>", 1)
    case.write(name, page.replace("</body>", SCRIPT.replace("BODY", body).replace("SIDE", str(side)) + "</body>"))
    done = subprocess.run(
        [CHROMIUM, "--headless=new", "--no-sandbox", "--disable-gpu-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
         "--window-size=500,400", "--user-data-dir=" + case.path("profile"), "--virtual-time-budget=20000", "--dump-dom",
         "file://" + case.path(name)],
        capture_output=True, text=True, check=False, timeout=300)
    found = re.search(r"RESULT(.*)END", done.stdout, re.DOTALL)
    case.assertIsNotNone(found, done.stdout[-2000:] + done.stderr[-2000:])
    result = json.loads(found.group(1).replace("&amp;", "&").replace("&lt;", "<").replace("&gt;", ">"))
    case.assertEqual(result["faults"], [])
    return result
