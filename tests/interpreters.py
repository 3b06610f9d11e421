"""Python in a fresh process, for tests of the effects of an import or a start."""

import json
import os
import subprocess
import sys


def run(code: str, **environment: str | None) -> tuple[dict, str]:
    """Returns the dictionary `found` that `code` has filled, and its standard error; None unsets a variable."""
    # PyOpenGL's platform follows from the backend, which this process may have chosen otherwise.
    variables = {**os.environ, "PYOPENGL_PLATFORM": None, **environment}
    variables = {name: value for name, value in variables.items() if value is not None}
    code = f"found = {{}}\n{code}\nimport json\nprint(json.dumps(found))"
    finished = subprocess.run([sys.executable, "-c", code], env=variables, capture_output=True, text=True, check=False)
    assert finished.returncode == 0, finished.stderr
    return json.loads(finished.stdout.splitlines()[-1]), finished.stderr
