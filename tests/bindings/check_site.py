"""The site as a reader uses it: no dead link, a text for every picture, and a search that finds what is asked for.

usage: check_site.py HTML_FOLDER        The search runs in Chromium; without it that part is not checked, and says so.
"""
import html.parser
import sys
import urllib.parse
from pathlib import Path

import browser

ROOT = Path(sys.argv[1]).resolve()
# What people type, and the pages of which one must be among the first results.
QUESTIONS = {
    "porosity": ("bindings/docs/sizes",),
    "is my packing jammed": ("bindings/docs/jammed", "bindings/docs/certificates", "bindings/docs/tutorial_referee"),
    "l0": ("bindings/docs/coming_from",),
    "rattler": ("bindings/docs/theory", "bindings/docs/certificates", "bindings/docs/jammed"),
    "sieve": ("bindings/docs/sizes",),
    "CALiPPSO": ("bindings/docs/coming_from", "bindings/docs/tutorial_calippso"),
    "isostatic": ("bindings/docs/theory",),
    "jam_crunch": ("api/crunch_to_the_jamming_point",),
}
FIRST = 5  # results that a reader looks through
# Of a page with code: colours of text and ground, of the article and of its code; margin; blocks without a button to copy;
# columns of code that a laptop's window shows.
LOOK = """(() => {
  const pre = document.querySelector('.highlight pre'), style = (e) => getComputedStyle(e);
  const ground = (e) => style(e).backgroundColor.startsWith('rgba') ? ground(e.parentElement) : style(e).backgroundColor;
  const colours = [document.querySelector('article p'), pre].map((e) => [style(e).color, ground(e)]);
  const row = document.createElement('span');
  row.textContent = '0'.repeat(100);
  pre.append(row);
  const columns = (pre.clientWidth - 2 * parseFloat(style(pre).paddingLeft)) / (row.getBoundingClientRect().width / 100);
  const blocks = [...document.querySelectorAll('div.highlight')].filter((block) => !block.querySelector('button.copy'));
  return [colours, style(document.body).margin, blocks.length, columns];
})()"""


class Page(html.parser.HTMLParser):
    """Links, names and pictures of a page."""

    def __init__(self, path):
        super().__init__()
        self.links, self.ids, self.bare = [], set(), []
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attributes):
        given = dict(attributes)
        self.ids |= {given[key] for key in ("id", "name") if given.get(key)}
        for key in ("href", "src"):
            if given.get(key):
                self.links.append(given[key])
        if tag == "img" and not (given.get("alt") or "").strip():
            self.bare.append(given.get("src"))


def dead_links(pages):
    for path, page in pages.items():
        for link in page.links:
            parts = urllib.parse.urlsplit(link)
            if parts.scheme or parts.netloc:
                continue
            target = (path.parent / urllib.parse.unquote(parts.path)).resolve() if parts.path else path
            if not target.is_file():
                yield f"{path.relative_to(ROOT)}: {link} is not there"
            elif parts.fragment and target in pages:
                name = urllib.parse.unquote(parts.fragment)
                if name not in pages[target].ids:
                    yield f"{path.relative_to(ROOT)}: {link} has no such place"


def results(page, question):
    """Addresses of the results of the site's own search, in its order."""
    page._loaded = False
    page.ask("Page.navigate", url=f"file://{ROOT}/search.html?q={urllib.parse.quote(question)}")
    while not page._loaded:
        page._next()
    done = "document.querySelector('#search-results .search-summary')?.textContent.match(/found|finished|matching/)"
    page.run(
        f"new Promise(r => {{ let n = 0; const wait = () => ({done} || n++ > 100) ? r() : setTimeout(wait, 50); wait(); }})"
    )
    found = page.run("[...document.querySelectorAll('#search-results ul.search li > a')].map(a => a.getAttribute('href'))")
    return [link.partition("?")[0].partition("#")[0].removesuffix(".html") for link in found]


def luminance(colour):
    red, green, blue = (int(c) / 255 for c in colour[4:-1].split(","))
    return sum(w * (c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4) for w, c in ((0.2126, red), (0.7152, green), (0.0722, blue)))


def unreadable(window):
    """In systems that are light or dark: the page follows, its text has the contrast that WCAG asks for (4.5), lines of 88 columns fit."""
    window.resize(1280, 900)
    for scheme in ("light", "dark"):
        window.media(scheme)
        window.open(ROOT / "bindings/docs/quickstart.html")
        colours, margin, without_button, columns = window.run(LOOK)
        for what, pair in zip(("text", "code"), colours):
            text, ground = map(luminance, pair)
            if (max(text, ground) + 0.05) / (min(text, ground) + 0.05) < 4.5 or (ground > text) != (scheme == "light"):
                yield f"{what} in a {scheme} system has the colours {pair}"
        if (margin, without_button) != ("0px", 0) or columns < 88:
            yield f"{scheme}: a margin of {margin}, {without_button} blocks of code without a button to copy, {columns:.0f} columns"


def main():
    pages = {path: Page(path) for path in sorted(ROOT.rglob("*.html"))}
    wrong = list(dead_links(pages))
    wrong += [f"{path.relative_to(ROOT)}: the picture {src} has no text" for path, page in pages.items() for src in page.bare]
    if len(pages) < 40 or not any(page.links for page in pages.values()):
        wrong.append("this check is broken")
    if browser.find() is None:
        print("Chromium is not installed (Debian: chromium): the search was not tried")
    else:
        window = browser.Browser()
        for question, wanted in QUESTIONS.items():
            found = results(window, question)
            if not set(found[:FIRST]) & set(wanted):
                wrong.append(f"a search for {question!r} finds {found[:FIRST]}")
        wrong += unreadable(window)
        window.close()
    for line in wrong:
        print(line)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
