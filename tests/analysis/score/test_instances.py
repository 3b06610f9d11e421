"""Private instances follow from a key that no agent sees, and a score shows which key that was."""

import hashlib
import json
import multiprocessing
from pathlib import Path
import re
import sys

import numpy as np
import pytest

from physexp import cli, suite
from physexp.analysis.score import instances, log, protocol, scoring, targets, verifying

pytestmark = pytest.mark.usefixtures("here")

KEY = "00112233445566778899aabbccddeeff"
TASK = "threshold/features"
(THRESHOLD,) = protocol.named([TASK])
PRIVATE = instances.Private(KEY)

_CHEATS = '''
"""Answers at once, from the public instances."""

from physexp.analysis.score import protocol


def make(question):
    environment = protocol.load(question)

    def policy(observation, state):
        environment.reset()
        return question.num_interactions + environment.task.correct_answer, None

    return policy
'''

_LOOKS = '''
"""Writes down all that its process knows, and answers."""

import os
from pathlib import Path
import sys


def make(question):
    frames, frame = [], sys._getframe()
    while frame:
        frames.append({name: value for name, value in frame.f_locals.items() if name != "frames"})
        frame = frame.f_back
    Path("seen").write_text(repr([sys.argv, sys.orig_argv, dict(os.environ), vars(question), frames]))
    return lambda observation, state: (question.num_interactions, None)
'''


@pytest.fixture
def run(monkeypatch, capsys):
    """A function that runs the command with some arguments and returns its output, or its error if that is expected."""

    def run(*arguments, status=0):
        monkeypatch.setattr(sys, "argv", ["physexp", *map(str, arguments)])
        capsys.readouterr()
        try:
            cli.main()
            found = 0
        except SystemExit as error:
            found = error.code or 0
        printed = capsys.readouterr()
        assert found == status, printed
        return printed.err if status else printed.out

    return run


@pytest.fixture
def refused(run):
    """A function that returns the line of a command that is refused."""

    def refused(*arguments):
        said = run(*arguments, status=2)
        assert said.count("\n") == 1
        return said

    return refused


def test_the_seed_of_each_episode_is_a_code_of_its_own():
    def sha(*parts):
        return hashlib.sha256(b"".join(parts)).digest()

    block = KEY.encode().ljust(64, b"\0")  # RFC 2104.
    inner, outer = (bytes(byte ^ pad for byte in block) for pad in (0x36, 0x5C))
    for episode in (0, 7):
        code = sha(outer, sha(inner, f"{TASK} {episode}".encode()))
        assert PRIVATE.seed_of(TASK, episode) == 2**62 + int.from_bytes(code[:8], "big") % 2**62
    seeds = [PRIVATE.seed_of(TASK, episode) for episode in range(1000)]
    assert len(set(seeds)) == 1000 and min(seeds) > 2**32 > suite.environment_seed(0, 0)
    assert PRIVATE.key_hash == hashlib.sha256(KEY.encode()).hexdigest() and KEY not in repr(PRIVATE)


