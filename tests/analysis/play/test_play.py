"""The game in a terminal: drawings, prompts and scores."""

import dataclasses
import io
import os
import re
import subprocess
import sys

import numpy as np
import pytest
from seeds import fresh_seed
from trainers import PHYSEXP

from physexp import suite
from physexp.agents import pretrained
from physexp.analysis.play import game, terminal
from physexp.analysis.score import records
from physexp.cli import printing


def typed(*lines):
    """A player who types these lines and then leaves."""
    left = list(lines)

    def read(prompt):
        if not left:
            raise EOFError
        return left.pop(0)

    return read


def test_right_answers_are_counted_and_others_play_the_same_instances():
    seed = fresh_seed()
    environment = suite.load("which_is_heavier", "features", task_kwargs={"random": seed})
    lines = []
    for _ in range(3):
        environment.reset()
        lines += ["0", str(4 + environment.task.correct_answer)]
    shown = []
    scores = game.play("which_is_heavier", "features", seed=seed, read=typed(*lines), show=shown.append)
    assert (scores["you"].episodes, scores["you"].right) == (3, 3)
    assert scores["you"].total == pytest.approx(3 * 0.95)  # One interaction each, at the trained agent's discount.
    assert {name: score.episodes for name, score in scores.items()} == {
        "you": 3,
        "trained agent": 3,
        "ideal experimenter": 3,
    }
    assert sum(text.startswith("Right!") for text in shown) == 3
    assert "none in 100 steps -1. Each interaction\nbefore it multiplies that by 0.95." in shown[0]


def test_what_is_typed_is_a_record_that_is_judged_again(tmp_path):
    path, shown = tmp_path / "records.jsonl", []
    game.play("strings", "features", {"num_clamps": 2}, 5, records=path, read=typed("0", "1", "7"), show=shown.append)
    ((record,), _) = records.read(path)
    assert (record.question.name, record.seed, record.episode) == ("strings/features,num_clamps=2", 5, 0)
    assert record.actions == (0, 1, 7)
    (score,) = records.score([record])[record.player]
    assert score.metrics["mean_interactions"] == 2
    assert "seed 5" in shown and "worth now 0.90; 18 moves left" in shown
    assert any(
        re.search("ideal experimenter was right after . interactions: pull puck ., .*answer: ", text) for text in shown
    )


def test_a_wrong_answer_and_the_right_one_are_told():
    seed = fresh_seed()
    environment = suite.load("towers", "fist_features", task_kwargs={"random": seed})
    environment.reset()
    wrong = (environment.task.correct_answer + 1) % 5
    shown = []
    scores = game.play("towers", "fist_features", seed=seed, read=typed(str(4 + wrong)), show=shown.append)
    assert scores["you"].total == -1
    assert f"Wrong. The answer: {environment.task.label_names[environment.task.correct_answer]}." in shown
    assert scores["ideal experimenter"].right == 1  # It is always right.


HEAVIER = suite.load_task("which_is_heavier", "features").readings
TOWERS = suite.load_task("towers", "fist_features").readings


def test_heights_are_drawn_as_bars():
    text = terminal.drawing({"heights": np.array([0.0, 0.123, 0.4, 0.0], np.float32)}, HEAVIER).splitlines()
    assert text[1].count("#") == 12 and "12.3 cm" in text[1]
    assert text[2].count("#") == 40 and not text[0].count("#")


def test_a_tower_is_drawn_from_the_side_with_the_fist_beside_it():
    environment = suite.load("towers", "fist_features", task_kwargs={"random": 0})
    rows = terminal.drawing(environment.reset().observation, TOWERS).splitlines()
    places = {name: (row, line.index(name)) for row, line in enumerate(rows[:-2]) for name in "01234O" if name in line}
    assert [places[str(k)][0] for k in range(5)] == sorted((places[str(k)][0] for k in range(5)), reverse=True)
    assert len({places[str(k)][1] for k in range(5)}) == 1
    assert places["O"][1] < places["2"][1] and places["O"][0] == places["2"][0]


def test_an_image_is_drawn_in_its_own_colours():
    image = np.zeros((84, 84, 3), np.uint8)
    image[0, 0], image[1, 0] = (10, 20, 30), (40, 50, 60)
    lines = terminal.drawing({"pixels": image}, TOWERS, 84, 45).splitlines()
    assert len(lines) == 42
    assert lines[0].startswith("\x1b[38;2;10;20;30;48;2;40;50;60m▀")


@pytest.mark.parametrize(("columns", "lines"), [(80, 24), (40, 50), (200, 20), (16, 11)])
def test_an_image_fits_the_terminal_and_keeps_its_mean(columns, lines):
    image = np.random.default_rng(fresh_seed()).integers(256, size=(84, 84, 3), dtype=np.uint8)
    rows = terminal.drawing({"pixels": image}, HEAVIER, columns, lines).splitlines()
    assert len(rows) <= lines - 2 and {row.count("▀") for row in rows} == {2 * len(rows)} and 2 * len(rows) <= columns
    colors = np.array(re.findall(r"8;2;(\d+);(\d+);(\d+)", "\n".join(rows)), int)
    assert len(colors) == (2 * len(rows)) ** 2
    np.testing.assert_allclose(colors.mean(axis=0), image.mean(axis=(0, 1)), atol=0.6)


