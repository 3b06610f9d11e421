"""A target is found by a name: a baseline, an agent, a team of agents, or a user's function."""

import pytest

from physexp.agents import pretrained
from physexp.analysis.score import protocol, targets


def names(target):
    return [asked.name for asked in targets.find(target).choose([], [])]


def described(name):
    target = targets.find(name)
    return target.describe(target.questions)


def test_an_unknown_target_is_refused_with_the_known_ones():
    with pytest.raises(ValueError, match="fly holds no run.*DOMAIN/TASK.*random, at_once, silent, ideal, .*rule"):
        targets.find("fly")


def test_an_agent_plays_its_own_task_and_others_with_equal_spaces():
    name = "which_is_heavier-features-difficulty3"
    assert names(name) == ["which_is_heavier/features,difficulty=3"]
    asked = targets.find(name).choose(["which_is_heavier/features,difficulty=2"], [])
    assert " --difficulty 3 " in targets.find(name).describe(asked)["command"] + " "
    for other in ("which_is_heavier/features,reveal=True", "which_is_heavier/pixels"):  # One more array, and an image.
        with pytest.raises(ValueError, match=f"does not play {other}; it plays which_is_heavier/features,difficulty=3"):
            targets.find(name).choose([other], [])


def test_a_target_plays_the_tasks_of_tracks_that_it_can():
    agent, (task, *_) = targets.find("threshold/features"), protocol.named(["threshold/features"])
    assert agent.choose([], ["exact"]) == agent.choose([], ["exact", "pixels"]) == (task,)
    assert targets.find("random").choose([], ["all"]) == protocol.in_tracks(["all"])
    with pytest.raises(ValueError, match="does not play any task of pixels; it plays threshold/features"):
        agent.choose([], ["pixels"])
    with pytest.raises(ValueError, match="track is 'hard'; choose from exact, pixels, .*all"):
        agent.choose([], ["hard"])


def test_the_agents_of_a_team_may_be_of_one_task_with_several_options():
    target = targets.find("which_is_heavier-features-difficulty3,which_is_heavier-features-difficulty5")
    usual, hard, harder = asked = protocol.named(
        [
            "which_is_heavier/features",
            "which_is_heavier/features,difficulty=3",
            "which_is_heavier/features,difficulty=2",
        ]
    )
    assert target.choose([], []) == (usual,)
    of_each = target.describe(asked)["agents"]
    assert of_each[hard.name] == of_each[harder.name] != of_each[usual.name], "the first agent plays a new setting"


def test_baselines_of_a_task_play_it_without_options():
    with pytest.raises(
        ValueError, match="lookup does not play towers/direct_features,cube_size=0.09; it plays towers/"
    ):
        targets.find("lookup").choose(["towers/direct_features,cube_size=0.09"], [])


def test_targets_play_the_tasks_that_they_can():
    assert targets.find("random").questions is targets.find("made:dies").questions is None
    path = str(pretrained.FOLDER / "threshold-features.safetensors")
    assert names("threshold/features") == names("threshold-features") == names(path) == ["threshold/features"]
    assert described(path) == described("threshold-features") == described("threshold/features")
    assert described(path)["frames"] == 60_024 and described(path)["command"].startswith("physexp train threshold")
    assert names("which_is_heavier-features-difficulty5") == ["which_is_heavier/features"]
    assert names("rule") == names("lookup") == ["towers/direct_features", "towers/fist_features"]
    with pytest.raises(ValueError, match="threshold/features does not play strings/features; it plays threshold/fe"):
        targets.find("threshold/features").choose(["strings/features"], [])


def test_each_agent_of_a_team_plays_its_own_task():
    assert names("a3c") == ["which_is_heavier/features", "towers/direct_features", "towers/fist_features"]
    team = targets.find("shipped")
    features, pixels = ([asked.name for asked in team.choose([], [track])] for track in ("exact", "pixels"))
    assert set(protocol.in_tracks(["exact", "pixels"])) <= set(team.agents)
    assert {"threshold/features", "strike/features"} < set(features) and "threshold/pixels" not in features
    assert "threshold/pixels" in pixels and "threshold/features" not in pixels
    assert names("threshold/features,strings/features") == ["threshold/features", "strings/features"]


def test_each_agent_of_a_team_in_a_team_counts_once():
    outer, inner, single = described("a3c,threshold/features"), described("a3c"), described("threshold/features")
    assert len(inner["agents"]) > 1
    assert outer["agents"] == inner["agents"] | {"threshold/features": single}
    assert outer["frames"] == inner["frames"] + single["frames"]


@pytest.mark.parametrize(
    ("target", "said"),
    [
        ("threshold/features,threshold-features", "has two agents for threshold/features with equal seeds"),
        ("threshold/features,random", "random is no trained agent; a team is of trained agents, so give it alone"),
        ("rule,threshold/features", "rule is no trained agent; a team is of trained agents, so give it alone"),
        ("threshold/features,fly", "fly holds no run"),
    ],
)
def test_a_team_with_no_agent_or_two_for_a_task_is_refused(target, said):
    with pytest.raises(ValueError, match=said):
        targets.find(target)


def test_files_of_a_target_have_a_name_of_letters(tmp_path, monkeypatch):
    (tmp_path / "here").mkdir()
    monkeypatch.chdir(tmp_path / "here")
    names_of_files = {"threshold/features": "threshold_features", "../x": "x", ".": "here", "+++": "target"}
    for target, name in {**names_of_files, 240 * "a": 60 * "a"}.items():
        assert targets.file_name(target) == name
