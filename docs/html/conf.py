# SPDX-License-Identifier: GPL-3.0-or-later
"""Sphinx with MyST makes a site of the repository's own Markdown: docs/build_html.sh.

The pages stay as they are on a forge. Two things are added while they are read: names of documents
in backticks become links, and README gets the table of contents."""
import os
import pathlib
import re

SOURCE = pathlib.Path(__file__).resolve().parents[2]
CONTENTS = {
    "First steps": ["docs/your-own-ship", "docs/limitations", "docs/validation",
                    "docs/validation-measured"],
    "Programs": ["docs/spherize", "docs/icefield", "docs/iceflow", "docs/icesolve",
                 "docs/icepost", "docs/case-keys", "workflow/README",
                 "python/README"],
    "Cases": ["cases/paper-2d", "cases/paper-3d/README", "cases/paper-3d-defaults/README",
              "cases/presawn-channel/README", "cases/icebreaker-100m/README",
              "cases/level-ice-icebreaker/README", "cases/h-v-icebreaker/README",
              "cases/broken-field/README", "validation/uikku/README", "meshes/README"],
    "Results": ["docs/answers", "docs/energy", "docs/convergence", "docs/soak"],
    "Reference": ["docs/method", "docs/contract", "docs/library", "docs/design-notes"],
    "Project": ["CONTRIBUTING", "SECURITY", "CHANGELOG", "packaging/README",
                "examples/ci/README"],
}
PAGES = ["README", *(page for pages in CONTENTS.values() for page in pages)]

project = "icesolve"
author = copyright = "the icesolve maintainers"
extensions = ["myst_parser"]
root_doc = "README"
include_patterns = [f"{page}.md" for page in PAGES]
# folders that are not even looked into
exclude_patterns = ["build", "results", "tests", "common", "preprocess", "solver", "postprocess",
                    ".*", "**/node_modules"]
myst_heading_anchors = 4
highlight_language = "none"
html_theme = "alabaster"
html_theme_options = {"page_width": "1240px", "body_max_width": "none", "sidebar_width": "260px",
                      "fixed_sidebar": True}
html_sidebars = {"**": ["about.html", "searchbox.html", "navigation.html"]}
html_copy_source = html_show_sourcelink = False


def link_documents(folder, text):
    """`docs/method.md` outside of blocks and of links becomes a link to that page."""
    def link(match):
        name = match[1].removesuffix(".md")
        for page in (name, os.path.normpath(os.path.join(folder, name))):
            if page in PAGES:
                return f"[`{match[1]}`]({os.path.relpath(page, folder or '.')}.md)"
        return match[0]
    parts = re.split(r"(^```.*?^```$)", text, flags=re.M | re.S)
    parts[::2] = [re.sub(r"(?<!\[)`([\w./-]+[.]md)`(?!\])", link, part) for part in parts[::2]]
    return "".join(parts)


def contents():
    blocks = [f"```{{toctree}}\n:hidden:\n:caption: {caption}\n\n"
              + "\n".join(f"/{p}" for p in pages) + "\n```\n"
              for caption, pages in CONTENTS.items()]
    return "\n" + "\n".join(blocks)


def read(_, page, source):
    source[0] = link_documents(os.path.dirname(page), source[0])
    if page == root_doc:
        source[0] += contents()


def setup(app):
    app.connect("source-read", read)
