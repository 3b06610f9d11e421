"""The process of a user's function: makes the actor, shows it time steps, and answers with its actions.

It answers in JSON, so that nothing of the actor's runs in the process that scores it.
"""

import importlib
import inspect
import json
import multiprocessing
from multiprocessing import connection
import os
from pathlib import Path
import signal
import sys
import sysconfig
import threading
import traceback
from typing import Any

import numpy as np

import physexp
from physexp.agents import core, processes
from physexp.analysis.score import actors, protocol

_LONGEST = 200  # Characters of a text in an answer.
_METHODS = ("select_action", "observe_first", "observe", "update")

_is_here = False  # Whether this process is the one of a user's function.


class TargetError(ValueError):
    """A function cannot play; the line says what is allowed."""


def refuse_here() -> None:
    """Raises TargetError in the process of a user's function, where an import would play episodes again."""
    if _is_here:
        raise TargetError(
            'the module plays episodes when it is imported; put its own calls below `if __name__ == "__main__":`'
        )


def make_actor(name: str, question: protocol.Question) -> core.Actor:
    """Returns an actor for a task from a user's function, `module:function`; raises TargetError if it makes none."""
    module, _, attribute = name.partition(":")
    if (here := str(Path.cwd())) not in sys.path:
        sys.path.insert(0, here)
    try:
        function = getattr(importlib.import_module(module), attribute)
    except ModuleNotFoundError as error:
        raise TargetError(f"{error}; start where it is, or install it") from None
    except AttributeError:
        raise TargetError(f"{module} has no {attribute}; name a function that it has") from None
    count = _num_parameters(function)
    if count == 1:
        made = function(question)
        if all(callable(getattr(made, method, None)) for method in _METHODS):
            return made
        if callable(made):
            return actors.Policy(made)
        raise TargetError(
            f"it returned {type(made).__name__}; return an actor, with {', '.join(_METHODS)}, or a policy, a function "
            "of an observation and a state"
        )
    if count == 2:
        return actors.Policy(function)
    what = f"has {count} parameters without a default" if callable(function) else "is no function"
    raise TargetError(
        f"{attribute} {what}; give a function of a question, which returns an actor or a policy, or a policy, a "
        "function of an observation and a state"
    )


def serve(messages: connection.Connection, name: str) -> None:
    """Answers messages until the process is killed, with actors of `module:function`."""
    global _is_here
    _is_here = True
    os.setsid()  # The stop signals of the scoring program's group do not reach it, and its own group ends as one.
    signal.pthread_sigmask(signal.SIG_UNBLOCK, processes.STOP_SIGNALS)  # Programs that the actor starts inherit it.
    threading.Thread(target=_end_with_parent, daemon=True).start()
    os.dup2(2, 1)  # Prints of the actor are no output of the scoring program.
    sys.stdout.reconfigure(line_buffering=True)  # type: ignore[union-attr]
    actor: Any = None
    while True:
        answer: dict[str, Any] = {}
        try:
            match messages.recv():
                case protocol.Question() as question:
                    actor = make_actor(name, question)
                case None, timestep:
                    actor.observe_first(timestep)
                    answer["action"] = _plain(actor.select_action(timestep.observation))
                case action, timestep:
                    actor.observe(action, timestep)
                    actor.update()
                    if not timestep.last():
                        answer["action"] = _plain(actor.select_action(timestep.observation))
        except Exception as error:  # The scoring program reports it.
            answer = {"error": _described(error)}
        messages.send_bytes(json.dumps(answer).encode())


def _num_parameters(function: Any) -> int:
    """Returns the number of arguments that a function must be given; 0 for anything else."""
    if not callable(function):
        return 0
    parameters = inspect.signature(function).parameters.values()
    optional = (inspect.Parameter.VAR_POSITIONAL, inspect.Parameter.VAR_KEYWORD)
    return sum(one.default is one.empty and one.kind not in optional for one in parameters)


def _end_with_parent() -> None:
    """Ends this process and all that it has started when its parent ends."""
    parent = multiprocessing.parent_process()
    assert parent is not None
    parent.join()
    os.killpg(os.getpid(), signal.SIGKILL)


def _plain(action: Any) -> Any:
    """Returns an integer for an action that is one, and a text that shows any other."""
    array = np.asarray(action)
    is_integer = array.size == 1 and array.dtype.kind in "iu"
    return array.item() if is_integer else " ".join(repr(action).split())[:_LONGEST]


def _described(error: Exception) -> str:
    """Returns an error in one line, with the last place in the user's code."""
    if isinstance(error, TargetError):
        return str(error)
    frames = traceback.extract_tb(error.__traceback__)
    own = [frame for frame in frames if not _is_of_a_library(frame.filename)]
    message = " ".join(str(error).split())[:_LONGEST]
    place = f", {Path(own[-1].filename).name}:{own[-1].lineno}" if own else ""
    return f"{type(error).__name__}: {message}{place}"


def _is_of_a_library(path: str) -> bool:
    """Returns whether a source file is Python's, an installed library's, or this package's."""
    libraries = [sysconfig.get_path(name) for name in ("stdlib", "purelib", "platlib")]
    folders = [*libraries, str(Path(physexp.__file__).parent)]
    return path.startswith("<") or any(Path(path).is_relative_to(folder) for folder in folders)
