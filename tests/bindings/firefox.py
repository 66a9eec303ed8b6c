"""A headless Firefox for tests, led by its own protocol, Marionette: JSON over a socket. No driver is needed."""
import base64
import json
import os
import shutil
import socket
import subprocess
import tempfile
import time

from closed_network import ClosedNetwork

PREFERENCES = {
    "app.update.disabledForTesting": True, "browser.download.folderList": 2, "browser.shell.checkDefaultBrowser": False,
    "browser.startup.page": 0, "browser.tabs.warnOnClose": False, "datareporting.policy.dataSubmissionEnabled": False,
    "network.proxy.allow_hijacking_localhost": True, "network.proxy.type": 1,
    "network.captive-portal-service.enabled": False, "network.connectivity-service.enabled": False,
    "services.settings.server": "data:,", "toolkit.telemetry.enabled": False, "webgl.force-enabled": True,
}  # fmt: skip
START = 60  # seconds


def find():
    """The program, or None where it is not installed."""
    return shutil.which("firefox-esr") or shutil.which("firefox")


def free_port():
    with socket.socket() as one:
        one.bind(("127.0.0.1", 0))
        return one.getsockname()[1]


class Firefox:
    """One page, with the calls of browser.Browser that need no more than WebDriver's commands. `errors` collects what is
    asked of the network, which is closed."""

    def __init__(self, width=1400, height=860, downloads=None):
        self.folder, port = tempfile.TemporaryDirectory(), free_port()
        self.errors = []
        self._network = ClosedNetwork(self.errors)
        proxy = {f"network.proxy.{kind}": "127.0.0.1" for kind in ("http", "ssl")}
        proxy |= {f"network.proxy.{kind}_port": self._network.port for kind in ("http", "ssl")}
        chosen = {**PREFERENCES, **proxy, "marionette.port": port, **({"browser.download.dir": str(downloads)} if downloads else {})}
        with open(os.path.join(self.folder.name, "user.js"), "w", encoding="ascii") as file:
            file.writelines(f"user_pref({json.dumps(key)}, {json.dumps(value)});\n" for key, value in chosen.items())
        self.process = subprocess.Popen(
            [find(), "--headless", "--marionette", "--no-remote", "--profile", self.folder.name],
            env={**os.environ, "HOME": self.folder.name, "MOZ_CRASHREPORTER_DISABLE": "1"},
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        self._socket, self._rest, self._count = self._connected(port), b"", 0
        self._message()  # which protocol it speaks
        self.ask("WebDriver:NewSession", strictFileInteractability=False)
        self.ask("WebDriver:SetTimeouts", script=600000, pageLoad=120000)
        self.resize(width, height)

    def _connected(self, port):
        for _ in range(10 * START):
            try:
                return socket.create_connection(("127.0.0.1", port))
            except OSError:
                time.sleep(0.1)
        self.process.kill()
        raise RuntimeError("the browser does not answer")

    def _message(self):
        while b":" not in self._rest:
            self._more()
        size, self._rest = self._rest.split(b":", 1)
        while len(self._rest) < int(size):
            self._more()
        text, self._rest = self._rest[: int(size)], self._rest[int(size) :]
        return json.loads(text)

    def _more(self):
        part = self._socket.recv(1 << 16)
        if not part:
            raise RuntimeError("the browser has ended")
        self._rest += part

    def ask(self, command, **parameters):
        self._count += 1
        text = json.dumps([0, self._count, command, parameters]).encode()
        self._socket.sendall(b"%d:%s" % (len(text), text))
        _, _, error, result = self._message()
        if error:
            raise RuntimeError(f"{command}: {error['message']}")
        return result

    def open(self, path):
        self.ask("WebDriver:Navigate", url="file://" + os.path.abspath(path))

    def resize(self, width, height):
        self.ask("WebDriver:SetWindowRect", width=width, height=height)

    def run(self, script):
        return self.ask("WebDriver:ExecuteScript", script=f"return {script}", args=[])["value"]

    def give(self, selector, path):
        found = self.ask("WebDriver:FindElement", using="css selector", value=selector)["value"]
        self.ask("WebDriver:ElementSendKeys", id=next(iter(found.values())), text=str(path))

    def drop(self, path):
        """A file on the page, by an event of its own making: WebDriver has no drop of files."""
        data = base64.b64encode(path.read_bytes()).decode()
        self.run(f"""((bytes) => {{
            const dataTransfer = new DataTransfer();
            dataTransfer.items.add(new File([bytes], {path.name!r}));
            for (const kind of ['dragover', 'drop'])
              document.body.dispatchEvent(new DragEvent(kind, {{ dataTransfer, bubbles: true, cancelable: true }}));
        }})(Uint8Array.from(atob('{data}'), (c) => c.charCodeAt(0)))""")

    def close(self):
        try:
            self.ask("Marionette:Quit", flags=["eForceQuit"])
        except (RuntimeError, OSError):
            pass
        try:
            self.process.wait(20)
        except subprocess.TimeoutExpired:
            self.process.kill()
            self.process.wait()
        self._socket.close()
        self._network.close()
        self.folder.cleanup()
