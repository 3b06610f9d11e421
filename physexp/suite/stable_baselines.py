"""A batch of environments for Stable-Baselines3 (and sb3-contrib), whose vector environments reset at once."""

from collections.abc import Sequence
from typing import Any, NoReturn, cast

from physexp import extras, suite

extras.require("stable_baselines3", "gymnasium")

from gymnasium import spaces  # noqa: E402
import numpy as np  # noqa: E402
from stable_baselines3.common.vec_env import base_vec_env  # noqa: E402

from physexp.suite import adapters  # noqa: E402


class VecEnv(base_vec_env.VecEnv):
    """Many environments that step together; an episode that ends is followed by the next one in the same step.

    `infos[i]` then has `terminal_observation`, `correct_answer`, `discounted_return`, `is_success`, and
    `TimeLimit.truncated`, which is true where the simulation has diverged, so that there is no outcome: running out of
    time is a wrong answer. `reset_infos[i]` has the `seed` and the `episode_index` of the episode that is played.
    """

    def __init__(
        self,
        domain: str,
        task: str,
        num_envs: int,
        num_threads: int = 1,
        render_mode: str | None = None,
        **task_kwargs: Any,
    ):
        """Loads a batch; arguments as for `suite.load_batch`, and `render_mode`: `rgb_array`, or None."""
        adapters.refuse_unknown(VecEnv, domain, task_kwargs)
        adapters.RENDER_MODE("render_mode", render_mode)
        num_envs = adapters.check_num_envs(num_envs)
        self._batch = suite.load_batch(domain, task, num_envs, task_kwargs, num_threads)
        self._started = False
        self.render_mode = render_mode
        super().__init__(
            num_envs,
            adapters.observation_space(self._batch.observation_spec()),
            spaces.Discrete(self._batch.action_spec().num_values),
        )
        cast(Any, self.metadata)["render_fps"] = adapters.frames_per_second(self._batch.task)

    def seed(self, seed: int | None = None) -> Any:
        """Has the next reset start the first episodes of another seed, by default a random one.

        It returns the seeds of the environments; `suite.load` with one of them makes that environment alone.
        """
        of_batch = cast(int, super().seed(adapters.check_seed(seed))[0])
        return [suite.environment_seed(of_batch, row) for row in range(self.num_envs)]

    def reset(self) -> Any:
        """Starts the next episode everywhere, or what `seed` and `set_options` have asked for.

        The only option is `episode`, the index of the episode to start, the same everywhere.
        """
        options = adapters.check_options(self._options[0], "episode")
        if any(others != self._options[0] for others in self._options):
            raise ValueError("options differ between environments; give all the same")
        if self._seeds[0] is not None:
            self._batch.reseed(self._seeds[0])
        self._reset_seeds()
        self._reset_options()
        return dict(self._begin(np.arange(self.num_envs), options.get("episode")))

    def _begin(self, rows: np.ndarray, episode: int | None = None) -> Any:
        """Starts episodes in some environments and tells which; returns the observations."""
        observation = self._batch.reset(rows, episode).observation
        infos = adapters.beginnings(self._batch)
        for row in rows:
            self.reset_infos[row] = {name: int(values[row]) for name, values in infos.items()}
        self._started = True
        return observation

    def step_async(self, actions: np.ndarray) -> None:
        adapters.check_started(self._started)
        self._actions = actions

    def step_wait(self) -> Any:
        timestep = self._batch.step(self._actions)
        ended = timestep.last()
        observation = dict(timestep.observation)
        infos: list[dict[str, Any]] = [{} for _ in range(self.num_envs)]
        if ended.any():
            batch, rows = self._batch, np.flatnonzero(ended)
            outcomes = adapters.outcomes(batch.task, batch.steps, timestep.reward, batch.correct_answers)
            for row in rows:
                terminal = {name: value[row] for name, value in observation.items()}
                infos[row] = {
                    "terminal_observation": terminal,
                    "TimeLimit.truncated": bool(timestep.reward[row] == 0),  # As in `gymnasium.VectorEnvironment`.
                    **{name: values[row].item() for name, values in outcomes.items()},
                }
            first = self._begin(rows)
            for name, value in observation.items():
                observation[name] = value.copy()
                observation[name][rows] = first[name]
        return observation, timestep.reward.astype(np.float32), ended, infos

    def get_images(self) -> Sequence[np.ndarray | None]:
        """Returns one image for each environment, as under Gymnasium; `render` lays them out side by side."""
        return [None] * self.num_envs if self.render_mode is None else adapters.images(self._batch)

    def close(self) -> None:
        self._batch.close()

    def __reduce__(self) -> NoReturn:  # Of copies and of pickles.
        self._batch.__reduce__()

    def get_attr(self, attr_name: str, indices: Any = None) -> list[Any]:
        return [getattr(self, attr_name)] * len(list(self._get_indices(indices)))

    def set_attr(self, attr_name: str, value: Any, indices: Any = None) -> None:
        raise NotImplementedError("the environments of a batch have no attributes of their own")

    def env_method(self, method_name: str, *method_args: Any, indices: Any = None, **method_kwargs: Any) -> list[Any]:
        raise NotImplementedError("the environments of a batch have no methods of their own")

    def env_is_wrapped(self, wrapper_class: Any, indices: Any = None) -> list[bool]:
        return [False] * len(list(self._get_indices(indices)))
