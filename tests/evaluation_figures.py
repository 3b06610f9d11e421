"""Names of the figures of an evaluation, in their order."""

NAMES = [
    "episodes",
    "success_rate",
    "success_interval",
    "mean_return",
    "mean_interactions",
    "median_interactions",
    "timeouts",
]

IDEAL = ["ideal_return", "share_of_ideal"]
"""Those of `physexp evaluate` where an ideal experimenter is known."""
