"""How well the agents that come with the package answer, on episodes that training never saw."""

from collections.abc import Iterator

from physexp.agents import pretrained
from physexp.analysis import domains
from physexp.analysis.bench import measuring
from physexp.analysis.training import finding, playing

EPISODES = 10_000


def figures() -> Iterator[dict]:
    """Evaluates every agent, its actions drawn from its policy as in training."""
    targets = {name: target for domain in domains.DOMAINS.values() for name, target in domain.targets.items()}
    for name, (measured, target) in targets.items():
        agent = pretrained.load_named(name)
        config = finding.config_of(agent.card)
        drawn, greedy = (
            playing.play(agent.network, config, EPISODES, greedy=greedy).summary(config.agent.discount)
            for greedy in (False, True)
        )
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
