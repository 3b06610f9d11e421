"""Texts of a replay: question, outcome, and a legend of the views."""

from collections.abc import Sequence

import numpy as np

from physexp.agents import config as agent_config
from physexp.analysis.replay import recording
from physexp.analysis.training import config as config_lib

HIDDEN_TAB = "with what is hidden"
"""Title of the view that shows the hidden properties."""

_BAR = 20  # Characters of a probability of one.

_READING = f"""
- **policy**: the probability of each action, now; of all labels together it is called *answers now*.
- **belief**: {{belief}}
- **value**: the return that it expects.
- **what is hidden**: guess first, then click *{HIDDEN_TAB}*, above the scene.
"""

_OWN_BELIEF = """how likely it holds each label to be right.
  An answer now is worth twice the greatest of them, less one."""

_BELIEF_OF_POLICY = """the policy restricted to the labels and renormalized: its answer, if it had to give one now.
  While it would rather experiment, the policy of every label is near 0, whatever it believes."""

_READING_LIVE = f"""
Type your actions in the terminal. What is hidden is there once you have answered: click *{HIDDEN_TAB}*, above the
scene.
"""


def name(episode: recording.Film) -> str:
    """Returns the name of an episode."""
    return f"{task_name(episode)}, seed {episode.seed}, episode {episode.index}"


def task_name(played: recording.Film | config_lib.TrainConfig) -> str:
    """Returns the name of a task with its options."""
    options = "".join(f", {key} {agent_config.shown(value)}" for key, value in played.task_kwargs.items())
    return f"{played.domain}/{played.task}{options}"


def about(episode: recording.Film, ending: str) -> str:
    """Returns question, ending, the episode's name and player, and a legend of the views, as Markdown."""
    belief = _OWN_BELIEF if len(episode.beliefs) else _BELIEF_OF_POLICY
    reading = _READING.format(belief=belief) if len(episode.policies) else _READING_LIVE
    player = f", played by {episode.agent}" if episode.agent else ""
    return f"### {episode.declared.question}\n**{ending}**\n\n{name(episode)}{player}\n{reading}"


def outcome(episode: recording.Film) -> str:
    """Returns the outcome of an episode as a sentence."""
    names, said = episode.declared.label_names, []
    labels = episode.actions - episode.declared.num_interactions
    steps = np.flatnonzero(labels >= 0)
    for number, (step, label, answer) in enumerate(zip(steps, labels[steps], episode.answers, strict=False)):
        verdict = "right" if label == answer else f"wrong; it is: {names[answer]}"
        said.append(f"Answer after {step - number} interactions: {names[label]}. That is {verdict}.")
    said += [f"Time ran out. The right answer: {names[answer]}." for answer in episode.answers[len(steps) :]]
    return " ".join(said)


def bars(labels: Sequence[str], belief: np.ndarray, answers: np.ndarray, ideal: np.ndarray | None) -> str:
    """Returns a Markdown table of labels: belief with a bar, policy and ideal belief, float64 [L] each."""
    heads = ["label", "belief", "", "policy", *([] if ideal is None else ["ideal belief"])]
    rows = [heads, [":--", "--:", ":--", "--:", "--:"][: len(heads)]]
    for k, label in enumerate(labels):
        full = round(_BAR * float(belief[k]))
        row = [label, f"{belief[k]:.2f}", "█" * full + "░" * (_BAR - full), f"{answers[k]:.2f}"]
        rows.append(row if ideal is None else [*row, f"{ideal[k]:.2f}"])
    return "\n".join(f"| {' | '.join(row)} |" for row in rows)
