"""examples/lab.html in a browser, by what a reader can see and press. JAM_LAB names another file."""
import os
import pathlib
import time

import browser
import firefox

ROOT = pathlib.Path(__file__).resolve().parents[2]
LAB = pathlib.Path(os.environ.get("JAM_LAB", ROOT / "examples/lab.html"))
LIMIT = 240  # seconds for one piece of work, under any load


class Lab:
    """The page in one browser."""

    def __init__(self, kind, folder):
        self.downloads = folder / "downloads"
        self.downloads.mkdir(exist_ok=True)
        if kind is firefox:
            self.page = firefox.Firefox(downloads=self.downloads)
        else:
            self.page = browser.Browser()
            self.page.download_to(self.downloads)
        self.open()

    def open(self):
        self.page.open(LAB)
        self.until("document.documentElement.dataset.ready === 'yes'")

    def until(self, condition):
        self.until_true(lambda: self.page.run(condition), condition)

    def until_true(self, found, what):
        end = time.monotonic() + LIMIT
        while not found():
            if time.monotonic() > end:
                raise AssertionError(f"not within {LIMIT} s: {what}; {self.text('status')} {self.text('error')}")
            time.sleep(0.05)

    def text(self, name):
        return self.page.run(f"document.getElementById('{name}')?.textContent ?? ''")

    def press(self, name, waits=True):
        self.page.run(f"document.getElementById('{name}').click()")
        if waits:
            self.until("document.getElementById('work').hidden")

    def fill(self, recipe):
        for name in ("n", "dim", "seed", "law", "items", "curve", "walls", "density", "porosity", "protocol"):
            value = str(recipe.get(name, {"law": "equal", "walls": "none", "protocol": "usual"}.get(name, "")))
            self.page.run(f"((box) => {{ box.value = {value!r}; if (box.id === 'make-law') box.dispatchEvent(new Event('change')); }})"
                          f"(document.getElementById('make-{name}'))")  # fmt: skip

    def make(self, recipe):
        self.fill(recipe)
        self.press("make-go")

    def give(self, name, path):
        self.page.give("#" + name, path)
        self.until("document.getElementById('work').hidden")

    def saved(self, button, name):
        """The bytes of a file that the page gives."""
        path = self.downloads / name
        path.unlink(missing_ok=True)
        self.press(button)
        partial = ("*.part", "*.crdownload")
        self.until_true(lambda: path.exists() and path.stat().st_size and not any(map(list, map(self.downloads.glob, partial))), name)
        return path.read_bytes()
