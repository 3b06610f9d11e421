"""The documentation's clone of the ideal experimenter learns from exported episodes, and is scored."""

from pathlib import Path
import shutil
import sys

from physexp.analysis.score import exporting, protocol, scoring, targets

EXAMPLE = Path(__file__).parents[3] / "docs" / "examples" / "clone_the_ideal.py"
sys.path.insert(0, str(EXAMPLE.parent))

import clone_the_ideal  # noqa: E402


def test_a_clone_of_the_ideal_scores_like_the_ideal(monkeypatch, tmp_path):
    monkeypatch.chdir(tmp_path)
    shutil.copy(EXAMPLE, tmp_path)
    asked = protocol.named(["threshold/features"])
    # Its eight levels are alike likely: that one of them is in none of 100 episodes has a chance of 8 (7/8)^100 = 1e-5.
    exporting.export(targets.find("ideal"), asked, 100, Path("exported"))
    clone_the_ideal.train("exported", "threshold/features", updates=300)
    found = scoring.score(targets.find("clone_the_ideal:make"), asked, 40, Path("scored"))
    assert found["tasks"]["threshold/features"]["score"] > 0.95
