"""Finds what the best experimenter earns if the length of the control step is hidden from it.

    python benchmarks/hidden_control_steps.py

Half of the episodes have the usual control step and half have one of 50 to 150 % of that (`step_variation` 0.5), as in
training with `--also step_variation=0.5`. The policy of the highest return is found by trying all sequences of so many
interactions; it answers after the last one at the latest. The time limit is that of the usual control step.
"""

import dataclasses

import numpy as np

from physexp import suite
from physexp.analysis import domains
from physexp.suite.engine import rules, snapshots

DEPTHS = {"lump": 7, "strike": 7, "sealed_box": 6}
VARIATION, NUM_THREADS = 0.5, 2
_MANY = 1_000_000  # More than there are readings.


class Search:
    """The search in one domain, among all pairs of a hidden property and a control step."""

    def __init__(self, domain: str):
        self.discount = domains.find(domain).discount
        known = domains.find(domain).ideal("features", {}, self.discount).hypotheses
        usual, size = known.task.options.substeps, len(known.hidden)
        widest = int(VARIATION * usual)
        lengths = np.arange(usual - widest, usual + widest + 1)
        self.num_actions, self.size = known.task.num_interactions, size * len(lengths)
        self.answers = np.tile(known.answers, len(lengths))
        settings = np.array([(lengths == usual).astype(float), np.full(len(lengths), 1 / len(lengths))])
        self.weights = np.einsum("sl,h->slh", settings, known.prior).reshape(2, -1)  # In each setting.
        self.batch = suite.BatchEnvironment(known.task, self.num_actions * self.size, NUM_THREADS)
        self.batch.reset(hidden=np.concatenate([known.hidden] * (self.num_actions * len(lengths))))
        self.batch.ledger.substeps[:] = np.tile(np.repeat(lengths, size), self.num_actions)
        self.readings: dict[bytes, int] = {}

    def run(self, depth: int) -> np.ndarray:
        """Returns discounted returns and shares of right answers, [2, 2], in the usual and in the varied setting."""
        everything = np.arange(self.size)
        start = snapshots.take(self.batch, everything)
        return self._best(start, everything, np.zeros(self.size, int), depth)[0]

    def _best(self, state: snapshots.Snapshot, members: np.ndarray, groups: np.ndarray, left: int) -> np.ndarray:
        """Returns what the best policy earns with each of G groups of members that look alike, [G, 2, 2]."""
        num_groups, num_labels = groups.max() + 1, self.answers.max() + 1
        of_labels = np.zeros((num_groups, num_labels, 2))
        np.add.at(of_labels, (groups, self.answers[members]), self.weights[:, members].T)
        total, likeliest = of_labels.sum(axis=1), of_labels.sum(axis=2).argmax(axis=1)
        right = of_labels[np.arange(num_groups), likeliest]
        best = np.stack([rules.RIGHT * right + rules.WRONG * (total - right), right], axis=1)
        is_open = (of_labels.sum(axis=2) > 0).sum(axis=1) > 1
        if not left or not is_open.any():
            return best
        members, groups = members[is_open[groups]], groups[is_open[groups]]
        snapshots.restore(self.batch, state.with_step_count(0).repeated(self.num_actions, self.size))
        observed = self.batch.step(np.repeat(np.arange(self.num_actions), self.size)).observation
        read = np.concatenate([each.reshape(len(each), -1).astype(np.float32) for each in observed.values()], axis=1)
        rows = self.size * np.arange(self.num_actions)[:, None] + np.arange(self.size)
        following = [snapshots.take(self.batch, each) for each in rows]
        for action, after in enumerate(following):
            codes = np.array(
                [self.readings.setdefault(row.tobytes(), len(self.readings)) for row in read[rows[action]]]
            )
            seen, parts = np.unique(groups * _MANY + codes[members], return_inverse=True)
            copied = dataclasses.replace(after, environments=np.arange(self.size))
            earned = self._best(copied, members, parts, left - 1)
            added = np.zeros_like(best)
            np.add.at(added, seen // _MANY, earned * np.array([self.discount, 1.0])[:, None])
            is_better = is_open & (added[:, 0].sum(axis=1) > best[:, 0].sum(axis=1))
            best[is_better] = added[is_better]
        return best


def main() -> None:
    for domain, depth in DEPTHS.items():
        returns, right = Search(domain).run(depth)
        for setting, earned, share in zip(("usual", "varied"), returns, right, strict=True):
            print(
                f"{domain}/features, {depth} interactions, {setting} control steps: {earned:.3f}, {share:.3f} right",
                flush=True,
            )


if __name__ == "__main__":
    main()
