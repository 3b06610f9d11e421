"""All targets are scored; a failure is one line, and the episodes before it are kept."""

from concurrent import futures
import json
import multiprocessing
import os
from pathlib import Path
import re
import signal
import subprocess
import sys

import commands
import numpy as np
import psutil
import pytest
import waiting

from physexp import suite
from physexp.analysis.score import judging, log, player, playing, protocol, scoring, targets, verifying

pytestmark = pytest.mark.usefixtures("here")

THRESHOLD = protocol.named(["threshold/features"])
BOTH = protocol.named(["threshold/features", "strings/features"])


def score(target, questions=THRESHOLD, count=4, folder="scored", greedy=False, **options):
    return scoring.score(targets.find(target, greedy), questions, count, Path(folder), **options)


def failure_of(target, **options):
    """Returns the message about an agent that fails in its third episode; checks that two were kept."""
    with pytest.raises(player.PlayerError) as error:
        score(target, **options)
    assert str(error.value).endswith("; the episodes before it are in scored, and the same command goes on after them")
    kept = scoring.read(Path("scored"))
    assert not kept["complete"] and kept["problem"] in str(error.value)
    assert kept["tasks"]["threshold/features"]["episodes"] == 2
    assert verifying.verify(Path("scored"))["episodes"] == 2
    assert "\n" not in str(error.value)
    return str(error.value)


def test_the_policy_of_the_documentation_is_as_good_as_the_ideal():
    metrics = score("halving:policy")["tasks"]["threshold/features"]
    # Eight levels, alike likely, and three pushes halve them three times; each costs a twentieth of the later reward.
    assert metrics["score"] == metrics["raw_score"] == 1
    assert metrics["ideal"] == pytest.approx(0.95**3)
    assert metrics["mean_interactions"] == metrics["ideal_interactions"] == 3
    assert metrics["bits_per_interaction"] == pytest.approx(1)
    assert metrics["success_rate"] == 1


def test_an_actor_gets_every_time_step_and_its_prints_are_no_output(capfd):
    score("made:Told", count=1)
    seen = "asked ['slid', 'strength']"
    assert Path("told").read_text() == (f"first None None; {seen}; saw 0 1.0; updated; {seen}; saw 8 0.0")
    printed = capfd.readouterr()
    assert not printed.out and printed.err.startswith("made for threshold/features")


@pytest.mark.parametrize(
    ("target", "said"),
    [
        ("made:opens_what_is_not_there", r"failed: FileNotFoundError: .*, made.py:\d+ \(threshold/features, episode 2"),
        ("made:returns_no_pair", r"failed: TypeError: a policy returns an action and the next state; .* returned 3 \("),
        ("made:dies", r"ended its process, exit code -9 \(threshold/features, episode 2, step 0\)"),
        ("made:chooses_text", r"chose 'push', which is no action \(.* step 0\); return an integer from 0 to 15"),
        ("made:chooses_too_much", "chose 16, which is no action"),
        ("made:hangs", r"did nothing within 2 s \(threshold/features, episode 2, step 0\)"),
    ],
)
def test_a_failing_agent_gives_one_line_and_earlier_episodes_are_kept(target, said):
    failure = failure_of(target, timeout=2.0)
    assert failure.startswith(f"{target} ") and re.search(said, failure), failure
    assert not [child for child in multiprocessing.active_children() if child.name.startswith("actor")]


def test_programs_of_an_agent_inherit_no_mask_and_end_with_it():
    failure_of("made:starts_a_program", timeout=5.0)
    number, blocked, *handlers = json.loads(Path("program").read_text())
    assert not blocked and handlers == ["default_int_handler", 0, 0]  # Python's own, and the system's.
    waiting.wait_until(lambda: not psutil.pid_exists(number), "the end of the program")


def test_programs_of_an_agent_end_when_the_score_is_killed(here):
    words = ["score", "made:starts_a_program", "--tasks", "threshold/features", "--output", "kept"]
    with commands.start(*words, cwd=here) as process:
        waiting.wait_until((here / "hanging").exists, "the third episode", pid=process.pid)
        refused = commands.run(*words, cwd=here)
        process.kill()
        process.wait()
    assert (refused.returncode, refused.stderr) == (
        2,
        "physexp: kept is in use by another process; give another --output\n",
    )
    number, *_ = json.loads(Path("program").read_text())
    waiting.wait_until(lambda: not psutil.pid_exists(number), "the end of the program")


