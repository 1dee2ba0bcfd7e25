"""How long the page of `tilepack view` takes to open in Chromium, and how it looks at some sizes.

    python3 tests/bench/view_opening.py PAGE.html FOLDER

Prints milliseconds from the start of loading to the first picture, on SwiftShader, and what was said on the console; FOLDER takes pictures:
from above, in flight, tinted, and all of them 400 pixels wide too. Chromium is driven by its own protocol through a pipe."""

import base64
import json
import os
import shutil
import subprocess
import sys
import tempfile

VIEWS = {"above": "", "flight": "#fly=1&height=1.2&pitch=25&relief=0.5", "borders": "#tint=borders&zoom=0.6", "levels": "#fly=1&height=2&tint=levels",
         "repeats": "#tint=repeats&zoom=0.6"}


class Browser:
    def __init__(self, folder):
        program = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
        if not program:
            sys.exit("no chromium")
        to_browser, self.to = os.pipe()
        self.back, from_browser = os.pipe()
        command = [program, "--headless=new", "--no-sandbox", "--disable-gpu-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
                   "--user-data-dir=" + folder, "--remote-debugging-pipe", "about:blank"]
        # Chromium reads from descriptor 3 and writes to 4.
        script = f'exec "$@" 3<&{to_browser} 4>&{from_browser}'
        self.process = subprocess.Popen(["sh", "-c", script, "sh", *command], pass_fds=(to_browser, from_browser), stdout=subprocess.DEVNULL,
                                        stderr=subprocess.DEVNULL)
        os.close(to_browser)
        os.close(from_browser)
        self.number, self.rest, self.said, self.session = 0, b"", [], None
        target = self.ask("Target.createTarget", url="about:blank")["targetId"]
        self.session = self.ask("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Log"):
            self.ask(domain + ".enable")

    def message(self):
        while b"\0" not in self.rest:
            part = os.read(self.back, 1 << 20)
            if not part:
                sys.exit("Chromium ended")
            self.rest += part
        text, self.rest = self.rest.split(b"\0", 1)
        message = json.loads(text)
        if message.get("method") in ("Runtime.exceptionThrown", "Runtime.consoleAPICalled", "Log.entryAdded"):
            self.said.append(json.dumps(message["params"])[:300])
        return message

    def ask(self, method, **parameters):
        self.number += 1
        request = {"id": self.number, "method": method, "params": parameters}
        if self.session:
            request["sessionId"] = self.session
        os.write(self.to, json.dumps(request).encode() + b"\0")
        while True:
            message = self.message()
            if message.get("id") == self.number:
                if "error" in message:
                    sys.exit(f"{method}: {message['error']}")
                return message["result"]

    def value(self, expression):
        return self.ask("Runtime.evaluate", expression=expression, awaitPromise=True, returnByValue=True)["result"].get("value")

    def open(self, address, width, height):
        """Milliseconds to the first picture."""
        self.ask("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=width < 500)
        self.ask("Page.navigate", url="about:blank")
        self.ask("Page.navigate", url=address)
        while not self.value("!!window.tilepackView"):
            pass
        # Reading a pixel back waits for the picture; browsers' finish() doesn't.
        return self.value("tilepackView.started.then(() => { const { gl } = tilepackView; "
                          "gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4)); return performance.now(); })")

    def picture(self, path):
        with open(path, "wb") as file:
            file.write(base64.b64decode(self.ask("Page.captureScreenshot", format="png")["data"]))

    def close(self):
        self.ask("Browser.close")
        self.process.wait(20)


def main():
    page, folder = os.path.abspath(sys.argv[1]), sys.argv[2]
    os.makedirs(folder, exist_ok=True)
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as profile:
        browser = Browser(profile)
        times = sorted(browser.open("file://" + page, 900, 600) for _ in range(5))
        print(f"opens in {times[0]:.0f} to {times[-1]:.0f} ms, median {times[2]:.0f}")
        for name, place in VIEWS.items():
            for width, height in ((900, 600), (400, 700)):
                browser.open("file://" + page + place, width, height)
                if name == "repeats":  # of the tile under the pointer
                    browser.ask("Input.dispatchMouseEvent", type="mouseMoved", x=width // 2, y=height // 2)
                browser.value("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")
                browser.picture(os.path.join(folder, f"{name}_{width}.png"))
                if browser.value("document.documentElement.scrollWidth > innerWidth"):
                    print(f"{name}: wider than {width} pixels")
        print("console:", browser.said or "nothing")
        browser.close()


if __name__ == "__main__":
    main()
