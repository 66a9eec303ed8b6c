"""A headless Chromium for tests, led over its debugging pipe: no driver and no network are needed."""
import base64
import json
import os
import shutil
import subprocess
import tempfile
import time

from closed_network import ClosedNetwork

ARGUMENTS = """--headless --no-sandbox --no-first-run --disable-background-networking --disable-component-update
    --proxy-bypass-list=<-loopback> --disable-sync --disable-quic --use-angle=swiftshader --enable-unsafe-swiftshader --remote-debugging-pipe""".split()


def find():
    """The program, or None where it is not installed."""
    return shutil.which("chromium")


class Browser:
    """One page. `errors` collects what the console complains about, and what is asked of the network, which is closed."""

    def __init__(self, width=1400, height=860):
        self.folder = tempfile.TemporaryDirectory()
        from_us, self._to = os.pipe()
        self._from, to_us = os.pipe()

        def ends():  # Chromium reads from 3 and writes to 4
            a, b = os.dup(from_us), os.dup(to_us)
            os.dup2(a, 3)
            os.dup2(b, 4)

        self.errors = []
        self._network = ClosedNetwork(self.errors)
        self.process = subprocess.Popen(
            [find(), *ARGUMENTS, f"--proxy-server=127.0.0.1:{self._network.port}", f"--user-data-dir={self.folder.name}", "about:blank"],
            preexec_fn=ends,
            close_fds=False,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        os.close(from_us)
        os.close(to_us)
        self._rest, self._count, self._loaded, self.session = b"", 0, False, None
        self._target, self._size = None, (width, height)
        self.new_tab()

    def new_tab(self):
        """Another tab; the one before is closed, whatever runs in it."""
        old, self.session = self._target, None
        self._target = self.ask("Target.createTarget", url="about:blank")["targetId"]
        if old:
            self.ask("Target.closeTarget", targetId=old)
        self.session = self.ask("Target.attachToTarget", targetId=self._target, flatten=True)["sessionId"]
        for part in ("Page", "Runtime", "Log"):
            self.ask(part + ".enable")
        self.resize(*self._size)

    def _next(self):
        while b"\0" not in self._rest:
            more = os.read(self._from, 1 << 16)
            if not more:
                raise RuntimeError("the browser has ended")
            self._rest += more
        message, self._rest = self._rest.split(b"\0", 1)
        found = json.loads(message)
        kind, about = found.get("method"), found.get("params", {})
        if kind == "Page.loadEventFired":
            self._loaded = True
        elif kind == "Runtime.exceptionThrown":
            self.errors.append(about["exceptionDetails"].get("exception", {}).get("description", "exception"))
        elif kind == "Log.entryAdded" and about["entry"]["level"] in ("error", "warning"):
            self.errors.append(about["entry"]["text"])
        elif kind == "Runtime.consoleAPICalled" and about["type"] in ("error", "warning", "assert"):
            self.errors.append(str(about["args"]))
        return found

    def ask(self, method, **parameters):
        self._count += 1
        wanted = self._count
        message = {"id": wanted, "method": method, "params": parameters}
        if self.session:
            message["sessionId"] = self.session
        os.write(self._to, json.dumps(message).encode() + b"\0")
        while True:
            found = self._next()
            if found.get("id") == wanted:
                if "error" in found:
                    raise RuntimeError(f"{method}: {found['error']}")
                return found["result"]

    def open(self, path):
        self._loaded = False
        self.ask("Page.navigate", url="file://" + os.path.abspath(path))
        while not self._loaded:
            self._next()
        self.settle()

    def resize(self, width, height):
        self.ask("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=False)

    def media(self, scheme):
        """The scheme that the reader prefers: 'dark' or 'light'."""
        self.ask("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": scheme}])

    def give(self, selector, path):
        """A file to an input of the page."""
        root = self.ask("DOM.getDocument")["root"]["nodeId"]
        node = self.ask("DOM.querySelector", nodeId=root, selector=selector)["nodeId"]
        self.ask("DOM.setFileInputFiles", nodeId=node, files=[str(path)])

    def drop(self, path, x=100, y=300):
        """A file on the page, as by a mouse."""
        data = {"items": [], "files": [str(path)], "dragOperationsMask": 1}
        for kind in ("dragEnter", "dragOver", "drop"):
            self.ask("Input.dispatchDragEvent", type=kind, x=x, y=y, data=data)

    def processes(self):
        """Type and processor seconds of each process of the browser."""
        own, self.session = self.session, None
        found = self.ask("SystemInfo.getProcessInfo")["processInfo"]
        self.session = own
        return found

    def download_to(self, folder):
        self.ask("Page.setDownloadBehavior", behavior="allow", downloadPath=str(folder))

    def settle(self):
        """Until what was asked for is drawn."""
        self.run("new Promise(r => requestAnimationFrame(() => requestAnimationFrame(() => setTimeout(r, 30))))")

    def run(self, script):
        found = self.ask("Runtime.evaluate", expression=script, returnByValue=True, awaitPromise=True)
        if "exceptionDetails" in found:
            raise RuntimeError(found["exceptionDetails"]["exception"].get("description"))
        return found["result"].get("value")

    def key(self, key):
        for kind in ("keyDown", "keyUp"):
            text = {"text": key} if len(key) == 1 and kind == "keyDown" else {}
            self.ask("Input.dispatchKeyEvent", type=kind, key=key, **text)
        self.settle()

    def mouse(self, kind, x, y):
        button = {} if kind == "mouseMoved" else {"button": "left", "clickCount": 1}
        self.ask("Input.dispatchMouseEvent", type=kind, x=x, y=y, **button)

    def picture(self, path):
        with open(path, "wb") as file:
            file.write(base64.b64decode(self.ask("Page.captureScreenshot", format="png")["data"]))

    def close(self):
        try:
            self.session = None
            self.ask("Browser.close")
        except (RuntimeError, OSError):
            pass
        try:
            self.process.wait(10)
        except subprocess.TimeoutExpired:
            self.process.kill()
            self.process.wait()
        os.close(self._to)
        os.close(self._from)
        self._network.close()
        for _ in range(50):  # its helpers may still write there
            try:
                self.folder.cleanup()
                return
            except OSError:
                time.sleep(0.1)
