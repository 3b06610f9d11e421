"""How the documentation is built: `make docs`."""

import importlib.metadata
from pathlib import Path
import sys

HERE = Path(__file__).parent
sys.path[:0] = [str(HERE), str(HERE / "examples")]

project = "physexp"
author = "the physexp authors"
release = importlib.metadata.version("physexp")

extensions = [
    "command_help",
    "from_code",
    "myst_nb",
    "plan_tables",
    "play_page",
    "sphinx.ext.autodoc",
    "sphinx.ext.napoleon",
    "sphinx.ext.viewcode",
    "sphinx_copybutton",
]
exclude_patterns = ["_build", "**.ipynb_checkpoints"]
html_theme = "furo"
html_show_copyright = False
html_title = f"physexp {release}"
html_static_path = ["static"]
html_css_files = ["page.css"]
copybutton_exclude = ".linenos, .gp, .go"

default_role = "py:obj"  # Single backticks in a docstring are code, and a link if it has a page.
myst_heading_anchors = 3
suppress_warnings = ["misc.highlighting_failure"]

# The notebook runs anew with every build, and a cell that fails fails the build.
nb_execution_mode = "force"
nb_execution_timeout = 300
nb_execution_raise_on_error = True
nb_execution_show_tb = True

autodoc_default_options = {"members": True, "show-inheritance": True}
autodoc_member_order = "bysource"
autodoc_typehints = "description"
autodoc_typehints_description_target = "documented"
napoleon_google_docstring = True
napoleon_numpy_docstring = False
napoleon_use_ivar = True
