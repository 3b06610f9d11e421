"""An actor in a process of its own, which gets what an agent may observe, and nothing else.

What it answers is JSON, so that nothing of the actor's runs in this process.
"""

from collections.abc import Iterator
import json
import multiprocessing
import os
import sys
import sysconfig
import traceback
from typing import Any

import dm_env
import numpy as np

import physexp
from physexp.agents import processes
from physexp.analysis.score import episodes, protocol, targets

_START_SECONDS = 300.0  # For a process to import what it needs and to make an actor, beside the limit of a call.
_LEAVE_SECONDS = 10.0  # For the system to tell how a process has ended.
_MOST_BYTES = 2**16  # Of what a process answers.
_LONGEST = 200  # Characters of a text in it.


class PlayerError(ValueError):
    """An actor has failed: it raised, did nothing in time, ended its process, or returned no action."""


class Player:
    """An actor in a process of its own; a context that leaves no process behind."""

    def __init__(self, target: str, greedy: bool, timeout: float):
        """Starts the process.

        Args:
          target, greedy: as for `targets.maker`.
          timeout: for each call of the actor, s.
        """
        self._target, self._timeout = target, timeout
        context = multiprocessing.get_context("spawn")
        self._ours, theirs = context.Pipe()
        self._process = context.Process(target=_serve, args=(theirs, target, greedy), name=f"actor {target}")
        with processes.inherited_by_workers():
            self._process.start()
        theirs.close()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        processes.kill(self._process)
        self._ours.close()

    def play(
        self, asked: protocol.Question, num_episodes: int, seed: int = protocol.SEED
    ) -> Iterator[episodes.Episode]:
        """Makes an actor for a task, and plays the first episodes of a seed; yields each when it is over.

        Raises:
          PlayerError: if the actor fails.
        """
        self._call(f"{asked.name}, before the first episode", ("task", asked), self._timeout + _START_SECONDS)
        environment = protocol.load(asked, seed)
        for number in range(num_episodes):
            place = f"{asked.name}, episode {number}"

            def act(step: int, timestep: dm_env.TimeStep, place: str = place) -> int:
                return self._act(asked, f"{place}, step {step}", timestep)

            played = episodes.play(environment, act, number)
            self._call(f"{place}, the end", ("step", played.timesteps[-1]), self._timeout)
            yield played
        environment.close()

    def _act(self, asked: protocol.Question, where: str, timestep: dm_env.TimeStep) -> int:
        action = self._call(where, ("step", timestep), self._timeout).get("action")
        if not isinstance(action, int) or not 0 <= action < asked.num_actions:
            raise PlayerError(
                f"{self._target} chose {action}, which is no action ({where}); return an integer from 0 to "
                f"{asked.num_actions - 1}"
            )
        return action

    def _call(self, where: str, message: tuple[str, Any], timeout: float) -> dict[str, Any]:
        try:
            self._ours.send(message)
            if not self._ours.poll(timeout):
                raise PlayerError(
                    f"{self._target} did nothing within {timeout:g} s ({where}); mend it, or give a longer --timeout"
                )
            said = json.loads(self._ours.recv_bytes(_MOST_BYTES))
        except (EOFError, OSError):
            self._process.join(_LEAVE_SECONDS)
            raise PlayerError(
                f"{self._target} ended its process, exit code {self._process.exitcode} ({where}); mend it"
            ) from None
        if "error" in said:
            raise PlayerError(f"{self._target} failed: {said['error']} ({where})")
        return said


def _serve(connection, target: str, greedy: bool) -> None:
    """The actor's process: answers until it is killed."""
    processes.begin()
    os.dup2(2, 1)  # What an actor prints is no part of what this program prints.
    sys.stdout.reconfigure(line_buffering=True)  # type: ignore[union-attr]
    make: targets.MakeActor | None = None
    actor: Any = None
    action: int | None = None
    while True:
        kind, content = connection.recv()
        said: dict[str, Any] = {}
        try:
            if kind == "task":
                make = make or targets.maker(target, greedy)
                actor = make(content)
            else:
                episodes.show(actor, None if content.first() else action, content)
                if not content.last():
                    action = said["action"] = _plain(actor.select_action(content.observation))
        except Exception as error:  # Whatever it is, the other side tells it, and ends.
            said = {"error": _described(error)}
        connection.send_bytes(json.dumps(said).encode())


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
