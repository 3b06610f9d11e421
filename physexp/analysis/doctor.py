"""What this machine offers: versions, the GL backend, threads, a GPU."""

import os
import platform


def examine() -> dict:
    """Facts about this machine by name.

    The GL renderer is found out by making a context with the backend in use; where none can be made, the entry says
    what is missing.
    """
    import torch

    from physexp.analysis import run
    from physexp.suite import rendering

    return {
        **run.versions(),
        "machine": f"{platform.system()} {platform.machine()}",
        "processors": len(os.sched_getaffinity(0)),
        "torch_threads": torch.get_num_threads(),
        "omp_num_threads": os.environ.get("OMP_NUM_THREADS", "not set"),
        "gpu": torch.cuda.get_device_name() if torch.cuda.is_available() else "none",
        "gl_backend": rendering.choose_backend(),
        "gl_renderer": rendering.renderer_name(),
    }
