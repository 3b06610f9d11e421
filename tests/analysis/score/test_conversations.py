"""Conversations to learn from are episodes in words."""

import json
import re

import pytest

from physexp.analysis.score import exporting, protocol, targets
from physexp.suite import words


def test_exported_conversations_are_episodes_with_the_best_beliefs(tmp_path):
    questions = protocol.named(["strings/features", "threshold/features"])
    exporting.export(targets.find("ideal"), questions, 3, tmp_path / "exported", in_words=True)
    for question in questions:
        path = tmp_path / "exported" / exporting.WORDS / f"{question.file_name}.jsonl"
        found = [json.loads(line) for line in path.read_text().splitlines()]
        assert [one["episode"] for one in found] == [0, 1, 2]
        environment = protocol.load(question, exporting.SEED)
        for index, one in enumerate(found):
            messages, episode = one["messages"], words.Episode(environment, index)
            assert [message["role"] for message in messages] == [
                "system",
                *["user", "assistant"] * (len(messages) // 2),
            ]
            assert messages[:2] == episode.messages()[:2]
            for said, told in zip(messages[2::2], [*messages[3::2], None], strict=True):
                reply = episode.say(said["content"])
                assert told is None or told["content"] == reply
            assert episode.is_over and episode.log_scores == [0.0] and episode.environment.task.ledger.returns[0] > 0
            prior = json.loads(re.search(r"\[.*\]", messages[2]["content"])[0])
            assert prior == [1 / 8] * 8  # The graphs of three pairs, and the forces, are equally likely.
    with pytest.raises(ValueError, match="observes images"):
        exporting.export(targets.find("random"), protocol.named(["strike/pixels"]), 1, tmp_path / "no", in_words=True)
