"""Commands in processes of their own, in hundredths of a second: forked from a server that has imported `physexp`.

The first test that needs the server (`multiprocessing`'s forkserver) starts it. A forked process has its own id, group,
working directory, environment and streams, and is signalled and killed as any other; so is its offspring. Tests of a
start's own imports, or of an environment variable that an import reads, start Python instead.
"""

import contextlib
import ctypes
import faulthandler
import multiprocessing
from multiprocessing import forkserver, reduction
import os
import signal
import struct
import subprocess
import sys
import threading
import types

import psutil
from waiting import Patience, wait_until

context = multiprocessing.get_context("forkserver")
_OURS = ["cli", "analysis.training.publishing", "analysis.replay", "analysis.experiments.reproduce"]
_OURS += ["suite.engine.rendering"]  # It opens no context before it draws: one could not be forked.
context.set_forkserver_preload(["pytest", "pandas", "torch._dynamo", *(f"physexp.{name}" for name in _OURS)])


class _Spawned(multiprocessing.context.ForkServerProcess):
    """A process with its parent's group, directory, environment, streams and signal mask, as `spawn` makes it."""

    def __getstate__(self):
        forkserver._forkserver.ensure_running()
        surroundings = {
            "group": os.getpgrp(),
            "cwd": os.getcwd(),
            "variables": dict(os.environ),
            "streams": [reduction.DupFd(number) for number in (1, 2)],
            "mask": signal.pthread_sigmask(signal.SIG_BLOCK, []),
            "server": forkserver._forkserver._forkserver_address,
        }
        return self.__dict__ | {"surroundings": surroundings}

    def run(self):
        _surround(**self.__dict__.pop("surroundings"))
        super().run()


class _Spawning(type(context)):
    """The context that code under test gets for `multiprocessing.get_context("spawn")`."""

    Process = _Spawned


def spawn_quickly() -> None:
    """Makes this process and its descendants fork from the server in place of spawning."""
    multiprocessing.context._concrete_contexts["spawn"] = _Spawning()


def _surround(group, cwd, variables, streams, mask, server) -> None:
    """Gives a forked process everything that it would inherit from its parent if that had spawned it."""
    signal.pthread_sigmask(signal.SIG_SETMASK, mask)
    os.setpgid(0, group)
    os.environ.clear()
    os.environ.update(variables)
    os.chdir(cwd)
    for number, stream in zip((1, 2), streams, strict=True):
        os.dup2(stream.detach(), number)
    # As when Python starts: output to a pipe is written in blocks, errors in lines.
    sys.stdout = os.fdopen(1, "w", closefd=False)
    sys.stderr = os.fdopen(2, "w", buffering=1, errors="backslashreplace", closefd=False)
    forkserver._forkserver._forkserver_address = server
    forkserver._forkserver.ensure_running = lambda: None  # It is.
    spawn_quickly()


class Process:
    """A function that runs in a process forked from the server, used like `subprocess.Popen`.

    Attributes:
      pid: of the process, and of the group that it leads.
      returncode: its exit status, below zero the signal that killed it; None while it runs.
    """

    def __init__(self, function, *args, first=None, cwd=None, env=None, stderr=subprocess.PIPE):
        """Starts `function(*args)`, after `first()`: functions at the top level of a module, and values to pickle.

        `cwd` and `env`, all of its environment variables, are this process's by default; `stderr` may be
        `subprocess.STDOUT`.
        """
        self.returncode = None
        forkserver.ensure_running()
        output, writer = os.pipe()
        errors, error_writer = os.pipe() if stderr == subprocess.PIPE else (None, writer)
        surroundings = {
            "cwd": os.getcwd() if cwd is None else str(cwd),
            "variables": dict(os.environ if env is None else env),
            "mask": signal.pthread_sigmask(signal.SIG_BLOCK, []),
            "server": forkserver._forkserver._forkserver_address,
        }
        self._process = _Started(target=_child, args=(surroundings, first, function, args))
        self._process.writers = writer, error_writer
        self._process.start()
        self.pid = self._process.pid
        self.stdout = _Stream(output)
        self.stderr = None if errors is None else _Stream(errors)
        for end in {writer, error_writer}:
            os.close(end)

    def poll(self):
        """Returns the exit status, or None while the process runs."""
        self.returncode = self._process.exitcode
        return self.returncode

    def wait(self) -> int:
        """Waits for the end as long as the process makes progress; kills a process that hangs and raises an error."""
        patience = Patience(self.pid)
        while self.poll() is None:
            self._process.join(1.0)
            if patience.is_over() and self.poll() is None:
                self.kill_all()
                raise AssertionError(f"process {self.pid} hangs: {patience}; {self.communicate()}")
        return self.returncode

    def communicate(self) -> tuple[str, str]:
        """Waits for the end; returns the texts of stdout and stderr."""
        self.wait()
        return self.stdout.read(), "" if self.stderr is None else self.stderr.read()

    def send_signal(self, number: int) -> None:
        if self.poll() is None:
            os.kill(self.pid, number)

    def kill(self) -> None:
        self.send_signal(signal.SIGKILL)

    def kill_all(self) -> None:
        """Ends the process and its descendants, apart from groups of their own."""
        self.kill()  # It has no group before it has begun.
        with contextlib.suppress(ProcessLookupError, PermissionError):
            os.killpg(self.pid, signal.SIGKILL)
        self._process.join()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.kill_all()
        self.poll()


