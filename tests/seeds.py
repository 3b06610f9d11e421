"""Seeds of randomised tests."""

import numpy as np


def fresh_seed() -> int:
    """Returns another seed each time, below 2**32, and prints it: pytest shows it where a test fails."""
    seed = np.random.SeedSequence().entropy % 2**32
    print("seed", seed)
    return seed
