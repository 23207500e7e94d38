"""The book: README, docs/*.md, the notebooks and the Python package as pages. `make book` builds it into target/book.

The sources stay where they are, so that their links hold on GitHub too; the folder of the sources is therefore that of the repository.
"""

import re
from pathlib import Path

from sphinx.util.logging import getLogger

logger = getLogger(__name__)
ROOT = Path(__file__).resolve().parents[2]
def notebooks(*names):
    return [f"python/notebooks/{name}" for name in names]


# The chapters in the order in which they are read. A page of docs/ or a notebook that is in none of them is a warning, and so an error.
CHAPTERS = {
    "Start": ["docs/start-here", "docs/gallery", "docs/glossary"],
    "Tutorials": notebooks(
        "outer-planets",
        "molecular-dynamics",
        "scheme-of-ones-own",
        "chaos-and-derivatives",
        "shadow-hamiltonian-monte-carlo",
        "precision",
        "drift-of-the-modified-energy",
    ),
    "How to": [f"docs/how-to/{name}" for name in ("which-scheme", "step-size", "undecided", "energy-drifts", "resume", "units")],
    "Theory": ["docs/theory", "docs/modified-hamiltonian", "docs/gradient-kicks-and-processing"],
    "Reference": [
        "docs/python",
        "docs/book/python-api",
        "docs/command-line",
        "docs/scenes",
        "docs/library",
        "docs/book/rust-api",
        "docs/schemes",
        *(f"docs/schemes/{family}" for family in ("general", "quadratic", "gradient-kicks", "near-integrable", "processed", "multiple-time-steps")),
        "schemes/tables/README",
        "docs/numbers",
        "docs/round-off",
        "docs/what-works-with-what",
    ],
    "Systems": ["docs/planets", "docs/liquids", "docs/magnetic-fields", "docs/explicit-time", "docs/transformed-time", "docs/linear-part", "docs/many-parts", "docs/multiple-time-steps"],
    "Tasks": [
        "docs/work-precision",
        "docs/many-runs",
        "docs/monitor",
        "docs/recorded-trajectories",
        "docs/chaos",
        "docs/derivatives",
        "docs/sampling",
        "docs/search",
        "docs/emit",
    ],
    "Evidence": ["docs/the-modified-energy", "docs/stability", "docs/errata-of-published-tables", "docs/speed", "docs/benchmarks", "docs/speed-against-error"],
    "Development": ["ARCHITECTURE", "CONTRIBUTING", "docs/language", "CHANGELOG"],
}

project = "Shadowstep"
extensions = ["myst_nb", "sphinx.ext.autodoc", "sphinx.ext.napoleon", "sphinx.ext.mathjax", "sphinx-mathjax-offline", "sphinx_design"]
autodoc_mock_imports = ["jax", "openmm", "rebound"]  # large, and imported by one module each
root_doc = "README"
include_patterns = ["README.md", *(f"{page}.*" for pages in CHAPTERS.values() for page in pages), "docs/*.md", "docs/how-to/*.md", "docs/schemes/*.md", "python/notebooks/*.ipynb"]
exclude_patterns = ["target", ".git", "**.rs", "**.py", "**.toml", "docs/pictures", "docs/sweeps"]

html_theme = "furo"
html_title = "Shadowstep"
html_show_sourcelink = False
html_theme_options = {"navigation_with_keys": True}
html_static_path = ["style"]
html_css_files = ["wide-tables.css", "pictures.css"]
html_js_files = ["filters.js"]

# formulas are set in the browser, from files of the book
myst_enable_extensions = ["dollarmath", "colon_fence"]
myst_heading_anchors = 4
# a picture of a notebook is one of the book; widgets would need the network
nb_ipywidgets_js = {}
nb_execution_mode = "cache"  # in the folder that `make book` names
nb_execution_timeout = 600
nb_execution_raise_on_error = True
nb_execution_show_tb = True

autodoc_member_order = "bysource"
autodoc_type_aliases = {name: name for name in ("Forces", "Number", "Schemes", "Values")}
maximum_signature_line_length = 80
python_use_unqualified_type_names = True
napoleon_custom_sections = ["Own forces"]
napoleon_use_rtype = False


def setup(app):
    app.connect("source-read", chapters)
    app.connect("source-read", sources_of_rust)
    app.connect("source-read", tabs)
    app.connect("autodoc-process-docstring", bars)
    app.connect("autodoc-process-signature", names_of_types)


def chapters(app, name, source):
    """The start page has the chapters; README itself has none, as GitHub shows it."""
    if name == root_doc:
        pages = {caption: "\n".join(f"/{page}" for page in pages) for caption, pages in CHAPTERS.items()}
        trees = [f"```{{toctree}}\n:hidden:\n:caption: {caption}\n\n{names}\n```" for caption, names in pages.items()]
        source[0] += "\n\n" + "\n\n".join(trees) + "\n"


def sources_of_rust(app, name, source):
    """A link to a Rust file of a crate leads to rustdoc's page of it, which is beside the book; one to a folder is its text only."""
    folder = (ROOT / name).parent

    def changed(link):
        path = (folder / link[2]).resolve()
        if path.is_dir():
            return link[1]
        crate, of_crate, file = str(path.relative_to(ROOT)).partition("/src/")
        if path.suffix != ".rs" or not of_crate or "/" in crate.removeprefix("crates/"):
            return link[0]
        page = f"rust/{crate_name(crate)}/index.html" if file == "lib.rs" else f"rust/src/{crate_name(crate)}/{file}.html"
        if not (Path(app.outdir) / page).exists():
            logger.warning("rustdoc has not written %s, to which %s leads", page, name)
        return f'<a href="{"../" * len(folder.relative_to(ROOT).parts)}{page}">{link[1]}</a>'

    source[0] = re.sub(r"\[([^\[\]]*)\]\(([^)#:\s]+)\)", changed, source[0])


def tabs(app, name, source):
    """What is between two comments are tabs, each of which begins with its name in bold; GitHub shows them one below the other."""

    def tab_set(found):
        names_and_texts = re.split(r"^\*\*(.+)\*\*$", found[1], flags=re.MULTILINE)[1:]
        items = [f":::{{tab-item}} {title}\n:sync: {title}\n{text.rstrip()}\n:::" for title, text in zip(names_and_texts[::2], names_and_texts[1::2])]
        return "::::{tab-set}\n" + "\n".join(items) + "\n::::"

    source[0] = re.sub(r"<!-- tabs -->\n(.*?)<!-- /tabs -->", tab_set, source[0], flags=re.DOTALL)


def crate_name(folder):
    manifest = (ROOT / folder / "Cargo.toml").read_text()
    return re.search(r'^name = "([^"]+)"', manifest, re.MULTILINE)[1].replace("-", "_")


def bars(app, what, name, obj, options, lines):
    """|H| is no substitution of reStructuredText, but in literals bars stay."""
    lines[:] = [line if ">>>" in line else re.sub(r"(``.*?``)|\|", lambda found: found[1] or r"\|", line) for line in lines]


def names_of_types(app, what, name, obj, options, signature, returned):
    """A name in `autodoc_type_aliases` is shown as it is, in unions too."""
    return signature and re.sub(r"TypeAliasForwardRef\('(\w+)'\)", r"\1", signature), returned