class _Stream:
    """The output of a process, read by a thread so that no pipe is ever full."""

    def __init__(self, reader):
        self._written: list[bytes] = []
        self._thread = threading.Thread(target=self._listen, args=(reader,), daemon=True)
        self._thread.start()

    def _listen(self, reader) -> None:
        with os.fdopen(reader, "rb") as file:
            self._written.extend(file)

    def so_far(self) -> str:
        """Returns the text so far."""
        return b"".join(self._written).decode(errors="replace")

    def read(self) -> str:
        """Returns the whole text, after all processes that could write have ended."""
        wait_until(lambda: not self._thread.is_alive(), "the end of the output of a process and its descendants")
        return self.so_far()


class _Started(multiprocessing.context.ForkServerProcess):
    """The process behind a `Process`; `writers` are its stdout and stderr."""

    def __getstate__(self):
        streams = [reduction.DupFd(number) for number in self.writers]
        return {name: value for name, value in self.__dict__.items() if name != "writers"} | {"streams": streams}

    def run(self):
        self._args = (self.__dict__.pop("streams"), *self._args)
        super().run()


def _child(streams, surroundings, first, function, args):
    os.setpgid(0, 0)
    _surround(group=os.getpid(), streams=streams, **surroundings)
    faulthandler.enable()
    # Its spawned processes would import that as the program.
    sys.modules["__main__"] = types.ModuleType("__main__")
    import torch

    torch.set_num_threads(1)
    if first is not None:
        first()
    try:
        function(*args)
    finally:
        sys.stdout.flush()


def physexp(*words) -> None:
    """`physexp` with these arguments, in this process."""
    from physexp import cli

    sys.argv = ["physexp", *map(str, words)]
    cli.main()


def start(*words, **kwargs) -> Process:
    """Starts `physexp` with these arguments in a process of its own; see `Process`."""
    return Process(physexp, *words, **kwargs)


def run(*words, check: bool = False, **kwargs) -> subprocess.CompletedProcess:
    """Runs `physexp` with these arguments in a process of its own, to its end; with `check`, its status must be 0."""
    with start(*words, **kwargs) as process:
        output, errors = process.communicate()
    done = subprocess.CompletedProcess(["physexp", *words], process.returncode, output, errors)
    if check and done.returncode:
        print(errors)
        done.check_returncode()
    return done


def bound() -> None:
    """Makes permissions bind root as they bind others; for `first` of a `Process`."""
    header = struct.pack("Ii", 0x20080522, 0)  # The version of the structure; this process.
    data = ctypes.create_string_buffer(24)
    libc = ctypes.CDLL(None, use_errno=True)
    if libc.capget(header, data):
        raise OSError(ctypes.get_errno(), "cannot read capabilities")
    words = list(struct.unpack("6I", data.raw))
    words[0] &= ~0b110  # CAP_DAC_OVERRIDE and CAP_DAC_READ_SEARCH, of the effective ones.
    if libc.capset(header, struct.pack("6I", *words)):
        raise OSError(ctypes.get_errno(), "cannot give up capabilities")
    libc.prctl(24, 1)  # PR_CAPBSET_DROP, CAP_DAC_OVERRIDE: nor do programs that it starts have it.


def listening(leader: int) -> set[tuple[str, int]]:
    """Returns the addresses and ports on which a process and its descendants listen."""
    found = set()
    with contextlib.suppress(psutil.NoSuchProcess):
        parent = psutil.Process(leader)
        for process in (parent, *parent.children(recursive=True)):
            with contextlib.suppress(psutil.NoSuchProcess, psutil.AccessDenied):
                found |= {(*one.laddr,) for one in process.net_connections("tcp") if one.status == psutil.CONN_LISTEN}
    return found
