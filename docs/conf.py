"""Settings of Sphinx for the site; `./dev docs` builds it without network."""

import os
import re
import shutil
import sys
from pathlib import Path

DOCS = Path(__file__).resolve().parent
ROOT = DOCS.parent
sys.path[:0] = [str(DOCS), str(ROOT / "python")]

from header_tables import with_tables  # noqa: E402  (the path is set above)

project = "QuasiMC"
copyright = "the QuasiMC developers"  # noqa: A001  (the name that Sphinx reads)
release = re.search(r"VERSION (\d+\.\d+\.\d+)", (ROOT / "CMakeLists.txt").read_text())[1]
version = release

extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.mathjax", "sphinx.ext.napoleon"]
myst_enable_extensions = ["dollarmath"]
myst_heading_anchors = 6
exclude_patterns = ["**/*.ipynb"]
html_theme = "furo"
html_title = f"QuasiMC {release}"
html_copy_source = False

# The package is documented from its sources: nothing has to be compiled or installed.
autodoc_mock_imports = ["quasimc._core", "numpy", "matplotlib"]
autodoc_member_order = "bysource"

# Formulas are typeset by the MathJax 2 of Debian's libjs-mathjax, copied into the site, so that they
# need no network.  Without that package Sphinx links to MathJax on the network.
MATHJAX = Path("/usr/share/javascript/mathjax")
MATHJAX_PARTS = [
    "MathJax.js",
    "config/TeX-AMS_CHTML.js",
    "extensions",
    "fonts/HTML-CSS/TeX/woff",
    "jax/element",
    "jax/input/TeX",
    "jax/output/CommonHTML",
]
if MATHJAX.is_dir():
    mathjax_path = "mathjax/MathJax.js?config=TeX-AMS_CHTML"
    mathjax2_config = {"showMathMenu": False, "messageStyle": "none"}
    myst_update_mathjax = False

LINK = re.compile(r"(?<!!)\[([^\]]*)\]\(([^()\s:#]+)(#[^()\s]*)?\)")


def prepare_page(app, docname, source):
    """Adds tables of headers; replaces links to files outside docs/, which are not on the site."""

    def named(link):
        target = os.path.normpath((DOCS / docname).parent / link[2])
        path = os.path.relpath(target, ROOT)
        if path.startswith("docs/"):
            return link[0]
        return link[1] if link[1].strip("`") == path else f"{link[1]} (`{path}`)"

    source[0] = LINK.sub(named, with_tables(source[0]))


def copy_mathjax(app, exception):
    """Copies the needed parts of MathJax into the site."""
    if exception or not MATHJAX.is_dir() or app.builder.format != "html":
        return
    for part in MATHJAX_PARTS:
        target = Path(app.outdir) / "_static/mathjax" / part
        target.parent.mkdir(parents=True, exist_ok=True)
        if (MATHJAX / part).is_dir():
            shutil.copytree(MATHJAX / part, target, dirs_exist_ok=True)
        else:
            shutil.copy(MATHJAX / part, target)


def setup(app):
    """Connects the functions above."""
    app.connect("source-read", prepare_page)
    app.connect("build-finished", copy_mathjax)