def test_a_script_needs_no_guard_unless_it_plays_itself(here):
    lines = [
        "from pathlib import Path",
        "from physexp.analysis.score import protocol, scoring, targets",
        "from halving import policy",
        'tasks = protocol.named(["threshold/features", "strings/features"])',
        'print(scoring.score(targets.find("random"), tasks, 2, Path("random"))["complete"])',
        'scoring.score(targets.find("script:policy"), tasks[:1], 2, Path("itself"))',
    ]
    (here / "script.py").write_text("\n".join(lines))
    done = subprocess.run([sys.executable, "script.py"], capture_output=True, text=True)
    assert done.stdout == "True\n"
    assert done.stderr.splitlines()[-1].endswith(
        "PlayerError: script:policy failed: the module plays episodes when it is imported; "
        'put its own calls below `if __name__ == "__main__":` (threshold/features, before the first episode)'
    )


@pytest.mark.parametrize(
    ("target", "said"),
    [
        ("nowhere:policy", "No module named 'nowhere'; start where it is, or install it"),
        ("made:nothing", "made has no nothing; name a function that it has"),
        ("made:number", "number is no function; give a function of a question"),
        ("made:of_three", "of_three has 3 parameters without a default; give a function of a question"),
        ("made:makes_nothing", "it returned int; return an actor, with select_action, observe_first, observe, update"),
    ],
)
def test_a_function_that_cannot_play_fails_before_the_first_episode(target, said):
    with pytest.raises(player.PlayerError, match="before the first episode") as error:
        score(target)
    assert str(error.value).startswith(f"{target} failed: {said}")
    assert not Path("scored").exists(), "so that it can be tried again"


def test_a_team_scores_like_its_agents_alone():
    team = score("threshold/features,strings/features", BOTH, folder="team")
    for asked in BOTH:
        alone = score(asked.name, [asked], folder=asked.domain)
        assert team["tasks"][asked.name]["score"] == alone["tasks"][asked.name]["score"]
        assert team["agent"]["agents"][asked.name] == alone["agent"]
    assert team["agent"]["frames"] == sum(one["frames"] for one in team["agent"]["agents"].values())


@pytest.mark.parametrize("target", ["random", "threshold/features"])
def test_a_target_plays_the_same_again_for_any_number_of_episodes(target):
    score(target, folder="once")
    score(target, folder="fewer", count=3)
    fewer = log.read(Path("fewer"))
    assert log.read(Path("once")).slice(0, len(fewer)).equals(fewer)


def test_the_log_has_a_row_for_each_action_and_rebuilds_each_instance():
    score("random", BOTH)
    rows = log.read(Path("scored")).to_pandas()
    for (domain, task, seed, episode), played in rows.groupby(["domain", "task", "seed", "episode"], sort=False):
        environment = suite.load_batch(domain, task, 1, {"random": protocol.SEED})
        assert seed == suite.environment_seed(protocol.SEED, 0)
        timestep = environment.reset(episode=episode)
        for row in played.itertuples():
            assert row.observation == log.digest({name: value[0] for name, value in timestep.observation.items()})
            timestep = environment.step(np.array([row.action]))
            assert row.reward == timestep.reward[0]
        assert timestep.last()
    made = rows.mistake.notna()
    np.testing.assert_allclose(rows.regret, rows.value - rows.worth, atol=1e-12)
    assert (rows.regret[made] > 1e-9).all() and (rows.regret[~made].abs() <= 1e-9).all()


def test_the_command_scores_and_verifies(here):
    words = ["score", "halving:policy", "--tasks", "threshold/features", "--episodes", "3", "--minutes", "2"]
    done = commands.run(*words, cwd=here)
    assert done.returncode == 0, done.stderr
    assert (here / "scores/halving_policy/report.html").exists()
    head, line, folder = done.stdout.splitlines()
    assert head.split()[:2] == ["task", "score"] and folder == "scores/halving_policy"
    assert line.split() == ["threshold/features", "1.0000", "1.0000", "to", "1.0000", "1.0000", "3.0000", "nothing"]
    assert commands.run(*words, cwd=here).stdout.splitlines()[-1] == "scores/halving_policy-2"
    refused = commands.run(*words, "--output", folder, cwd=here)
    assert refused.stderr == f"physexp: {folder} exists and is not empty; give another --output\n"
    done = commands.run("verify", folder, cwd=here)
    assert done.stdout == "OK: 3 episodes were played so, by halving:policy; score threshold/features 1.0000\n"
    done = commands.run("verify", folder, "--json", cwd=here)
    played = {"episodes": 3, "actions": 12, "target": "halving:policy", "scores": {"threshold/features": 1.0}}
    assert json.loads(done.stdout) == played | {"complete": True, **protocol.PUBLIC.facts}
    refused = commands.run("verify", "nowhere", cwd=here)
    assert refused.stderr == (
        "physexp: nowhere holds no score (score.json); give a folder that `physexp score` has written\n"
    )


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["--tasks", "threshold/fast"], "task is 'threshold/fast'; choose from which_is_heavier/"),
        (["--episodes", "0"], "episodes is 0; give a number from 1 to 10,000"),
        (["--timeout", "0"], "timeout is 0.0; give a number from 0 to 1e+06 s but not 0"),
        (["--minutes", "nan"], "minutes is nan; give "),
        (["--frames", "-3"], "frames is -3; give an integer >= 0"),
    ],
)
def test_the_command_refuses_before_anything_is_played(here, words, said):
    done = commands.run("score", "halving:policy", *words, cwd=here)
    assert done.returncode == 2 and done.stderr.startswith(f"physexp: {said}"), done.stderr
    assert not (here / "scores").exists()


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGKILL])
def test_an_interrupted_score_goes_on_and_plays_nothing_twice(here, number):
    words = ["score", "made:waits", "--tasks", "threshold/features", "--episodes", "5"]
    begun = here / "begun"
    with commands.start(*words, cwd=here) as process:
        waiting.wait_until(lambda: begun.exists() and begun.stat().st_size == 3, "an episode", pid=process.pid)
        process.send_signal(number)
        _, errors = process.communicate()
    assert process.returncode == (-9 if number == signal.SIGKILL else 128 + number)
    if number == signal.SIGINT:
        assert errors == (
            "the episodes that were played are in scores/made_waits; the same command goes on after them\n"
            "physexp: interrupted\n"
        )
    (here / "go").touch()
    commands.run(*words, cwd=here, check=True)
    assert begun.stat().st_size == 3 + 3, "two episodes were over, and the third is played anew"
    score("halving:policy", count=5, folder="whole")
    found, whole = (log.read(here / folder) for folder in ("scores/made_waits", "whole"))
    assert found.equals(whole)
    assert sorted(path.name for path in (here / "whole").iterdir()) == ["actions.parquet", "score.json"]


