"""Settings of torch while an agent computes: its own inside, the caller's again outside."""

from collections.abc import Iterator
import contextlib

import torch


@contextlib.contextmanager
def own_torch(num_threads: int = 1) -> Iterator[None]:
    """Returns a context in which torch has its usual settings; it decorates functions, too.

    The settings are the random state, the number of threads, the default type, and that gradients are computed.
    Afterwards the caller finds its own.

    Args:
      num_threads: threads inside.
    """
    threads, dtype = torch.get_num_threads(), torch.get_default_dtype()
    try:
        torch.set_num_threads(num_threads)
        torch.set_default_dtype(torch.float32)
        with torch.random.fork_rng(devices=[]), torch.inference_mode(False), torch.enable_grad():
            yield
    finally:
        torch.set_default_dtype(dtype)
        torch.set_num_threads(threads)
