"""Every block of the README does what it says."""

from pathlib import Path
import re
import subprocess
import sys

import pytest

ROOT = Path(__file__).parent.parent
BLOCKS = re.findall(r"^```(\w+)\n(.*?)^```", (ROOT / "README.md").read_text(), re.DOTALL | re.MULTILINE)
PYTHON_BLOCKS = [block for language, block in BLOCKS if language == "python"]
SHELL_LINES = [
    line.split("#")[0].strip() for language, block in BLOCKS if language == "sh" for line in block.splitlines()
]


def test_the_readme_has_blocks_of_python_and_shell_and_nothing_else():
    assert {language for language, _ in BLOCKS} == {"python", "sh"}
    assert len(PYTHON_BLOCKS) >= 3 and len(SHELL_LINES) >= 5


@pytest.mark.parametrize("block", PYTHON_BLOCKS, ids=range(len(PYTHON_BLOCKS)))
def test_a_python_block_runs(block, tmp_path):
    subprocess.run([sys.executable, "-c", block], check=True, cwd=tmp_path, timeout=120)


def test_the_physexp_commands_run_one_after_the_other(tmp_path):
    commands = [line for line in SHELL_LINES if line.startswith("physexp")]
    assert any(command.startswith("physexp train") for command in commands)
    for command in commands:
        _, *arguments = command.split()
        subprocess.run([Path(sys.executable).with_name("physexp"), *arguments], check=True, cwd=tmp_path, timeout=300)


def test_the_make_commands_are_targets_of_the_makefile():
    commands = [line for line in SHELL_LINES if line.startswith("make")]
    assert commands == ["make demo", "make test"]
    for command in commands:  # Only shown: these tests are themselves a part of `make test`.
        _, target = command.split()
        subprocess.run(["make", "--dry-run", target], check=True, cwd=ROOT, stdout=subprocess.DEVNULL)