def test_a_terminal_that_is_too_small_for_an_image_is_told_so():
    for columns, lines in ((15, 50), (80, 10)):
        text = terminal.drawing({"pixels": np.zeros((84, 84, 3), np.uint8)}, HEAVIER, columns, lines)
        assert f"{columns} columns by {lines} lines" in text and "16 by 11" in text and "\n" not in text


def test_a_switch_is_shown_as_0_or_1_and_what_has_no_bounds_as_a_number():
    switch = suite.load_task("threshold", "features").readings
    assert terminal.drawing({"slid": np.ones(1, np.float32)}, switch) == "slid 1"
    assert terminal.legend({"slid"}, switch) == f"You see slid: {switch['slid'].meaning}."
    unbounded = {name: dataclasses.replace(reading, bounds=None) for name, reading in HEAVIER.items()}
    text = terminal.drawing({"heights": np.array([0.0, 0.123, 0.4, 0.0], np.float32)}, unbounded).splitlines()
    assert [line.split() for line in text[1:3]] == [["block", "1", "12.3", "cm"], ["block", "2", "40.0", "cm"]]


@pytest.mark.parametrize("columns", [20, 48, 200])
def test_features_fit_the_terminal(columns):
    heights = {"heights": np.array([0.0, 0.123, 0.4, 0.0], np.float32)}
    positions = {"positions": np.array([(0, 0, 0.05 + 0.1 * k) for k in range(5)])}
    assert all(len(line) <= columns for line in terminal.drawing(heights, HEAVIER, columns, 10).splitlines())
    side = terminal.drawing(positions, TOWERS, columns, 10).splitlines()
    assert len(side) <= 9 and all(len(line) <= columns for line in side[:-1])


@pytest.mark.parametrize(
    ("domain", "task", "words"),
    [
        ("which_is_heavier", "features", ["Which block is heaviest?", "0  poke block 0"]),
        ("towers", "fist_features", ["How many rigid bodies is the tower made of?", "O is the fist"]),
    ],
)
def test_the_question_comes_first_and_a_wrong_word_is_asked_again(domain, task, words):
    shown = []
    scores = game.play(domain, task, seed=1, read=typed("nine", "99", "-1", "?", "q", "0"), show=shown.append)
    assert scores["you"].episodes == 0
    last = suite.load_task(domain, task).rules.num_actions - 1
    for text in ("'nine'", "'99'", "'-1'"):
        assert f"{text} is no action; type a number from 0 to {last}, ? or q" in shown
    assert shown[0].startswith(words[0]) and all(word in shown[0] for word in words)
    assert shown.count(shown[0]) == 2  # Again, when it is asked for.


@pytest.mark.parametrize(
    ("options", "shown_options"),
    [
        ({"difficulty": 3.0}, ""),
        ({"difficulty": 4.0}, "difficulty 4"),
        ({"control_timestep": 0.05}, "control_timestep 0.05"),
    ],
)
def test_a_player_is_compared_with_an_agent_of_the_same_options(monkeypatch, options, shown_options):
    loaded, load, shown = [], pretrained.load, []
    monkeypatch.setattr(
        pretrained, "load", lambda *names, **kwargs: loaded.append((*names, kwargs)) or load(*names, **kwargs)
    )
    scores = game.play("which_is_heavier", "features", options, 1, read=typed("0", "4"), show=shown.append)
    assert loaded == [("which_is_heavier", "features", options if "difficulty" in options else {})]
    assert set(scores) == {"you", "ideal experimenter"} | (set() if shown_options else {"trained agent"})
    assert all(score.episodes == 1 for score in scores.values())
    missing = f"There is no agent trained at {shown_options} to compare you with.\n"
    assert (missing in shown) == bool(shown_options)


def test_the_command_plays_without_any_gl_from_what_is_typed():
    environment = {**os.environ, "MUJOCO_GL": "disable"}
    done = subprocess.run(
        [PHYSEXP, "play", "which_is_heavier", "features", "--seed", "3"],
        input="0\n1\n5\nq\n",
        capture_output=True,
        text=True,
        check=True,
        env=environment,
    )
    assert "poke block 0" in done.stdout and "The answer: block" in done.stdout
    assert "you " in done.stdout and "ideal experimenter" in done.stdout


def test_a_terminal_without_half_blocks_shows_other_letters(monkeypatch):
    written = io.BytesIO()
    monkeypatch.setattr(sys, "stdout", io.TextIOWrapper(written, "latin-1", write_through=True))
    printing.prepare()
    game.play("which_is_heavier", "pixels", seed=3, read=typed("0"))
    assert b"m?\x1b[" in written.getvalue()
