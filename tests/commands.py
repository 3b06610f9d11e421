"""Real processes in hundredths of a second: forked from a server that has made the imports of `physexp`.

The server (`multiprocessing`'s forkserver) is started by the first test that needs it. What it forks has a process id,
a session, a working directory, an environment and streams of its own, and is signalled and killed as any other. Tests
of what a start itself imports, or of an environment variable that an import looks at, start Python instead.
"""

import contextlib
import ctypes
import faulthandler
import multiprocessing
import os
import signal
import struct
import subprocess
import sys
import threading
import time
import types

from waiting import Patience

context = multiprocessing.get_context("forkserver")
context.set_forkserver_preload(
    [
        "pytest",
        "pandas",
        "torch._dynamo",
        "physexp.cli",
        "physexp.analysis.evaluation.publishing",
        "physexp.analysis.replay",
        "physexp.analysis.reproduction.reproduce",
        "physexp.suite.engine.rendering",  # Which opens no context before it draws: one could not be forked.
    ]
)


class Process:
    """A function that runs in a process forked from the server; it is used like `subprocess.Popen`.

    Attributes:
      pid: of the process, and of the session and the group that it leads.
      returncode: its exit status, below zero the signal that killed it; None while it runs.
      seconds: how long it took, once it is over.
    """

    def __init__(self, function, *args, first=None, cwd=None, env=None, stderr=subprocess.PIPE):
        """Starts `function(*args)`, after `first()`.

        Args:
          function, args, first: what a pickle can hold: functions at the top level of a module.
          cwd: its working directory; this process's by default.
          env: all of its environment variables; this process's by default.
          stderr: `subprocess.STDOUT` sends errors where the output goes.
        """
        self._started = time.monotonic()
        self.returncode, self.seconds = None, None
        output, theirs = context.Pipe(duplex=False)
        errors, their_errors = context.Pipe(duplex=False) if stderr == subprocess.PIPE else (None, theirs)
        surroundings = (os.getcwd() if cwd is None else str(cwd), dict(os.environ if env is None else env))
        self._process = context.Process(target=_child, args=(theirs, their_errors, surroundings, first, function, args))
        self._process.start()
        self.pid = self._process.pid
        self.stdout = _Stream(output)
        self.stderr = None if errors is None else _Stream(errors)
        for end in {theirs, their_errors}:
            end.close()

    def poll(self):
        """Returns the exit status, or None while the process runs."""
        if self.returncode is None and self._process.exitcode is not None:
            self.returncode, self.seconds = self._process.exitcode, time.monotonic() - self._started
        return self.returncode

    def wait(self) -> int:
        """Waits for the end, for as long as the process gets on; one that hangs is killed, and an error."""
        patience = Patience(self.pid)
        while self.poll() is None:
            self._process.join(1.0)
            if patience.is_over() and self.poll() is None:
                self.kill_all()
                raise AssertionError(f"process {self.pid} hangs: {patience}; {self.communicate()}")
        return self.returncode

    def communicate(self) -> tuple[str, str]:
        """Waits for the end; returns what was written to stdout and to stderr."""
        self.wait()
        return self.stdout.read(), "" if self.stderr is None else self.stderr.read()

    def send_signal(self, number: int) -> None:
        if self.poll() is None:
            os.kill(self.pid, number)

    def kill(self) -> None:
        self.send_signal(signal.SIGKILL)

    def kill_all(self) -> None:
        """Ends the process and what it has started, other than sessions of their own."""
        with contextlib.suppress(ProcessLookupError, PermissionError):
            os.killpg(self.pid, signal.SIGKILL)
        self._process.join()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.kill_all()
        self.poll()


class _Stream:
    """What a process writes, read by a thread so that no pipe is ever full."""

    def __init__(self, reader):
        self._written: list[bytes] = []
        self._thread = threading.Thread(target=self._listen, args=(reader,), daemon=True)
        self._thread.start()

    def _listen(self, reader) -> None:
        with open(reader.fileno(), "rb", closefd=False) as file:
            self._written.extend(file)
        reader.close()

    def so_far(self) -> str:
        """Returns the lines that were written until now."""
        return b"".join(self._written).decode(errors="replace")

    def read(self) -> str:
        """Returns all that is written, when everybody who might write is gone."""
        self._thread.join()
        return self.so_far()


def _child(output, errors, surroundings, first, function, args):
    os.setsid()
    cwd, variables = surroundings
    os.environ.clear()
    os.environ.update(variables)
    os.chdir(cwd)
    for number, stream in ((1, output), (2, errors)):
        os.dup2(stream.fileno(), number)
    output.close()
    errors.close()
    # As they are when Python starts: what goes to a pipe is written in blocks, errors in lines.
    sys.stdout = os.fdopen(1, "w", closefd=False)
    sys.stderr = os.fdopen(2, "w", buffering=1, errors="backslashreplace", closefd=False)
    faulthandler.enable()
    # What processes it starts would import as this one's program is that of the tests.
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
    """Runs `physexp` with these arguments in a process of its own, to its end.

    Raises:
      CalledProcessError: if its status is not 0 and `check` is set.
    """
    with start(*words, **kwargs) as process:
        output, errors = process.communicate()
    done = subprocess.CompletedProcess(["physexp", *words], process.returncode, output, errors)
    if check and done.returncode:
        print(errors)
        done.check_returncode()
    return done


def bound() -> None:
    """Has permissions bind root as they bind others: to be called in a process, before the function."""
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
