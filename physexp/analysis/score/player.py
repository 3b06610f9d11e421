"""A user's actor in a process of its own, which gets what an agent may observe, and nothing else.

It answers in lines of JSON, so that nothing of the actor's runs in this process.
"""

import contextlib
import json
import multiprocessing
import os
import pickle
import signal
import socket
import sys
import sysconfig
import threading
import time
import traceback
from typing import Any

import dm_env
import numpy as np

import physexp
from physexp.agents import processes
from physexp.analysis.score import episodes, protocol, targets

_START_SECONDS = 300.0  # For a process to import what it needs and to make an actor, beside the limit of a call.
_LEAVE_SECONDS = 10.0  # For the system to tell how a process has ended.
_MOST_BYTES = 2**16  # Of an answer.
_LONGEST = 200  # Characters of a text in it.

_is_actor = False  # Whether this process is an actor's.


class PlayerError(ValueError):
    """An actor has failed: it raised, did nothing in time, ended its process, or returned no action."""


def check_place() -> None:
    """Raises TargetError in an actor's process: the import of a script without a guard comes to play there again."""
    if _is_actor:
        raise targets.TargetError(
            'the module plays episodes when it is imported; put its own calls below `if __name__ == "__main__":`'
        )


class Player:
    """An actor in a process of its own; a context that ends the process and all that it has started."""

    def __init__(self, target: str, timeout: float):
        """Prepares a process.

        Args:
          target: a user's function, as for `targets.find`.
          timeout: for each call of the actor, s.
        """
        self._target, self._timeout = target, timeout
        self._process: Any = None

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self._process is None:
            return
        with contextlib.suppress(ProcessLookupError):  # It has no group as long as it has not begun.
            os.killpg(self._process.pid, signal.SIGKILL)
        processes.kill(self._process)
        self._ours.close()

    def begin(self, asked: protocol.Question, first: int) -> episodes.Act:
        """Makes an actor for a task; returns its choice of actions.

        Args:
          asked: the task.
          first: the index of the first episode that it will play.

        Raises:
          PlayerError: if the actor fails, then or later.
        """
        if self._process is None:
            self._start()
        self._asked, self._number = asked, first
        self._call("before the first episode", ("task", asked), self._timeout + _START_SECONDS)
        return self._act

    def end(self, timestep: dm_env.TimeStep) -> None:
        """Shows the actor the last time step of an episode; raises PlayerError if it fails."""
        self._call(f"episode {self._number}, the end", ("step", timestep), self._timeout)
        self._number += 1

    def _start(self) -> None:
        self._ours, theirs = socket.socketpair()
        context = processes.spawning()
        name = f"actor {self._target}"
        self._process = context.Process(target=_serve, args=(theirs, self._target), name=name)
        with processes.without_script(), processes.inherited_by_workers():
            self._process.start()
        theirs.close()

    def _act(self, step: int, timestep: dm_env.TimeStep) -> int:
        where = f"episode {self._number}, step {step}"
        action = self._call(where, ("step", timestep), self._timeout).get("action")
        if not isinstance(action, int) or not 0 <= action < self._asked.num_actions:
            raise PlayerError(
                f"{self._target} chose {action}, which is no action ({self._asked.name}, {where}); return an integer "
                f"from 0 to {self._asked.num_actions - 1}"
            )
        return action

    def _call(self, where: str, message: tuple[str, Any], timeout: float) -> dict[str, Any]:
        place = f"({self._asked.name}, {where})"
        try:
            said = dict(json.loads(self._exchange(pickle.dumps(message), time.monotonic() + timeout)))
        except TimeoutError:
            raise PlayerError(
                f"{self._target} did nothing within {timeout:g} s {place}; mend it, or give a longer --timeout"
            ) from None
        except (EOFError, OSError):
            self._process.join(_LEAVE_SECONDS)
            raise PlayerError(
                f"{self._target} ended its process, exit code {self._process.exitcode} {place}; mend it"
            ) from None
        except (ValueError, TypeError, RecursionError):
            said = {"error": "it wrote to the connection of its process"}
        if "error" in said:
            raise PlayerError(f"{self._target} failed: {said['error']} {place}")
        return said

    def _exchange(self, message: bytes, end: float) -> bytes:
        """Sends a message and returns the line that answers it; raises TimeoutError after a time of `monotonic`."""
        self._wait_until(end)
        self._ours.sendall(message)
        said = b""
        while not said.endswith(b"\n"):
            self._wait_until(end)
            part = self._ours.recv(_MOST_BYTES)
            said += part
            if not part:
                raise EOFError
            if len(said) > _MOST_BYTES:
                raise ValueError("more than an answer")
        return said

    def _wait_until(self, end: float) -> None:
        left = end - time.monotonic()
        if left <= 0:
            raise TimeoutError
        self._ours.settimeout(left)


def _serve(connection: socket.socket, target: str) -> None:
    """The actor's process: answers until it is killed."""
    global _is_actor
    _is_actor = True
    os.setsid()  # Requests to end this program go to its group, and the actor's ends as one.
    signal.pthread_sigmask(signal.SIG_UNBLOCK, processes.STOP_SIGNALS)  # Programs of the actor's inherit the mask.
    threading.Thread(target=_end_with_parent, daemon=True).start()
    os.dup2(2, 1)  # An actor's prints are no part of this program's output.
    sys.stdout.reconfigure(line_buffering=True)  # type: ignore[union-attr]
    make = targets.find(target).make
    actor: Any = None
    action: int | None = None
    messages = connection.makefile("rb")
    while True:
        kind, content = pickle.load(messages)
        said: dict[str, Any] = {}
        try:
            if kind == "task":
                actor = make(content, 0)
            else:
                episodes.show(actor, None if content.first() else action, content)
                if not content.last():
                    action = said["action"] = _plain(actor.select_action(content.observation))
        except Exception as error:  # The other side tells it, and ends.
            said = {"error": _described(error)}
        connection.sendall(json.dumps(said).encode() + b"\n")


def _end_with_parent() -> None:
    """Ends this process and all that it has started when its parent ends."""
    parent = multiprocessing.parent_process()
    assert parent is not None
    parent.join()
    os.killpg(os.getpid(), signal.SIGKILL)


def _plain(action: Any) -> Any:
    """Returns an action as an integer, where it is one, and else as a text that shows it."""
    array = np.asarray(action)
    is_integer = array.size == 1 and array.dtype.kind in "iu"
    return array.item() if is_integer else " ".join(repr(action).split())[:_LONGEST]


def _described(error: Exception) -> str:
    """Returns an error in one line, with the place in the code that plays: the last one that is no library's."""
    if isinstance(error, targets.TargetError):
        return str(error)
    frames = traceback.extract_tb(error.__traceback__)
    own = [frame for frame in frames if not _is_of_a_library(frame.filename)]
    message = " ".join(str(error).split())[:_LONGEST]
    place = f", {os.path.basename(own[-1].filename)}:{own[-1].lineno}" if own else ""
    return f"{type(error).__name__}: {message}{place}"


def _is_of_a_library(path: str) -> bool:
    """Returns whether a source file is Python's, an installed library's, or this package's."""
    folders = (*map(sysconfig.get_path, ("stdlib", "purelib", "platlib")), os.path.dirname(physexp.__file__))
    return path.startswith(("<", *(os.path.join(folder, "") for folder in folders)))
