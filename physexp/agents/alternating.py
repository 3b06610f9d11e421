"""A batch that plays one setting of a task in one round and another in the next, to train one network on all."""

from collections.abc import Mapping, Sequence

import dm_env
from dm_env import specs
import numpy as np

from physexp.agents import core


class Alternating(core.Batch):
    """Batches of one task with K settings: the round of index r is played in the batch r modulo K.

    The settings are not told, so the specs are those of the first batch.
    """

    def __init__(self, batches: Sequence[core.Batch]):
        """Takes batches of as many environments each; raises ValueError if one network cannot play them all."""
        first, *others = map(_spaces, batches)
        if different := [space for space in others if space != first]:
            raise ValueError(f"a setting has {different[0]}, the first one {first}; give settings that have the same")
        self._batches, self._current, self._next = batches, batches[0], 0

    @property
    def num_interactions(self) -> int:
        return self._batches[0].num_interactions

    @property
    def is_told(self) -> bool:
        return self._batches[0].is_told

    @property
    def step_limit(self) -> int:
        return self._batches[0].step_limit

    def observation_spec(self) -> Mapping[str, specs.Array]:
        return self._batches[0].observation_spec()

    def action_spec(self) -> specs.DiscreteArray:
        return self._batches[0].action_spec()

    @property
    def num_environments(self) -> int:
        return self._batches[0].num_environments

    @property
    def num_questions(self) -> int:
        return self._batches[0].num_questions

    @property
    def correct_answers(self) -> np.ndarray:
        return self._current.correct_answers

    def reset(self, *, episode: int | None = None) -> dm_env.TimeStep:
        episode = self._next if episode is None else episode
        self._current, self._next = self._batches[episode % len(self._batches)], episode + 1
        return self._current.reset(episode=episode)

    def step(self, actions: np.ndarray, environments: np.ndarray) -> dm_env.TimeStep:
        return self._current.step(actions, environments)

    def close(self) -> None:
        for batch in self._batches:
            batch.close()


def _spaces(batch: core.Batch) -> str:
    shapes = ", ".join(f"{name} {list(spec.shape)}" for name, spec in batch.observation_spec().items())
    actions = f"{batch.num_interactions} interactions, {batch.action_spec().num_values} actions"
    return f"{actions}, num_questions {batch.num_questions}, and {shapes}"
