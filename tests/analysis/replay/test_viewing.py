"""Files for the viewer on a full disk; the viewer in a window, in a browser, and beside a game."""

import contextlib
import os
from pathlib import Path
import re
import resource
import signal
import subprocess
import urllib.request

import commands
import numpy as np
from PIL import Image
import pytest
import recordings
from rerun.chunk import RrdReader
import screens
from trainers import PHYSEXP
import waiting
from waiting import wait_until

from physexp.analysis.replay import writing
from physexp.suite.parts import things as things_lib


def film(seed=0):
    return recordings.play("which_is_heavier", "features", [0, 1, 4], random=seed)


def test_a_full_disk_leaves_the_earlier_episodes(tmp_path):
    one = writing.write(tmp_path / "one.rrd", [lambda: [film()]])
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    # Each episode is about as large as the next; the kernel refuses files of two and a half.
    resource.setrlimit(resource.RLIMIT_FSIZE, (int(2.5 * one.stat().st_size), before[1]))
    try:
        with pytest.raises(OSError, match="File too large: .*four.rrd"):
            writing.write(tmp_path / "four.rrd", [lambda k=k: [film(k)] for k in range(4)])
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)
    recordings.verify(tmp_path / "four.rrd")
    assert len(RrdReader(str(tmp_path / "four.rrd")).recordings()) == 2
    assert sorted(path.name for path in tmp_path.iterdir()) == ["four.rrd", "one.rrd"]


def test_a_failing_or_hanging_rerun_program_is_one_line(tmp_path, monkeypatch):
    failing, sleeping = tmp_path / "failing", tmp_path / "sleeping"
    failing.write_text("#!/bin/sh\ncat > /dev/null\necho something went wrong >&2\nexit 3\n")
    sleeping.write_text("#!/bin/sh\nexec sleep 1000\n")
    played = film()
    for program, message in ((failing, "cannot merge the recordings: something went wrong$"), (sleeping, "not merged")):
        program.chmod(0o755)
        if program is sleeping:
            monkeypatch.setattr(writing, "_MERGE_SECONDS", 0.2)
        monkeypatch.setattr(writing, "PROGRAM", program)
        path = tmp_path / f"{program.name}.rrd"
        with pytest.raises(RuntimeError, match=message):
            writing.write(path, [lambda: [played]] * 2)
        assert len(RrdReader(str(path)).recordings()) == 1  # The first one is there.


@screens.needs_screen
def test_the_viewer_opens_a_file_and_shows_it(tmp_path):
    path, picture = writing.write(tmp_path / "one.rrd", [lambda: [film()]]), tmp_path / "viewer.png"
    environment = {"HOME": str(tmp_path), "PATH": "/usr/bin:/bin"}
    waiting.run([writing.PROGRAM, "analytics", "disable"], env=environment)
    # The pointer is in the middle of the screen; beside the window, it covers nothing with what it points to.
    with screens.screen("3000x2000x24") as display:
        # Without `--new`, a viewer that finds rerun's port taken hands over its data and ends.
        command = [writing.PROGRAM, path, "--new", "--screenshot-to", picture, "--window-size", "1280x800"]
        waiting.run(command, env={**environment, "DISPLAY": display})
    pixels = np.asarray(Image.open(picture).convert("RGB"))
    colors, counts = np.unique(pixels.reshape(-1, 3), axis=0, return_counts=True)
    assert len(colors) > 200  # Text, curves, shaded cubes: much more than a background.
    assert counts.max() < 0.95 * counts.sum()
    red = np.array(things_lib.COLORS[0][:3])  # The face of block 0, in whatever light.
    seen = colors[np.linalg.norm(colors, axis=1) > 0].astype(float)
    hue = seen / np.linalg.norm(seen, axis=1, keepdims=True) - red / np.linalg.norm(red)
    assert counts[np.linalg.norm(colors, axis=1) > 0][np.linalg.norm(hue, axis=1) < 0.08].sum() > 300


def test_a_live_episode_shows_nothing_hidden_before_it_is_over(tmp_path):
    paths = [tmp_path / "so_far.rrd", tmp_path / "all.rrd"]
    for path, actions in zip(paths, ([0, 1], [0, 1, 4]), strict=True):
        recordings.play("which_is_heavier", "features", actions, path)
    so_far, everything = map(recordings.contents, paths)
    assert {"/world/things/block_0", "/did/actions", "/seen/heights"} <= so_far.keys()
    assert not [entity for entity in so_far if "hidden" in entity or "ideal" in entity]
    assert {"/world/hidden/mark_block_0", "/belief/ideal"} <= everything.keys()
    said = [{text[0] for text in rows["/did/outcome"]["TextDocument:text"]} for rows in (so_far, everything)]
    assert all("Not answered yet" in text for text in said[0])
    assert any("Answer after 2 interactions" in text for text in said[1])
    log = everything["/did/actions"]["TextDocument:text"][-1][0].splitlines()
    assert log == ["- step 0: poke block 0", "- step 1: poke block 1", "- step 2: answer: block 0 is heaviest"]


