"""Sphinx configuration of the site. bindings/CMakeLists.txt runs it: cmake --build build --target docs"""
import os
import re
import sys
import types
from pathlib import Path

root = Path(__file__).resolve().parents[2]

project = "libjam"
author = "the libjam authors"
copyright = author
release = version = os.environ.get("JAM_VERSION", "")

extensions = ["myst_parser", "breathe", "sphinx.ext.autodoc", "sphinx.ext.napoleon"]
include_patterns = [
    "index.md",
    "CHANGELOG.md",
    "api/*",
    "bindings/docs/*.md",
    "bindings/README.md",
    "examples/README.md",
    "examples/studies/README.md",
    "examples/studies/near_jamming.md",
    "examples/studies/scenes.md",
    "examples/studies/thesis.md",
    "examples/studies/errors.md",
    "examples/studies/final_network.md",
    "examples/studies/ensembles/README.md",
    "examples/studies/ensembles/glasses.md",
    "src/README.md",
    "src/crunch/README.md",
    "tests/bench/README.md",
    "tests/bench/dynamics.md",
    "tests/bench/tried.md",
]
exclude_patterns = ["bindings/docs/index.md"]  # site.py puts it at the top
myst_heading_anchors = 3

# ---- the C and C++ headers, read by Doxygen
breathe_projects = {"jam": os.environ.get("JAM_XML", "")}
breathe_default_project = "jam"
breathe_domain_by_extension = {"h": "c", "hpp": "cpp"}
breathe_show_include = False
c_id_attributes = ["JAM_API"]

# ---- the Python package. Its C layer is not needed for its text, so a stand-in takes its place.
sys.path.insert(0, str(Path(os.environ["JAM_XML"]).parent / "python"))  # by site.py
autodoc_member_order = "bysource"
autodoc_typehints = "signature"
python_use_unqualified_type_names = True
stand_in = types.ModuleType("jam.raw")
stand_in.jam_version = lambda: version
stand_in.jam_blas_kernel = lambda: ""
abi = re.search(r"#define JAM_ABI (\d+)", (root / "include/jam/jam.h").read_text()).group(1)
stand_in.jam_abi_version = lambda: int(abi)
stand_in.__getattr__ = lambda name: lambda *a, **k: None
sys.modules["jam.raw"] = stand_in


def as_text(app, what, name, thing, options, lines):
    """Stars, bars and underscores of plain docstrings mean themselves; lists of options become lists."""
    made, listing = [], False
    for line in lines:
        if not line.lstrip().startswith(">>>"):
            parts = re.split(r"(`[^`]*`)", line)
            parts[::2] = [re.sub(r"([*|]|_(?!\w))", r"\\\1", part) for part in parts[::2]]
            line = "".join(parts)
        if re.match(r"\s*Options:$", line):
            listing = True
            made += ["", "**Options**", ""]
        elif listing and line.strip():
            made.append("- " + re.sub(r"^(\w+):", r"``\1``:", line.strip()))
        else:
            made.append(re.sub(r"(^|\s)(Status|Errors|Threads):", r"\1**\2:**", line))
    lines[:] = made


def setup(app):
    app.connect("autodoc-process-docstring", as_text, priority=100)  # before napoleon


# ---- how it looks
html_theme = "furo"
html_title = f"libjam {version}"
html_copy_source = False
html_show_sphinx = False
html_static_path = ["static"]
html_css_files = ["site.css"]
html_js_files = ["copy.js"]
pygments_style, pygments_dark_style = "tango", "monokai"
# Debian's furo has no colours for dark systems of its own. Names of its variables without --color-.
DARK = {
    "foreground-primary": "#d8dadd", "foreground-secondary": "#a3a8ae", "foreground-muted": "#868c93", "foreground-border": "#6b7077",
    "background-primary": "#15171a", "background-secondary": "#1c1f23", "background-hover": "#24282d", "background-item": "#4a4f55",
    "background-hover--transparent": "#24282d00", "background-border": "#34393f", "brand-primary": "#6ea8fe", "brand-content": "#6ea8fe",
    "problematic": "#ff7b72", "highlight-on-target": "#3a3a12", "highlighted-background": "#1d3b5c", "admonition-background": "#1c1f23",
    "card-background": "#1c1f23", "guilabel-background": "#1d3b5c80", "guilabel-border": "#2f5a8880",
}
html_theme_options = {
    "navigation_with_keys": True,
    "dark_css_variables": {f"color-{name}": value for name, value in DARK.items()},
}
