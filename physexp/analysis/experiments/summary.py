"""The summary of a report: the claims of the paper that hold, fail or are undecided, with the reasons."""

import collections
from collections.abc import Sequence
import json

from physexp.analysis.experiments import claims as claims_lib
from physexp.analysis.experiments import conditions

Tested = tuple[claims_lib.Tested, str]
"""A claim under one condition, and its verdict."""


def of_claims(tested: Sequence[Tested]) -> dict[str, list[str]]:
    """Returns headings, and below each a point for each claim with that verdict.

    Args:
      tested: the claims of the paper, without sanity checks.
    """
    held, failed, is_open = _groups(tested)
    points = {
        "Replicated:": [f"{_named(its)} ({_count(len(its), 'condition')})." for its in held],
        "Not replicated:": [" ".join([_failure(its), *_openings(its)]) for its in failed],
        "Undecided:": [" ".join([f"{_named(its)}.", *_openings(its)]) for its in is_open],
    }
    return {heading: its for heading, its in points.items() if its}


def in_numbers(tested: Sequence[Tested]) -> str:
    """Returns the number of claims of each verdict, in words."""
    held, failed, is_open = map(len, _groups(tested))
    return (
        f"Claims of the paper: {held + failed + is_open}. Held in every condition in which they were tested: {held}. "
        f"Failed in at least one: {failed}. Undecided in at least one, and failed in none: {is_open}."
    )


def _groups(tested: Sequence[Tested]) -> list[list[list[Tested]]]:
    """Returns claims, each under all of its conditions: those that hold, that fail somewhere, and the others."""
    by_text = collections.defaultdict(list)
    for claim, verdict in tested:
        by_text[claim.text, claim.section].append((claim, verdict))
    groups = collections.defaultdict(list)
    for its in by_text.values():
        verdicts = {verdict for _, verdict in its}
        worst = next(one for one in (claims_lib.FAILS, claims_lib.UNDECIDED, claims_lib.HOLDS) if one in verdicts)
        groups[worst].append(its)
    return [groups[one] for one in (claims_lib.HOLDS, claims_lib.FAILS, claims_lib.UNDECIDED)]


def of_workers(configs: Sequence[str]) -> str:
    """Returns a sentence about the A3C agents that had one worker; nothing where there are none.

    Args:
      configs: the configurations of the runs, in JSON.
    """
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
    """Returns a claim, with the section of the paper, which may claim the same of another task elsewhere."""
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
