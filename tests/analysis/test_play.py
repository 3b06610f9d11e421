"""A person at the terminal: what is drawn, asked and counted."""

import os
import subprocess

import numpy as np
import pytest
from trainers import PHYSEXP, fresh_seed

from physexp import suite
from physexp.analysis import play


def typed(*lines):
    """A player who types these lines and then leaves."""
    left = list(lines)

    def read(prompt):
        if not left:
            raise EOFError
        return left.pop(0)

    return read


def test_a_player_who_knows_the_answers_is_counted_right_and_compared_on_the_same_instances():
    seed = fresh_seed()
    environment = suite.load("which_is_heavier", "features", task_kwargs={"random": seed})
    lines = []
    for _ in range(3):
        environment.reset()
        lines += ["0", str(4 + environment.task.correct_answer)]
    shown = []
    scores = play.play("which_is_heavier", "features", seed=seed, read=typed(*lines), show=shown.append)
    assert (scores["you"].episodes, scores["you"].right) == (3, 3)
    assert scores["you"].total == pytest.approx(3 * 0.95)  # One interaction each, at the trained agent's discount.
    assert {name: score.episodes for name, score in scores.items()} == {
        "you": 3, "trained agent": 3, "ideal experimenter": 3,
    }  # fmt: skip
    assert sum(text.startswith("Right!") for text in shown) == 3


def test_a_wrong_answer_and_the_right_one_are_told():
    seed = fresh_seed()
    environment = suite.load("towers", "fist_features", task_kwargs={"random": seed})
    environment.reset()
    wrong = (environment.task.correct_answer + 1) % 5
    shown = []
    scores = play.play("towers", "fist_features", seed=seed, read=typed(str(4 + wrong)), show=shown.append)
    assert scores["you"].total == -1
    assert f"Wrong. The answer: {environment.task.label_names[environment.task.correct_answer]}." in shown
    assert scores["ideal experimenter"].right == 1  # It is always right.


def test_what_is_no_action_is_asked_again():
    shown = []
    scores = play.play(
        "which_is_heavier", "features", seed=1, read=typed("nine", "8", "-1", "q", "0"), show=shown.append
    )
    assert scores["you"].episodes == 0
    for text in ("'nine'", "'8'", "'-1'"):
        assert f"{text} is no action; type a number from 0 to 7, or q" in shown


def test_heights_are_drawn_as_bars():
    text = play.drawing({"heights": np.array([0.0, 0.123, 0.4, 0.0], np.float32)}).splitlines()
    assert text[1].count("#") == 12 and "12.3 cm" in text[1]
    assert text[2].count("#") == 40 and not text[0].count("#")


def test_a_tower_is_drawn_from_the_side_with_the_fist_beside_it():
    environment = suite.load("towers", "fist_features", task_kwargs={"random": 0})
    rows = play.drawing(environment.reset().observation).splitlines()
    places = {name: (row, line.index(name)) for row, line in enumerate(rows[:-2]) for name in "01234O" if name in line}
    assert [places[str(k)][0] for k in range(5)] == sorted((places[str(k)][0] for k in range(5)), reverse=True)
    assert len({places[str(k)][1] for k in range(5)}) == 1
    assert places["O"][1] < places["2"][1] and places["O"][0] == places["2"][0]


def test_an_image_is_drawn_in_its_own_colours():
    image = np.zeros((84, 84, 3), np.uint8)
    image[0, 0], image[1, 0] = (10, 20, 30), (40, 50, 60)
    lines = play.drawing({"pixels": image}).splitlines()
    assert len(lines) == 42
    assert lines[0].startswith("\x1b[38;2;10;20;30;48;2;40;50;60m▀")


def test_the_command_plays_without_any_gl_from_what_is_typed():
    environment = {**os.environ, "MUJOCO_GL": "disable"}
    done = subprocess.run([PHYSEXP, "play", "which_is_heavier", "features", "--seed", "3"], input="0\n1\n5\nq\n",
                          capture_output=True, text=True, check=True, env=environment)  # fmt: skip
    assert "poke block 0" in done.stdout and "The answer: block" in done.stdout
    assert "you " in done.stdout and "ideal experimenter" in done.stdout
