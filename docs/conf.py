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
# `--option` in running text stays as it is typed.
smartquotes = False

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
html_static_path = ["_static"]
html_css_files = ["gallery.css"]


#: Copied into the site as they are: the lab, which `setup` makes.
html_extra_path = ["_lab"]


def setup(app):
    """Write the pages and pictures that the package makes of itself; they are not kept with the text."""
    import sys
    from pathlib import Path

    sys.path.insert(0, str(app.srcdir))
    import make_blind_history
    import make_checks
    import make_errors
    import make_figures
    import make_gallery
    import make_judge_table
    import make_reference
    import make_review
    import make_zoo

    makers = (make_blind_history, make_checks, make_errors, make_figures, make_gallery, make_reference)
    for maker in (*makers, make_judge_table, make_review, make_zoo):
        maker.write()
    Path(app.srcdir, "_lab").mkdir(exist_ok=True)  # sphinx asks for it before it builds anything
    app.connect("builder-inited", lambda app: make_gallery.write_pictures(Path(app.srcdir, "reference", "effects")))
    app.connect("builder-inited", lambda app: write_lab(Path(app.srcdir)))


def write_lab(docs):
    """Write the page of the lab, with a practice experiment, where the site takes it from."""
    from rockref.discover.compare.models import baseline_model
    from rockref.lab.page import write_page
    from rockref.measure import load_experiment

    experiment = load_experiment(docs.parent / "data" / "experiments" / "mystery-04")
    write_page(docs / "_lab" / "lab_page.html", baseline_model(experiment), experiment)