def viewers(home):
    """The processes of rerun's program whose HOME is this."""
    found = []
    for entry in Path("/proc").iterdir():
        with contextlib.suppress(OSError):
            is_ours = entry.name.isdigit() and f"HOME={home}\0".encode() in (entry / "environ").read_bytes()
            if is_ours and os.readlink(entry / "exe") == str(writing.PROGRAM.resolve()):
                found.append(int(entry.name))
    return found


URL = r"http://127\.0\.0\.1:\d+/\S+"


def test_the_browser_viewer_is_served_on_the_loopback_alone(tmp_path):
    environment = {**os.environ, "HOME": str(tmp_path), "BROWSER": "true"}
    options = ["--episodes", 1, "--web", "--output", tmp_path / "one.rrd"]

    def sockets():
        return {socket for viewer in viewers(tmp_path) for socket in commands.listening(viewer)}

    with commands.start(
        "replay", "which_is_heavier/features", *options, env=environment, stderr=subprocess.STDOUT
    ) as process:
        wait_until(lambda: len(sockets()) >= 2, "two listening sockets")
        assert {address for address, _ in sockets()} == {"127.0.0.1"}
        wait_until(lambda: re.search(URL, process.stdout.so_far()), "its address")
        (url,) = re.findall(URL, process.stdout.so_far())
        with urllib.request.urlopen(url, timeout=600) as page:
            assert page.status == 200
        process.send_signal(signal.SIGINT)
        assert process.wait() == 0
        wait_until(lambda: not viewers(tmp_path), "the viewer to be gone")
        assert "Traceback" not in process.stdout.read()


@screens.needs_screen
def test_a_person_plays_beside_a_local_viewer_that_may_be_closed(tmp_path):
    with screens.screen() as display:
        environment = {
            "HOME": str(tmp_path),
            "PATH": f"{PHYSEXP.parent}:/usr/bin:/bin",
            "PYTHONPATH": os.environ.get("PYTHONPATH", ""),
            "DISPLAY": display,
        }
        waiting.run([writing.PROGRAM, "analytics", "disable"], env=environment)
        _play_beside_the_viewer(environment, tmp_path)


def _play_beside_the_viewer(environment, home):
    command = [PHYSEXP, "play", "which_is_heavier", "features", "--seed", "3", "--view"]
    output = home / "output"
    with open(output, "w") as file:
        process = subprocess.Popen(
            command, env=environment, stdin=subprocess.PIPE, stdout=file, stderr=file, text=True, start_new_session=True
        )

    def type_in(text):
        asked = output.read_text().count("action: ")
        process.stdin.write(text + "\n")
        process.stdin.flush()
        wait_until(lambda: output.read_text().count("action: ") > asked, f"the question after {text}")

    try:
        wait_until(lambda: "action: " in output.read_text(), "the first question")
        wait_until(lambda: any(map(commands.listening, viewers(home))), "a viewer that listens")
        (first,) = viewers(home)
        assert {address for address, _ in commands.listening(first)} == {"127.0.0.1"}
        type_in("0")
        os.kill(first, signal.SIGKILL)  # The player closes the window.
        type_in("0")
        type_in("4")  # The next episode opens another one.
        wait_until(lambda: set(viewers(home)) - {first}, "another viewer")
        process.stdin.write("q\n")
        process.stdin.close()
        wait_until(lambda: process.poll() is not None, "the end of the game")
        assert process.returncode == 0
        assert output.read_text().count("The answer: block") == 1 and "Traceback" not in output.read_text()
    finally:
        for pid in viewers(home):
            with contextlib.suppress(ProcessLookupError):
                os.kill(pid, signal.SIGKILL)
        with contextlib.suppress(ProcessLookupError):
            os.killpg(process.pid, signal.SIGKILL)
        process.wait()
        process.stdin.close()


def test_without_a_display_the_viewer_is_refused_in_one_line(tmp_path):
    environment = {"HOME": str(tmp_path), "PYTHONPATH": os.environ.get("PYTHONPATH", "")}
    done = commands.run("replay", "which_is_heavier/features", "--view", cwd=tmp_path, env=environment)
    assert not list(tmp_path.glob("*.rrd"))
    assert done.returncode == 2 and done.stderr.count("\n") == 1 and "no display" in done.stderr
