"""A batch of environments for Stable-Baselines3 (and sb3-contrib), whose vector environments reset at once."""

from collections.abc import Iterable, Sequence
from typing import Any, NoReturn, cast

from physexp import extras, suite

extras.require("stable_baselines3", "gymnasium")

import numpy as np  # noqa: E402
from stable_baselines3.common.vec_env import base_vec_env  # noqa: E402

from physexp.suite import gymnasium  # noqa: E402


class VecEnv(base_vec_env.VecEnv):
    """Many environments that step together; an episode that ends is followed by the next one in the same step.

    `infos[i]` then has `terminal_observation`, `correct_answer`, `discounted_return`, `is_success`, and
    `TimeLimit.truncated`, which is true where the simulation has diverged, so that there is no outcome: running out of
    time is a wrong answer. `reset_infos[i]` has the `seed` and the `episode_index` of the episode that is played.

    Attributes:
      batch: the batch behind the environments.
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
        gymnasium.RENDER_MODE("render_mode", render_mode)
        self._vector = gymnasium.VectorEnvironment(
            domain, task, num_envs, num_threads, render_mode, autoreset_mode="same_step", **task_kwargs
        )
        self.batch = self._vector.batch
        self.render_mode = render_mode
        super().__init__(num_envs, self._vector.single_observation_space, self._vector.single_action_space)
        cast(Any, self.metadata)["render_fps"] = self._vector.metadata["render_fps"]

    def seed(self, seed: int | None = None) -> Any:
        """Has the next reset start the first episodes of another seed, by default a random one.

        It returns the seeds of the environments; `suite.load` with one of them makes that environment alone.
        """
        of_batch = cast(int, super().seed(seed)[0])
        return [suite.environment_seed(of_batch, row) for row in range(self.num_envs)]

    def reset(self) -> Any:
        """Starts the next episode everywhere, or what `seed` and `set_options` have asked for.

        The only option is `episode`, the index of the episode to start, the same everywhere.
        """
        options = self._options[0]
        if any(others != options for others in self._options):
            raise ValueError("options differ between environments; give all the same")
        observation, infos = self._vector.reset(seed=self._seeds[0], options=options)
        self._reset_seeds()
        self._reset_options()
        self._note_beginnings(range(self.num_envs), infos)
        return observation

    def step_async(self, actions: np.ndarray) -> None:
        self._actions = actions

    def step_wait(self) -> Any:
        observation, rewards, terminated, truncated, told = self._vector.step(self._actions)
        ended = terminated | truncated
        infos: list[dict[str, Any]] = [{} for _ in range(self.num_envs)]
        for row in np.flatnonzero(ended):
            final = {name: values[row].item() for name, values in told["final_info"].items() if name[0] != "_"}
            terminal = {"terminal_observation": told["final_obs"][row], "TimeLimit.truncated": bool(truncated[row])}
            infos[row] = terminal | final
        self._note_beginnings(np.flatnonzero(ended), told)
        return observation, rewards.astype(np.float32), ended, infos

    def _note_beginnings(self, rows: Iterable[int], infos: dict[str, np.ndarray]) -> None:
        for row in rows:
            self.reset_infos[row] = {name: int(infos[name][row]) for name in ("seed", "episode_index")}

    def get_images(self) -> Sequence[np.ndarray | None]:
        """Returns one image for each environment, as under Gymnasium; `render` lays them out side by side."""
        return [None] * self.num_envs if self.render_mode is None else self._vector.render()

    def close(self) -> None:
        self._vector.close()

    def __reduce__(self) -> NoReturn:  # Of copies and of pickles.
        self.batch.__reduce__()

    def get_attr(self, attr_name: str, indices: Any = None) -> list[Any]:
        return [getattr(self, attr_name)] * len(list(self._get_indices(indices)))

    def set_attr(self, attr_name: str, value: Any, indices: Any = None) -> None:
        raise NotImplementedError("the environments of a batch have no attributes of their own")

    def env_method(self, method_name: str, *method_args: Any, indices: Any = None, **method_kwargs: Any) -> list[Any]:
        raise NotImplementedError("the environments of a batch have no methods of their own")

    def env_is_wrapped(self, wrapper_class: Any, indices: Any = None) -> list[bool]:
        return [False] * len(list(self._get_indices(indices)))
