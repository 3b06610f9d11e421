"""Speed of the default agents' training, and success of the agents that come with the package."""

from collections.abc import Iterator

from physexp.agents import pretrained
from physexp.analysis import domains
from physexp.analysis.bench import measuring
from physexp.analysis.training import finding, playing

_SECONDS = 20.0  # Of training, for one rate.
_TARGETS = {"heavier": 0.35}
_TARGET_OF_OTHERS = 0.8
_EPISODES = 10_000


def training() -> Iterator[dict]:
    """Measures frames per second of training, against a random policy in the same batch."""
    for name, task in measuring.FEATURES.items():
        trained = measuring.training_rate(task, _SECONDS)
        random = measuring.rates(measuring.random_batch(task), seconds=2.0)[0]
        target = _TARGETS.get(name, _TARGET_OF_OTHERS)
        figure = f"training / random policy in the batch: {name}"
        yield measuring.ratio(figure, target, training=trained, random=random)


def pretrained_agents() -> Iterator[dict]:
    """Evaluates every agent, with actions drawn from its policy and with the likeliest ones."""
    targets = {name: target for domain in domains.DOMAINS.values() for name, target in domain.targets.items()}
    for name, (measured, target) in targets.items():
        agent = pretrained.load_named(name)
        config = finding.config_of(agent.card)
        drawn, greedy = (
            playing.play(agent.network, config, _EPISODES, greedy=greedy).summary(config.agent.discount)
            for greedy in (False, True)
        )
        others = {"right": drawn["success_rate"], "interactions": drawn["mean_interactions"]}
        others |= {"million_frames": agent.card["frames"] / 1e6, "minutes": agent.card["seconds"] / 60}
        yield measuring.row(f"{measured}: {name}", drawn[measured], "", target, greedy=greedy[measured], **others)
