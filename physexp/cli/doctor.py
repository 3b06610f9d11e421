"""Examines this machine: what it offers, what is missing, and what to do about it."""

from collections.abc import Iterator
import importlib
import importlib.metadata
import os
from pathlib import Path
import platform
import shutil

from packaging import requirements

from physexp import extras
from physexp.agents import processes

OK, MISSING, BROKEN = "ok", "missing", "broken"
"""Verdicts, which mean fine; some commands or some speed need it; the environments themselves do not work."""

# The suite imports mujoco and dm_control, whatever the environment variables of GL say.
_CORE = ("numpy", "scipy", "physexp.suite", "torch", "pyarrow", "rerun")
_PYTHON = ((3, 11), (3, 12))  # The first and the last that are tested.
_MEMORY = 2.0  # GiB: two workers that train the towers from pixels take 1.2.
_DISK = 1.0  # GiB: a run from pixels takes some hundredths of it, its replays more.


def examine() -> dict:
    """Facts about this machine by name, and `checks`, a list of verdicts with what to do.

    A check has `check`, its name; `verdict`, one of `OK`, `MISSING` and `BROKEN`; `found`; and `advice`, which is empty
    where all is well. If the core is broken, there are no facts but those that need none of it.
    """
    checks = list(_core())
    facts = {"python": platform.python_version(), "machine": f"{platform.system()} {platform.machine()}"}
    if not any(check["verdict"] == BROKEN for check in checks):
        facts |= _facts()
        checks += _hardware(facts)
    return {**facts, "checks": checks + list(_extras())}


def _facts() -> dict:
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


def _check(name: str, found: object, verdict: str = OK, advice: str = "") -> dict:
    return {"check": name, "verdict": verdict, "found": str(found), "advice": advice}


def _core() -> Iterator[dict]:
    """Whether Python and the libraries are of versions that fit, can be imported, and play an episode."""
    first, last = (".".join(map(str, version)) for version in _PYTHON)
    fits = _PYTHON[0] <= tuple(map(int, platform.python_version_tuple()[:2])) <= _PYTHON[1]
    yield _check("python", platform.python_version(), *(() if fits else (MISSING, f"tested with {first} to {last}")))
    yield from _versions(extra="")
    for module in _CORE:
        try:
            importlib.import_module(module)
        except Exception as error:  # The user is to read the broken library's own words.
            advice = "install physexp anew, into an environment of its own"
            yield _check(f"import {module}", _in_a_line(error), BROKEN, advice)
            return
    try:
        from physexp import suite

        for names in suite.ALL_TASKS:
            if not suite.load_task(*names).sense.needs_gl:
                environment = suite.load(*names, task_kwargs={"random": 0})
                environment.reset()
                environment.step(0)
                environment.close()
    except Exception as error:
        yield _check("environments", _in_a_line(error), BROKEN, "install physexp anew, with the versions above")
    else:
        yield _check("environments", "every task plays from features")


def _versions(extra: str) -> Iterator[dict]:
    """Whether the libraries that are installed, of the core or of an extra, are of versions that fit."""
    try:
        lines = importlib.metadata.requires("physexp") or ()
    except importlib.metadata.PackageNotFoundError:
        if not extra:
            tree = Path(__file__).parents[2]
            yield _check("versions", "unknown: physexp is not installed", MISSING, f"pip install -e {tree}")
        return
    for line in lines:
        wanted = requirements.Requirement(line)
        belongs = (
            wanted.marker is None
            if not extra
            else wanted.marker is not None and wanted.marker.evaluate({"extra": extra})
        )
        if not belongs or wanted.name == "physexp":
            continue
        try:
            found = importlib.metadata.version(wanted.name)
        except importlib.metadata.PackageNotFoundError:
            if not extra:
                yield _check(wanted.name, "not installed", BROKEN, f"pip install '{wanted.name}{wanted.specifier}'")
            continue
        if wanted.specifier.contains(found, prereleases=True):
            yield _check(wanted.name, found)
        else:
            yield _check(wanted.name, found, MISSING, f"pip install '{wanted.name}{wanted.specifier}'")


def _hardware(facts: dict) -> Iterator[dict]:
    from physexp.suite.engine import gl

    backend, renderer = facts["gl_backend"], facts["gl_renderer"]
    if renderer.startswith("none"):
        found, _, advice = renderer.rpartition("; ")
        yield _check("OpenGL", found, MISSING, advice)
    elif gl.is_software(renderer) and gl.gpu_is_present():
        yield _check(
            "OpenGL",
            f"{backend}: {renderer}",
            MISSING,
            "pixels are drawn by the processor: install the GPU's EGL driver",
        )
    else:
        yield _check("OpenGL", f"{backend}: {renderer}")
    if facts["gpu"] == "none" and gl.gpu_is_present():
        yield _check("GPU", "torch sees none", MISSING, "there is one: install its driver and a CUDA build of torch")
    else:
        yield _check("GPU", facts["gpu"] if facts["gpu"] != "none" else "none; no task needs one")
    yield _at_least("processors", facts["processors"], 2, "", "training is slower; give --num-workers 1")
    yield _at_least(
        "free memory", _available_memory(), _MEMORY, " GiB", "close other programs, or train with --num-workers 1"
    )
    disk = shutil.disk_usage(".").free / 2**30
    yield _at_least("free disk space here", disk, _DISK, " GiB", "make room, or train elsewhere with --run-dir")
    threads = facts["omp_num_threads"]
    too_many = threads.isdecimal() and int(threads) > facts["processors"]
    yield _check("OMP_NUM_THREADS", threads, *((MISSING, "more than processors: unset it") if too_many else ()))
    if os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY"):
        yield _check("display", os.environ.get("WAYLAND_DISPLAY") or os.environ["DISPLAY"])
    else:
        yield _check(
            "display", "none", MISSING, "only --view needs one; copy replays to a machine that has one, or --web"
        )


def _available_memory() -> float:
    """Returns the memory that programs can have, GiB; on Linux without what other programs have now."""
    path, most = Path("/proc/meminfo"), processes.memory()
    if path.exists():
        kibibytes = dict(line.split()[:2] for line in path.read_text(encoding="utf-8").splitlines())
        most = min(most, 2**10 * int(kibibytes.get("MemAvailable:", most)))
    return most / 2**30


def _at_least(name: str, value: float, least: float, unit: str, advice: str) -> dict:
    found = f"{value:.3g}{unit}"
    return (
        _check(name, found) if value >= least else _check(name, found, MISSING, f"less than {least:g}{unit}: {advice}")
    )


def _extras() -> Iterator[dict]:
    """Which extras are installed, in versions that fit."""
    for extra in dict.fromkeys(extras.EXTRAS.values()):
        modules = [module for module, bringer in extras.EXTRAS.items() if bringer == extra]
        install = f"pip install 'physexp[{extra}]'"
        if missing := extras.find_missing(modules):
            yield _check(f"extra {extra}", f"without {', '.join(missing)}", MISSING, install)
            continue
        versions = list(_versions(extra))
        found = ", ".join(f"{check['check']} {check['found']}" for check in versions) or "installed"
        fits = all(check["verdict"] == OK for check in versions)
        yield _check(f"extra {extra}", found, *(() if fits else (MISSING, install)))


def _in_a_line(error: Exception) -> str:
    return f"{type(error).__name__}: {' '.join(str(error).split())}"
