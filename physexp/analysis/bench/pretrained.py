"""How well the agents that come with the package answer, on episodes that training never saw."""

from collections.abc import Iterator

from physexp.agents import pretrained
from physexp.analysis.bench import measuring
from physexp.analysis.evaluation import playing

EPISODES = 10_000
# What each agent must reach: a figure of the evaluation and its least value.
TARGETS = {
    ("which_is_heavier", "features", 3): ("mean_return", 0.79),
    ("which_is_heavier", "features", 5): ("mean_return", 0.83),
    ("which_is_heavier", "features", 10): ("mean_return", 0.86),
    ("towers", "direct_features", None): ("success_rate", 0.95),
    ("towers", "fist_features", None): ("success_rate", 0.98),
    ("which_is_heavier", "pixels", 3): ("success_rate", 0.88),
    ("which_is_heavier", "pixels", 5): ("success_rate", 0.94),
    ("which_is_heavier", "pixels", 10): ("success_rate", 0.97),
    ("towers", "direct_pixels", None): ("success_rate", 0.93),
    ("towers", "fist_pixels", None): ("success_rate", 0.97),
}


def figures() -> Iterator[dict]:
    """Evaluates every agent, its actions drawn from its policy as in training."""
    for (domain, task, difficulty), (measured, target) in TARGETS.items():
        agent = pretrained.load(domain, task, difficulty)
        config = playing.config_of(agent)
        drawn, greedy = (
            playing.play(agent.network, config, EPISODES, greedy=greedy).summary(config.agent.discount)
            for greedy in (False, True)
        )
        name = pretrained.name(domain, task, agent.card["task_kwargs"])
        yield measuring.row(
            f"{measured}: {name}",
            drawn[measured],
            "",
            target,
            greedy=greedy[measured],
            right=drawn["success_rate"],
            interactions=drawn["mean_interactions"],
            million_frames=agent.card["frames"] / 1e6,
            minutes=agent.card["seconds"] / 60,
        )
