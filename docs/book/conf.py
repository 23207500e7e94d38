"""The book: README, docs/*.md, the notebooks and the Python package as pages. `make book` builds it into target/book.

The sources stay where they are, so that their links hold on GitHub too; the folder of the sources is therefore that of the repository.
"""

import re
from pathlib import Path

from sphinx.util.logging import getLogger

logger = getLogger(__name__)
ROOT = Path(__file__).resolve().parents[2]
NOTEBOOKS = ["outer-planets", "molecular-dynamics", "drift-of-the-modified-energy", "scheme-of-ones-own", "chaos-and-derivatives", "precision", "shadow-hamiltonian-monte-carlo"]

# The chapters in the order in which they are read. A page of docs/ or a notebook that is in none of them is a warning, and so an error.
CHAPTERS = {
    "Python": ["docs/python", *(f"python/notebooks/{name}" for name in NOTEBOOKS), "docs/book/python-api"],
    "Rust and the command line": [
        "docs/library",
        "docs/command-line",
        "docs/ensembles",
        "docs/sweeps",
        "docs/clusters",
        "docs/emit",
        "docs/what-works-with-what",
        "docs/book/rust-api",
    ],
    "The modified energy, and chaos": ["docs/the-modified-energy", "docs/modified-hamiltonian", "docs/monitor", "docs/recorded-trajectories", "docs/chaos", "docs/derivatives"],
    "Schemes": [
        "docs/schemes",
        "schemes/tables/README",
        "docs/gradient-kicks",
        "docs/processed-schemes",
        "docs/search",
        "docs/sampling",
        "docs/errata-of-published-tables",
    ],
    "Systems": ["docs/planets", "docs/linear-part", "docs/many-parts", "docs/multiple-time-steps", "docs/transformed-time", "docs/explicit-time", "docs/magnetic-fields", "docs/liquids"],
    "Numbers": ["docs/numbers", "docs/round-off"],
    "Measurements": [
        "docs/work-precision",
        "docs/speed-against-error",
        "rivals/README",
        "docs/speed",
        "docs/benchmarks",
        "docs/stability",
    ],
    "The project": ["ARCHITECTURE", "CONTRIBUTING", "docs/language", "CHANGELOG"],
}

project = "Shadowstep"
extensions = ["myst_nb", "sphinx.ext.autodoc", "sphinx.ext.napoleon", "sphinx.ext.mathjax", "sphinx-mathjax-offline"]
root_doc = "README"
include_patterns = ["README.md", *(f"{page}.*" for pages in CHAPTERS.values() for page in pages), "docs/*.md", "python/notebooks/*.ipynb"]
exclude_patterns = ["target", ".git", "**.rs", "**.py", "**.toml", "docs/pictures", "docs/sweeps"]

html_theme = "furo"
html_title = "Shadowstep"
html_show_sourcelink = False
html_theme_options = {"navigation_with_keys": True}
html_static_path = ["style"]
html_css_files = ["wide-tables.css"]

# formulas are set in the browser, from files of the book
myst_enable_extensions = ["dollarmath"]
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
        if path.suffix != ".rs" or not of_crate or "/" in crate:
            return link[0]
        page = f"rust/{crate_name(crate)}/index.html" if file == "lib.rs" else f"rust/src/{crate_name(crate)}/{file}.html"
        if not (Path(app.outdir) / page).exists():
            logger.warning("rustdoc has not written %s, to which %s leads", page, name)
        return f'<a href="{"../" * len(folder.relative_to(ROOT).parts)}{page}">{link[1]}</a>'

    source[0] = re.sub(r"\[([^\[\]]*)\]\(([^)#:\s]+)\)", changed, source[0])


def crate_name(folder):
    manifest = (ROOT / folder / "Cargo.toml").read_text()
    return re.search(r'^name = "([^"]+)"', manifest, re.MULTILINE)[1].replace("-", "_")


def bars(app, what, name, obj, options, lines):
    """|H| is no substitution of reStructuredText, but in literals bars stay."""
    lines[:] = [line if ">>>" in line else re.sub(r"(``.*?``)|\|", lambda found: found[1] or r"\|", line) for line in lines]


def names_of_types(app, what, name, obj, options, signature, returned):
    """A name in `autodoc_type_aliases` is shown as it is, in unions too."""
    return signature and re.sub(r"TypeAliasForwardRef\('(\w+)'\)", r"\1", signature), returned
