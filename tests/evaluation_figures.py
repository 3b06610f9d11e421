"""Names of the statistics of an evaluation, in their order."""

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
"""Further ones of `physexp evaluate` in tasks with a known ideal experimenter."""
