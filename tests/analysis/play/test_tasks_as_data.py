"""Tasks as data: rules that are traced from Python, and tasks that cannot be exported."""

import numpy as np
import pytest

from physexp import suite
from physexp.analysis.play import exporting, tracing
from physexp.analysis.score import protocol


def test_a_task_that_is_no_expression_of_arrays_is_refused_by_name(monkeypatch):
    question = protocol.question("crush", "features")
    task = suite.load_task("crush", "features", {"random": 0})

    def drive(self, actions, qpos, ctrl):
        return self.controls[[int(action) for action in actions.tolist()]]

    monkeypatch.setattr(type(task), "drive", drive)
    message = "^crush/features cannot be played in a browser: its drive is no expression of arrays that can be traced: "
    with pytest.raises(ValueError, match=f"{message}.*tolist"):
        exporting.export(question, range(1))


def test_pixels_and_revealed_answers_are_refused():
    with pytest.raises(ValueError, match="^crush/pixels observes pixels"):
        exporting.export(protocol.question("crush", "pixels"), range(1))
    with pytest.raises(ValueError, match="^crush/features,reveal=True reveals the answers"):
        exporting.export(protocol.question("crush", "features", {"reveal": True}), range(1))


def written(values):
    values[:, 0] = 0
    return values


@pytest.mark.parametrize(
    ("function", "message"),
    [
        (lambda x: x if x.any(axis=1) else -x, "asks whether an array is true"),
        (written, "writes into an array"),
        (lambda x: np.eye(4)[x.astype(int)], "needs the values"),
        (lambda x: np.sin(x), "np.sin of these numbers"),
        (lambda x: x // 0.3, "np.floor_divide of these numbers"),
        (lambda x: x[0], r"\[:, a:b\]"),
        (lambda x: x[:, ::2], "not contiguous"),
        (lambda x: np.concatenate([x, x, x], axis=1).sum(axis=1), "more than 7 numbers"),
        (lambda x: np.linalg.norm(x), "np.norm"),
        (lambda x: x @ np.eye(4), "np.matmul"),
    ],
)
def test_what_cannot_be_traced_is_told_in_one_line(function, message):
    with pytest.raises(tracing.NotTraced, match=message) as caught:
        tracing.trace(function, x=np.ones((1, 4)))
    assert "\n" not in str(caught.value)


def test_a_rule_names_operations_values_and_constants():
    rule = tracing.trace(lambda x, y: np.where(x[:, 1:3] > 0.5, y, [[1, 2]]), x=np.ones((1, 4)), y=np.ones((1, 2)))
    assert rule == ["where", ["greater", ["slice", "x", 1, 3], 0.5], "y", [1.0, 2.0]]