def test_a_score_is_complete_once_its_report_is_drawn():
    def fail(folder):
        raise OSError("no space left")

    with pytest.raises(OSError, match="no space left"):
        score("random", finish=fail)
    assert (Path("scored") / playing.FILE).exists()
    drawn = []
    score("random", finish=drawn.append)
    assert drawn == [Path("scored")] and not (Path("scored") / playing.FILE).exists()


def test_a_score_goes_on_with_the_episodes_that_were_written_whole():
    class Ended(Exception):
        """As a kill would: nothing catches it."""

    def end(done):
        if done == 5:  # Ten of twelve are played, and none is judged.
            raise Ended

    score("random", BOTH, count=6, folder="whole")
    with pytest.raises(Ended):
        score("random", BOTH, count=6, show=end)
    played = Path("scored") / playing.FILE
    with played.open("ab") as file:
        file.write(b'["strings/features", [1, 2')  # As when the power fails.
    for target, options, said in (
        ("at_once", {"count": 6}, 'begun with target "random" instead of "at_once"; give the same, or another --outp'),
        ("random", {"count": 5}, "begun with protocol episodes 6 instead of 5; give the same, or"),
        ("random", {"count": 6, "greedy": True}, "begun with greedy false instead of true"),
    ):
        with pytest.raises(ValueError, match=said):
            score(target, BOTH, **options)
    score("random", BOTH, count=6)
    assert log.read(Path("scored")).equals(log.read(Path("whole")))
    assert not played.exists()


def test_a_killed_judge_is_an_error():
    def kill(done):
        for worker in multiprocessing.active_children():
            worker.kill()

    # A hundred aimless episodes of Sealed Box take half a minute to judge; the one of Threshold is done before.
    (slow,), (fast,) = protocol.named(["sealed_box/features"]), THRESHOLD
    ways = np.random.default_rng(0).integers(slow.num_interactions, size=(100, 20))
    aimless = zip(protocol.drawn(slow, 100), ways, strict=True)
    played = {slow: list(aimless), fast: [(protocol.drawn(fast, 1)[0], np.array([fast.num_interactions]))]}
    with pytest.raises(futures.BrokenExecutor):
        judging.judge(played, kill)
    assert not multiprocessing.active_children()


def test_a_hangup_of_the_terminal_ends_judges_without_a_word(here):
    """With real processes of their own, whose tracker of semaphores is in the terminal's group, too."""
    words = ["score", "random", "--tasks", "sealed_box/features", "threshold/features", "--episodes", "60"]
    program, played = Path(sys.executable).with_name("physexp"), here / "out" / playing.FILE
    with subprocess.Popen(
        [program, *words, "--output", "out"], stderr=subprocess.PIPE, text=True, start_new_session=True
    ) as process:
        waiting.wait_until(
            lambda: played.exists() and len(played.read_bytes().splitlines()) == 1 + 2 * 60, "judges", pid=process.pid
        )
        waiting.wait_until(
            lambda: len(psutil.Process(process.pid).children()) == 3, "two judges and the tracker", pid=process.pid
        )
        os.killpg(process.pid, signal.SIGHUP)
        _, errors = process.communicate()
    assert errors == (
        "the episodes that were played are in out; the same command goes on after them\nphysexp: interrupted\n"
    )
