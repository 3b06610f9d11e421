"""Benchmarks: measured figures, each beside what it is compared with."""

SECTIONS: dict[str, tuple[str, ...]] = {
    "reset": (),
    "batch": (),
    "training": (),
    "peers": ("gymnasium", "stable_baselines3", "sb3_contrib"),
    "pixels": (),
    "pretrained": (),
    "replay": (),
    "distributed": ("ray",),
    "learning": ("matplotlib", "pandas"),
}
"""The sections of the benchmark, with the modules of extras that each uses; light, for the command line's help."""

DEFAULT = tuple(section for section in SECTIONS if section != "learning")
"""What is measured unless something is asked for: learning takes hours."""
