"""The texts of a replay: the question, how the episode ended, and how to read what is shown."""

from collections.abc import Sequence

import numpy as np

from physexp.agents import config as agent_config
from physexp.analysis.replay import recording

HIDDEN_TAB = "with what is hidden"
"""The title of the view that shows it."""

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


def name(episode: recording.Episode) -> str:
    """Returns which episode it is, in words."""
    options = "".join(f", {key} {agent_config.shown(value)}" for key, value in episode.task_kwargs.items())
    return f"{episode.domain}/{episode.task}{options}, seed {episode.seed}, episode {episode.episode}"


def about(episode: recording.Episode, ending: str) -> str:
    """Returns the question, how it ended, which episode it is and whose, and how to read what is shown; Markdown."""
    belief = _OWN_BELIEF if len(episode.beliefs) else _BELIEF_OF_POLICY
    reading = _READING.format(belief=belief) if len(episode.policies) else _READING_LIVE
    player = f", played by {episode.agent}" if episode.agent else ""
    return f"### {episode.declared.question}\n**{ending}**\n\n{name(episode)}{player}\n{reading}"


def outcome(episode: recording.Episode) -> str:
    """Returns how an episode ended, in words."""
    label = int(episode.actions[-1]) - episode.declared.num_interactions
    label_names = episode.declared.label_names
    truth = label_names[episode.answer]
    if label < 0:
        return f"Time ran out. The right answer: {truth}."
    verdict = "right" if label == episode.answer else f"wrong; it is: {truth}"
    return f"Answer after {len(episode.actions) - 1} interactions: {label_names[label]}. That is {verdict}."


def bars(labels: Sequence[str], belief: np.ndarray, answers: np.ndarray, ideal: np.ndarray | None) -> str:
    """Returns a belief as named bars, beside what the policy and an ideal experimenter make of each label; Markdown.

    Args:
      labels: names of L labels.
      belief: float64 [L], of sum one.
      answers: the policy's probabilities of them, float64 [L].
      ideal: the ideal experimenter's belief, float64 [L], where there is one.
    """
    heads = ["label", "belief", "", "policy", *([] if ideal is None else ["ideal belief"])]
    rows = [heads, [":--", "--:", ":--", "--:", "--:"][: len(heads)]]
    for k, label in enumerate(labels):
        full = round(_BAR * float(belief[k]))
        row = [label, f"{belief[k]:.2f}", "█" * full + "░" * (_BAR - full), f"{answers[k]:.2f}"]
        rows.append(row if ideal is None else [*row, f"{ideal[k]:.2f}"])
    return "\n".join(f"| {' | '.join(row)} |" for row in rows)
