"""The summary of a report: the claims of the paper that hold, fail or are undecided, with the reasons."""

import collections
from collections.abc import Sequence
import itertools
import json

from physexp.analysis.experiments import claims as claims_lib
from physexp.analysis.experiments import conditions

Tested = tuple[claims_lib.Tested, str]
"""A claim under one condition, and its verdict."""


def paragraphs(tested: Sequence[Tested], configs: Sequence[str]) -> list[str]:
    """Returns the number of claims of each verdict, and below a heading for each verdict a point for each claim.

    Args:
      tested: the claims of the paper, without sanity checks.
      configs: the configurations of the runs, in JSON.
    """
    held, failed, is_open = _groups(tested)
    numbers = (
        f"Claims of the paper: {len(held) + len(failed) + len(is_open)}. Held in every condition in which they were "
        f"tested: {len(held)}. Failed in at least one: {len(failed)}. Undecided in at least one, and failed in none: "
        f"{len(is_open)}."
    )
    points = {
        "Replicated:": [f"{_named(its)} ({_count(len(its), 'condition')})." for its in held],
        "Not replicated:": [" ".join([_failure(its), *_openings(its)]) for its in failed],
        "Undecided:": [" ".join([f"{_named(its)}.", *_openings(its)]) for its in is_open],
    }
    lists = [(heading, "\n".join(f"- {point}" for point in its)) for heading, its in points.items() if its]
    return [f"{numbers} {_workers(configs)}".strip(), *itertools.chain.from_iterable(lists)]


def _groups(tested: Sequence[Tested]) -> list[list[list[Tested]]]:
    """Returns claims with all of their conditions: those that hold, those that fail somewhere, and the others."""
    by_text = collections.defaultdict(list)
    for claim, verdict in tested:
        by_text[claim.text, claim.section].append((claim, verdict))
    groups = collections.defaultdict(list)
    for its in by_text.values():
        verdicts = {verdict for _, verdict in its}
        worst = next(one for one in (claims_lib.FAILS, claims_lib.UNDECIDED, claims_lib.HOLDS) if one in verdicts)
        groups[worst].append(its)
    return [groups[one] for one in (claims_lib.HOLDS, claims_lib.FAILS, claims_lib.UNDECIDED)]


def _workers(configs: Sequence[str]) -> str:
    """Returns a sentence about the A3C agents with one worker; nothing where there are none."""
    agents = [json.loads(config)["agent"] for config in configs]
    workers = [agent["num_workers"] for agent in agents if agent["algorithm"] == "a3c"]
    if not (alone := workers.count(1)):
        return ""
    share = f"All {alone}" if alone == len(workers) else f"{alone} of the {len(workers)}"
    return (
        f"{share} A3C agents of these data were trained by a single worker, and so synchronously; the paper's learner "
        "has many workers, which do not wait for each other."
    )


def _count(number: int, noun: str) -> str:
    return f"{number} {noun}{'' if number == 1 else 's'}"


def _named(its: Sequence[Tested]) -> str:
    """Returns a claim with its section, since the paper claims some things of several tasks."""
    return f"Section {its[0][0].section}: {its[0][0].text}"


def _failure(its: Sequence[Tested]) -> str:
    """Returns a sentence on a claim and its failures, with our explanation."""
    failing = [claim for claim, verdict in its if verdict == claims_lib.FAILS]
    where = "; ".join(conditions.spelled_out(claim.condition) for claim in failing)
    reasons = dict.fromkeys(claim.reason for claim in failing if claim.reason)
    return " ".join([f"{_named(its)}: fails in {len(failing)} of {len(its)} ({where}).", *reasons])


def _openings(its: Sequence[Tested]) -> list[str]:
    """Returns a sentence for each condition in which a claim is undecided: the reason."""
    return [_opening(claim) for claim, verdict in its if verdict == claims_lib.UNDECIDED]


def _opening(claim: claims_lib.Tested) -> str:
    where, estimate = conditions.spelled_out(claim.condition), claim.estimate
    if not estimate.can_be_tested:
        return f"Undecided in {where}: too few agents."
    interval = f"Undecided in {where}: the interval, {estimate.low:.3g} to {estimate.high:.3g},"
    if claim.verdict == claims_lib.UNDECIDED:
        return f"{interval} reaches across an end of the wanted range, {claim.wanted}."
    return f"{interval} is too near an end of the wanted range, {claim.wanted}, for as many tests of one claim."
