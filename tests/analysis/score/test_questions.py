"""A task is scored with its options, which its name says."""

from pathlib import Path

import pytest

from physexp.analysis.score import log, protocol, scoring, targets, verifying


@pytest.mark.parametrize(
    ("given", "name", "options"),
    [
        ("strings/features,difficulty=2.0", "strings/features,difficulty=2", {"difficulty": 2}),
        ("strings/features,difficulty=1,reveal=False", "strings/features", {}),
        (
            "lump/features,difficulty=3,reveal=True",
            "lump/features,reveal=True,difficulty=3",
            dict(difficulty=3, reveal=True),
        ),
    ],
)
def test_one_question_has_one_name_which_says_its_options(given, name, options):
    (asked,) = protocol.named([given, name])
    assert (asked.name, asked.options) == (name, options)
    assert protocol.question(asked.domain, asked.task, options) is asked


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("strings/forces", "task is 'strings/forces'; choose from .*, strings/features, "),
        ("strings/features,pucks=4", "task_kwargs has 'pucks'; allowed: .*, difficulty"),
        ("strings/features,difficulty=low", "difficulty is 'low'; give a finite number >= 1"),
        ("strings/features,difficulty", "'difficulty' is no option of a task; give NAME=VALUE"),
        ("strings/features,random=3", "random is 3; leave it out: all targets play the same instances"),
    ],
)
def test_an_unknown_option_is_refused_with_those_that_are_allowed(name, said):
    with pytest.raises(ValueError, match=said):
        protocol.named([name])


def test_a_task_without_an_exact_ideal_is_refused_before_anything_is_played(here):
    (noisy,) = protocol.named(["which_is_heavier/features,noise=0.001"])
    with pytest.raises(ValueError, match="noise=0.001 has no score: .*, without noise, variation and step_variation"):
        scoring.score(targets.find("random"), [noisy], 1, Path("scored"))
    assert not Path("scored").exists()


def test_settings_of_one_task_are_scored_side_by_side(here):
    names = ["crush/features,num_cans=1", "crush/features"]
    folder, one, two = Path("scored"), *protocol.named(names)
    found = scoring.score(targets.find("ideal"), [one, two], 3, folder)
    assert [*found["tasks"]] == found["protocol"]["tasks"] == names
    single, double = found["tasks"].values()
    # With one can, each force is tried in turn: it is found with the press that crushes, the last one without.
    presses = [*range(1, 16), 15]
    assert single["ideal"] == pytest.approx(sum(one.discount**count for count in presses) / len(presses))
    assert single["score"] == pytest.approx(1) and double["ideal"] > single["ideal"]
    assert verifying.verify(folder)["episodes"] == 2 * 3
    assert set(log.of_task(log.read(folder), one)["task"]) == {"features,num_cans=1"}
