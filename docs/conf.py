# SPDX-License-Identifier: GPL-3.0-or-later
"""How Sphinx makes the site: of the pages that gather.py has put together, with nothing loaded from outside."""

import os

project = "Plekton"
author = "the authors of Plekton"
copyright = "the authors of Plekton; GPL-3.0-or-later"
version = release = os.environ.get("PLEKTON_VERSION", "")

extensions = ["myst_parser", "sphinx.ext.mathjax"]
myst_enable_extensions = ["dollarmath", "colon_fence"]
myst_heading_anchors = 4
source_suffix = {".md": "markdown"}
exclude_patterns = ["_build", "README.md"]
nitpicky = True
smartquotes = False  # texts of a scenario are in straight ones

html_theme = "pydata_sphinx_theme"
html_title = "Plekton"
html_static_path = ["_static"]
html_css_files = ["katex/katex.min.css", "site.css"]
html_js_files = [("katex/katex.min.js", {"defer": "defer"}), ("katex/auto-render.min.js", {"defer": "defer"})]
html_theme_options = {"show_prev_next": False, "show_toc_level": 2, "use_edit_page_button": False}
html_show_sourcelink = False
html_copy_source = False

# Formulas are left in the page between \( \), and KaTeX beside it sets them.
mathjax_path = "formulas.js"
mathjax_options = {"defer": "defer"}
