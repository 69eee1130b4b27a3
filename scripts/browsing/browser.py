"""Chromium without a screen, spoken to by its debugging protocol, and the program whose page it shows."""
import base64
import json
import os
import subprocess
import sys
import time
import urllib.request
from pathlib import Path

sys.path.append("/usr/lib/python3/dist-packages")
import websocket  # noqa: E402

LAPTOP = (1366, 768)
PHONE = (390, 844)


class Browser:
    def __init__(self, folder):
        self.process = subprocess.Popen(
            # Without a graphics card: WebGL in software, the rest of the page put together as a picture.
            ["chromium", "--headless", "--no-sandbox", "--disable-gpu-compositing", "--use-gl=angle", "--use-angle=swiftshader",
             "--enable-unsafe-swiftshader", "--remote-debugging-port=0", f"--user-data-dir={folder}",
             "--no-first-run", "--disable-background-networking", "about:blank"],
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        port_file = Path(folder) / "DevToolsActivePort"
        wait_for(lambda: port_file.exists() and port_file.read_text().count("\n") >= 1, "Chromium")
        port = port_file.read_text().split()[0]
        pages = json.load(urllib.request.urlopen(f"http://127.0.0.1:{port}/json"))
        page = next(p for p in pages if p["type"] == "page")
        self.socket = websocket.create_connection(page["webSocketDebuggerUrl"], suppress_origin=True, timeout=60)
        self.next_id = 0
        self.problems = []
        # Not "Network": it would report every frame of the stream, and slow what is measured here.
        for domain in ("Runtime", "Log", "Page"):
            self.call(f"{domain}.enable")
        self.downloads = Path(folder) / "downloads"
        self.downloads.mkdir()
        self.call("Page.setDownloadBehavior", behavior="allow", downloadPath=str(self.downloads))
        self.resize(LAPTOP)

    def note(self, event):
        method, details = event.get("method"), event.get("params", {})
        if method == "Runtime.exceptionThrown":
            self.problems.append(details["exceptionDetails"].get("exception", {}).get("description", str(details)))
        if method == "Runtime.consoleAPICalled" and details["type"] in ("error", "warning", "assert"):
            self.problems.append(" ".join(str(a.get("value")) for a in details["args"]))
        if method == "Log.entryAdded" and details["entry"]["level"] == "error":
            self.problems.append(f'{details["entry"]["text"]} {details["entry"].get("url", "")}')

    def call(self, method, **params):
        self.next_id += 1
        self.socket.send(json.dumps({"id": self.next_id, "method": method, "params": params}))
        while True:
            answer = json.loads(self.socket.recv())
            if answer.get("id") == self.next_id:
                return answer.get("result", {})
            self.note(answer)

    def value(self, expression, wait=False):
        answer = self.call("Runtime.evaluate", expression=expression, returnByValue=True, awaitPromise=wait)
        if "exceptionDetails" in answer:
            sys.exit(f"check-page: {expression[:200]}: {answer['exceptionDetails'].get('exception', answer)}")
        return answer["result"].get("value")

    def resize(self, size):
        phone = size == PHONE
        self.call("Emulation.setDeviceMetricsOverride", width=size[0], height=size[1], deviceScaleFactor=1, mobile=phone)
        self.call("Emulation.setTouchEmulationEnabled", enabled=phone, maxTouchPoints=2)
        time.sleep(0.6)

    def scheme(self, name):
        self.call("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": name}])
        time.sleep(0.2)

    # A key, as "a", "Tab", "ArrowLeft" or " ".
    def key(self, key):
        details = {"key": key}
        if len(key) == 1:
            details["text"] = key
        codes = {"Tab": 9, "Enter": 13, "Escape": 27, " ": 32, "ArrowLeft": 37, "ArrowUp": 38, "ArrowRight": 39, "ArrowDown": 40}
        if key in codes:
            details["windowsVirtualKeyCode"] = codes[key]
        if key == "Enter":
            details["text"] = "\r"
        self.call("Input.dispatchKeyEvent", type="keyDown", **details)
        self.call("Input.dispatchKeyEvent", type="keyUp", key=key)

    # Fingers that go from places to places: [(x0, y0, x1, y1), ...]
    def touch(self, ways, steps=8):
        def points(share):
            return [{"x": x0 + share * (x1 - x0), "y": y0 + share * (y1 - y0), "id": i} for i, (x0, y0, x1, y1) in enumerate(ways)]
        self.call("Input.dispatchTouchEvent", type="touchStart", touchPoints=points(0))
        for i in range(1, steps + 1):
            self.call("Input.dispatchTouchEvent", type="touchMove", touchPoints=points(i / steps))
        self.call("Input.dispatchTouchEvent", type="touchEnd", touchPoints=[])

    def picture(self, path):
        path.write_bytes(base64.b64decode(self.call("Page.captureScreenshot", format="png")["data"]))

    def close(self):
        self.process.terminate()
        self.process.wait()


def wait_for(condition, what, seconds=90):
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        if condition():
            return
        time.sleep(0.1)
    sys.exit(f"check-page: {what} did not come within {seconds} s")


def start_program(program, *arguments, folder=None, environment=None):
    """The program, in a folder of its own, and the address of its page. `environment`: beside this one's."""
    process = subprocess.Popen([program, *arguments], stderr=subprocess.PIPE, text=True, cwd=folder,
                               env={**os.environ, **(environment or {})})
    for line in process.stderr:
        if line.startswith(("view: ", "serving ")):
            return process, line.split()[1]
    sys.exit("check-page: the program did not start")
