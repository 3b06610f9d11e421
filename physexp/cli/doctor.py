"""Examines this machine: versions, hardware and extras, each with advice if something is missing."""

from collections.abc import Iterator
import dataclasses
import importlib
import importlib.metadata
import os
from pathlib import Path
import platform
import shutil
import sys
from typing import Any

from packaging import requirements, specifiers

from physexp import extras
from physexp.agents import processes
from physexp.cli import printing
from physexp.cli.arguments import option

OK, MISSING, BROKEN = "ok", "missing", "broken"
"""Verdicts: fine; some commands or some speed need it; the environments themselves do not work."""

# The suite imports mujoco and dm_control with the environment variables of GL set aside.
_CORE = ("numpy", "scipy", "physexp.suite", "torch", "pyarrow", "rerun")
_MEMORY = 2.0  # GiB: two workers that train the towers from pixels take 1.2.
_DISK = 1.0  # GiB: a run from pixels takes some hundredths of it, its replays more.


@dataclasses.dataclass
class Doctor:
    """Check versions, GPU and OpenGL, and advise about everything that is missing.

    The exit status is 1 if the environments themselves do not work, else 0.
    """

    json: bool = option(False, "print JSON")

    def run(self) -> None:
        """Prints the checks and exits."""
        found = examine()
        printing.show(found if self.json else found["checks"], self.json)
        if any(check["verdict"] == BROKEN for check in found["checks"]):
            sys.exit(1)


def examine() -> dict[str, Any]:
    """Returns facts about this machine by name, and `checks`.

    A check has the keys `check`, its name; `verdict`, one of `OK`, `MISSING` and `BROKEN`; `found`; and `advice`, which
    is empty if the verdict is `OK`. If the core is broken, facts that need it are left out.
    """
    checks = list(_core())
    facts = {"python": platform.python_version(), "machine": f"{platform.system()} {platform.machine()}"}
    if all(check["verdict"] != BROKEN for check in checks):
        facts |= _facts()
        checks += _hardware(facts)
    return {**facts, "checks": checks + list(_extras())}


def _facts() -> dict[str, Any]:
    import torch

    from physexp.analysis.data import provenance
    from physexp.suite.engine import gl

    return {
        **provenance.versions(),
        "processors": processes.num_cores(),
        "torch_threads": torch.get_num_threads(),
        "omp_num_threads": os.environ.get("OMP_NUM_THREADS", "not set"),
        "gpu": torch.cuda.get_device_name() if torch.cuda.is_available() else "none",
        "gl_backend": gl.choose_backend(),
        "gl_renderer": gl.renderer_name(),
    }


def _check(name: str, found: object, advice: str = "", verdict: str = MISSING) -> dict[str, str]:
    return {"check": name, "verdict": verdict if advice else OK, "found": str(found), "advice": advice}


def _core() -> Iterator[dict[str, str]]:
    """Yields whether Python and the libraries fit, can be imported and play an episode."""
    try:
        wanted = importlib.metadata.metadata("physexp")["Requires-Python"]
    except importlib.metadata.PackageNotFoundError:
        yield _check("versions", "unknown: physexp is not installed", f"pip install -e {Path(__file__).parents[2]}")
    else:
        fits = specifiers.SpecifierSet(wanted).contains(platform.python_version())
        yield _check("python", platform.python_version(), "" if fits else f"install Python {wanted}")
        yield from map(_version, _requirements(extra=""))
    step = ""
    try:
        for module in _CORE:
            step = f"import {module}"
            importlib.import_module(module)
        step = "environments"
        from physexp import suite

        for names in suite.ALL_TASKS:
            if not suite.load_task(*names).pixels:
                environment = suite.load(*names, task_kwargs={"random": 0})
                environment.reset()
                environment.step(0)
                environment.close()
    except Exception as error:  # Any error of a broken library is shown to the user.
        found = f"{type(error).__name__}: {' '.join(str(error).split())}"
        yield _check(step, found, "install physexp into a new environment", BROKEN)
    else:
        yield _check("environments", "every task plays from features")


