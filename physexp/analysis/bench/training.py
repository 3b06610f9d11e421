"""How quickly the default agents train, against a random policy in the same batch."""

from collections.abc import Iterator

from physexp.analysis.bench import measuring

_SECONDS = 20.0  # Of training, for one rate.
_TARGETS = {"heavier": 0.35}
_TARGET_OF_OTHERS = 0.8


def figures() -> Iterator[dict]:
    """Measures frames per second."""
    for name, task in measuring.FEATURES.items():
        trained = measuring.training_rate(task, _SECONDS)
        random = measuring.rates(measuring.random_batch(task), seconds=2.0)[0]
        yield measuring.row(
            f"training / random policy in the batch: {name}",
            trained / random,
            "x",
            _TARGETS.get(name, _TARGET_OF_OTHERS),
            training=trained,
            random=random,
        )
