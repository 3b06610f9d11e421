"""Conversations to learn from are episodes in words."""

import json
import re

import pytest

from physexp.analysis.score import exporting, protocol, targets
from physexp.suite import words


def test_exported_conversations_are_episodes_in_words_with_the_best_beliefs(tmp_path):
    questions = protocol.named(["strings/features", "balance/features,difficulty=3"])
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
            count = {"strings": 8, "balance": 8}[question.domain]  # All graphs; four suspects, heavier or lighter.
            assert sorted(prior, reverse=True)[:count] == [1 / count] * count and sum(prior) == 1
    with pytest.raises(ValueError, match="observes images"):
        exporting.export(targets.find("random"), protocol.named(["strike/pixels"]), 1, tmp_path / "no", in_words=True)
