"""How Sphinx makes the site of a copy of docs/ that scripts/docs has prepared, and which hands over the version."""

import importlib.util

from pygments.lexers.special import TextLexer
from sphinx.highlighting import lexers

project = "Strandlab"
author = "The Strandlab authors"

extensions = ["myst_parser", "sphinx.ext.autodoc"]
source_suffix = {".md": "markdown"}
myst_heading_anchors = 4  # as GitHub names them
suppress_warnings = ["myst.header"]  # messages are small headings under large ones
highlight_language = "none"
lexers["csv"] = TextLexer()

html_theme = "furo"
html_show_sourcelink = False
html_copy_source = False
html_show_copyright = False

autodoc_member_order = "bysource"
autodoc_default_options = {"undoc-members": True}
default_role = "literal"  # as in the descriptions
if importlib.util.find_spec("strandlab._core") is None:
    autodoc_mock_imports = ["strandlab._core"]


def describe(app, what, name, thing, options, lines):
    """Indented lines of a description are code."""
    told = []
    for line in lines:
        if line.startswith("    ") and told and not told[-1] and not (len(told) > 1 and told[-2].startswith("    ")):
            told += [".. code-block:: python", ""]
        told.append(line)
    lines[:] = told


def setup(app):
    app.connect("autodoc-process-docstring", describe)
    # Users get objects from functions: how they are made is no part of them.
    app.connect("autodoc-process-signature", lambda app, what, *_: ("", None) if what == "class" else None)
