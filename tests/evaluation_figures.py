"""What an evaluation tells, in its order."""

NAMES = [
    "episodes",
    "success_rate",
    "success_interval",
    "mean_return",
    "mean_interactions",
    "median_interactions",
    "timeouts",
]
