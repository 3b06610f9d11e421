"""A task is scored with its options, which its name says."""

import contextlib
import functools
from pathlib import Path

import numpy as np
import pytest

from physexp.analysis.score import log, protocol, scores, scoring, targets, verifying


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


_FIRST = ["balance", "sealed_box", "strike", "strings", "threshold", "towers/direct", "towers/fist", "which_is_heavier"]
TRACKS = {
    "exact": [f"{task}_features" if "/" in task else f"{task}/features" for task in _FIRST],
    "pixels": [f"{task}_pixels" if "/" in task else f"{task}/pixels" for task in _FIRST],
    "plan": [
        "balance/features,latch=True",
        "crush/features",
        "strike/features,difficulty=1",
        "strings/features,time_limit=4,num_pucks=4,num_clamps=2",
    ],
    "noise": ["threshold/features,flag_noise=0.1"],
    "questions": ["strings/features,questions=held_out", "strings/features,questions=held_out,num_questions=4"],
    "unseen": [
        "balance/features,difficulty=2",
        "lump/features,control_timestep=0.15",
        "sealed_box/features,physics_timestep=0.004,control_timestep=0.14",
        "strike/features,control_timestep=0.15",
        "strings/features,difficulty=2",
        "threshold/features,difficulty=2",
        "towers/direct_features,control_timestep=0.05",
        "towers/direct_features,sliding_friction=0.48",
        "towers/fist_features,control_timestep=0.05",
        "towers/fist_features,sliding_friction=0.48",
        "which_is_heavier/features,difficulty=2",
    ],
}


def test_the_tasks_of_a_track_stay_as_they_are():
    assert {track: sorted(asked.name for asked in protocol.in_tracks([track])) for track in protocol.TRACKS} == TRACKS
    assert all(map(protocol.is_judged, protocol.in_tracks(["all"])))


def test_greed_for_information_scores_little_in_the_track_of_plans():
    crush = next(asked for asked in protocol.in_tracks(["plan"]) if asked.domain == "crush")
    solution = protocol.ideal(crush)
    earned = solution.planning()
    assert (earned["greedy"] - earned["floor"]) / (solution.value - earned["floor"]) < 0.8


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


def test_a_task_without_an_exact_ideal_is_refused_at_once(here):
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


SEVERAL = "strings/features,questions=all,num_questions=3"


def test_every_right_answer_to_several_questions_counts(here):
    (asked,), folder = protocol.named([SEVERAL]), Path("scored")
    of_ideal = scoring.score(targets.find("ideal"), [asked], 6, Path("ideal"))["tasks"][SEVERAL]
    assert of_ideal["score"] == pytest.approx(1)
    assert of_ideal["mean_interactions"] == of_ideal["ideal_interactions"]
    gains, reference = of_ideal["gains"], of_ideal["ideal_gains"]  # The last steps are answers.
    assert gains == pytest.approx(reference[: len(gains)], abs=1e-12) and not any(reference[len(gains) :])
    metrics = scoring.score(targets.find("random"), [asked], 6, folder)["tasks"][SEVERAL]
    assert metrics["score"] + sum(metrics["mistakes"].values()) == pytest.approx(1)
    assert metrics["score"] + metrics["luck"] == pytest.approx(metrics["raw_score"])
    right, returns = 0, []
    with contextlib.closing(protocol.load(asked)) as environment:
        for actions in log.split(log.of_task(log.read(folder), asked)):
            environment.reset()
            rewards = []
            for action in actions["action"]:
                right += action == asked.num_interactions + environment.task.correct_answer
                rewards.append(environment.step(int(action)).reward)
            returns.append(np.dot(asked.discount ** np.arange(len(rewards)), rewards))
    assert metrics["success_rate"] == pytest.approx(right / (3 * 6))
    share = (np.mean(returns) - metrics["floor"]) / (metrics["ideal"] - metrics["floor"])
    assert metrics["raw_score"] == pytest.approx(share)
    assert verifying.verify(folder)["episodes"] == 6


@pytest.mark.parametrize("name", ["crush/features", SEVERAL])
def test_random_actions_earn_the_mean_over_all_of_them(name):
    (asked,) = protocol.named([name])
    num_labels = asked.num_actions - asked.num_interactions

    @functools.cache
    def expected(step, left):
        """From a step on, with some questions left; a right answer earns 1, all others and those left over cost 1."""
        if step == asked.step_limit or not left:
            return -left / asked.discount  # At the step before.
        answer = 1 / num_labels - (num_labels - 1) / num_labels + asked.discount * expected(step + 1, left - 1)
        interaction = asked.discount * expected(step + 1, left)
        return (num_labels * answer + asked.num_interactions * interaction) / asked.num_actions

    assert scores.random_return(asked) == pytest.approx(expected(0, asked.num_questions))
