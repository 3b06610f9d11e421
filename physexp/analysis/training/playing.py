"""Evaluation: plays episodes with a trained agent."""

from collections.abc import Callable

import numpy as np

from physexp.agents import acting, devices, networks
from physexp.analysis import domains
from physexp.analysis.data.episodes import Episodes
from physexp.analysis.training import config as config_lib
from physexp.analysis.training import finding, trainer
from physexp.analysis.training import run as run_lib

SEED = 1_000_003  # Of the evaluation's environments, apart from those of training.
INTERACTIONS = ("learned", "random")
_BATCH = 256


def evaluate(run: run_lib.Run, num_episodes: int, interaction: str = "learned", seed: int = SEED) -> Episodes:
    """Plays episodes with the agent of a run; otherwise as `play`."""
    network = finding.load_network(run)
    return play(network, run.config, num_episodes, interaction, seed=seed)


@devices.own_torch()
def play(
    network: networks.RecurrentNetwork,
    config: config_lib.TrainConfig,
    num_episodes: int,
    interaction: str = "learned",
    greedy: bool = False,
    seed: int = SEED,
    num_threads: int = 2,
    device: str = "auto",
    num_steps: int = 0,
    show: Callable[[int], None] = lambda done: None,
) -> Episodes:
    """Returns episodes that a network has played in the task of a configuration; of several settings, in the first.

    The interaction is `learned`, or `random` for the paper's randomized interaction; see `randomized`. `greedy` takes
    the likeliest action instead of drawing one. With a least number of environment steps, `num_steps`, whole rounds are
    returned. `show` is called after each round with the number of episodes played. Raises ValueError for an unknown
    interaction or a number of episodes below one.
    """
    if interaction not in INTERACTIONS:
        raise ValueError(f"interaction is {interaction!r}; choose from {', '.join(INTERACTIONS)}")
    if num_episodes < 1:
        raise ValueError(f"episodes is {num_episodes}; give a number >= 1")
    network.to(devices.choose(device, network.sees_images))
    batch_size = _BATCH if num_steps else min(num_episodes, _BATCH)
    environment = trainer.make_environment(config.settings[0], seed, batch_size, num_threads)
    num_interactions = environment.task.num_interactions
    rounds: list[Episodes] = []
    count = steps = 0
    while count < num_episodes or steps < num_steps:
        generator = np.random.default_rng([seed, len(rounds)])
        choose = acting.likeliest if greedy else acting.drawn(generator)
        if interaction == "random":
            choose = randomized(choose, num_interactions, generator)
        played = acting.play_round(network, environment, len(rounds), choose)
        rules = environment.task.rules
        rounds.append(Episodes.of_round(played, rules, environment.seeds, len(rounds), environment.hidden))
        count, steps = count + len(rounds[-1]), steps + played.num_frames
        show(min(count, num_episodes))
    environment.close()
    joined = Episodes.joined(rounds)
    return joined if num_steps else joined.first(num_episodes)


def ideal_return(config: config_lib.TrainConfig) -> float | None:
    """Returns the expected return of the ideal experimenter in an agent's task; None where it is not known."""
    find = domains.find(config.domain).ideal_with(config.task_kwargs)
    try:
        return None if find is None else find(config.task, config.task_kwargs, config.agent.discount).value
    except ValueError:  # It is not defined for these options.
        return None


def randomized(choose: acting.Choose, num_interactions: int, generator: np.random.Generator) -> acting.Choose:
    """Returns a choice that draws interaction actions uniformly; labeling actions pass (paper, Section 5.3)."""

    def choose_anew(output: networks.Output, environments: np.ndarray, step: int) -> np.ndarray:
        actions = choose(output, environments, step)
        drawn = generator.integers(num_interactions, size=len(actions))
        return np.where(actions < num_interactions, drawn, actions)

    return choose_anew