def test_a_score_of_private_instances_is_verified_with_their_file(run, refused, tmp_path):
    (tmp_path / "key").write_text(f"{KEY}\n")
    run("draw-instances", "--key", "key", "--json", "one.json")
    printed = run("draw-instances", "two.json")
    two = instances.read(Path("two.json"), protocol.VERSION)
    assert printed == f"The SHA-256 of the key in two.json is {hashlib.sha256(two.key.encode()).hexdigest()}.\n"
    assert instances.read(Path("one.json"), protocol.VERSION) == PRIVATE
    assert Path("two.json").stat().st_mode & 0o777 == 0o600

    command = ("score", "random", "--tasks", TASK, "--episodes", 30)
    run(*command, "--instances", "one.json", "--output", "private")
    run(*command, "--output", "public")
    rows = log.as_columns(log.read(Path("private")))
    first = rows["step"] == 0
    assert rows["seed"][first].tolist() == [PRIVATE.seed_of(TASK, episode) for episode in range(30)]
    for index, seed in enumerate(rows["seed"][first][:5]):
        environment = suite.load("threshold", "features", {"random": int(seed)})
        environment.task.next_episode = index
        environment.reset()
        np.testing.assert_array_equal(environment.task.hidden, protocol.drawn(THRESHOLD, 30, PRIVATE)[index])
    assert not np.array_equal(protocol.drawn(THRESHOLD, 30, PRIVATE), protocol.drawn(THRESHOLD, 30))

    said = refused("verify", "private")
    assert f"the hash {PRIVATE.key_hash}; put their file, which its author" in said
    assert f"key_hash is {PRIVATE.key_hash} instead of {two.key_hash}" in refused(
        "verify", "private", "--instances", "two.json"
    )
    assert "public is of the public instances; leave out --instances" in refused(
        "verify", "public", "--instances", "one.json"
    )
    told = f"30 episodes were played so, by random, on the private instances of the key with SHA-256 {PRIVATE.key_hash}"
    assert told in run("verify", "private", "--instances", "one.json")
    Path("one.json").rename("private/instances.json")  # As they are published with the row.
    assert verifying.verify(Path("private"))["episodes"] == 30


def test_public_answers_are_worth_nothing_on_private_instances(tmp_path):
    (tmp_path / "cheats.py").write_text(_CHEATS)
    for which, is_right in ((protocol.PUBLIC, True), (PRIVATE, False)):
        folder = Path(f"right {is_right}")
        found = scoring.score(targets.find("cheats:make"), [THRESHOLD], 20, folder, which=which)
        # By chance one of eight levels is right; 14 of 20 are less likely than 1e-8.
        assert (found["tasks"][TASK]["success_rate"] >= 0.7) == is_right


def test_the_process_of_an_agent_knows_neither_the_key_nor_its_file(run, monkeypatch, tmp_path):
    """The process is spawned, for which multiprocessing tells it the arguments of its parent."""
    monkeypatch.setitem(multiprocessing.context._concrete_contexts, "spawn", multiprocessing.context.SpawnContext())
    (tmp_path / "looks.py").write_text(_LOOKS)
    instances.write(Path("secret.json"), PRIVATE, protocol.VERSION)
    run("score", "looks:make", "--tasks", TASK, "--episodes", 1, "--instances", "secret.json")
    seen = Path("seen").read_text()
    assert "spawn_main" in seen and "threshold" in seen
    found = [text for text in ("secret.json", KEY) if text in seen]
    assert not found


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (lambda found: found.pop("key"), "has no key; its author publishes it when the scores are made"),
        (lambda found: found.update(key=f"{KEY} "), "key_hash is '.*', and the key's is .*; one of them was changed"),
        (lambda found: found.update(key="secret"), "the key is no secret: it has 6 characters"),
        (lambda found: found.update(version="v0"), f"of protocol 'v0'; give some of {protocol.VERSION}"),
        (
            lambda found: found.pop("key_hash"),
            "holds no instances; give a file that `physexp draw-instances` has written",
        ),
    ],
)
def test_a_file_that_does_not_fit_is_refused_in_one_line(refused, change, said):
    path = Path("changed.json")
    instances.write(path, PRIVATE, protocol.VERSION)
    found = json.loads(path.read_text())
    change(found)
    path.write_text(json.dumps(found))
    assert re.search(said, refused("score", "silent", "--instances", path))
    assert not Path("scores").exists()


def test_a_key_is_never_overwritten_and_a_poor_one_is_refused(refused):
    instances.write(Path("old.json"), PRIVATE, protocol.VERSION)
    assert "old.json exists, and may hold the only copy of a key" in refused("draw-instances", "old.json")
    assert instances.read(Path("old.json"), protocol.VERSION) == PRIVATE
    Path("short").write_text("12345\n")
    Path("odd").write_bytes(b"\xff" * 64)
    assert "the key is no secret: it has 5 characters" in refused("draw-instances", "new.json", "--key", "short")
    assert "the key is no secret" in refused("draw-instances", "new.json", "--key", "odd")
    assert not Path("new.json").exists()
