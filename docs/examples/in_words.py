"""Episodes in words, played by a function of the messages so far: a call of a model, or one of these scripted players.

python in_words.py FOLDER PROGRAM ITS ARGUMENTS lets a program play, which reads the messages and writes a reply.
"""

import json
from pathlib import Path
import random
import re
import subprocess
import sys

import numpy as np

from physexp import suite
from physexp.analysis.score import transcripts


def play(episode, player, most_replies=60):
    """Plays an episode, or goes on with one, until it is over or a number of replies is spent."""
    for _ in range(most_replies):
        if episode.is_over:
            return
        episode.say(player(episode.messages()))
    episode.stop(f"{most_replies} replies")


def program(arguments):
    """Returns a player that asks a program, with the messages as JSON on its standard input."""

    def player(messages):
        told = json.dumps(messages)
        return subprocess.run(arguments, input=told, stdout=subprocess.PIPE, encoding="utf-8", check=True).stdout

    return player


# Scripted players.


def at_once(messages):
    """Answers at once."""
    return "answer(0)"


def pokes_everything(messages):
    """Does each experiment once, and answers."""
    count, done = num_experiments(messages), len(messages) // 2 - 1
    return f"experiment({done})" if done < count else "answer(0)"


def repeats_itself(messages):
    """Does the first experiment three times, and answers."""
    return "experiment(0)" if len(messages) < 8 else "answer(0)"


def at_random(messages):
    """Does experiments at random, and answers at random by and by."""
    generator = random.Random(repr(messages))
    return f"experiment({generator.randrange(num_experiments(messages))})" if generator.random() < 0.8 else "answer(0)"


def greedy(domain, task, num_instances=400, seed=1000):
    """Returns a player that does the experiment that tells most, and answers when it is sure, or none tells anything.

    It knows the task from instances of its own: those in which its experiments read as the messages say are possible.
    """
    batch = suite.load_batch(domain, task, num_instances, {"random": seed})
    count = batch.task.num_interactions

    def player(messages):
        told = [message["content"] for message in messages[1::2]]
        done = [int(re.search(r"experiment\((\d+)\)", message["content"])[1]) for message in messages[2::2]]
        pairs = zip(replayed(batch, done), told, strict=True)
        possible = np.all([(readings == numbers(text)).all(axis=1) for readings, text in pairs], axis=0)
        answers = batch.correct_answers
        belief = np.bincount(answers[possible], minlength=batch.task.num_labels) / max(1, possible.sum())
        left = {
            number: entropy_left(replayed(batch, [*done, number])[-1], answers, possible) for number in range(count)
        }
        best = min(left, key=left.get)
        is_last = len(done) == batch.task.rules.step_limit - 1
        call = f"answer({belief.argmax()})" if is_last or left[best] > entropy(belief) - 1e-9 else f"experiment({best})"
        return f"believe({belief.round(4).tolist()})\n{call}"

    return player


def num_experiments(messages):
    """Returns the number of experiments, from the rules."""
    experiments = messages[0]["content"].partition("Experiments:\n")[2].partition("\n\n")[0]
    return len(experiments.splitlines())


def numbers(text):
    """Returns the numbers that a text tells as readings, float32 [N]."""
    return np.array(re.findall(r"-?\d[\d.e-]*", " ".join(re.findall(r"\[.*\]", text))), np.float32)


def replayed(batch, actions):
    """Returns the readings of all instances, float32 [instances, N], after some actions: of each step."""
    steps = [batch.reset(episode=0), *map(batch.step, (np.full(batch.num_environments, one) for one in actions))]
    return [
        np.concatenate([values.reshape(batch.num_environments, -1) for values in step.observation.values()], axis=1)
        for step in steps
    ]


def entropy(belief):
    """Returns the entropy of a belief, bits."""
    return float(-belief @ np.log2(belief.clip(1e-300)))


def entropy_left(readings, answers, possible):
    """Returns the expected entropy of the answer once some readings are known."""
    groups = {}
    for row in np.flatnonzero(possible):
        groups.setdefault(readings[row].tobytes(), []).append(answers[row])
    shares = [np.bincount(group) / len(group) for group in groups.values()]
    sizes = [len(group) for group in groups.values()]
    return float(np.dot(sizes, [entropy(share) for share in shares]) / max(1, sum(sizes)))


if __name__ == "__main__":
    folder, *arguments = sys.argv[1:]
    facts = {"model": " ".join(arguments), "harness": "in_words.py", "tools": "none", "budget": "60 replies an episode"}
    with transcripts.run(Path(folder), **facts) as run:
        for name in ("strings/features", "threshold/features"):
            for episode in run.episodes(name, 10):
                play(episode, program(arguments))