def _requirements(extra: str) -> Iterator[requirements.Requirement]:
    """Yields the libraries of the core, or of an extra alone."""
    for line in importlib.metadata.requires("physexp") or ():
        wanted = requirements.Requirement(line)
        if wanted.name != "physexp" and (wanted.marker.evaluate({"extra": extra}) if wanted.marker else not extra):
            yield wanted


def _version(wanted: requirements.Requirement) -> dict[str, str]:
    """Returns whether a library is installed in a version that fits."""
    install = f"pip install '{wanted.name}{wanted.specifier}'"
    try:
        found = importlib.metadata.version(wanted.name)
    except importlib.metadata.PackageNotFoundError:
        return _check(wanted.name, "not installed", install, BROKEN)
    return _check(wanted.name, found, "" if wanted.specifier.contains(found, prereleases=True) else install)


def _hardware(facts: dict[str, Any]) -> Iterator[dict[str, str]]:
    from physexp.suite.engine import gl

    renderer, processors, threads = facts["gl_renderer"], facts["processors"], facts["omp_num_threads"]
    if renderer.startswith("none"):
        found, _, advice = renderer.rpartition("; ")
        yield _check("OpenGL", found, advice)
    else:
        is_slow = gl.is_software(renderer) and gl.gpu_is_present()
        advice = "pixels are drawn by the processor: install the GPU's EGL driver" if is_slow else ""
        yield _check("OpenGL", f"{facts['gl_backend']}: {renderer}", advice)
    if facts["gpu"] == "none" and gl.gpu_is_present():
        yield _check("GPU", "torch sees none", "there is one: install its driver and a CUDA build of torch")
    else:
        yield _check("GPU", facts["gpu"] if facts["gpu"] != "none" else "none; no task needs one")
    yield _at_least("processors", processors, 2, "", "training is slower; give --num-workers 1")
    advice = "close other programs, or train with --num-workers 1"
    yield _at_least("free memory", _available_memory(), _MEMORY, " GiB", advice)
    disk = shutil.disk_usage(".").free / 2**30
    yield _at_least("free disk space here", disk, _DISK, " GiB", "make room, or train elsewhere with --run-dir")
    too_many = threads.isdecimal() and int(threads) > processors
    yield _check("OMP_NUM_THREADS", threads, "more than processors: unset it" if too_many else "")
    display = os.environ.get("WAYLAND_DISPLAY") or os.environ.get("DISPLAY")
    advice = "only --view needs one; copy replays to a machine that has one, or give --web"
    yield _check("display", display or "none", "" if display else advice)


def _available_memory() -> float:
    """Returns the memory that programs can have, GiB; on Linux without the memory in use."""
    path, most = Path("/proc/meminfo"), processes.memory()
    if path.exists():
        kibibytes = dict(line.split()[:2] for line in path.read_text(encoding="utf-8").splitlines())
        most = min(most, 2**10 * int(kibibytes.get("MemAvailable:", most)))
    return most / 2**30


def _at_least(name: str, value: float, minimum: float, unit: str, advice: str) -> dict[str, str]:
    return _check(name, f"{value:.3g}{unit}", "" if value >= minimum else f"less than {minimum:g}{unit}: {advice}")


def _extras() -> Iterator[dict[str, str]]:
    """Yields whether extras are installed in versions that fit."""
    for extra in dict.fromkeys(extras.EXTRAS.values()):
        missing = extras.find_missing(module for module, name in extras.EXTRAS.items() if name == extra)
        install = f"pip install 'physexp[{extra}]'"
        if missing:
            yield _check(f"extra {extra}", f"without {', '.join(missing)}", install)
            continue
        versions = [_version(wanted) for wanted in _requirements(extra)]
        found = ", ".join(f"{check['check']} {check['found']}" for check in versions)
        yield _check(f"extra {extra}", found, "" if all(check["verdict"] == OK for check in versions) else install)
