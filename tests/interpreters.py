"""Python in a process of its own, which has imported nothing: for tests of what an import or a start does."""

import json
import os
import subprocess
import sys


def run(code: str, **environment: str | None) -> tuple[dict, str]:
    """Returns what `code` leaves in its dictionary `found`, and what it says on stderr; None unsets a variable."""
    # PyOpenGL's platform follows from the backend, which this process may have chosen otherwise.
    variables = {**os.environ, "PYOPENGL_PLATFORM": None, **environment}
    variables = {name: value for name, value in variables.items() if value is not None}
    code = f"found = {{}}\n{code}\nimport json\nprint(json.dumps(found))"
    finished = subprocess.run([sys.executable, "-c", code], env=variables, capture_output=True, text=True, check=False)
    assert finished.returncode == 0, finished.stderr
    return json.loads(finished.stdout.splitlines()[-1]), finished.stderr
