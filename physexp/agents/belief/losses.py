"""Targets and losses of beliefs and of the values of interactions; pure functions on tensors [T, B] of whole episodes.

With `b` the belief over the labels after some steps of an episode, an answer is worth `S = 2 max(b) - 1`.
"""

import torch
from torch.nn import functional

_NUM_BINS = 10  # Of confidence, in which calibration is measured.


def answer_values(beliefs: torch.Tensor) -> torch.Tensor:
    """Returns the expected rewards of answers that are right with these probabilities, a tensor of any shape."""
    return 2 * beliefs - 1


def label_posterior(logits: torch.Tensor, answers: torch.Tensor, are_right: torch.Tensor) -> torch.Tensor:
    """Returns the probabilities of the labels, [..., L], after an answer and its reward, by Bayes' rule.

    The label of a right answer is known. After a wrong one the others keep their relative probabilities:
    `p[l] = b[l] / (1 - b[a])` for the labels other than the answer `a`. With these as targets, a step on the
    cross-entropy is one on the likelihood of the reward, `log b[a]` for +1 and `log(1 - b[a])` for -1 (expectation
    maximization: Dempster, Laird & Rubin, 1977); and it is the target of earlier steps too, which know less.
    The logits, [..., L], are of the belief that the answers, int64 [...], were given with.
    """
    answered = functional.one_hot(answers, logits.shape[-1]).bool()
    others = logits.masked_fill(answered, -torch.inf).softmax(dim=-1)
    return torch.where(are_right[..., None], answered.float(), others)


def belief_loss(logits: torch.Tensor, labels: torch.Tensor, are_counted: torch.Tensor) -> torch.Tensor:
    """Returns the mean cross-entropy, [K], over the steps that count, bool [K, T, B].

    The logits are of the beliefs of K members, [K, T, B, L], and the labels are probabilities, [T, B, L].
    """
    return _means(-(labels * logits.log_softmax(dim=-1)).sum(-1), are_counted)


def value_loss(values: torch.Tensor, targets: torch.Tensor, are_counted: torch.Tensor) -> torch.Tensor:
    """Returns the mean squared error of values by K members, [K, T, B], over the steps that count, [K]."""
    return _means((values - targets).square(), are_counted)


def foresight_loss(expected: torch.Tensor, moved: torch.Tensor, are_counted: torch.Tensor) -> torch.Tensor:
    """Returns the mean Huber loss of expected changes of observations, [K], over the steps that count, bool [K, T, B].

    The changes expected by K members, [K, T, B, F], and those that followed, [T, B, F], are in units of the mean one.
    """
    errors = functional.smooth_l1_loss(expected, moved.expand_as(expected), reduction="none").sum(-1)
    return _means(errors, are_counted)


def _means(errors: torch.Tensor, are_counted: torch.Tensor) -> torch.Tensor:
    return (errors * are_counted).sum((1, 2)) / are_counted.sum((1, 2)).clamp(min=1)


def interaction_targets(
    answering: torch.Tensor,
    interacting: torch.Tensor,
    are_greedy: torch.Tensor,
    are_last: torch.Tensor,
    are_final: torch.Tensor,
    rewards: torch.Tensor,
    discount: float,
    lambda_: float,
) -> torch.Tensor:
    """Returns the targets of the values of interactions, [T, B]; they mean nothing where no interaction was taken.

    The target of an interaction is `gamma * V` of the step that follows it, `V = max(S, max Q)`, or `V = S` at a final
    step. As long as the interactions that follow are greedy, the return from there counts by `lambda` instead of `V`
    (Watkins' Q(lambda): Watkins, 1989). The target of an interaction that ends the episode is its reward.

    `answering` is S and `interacting` max Q, [T, B]; `are_greedy` says where the interaction taken is that of max Q,
    `are_last` which step is the last one for its question, and `are_final` at which steps an answer has to be given,
    bool [T, B]. The rewards, [T, B], are of these steps: each question is valued as if it were the last one of its
    episode.
    """
    values = torch.where(are_final, answering, torch.maximum(answering, interacting))
    goes_on = are_greedy & (interacting > answering) & ~are_last
    targets = rewards.clone()
    for step in range(len(values) - 2, -1, -1):
        traced = torch.lerp(values[step + 1], targets[step + 1], lambda_)
        following = torch.where(goes_on[step + 1], traced, values[step + 1])
        targets[step] = torch.where(are_last[step], rewards[step], discount * following)
    return targets


def calibration_error(confidences: torch.Tensor, outcomes: torch.Tensor) -> float:
    """Returns the expected calibration error of beliefs in answers, [N] (ECE: Naeini et al., 2015).

    Confidence is sorted into ten bins of equal width. Outcomes are 1 for a right answer and 0 for a wrong one.
    """
    bins = (confidences * _NUM_BINS).long().clamp(0, _NUM_BINS - 1)
    gaps = torch.zeros(_NUM_BINS, dtype=confidences.dtype).index_add_(0, bins, confidences - outcomes)
    return float(gaps.abs().sum() / max(1, len(confidences)))
