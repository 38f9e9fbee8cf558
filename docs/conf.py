"""How the documentation is built: `make docs`."""

from importlib.metadata import version as installed

project = "rockref"
author = "rockref authors"
copyright = "rockref authors"
release = installed("rockref")
version = release

# The formulas are drawn by a MathJax that lies in the site itself: pages are read without a network, too.
extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.mathjax", "sphinx-mathjax-offline", "sphinx_copybutton"]
source_suffix = {".md": "markdown"}
exclude_patterns = ["_build"]
nitpicky = False

myst_enable_extensions = ["dollarmath", "amsmath", "colon_fence", "deflist", "fieldlist"]
myst_heading_anchors = 3

# Docstrings give shapes and units in their own words; the signatures give the types.
autodoc_typehints = "signature"
autodoc_member_order = "bysource"

# Prompts are not copied with the command.
copybutton_prompt_text = "$ "
copybutton_exclude = ".linenos, .gp, .go"

html_theme = "furo"
html_title = f"rockref {release}"
html_static_path: list[str] = []


def setup(app):
    """Draw the pictures of the effects; they are not kept with the text."""
    from pathlib import Path

    from rockref.report.gallery import write_pictures

    app.connect("builder-inited", lambda app: write_pictures(Path(app.srcdir, "reference", "effects")))
