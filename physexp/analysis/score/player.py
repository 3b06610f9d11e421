"""Plays a user's agent in a process of its own: it gets all that an agent may observe, and nothing else.

The process may hang or die: a line names the episode and the step.
"""

import contextlib
import json
import os
import signal
from typing import Any

import dm_env

from physexp.agents import core, processes
from physexp.analysis.score import protocol, user_agent

_START_SECONDS = 300.0  # To import the user's modules and make an actor, beside the limit of a call.
_LEAVE_SECONDS = 10.0  # For the system to report the exit code of a process.


class PlayerError(ValueError):
    """A user's agent has failed: it raised, hung, ended its process, or returned no action."""


class Player:
    """The process of a user's agent."""

    def __init__(self, name: str, timeout: float):
        """Starts the process; takes the function, `module:function`, and the limit of each call, s."""
        self.name, self._timeout = name, timeout
        self._question: protocol.Question | None = None  # Of the actor in the process.
        context = processes.spawning()
        self._connection, theirs = context.Pipe()
        self._process = context.Process(target=user_agent.serve, args=(theirs, name), name=f"actor {name}")
        with processes.without_script(), processes.inherited_by_workers():
            self._process.start()
        theirs.close()

    def close(self) -> None:
        """Ends the process, and all that it has started."""
        assert self._process.pid is not None
        with contextlib.suppress(ProcessLookupError):  # It makes its group when it begins.
            os.killpg(self._process.pid, signal.SIGKILL)
        processes.kill(self._process)
        self._connection.close()

    def actor(self, question: protocol.Question, index: int) -> core.Actor:
        """Returns an actor for the episode of an index in a task; the agent keeps one for all episodes of a task."""
        if question is not self._question:
            self.call(f"({question.name}, before the first episode)", question, _START_SECONDS)
            self._question = question
        return _Actor(self, question, index)

    def call(self, place: str, message: Any, longer: float = 0.0) -> dict[str, Any]:
        """Sends a message and returns the answer; raises PlayerError, with the place, if the agent fails."""
        timeout = self._timeout + longer
        try:
            self._connection.send(message)
            if not self._connection.poll(timeout):
                raise PlayerError(
                    f"{self.name} did nothing within {timeout:g} s {place}; mend it, or give a longer --timeout"
                )
            answer: dict[str, Any] = json.loads(self._connection.recv_bytes())
        except (EOFError, OSError):
            self._process.join(_LEAVE_SECONDS)
            raise PlayerError(
                f"{self.name} ended its process, exit code {self._process.exitcode} {place}; mend it"
            ) from None
        if "error" in answer:
            raise PlayerError(f"{self.name} failed: {answer['error']} {place}")
        return answer


class _Actor(core.Actor):
    """The actor of a player's process in one episode; each time step is sent to it once."""

    def __init__(self, player: Player, question: protocol.Question, index: int):
        self._player, self._question, self._index = player, question, index
        self._message: tuple[int | None, dm_env.TimeStep]

    def observe_first(self, timestep):
        self._step, self._message = 0, (None, timestep)

    def select_action(self, observation):
        place = f"({self._question.name}, episode {self._index}, step {self._step})"
        action = self._player.call(place, self._message).get("action")
        if not isinstance(action, int) or not 0 <= action < self._question.num_actions:
            raise PlayerError(
                f"{self._player.name} chose {action}, which is no action {place}; return an integer from 0 to "
                f"{self._question.num_actions - 1}"
            )
        return action

    def observe(self, action: int, next_timestep: dm_env.TimeStep) -> None:
        self._step, self._message = self._step + 1, (action, next_timestep)
        if next_timestep.last():
            self._player.call(f"({self._question.name}, episode {self._index}, the end)", self._message)
