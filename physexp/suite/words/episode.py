"""The episode, whose methods are tools."""

from collections.abc import Callable, Mapping, Sequence
import contextlib
import functools
import inspect
import io
import json
import math
import re
import time
from typing import Any, Concatenate, ParamSpec

from PIL import Image

from physexp import checks, suite
from physexp.suite.words import telling

TOOLS = ("rules", "observe", "experiment", "answer", "believe", "note")
"""The names of the tools."""

LEAST_BELIEF = 1e-6
"""The probability that a smaller one counts as in the log score."""

_LONGEST = 10_000  # Characters of a text that is kept.
_ROUNDING = 0.01  # By which the sum of stated probabilities may differ from 1.
_CALL = re.compile(rf"^[^\w\n]*({'|'.join(TOOLS)})\((?:\w+ *=)?(.*)\)[^\w\n]*$", re.MULTILINE)
_Parameters = ParamSpec("_Parameters")


class Refusal(ValueError):
    """A call that has done nothing; the message says in one sentence what is allowed."""


def _tool(
    method: Callable[Concatenate["Episode", _Parameters], str],
) -> Callable[Concatenate["Episode", _Parameters], str]:
    """Returns a tool of an episode: a method whose calls are kept, and refused once the episode is over."""

    @functools.wraps(method)
    def called(self: "Episode", /, *args: _Parameters.args, **kwargs: _Parameters.kwargs) -> str:
        return self._noted(method.__name__, args, kwargs)

    return called


class Episode:
    """An episode of a task, played in words.

    A call that is refused raises `Refusal`, costs no step, and is counted.

    Attributes:
      environment: the environment that it is played in.
      seed, index: seed of the environment and index of the episode: they rebuild its instance. No tool tells them.
      actions: the actions so far.
      times: ms from the beginning of the episode to each of them.
      beliefs: the belief that was stated before each of them, the probabilities of all answers; None where none was.
      log_scores: for each answer, the base-2 logarithm of the probability that the last belief about its question gave
        to the right one; None where no belief was stated.
      num_refused: number of calls that were refused.
      events: all that was said and done, in order. The first event has `begun`, the arguments that start the episode
        again. Another has a `call` with its `arguments`, and the `reply` or the reason why it was `refused`; or a text
        that was `said`, and the `reply`; or the reason why the player was `stopped`. Each has its `time`, s since 1970,
        the `actions` that were taken, if any, and the record of the episode if it has `ended`.
    """

    def __init__(
        self,
        environment: suite.Environment,
        index: int | None = None,
        level: str = "named",
        digits: int | None = None,
        events: Sequence[Mapping[str, Any]] = (),
        keep: Callable[[Mapping[str, Any]], None] = lambda event: None,
        secret: Mapping[str, Any] | None = None,
    ):
        """Starts an episode in an environment of the suite; another episode that it plays is over.

        Args:
          environment: as `suite.load` returns it, without `flat_observation`.
          index: index of the episode; by default the next one of the environment.
          level: one of `LEVELS`.
          digits: decimals of the numbers that are told; None for the shortest form that has every bit of a float32.
          events: those of the same episode, broken off, which goes on after them.
          keep: called with each new event.
          secret: the entry of events and records in the place of a seed that is to stay secret.

        Raises:
          ValueError: for a value that is not allowed, or events that are not those of this episode.
        """
        self.environment, self._task = environment, environment.task
        self._teller = telling.Teller(self._task, level, digits)
        if index is not None:
            self._task.next_episode = index
        self._timestep = environment.reset()
        self.seed, self.index = int(self._task.options.random), self._task.episode
        self.actions: list[int] = []
        self.times: list[int] = []
        self.beliefs: list[list[float] | None] = []
        self.log_scores: list[float | None] = []
        self.num_refused = 0
        self.events: list[dict[str, Any]] = []
        self._belief: list[float] | None = None  # About the question that is asked now.
        self._stated: list[float] | None = None  # Since the last action.
        self._first = self._teller.told(self._timestep.observation)
        self._instance = {"seed": self.seed} if secret is None else dict(secret)
        begun = {**self._instance, "index": self.index, "level": level, "digits": digits}
        self._clock: Callable[[], float] = time.time
        self._keep: Callable[[Mapping[str, Any]], None] = lambda event: None
        self._repeat(events, begun)
        self._keep = keep
        if not events:
            self._note(begun=begun)

    @property
    def tools(self) -> list[Callable[..., str]]:
        """The tools: methods with type hints and docstrings, from which frameworks make descriptions for a model."""
        return [getattr(self, name) for name in TOOLS]

    @property
    def is_over(self) -> bool:
        """Whether the episode has ended, or its environment plays another one."""
        return self._timestep.last() or (self.seed, self.index) != (self._task.options.random, self._task.episode)

    @property
    def image(self) -> bytes | None:
        """The image that is observed now, as PNG; None in tasks with features."""
        if "pixels" not in self._timestep.observation:
            return None
        file = io.BytesIO()
        Image.fromarray(self._timestep.observation["pixels"]).save(file, "png")
        return file.getvalue()

    # The tools. Their docstrings are for models.

    @_tool
    def rules(self) -> str:
        """Tells the question, the experiments and the answers with their numbers, the readings, and the price."""
        return self._teller.rules()

    @_tool
    def observe(self) -> str:
        """Tells the readings now, the number of actions so far, and the worth of an answer. It costs nothing."""
        return self._teller.told(self._timestep.observation)

    @_tool
    def experiment(self, number: int) -> str:
        """Does an experiment, and tells the readings after it.

        Args:
            number: The number of the experiment, as the rules list them.
        """
        return self._act(_checked(number, self._task.num_interactions))

    @_tool
    def answer(self, number: int) -> str:
        """Answers the question. The last answer ends the episode.

        Args:
            number: The number of the answer, as the rules list them.
        """
        return self._act(self._task.num_interactions + _checked(number, self._task.num_labels))

    @_tool
    def believe(self, probabilities: list[float]) -> str:
        """States how likely each answer is. It costs nothing. The last belief before an answer is scored.

        The score is the base-2 logarithm of the probability of the right answer: 0 is the best, and honest numbers earn
        most.

        Args:
            probabilities: The probability of each answer, in the order of the rules; their sum is 1.
        """
        self._belief = self._stated = distribution(probabilities, self._task.num_labels)
        return "Kept."

    @_tool
    def note(self, text: str) -> str:
        """Keeps a thought or a plan in the transcript. It costs nothing.

        Args:
            text: The note.
        """
        if not isinstance(text, str) or len(text) > _LONGEST:
            raise Refusal(f"text is {checks.shown(text)}; give a text of at most {_LONGEST:,} characters")
        return "Kept."

    # For programs that lead a model through an episode.

    def call(self, name: Any, arguments: Any) -> str:
        """Calls a tool by its name, with arguments by their names, as models give them; raises `Refusal`."""
        return self._noted(name, (), arguments)

    def say(self, text: str) -> str:
        """Makes the calls in a reply of a model, such as `experiment(2)` in a line of its own; returns the replies.

        The reason why one is refused is among them, and the calls after it are not made.
        """
        text, told = text[:_LONGEST], []
        try:
            for name, given in _CALL.findall(text) or [("", "")]:
                told.append(self._do(name, _values(given), {})[1])
        except Refusal as refusal:
            told.append(f"Refused: {refusal}.")
        self._note(said=text, reply="\n".join(told))
        return "\n".join(told)

    def messages(self) -> list[dict[str, str]]:
        """Returns the conversation so far as models take it: messages, each with its `role` and its `content`."""
        found = [("system", self._teller.rules()), ("user", self._first)]
        for event in self.events:
            if "call" in event:
                arguments = event["arguments"]
                given = arguments if "refused" in event else ", ".join(map(json.dumps, arguments.values()))
                found.append(("assistant", f"{event['call']}({given})"))
                found.append(("user", event["reply"] if "reply" in event else f"Refused: {event['refused']}."))
            elif "said" in event:
                found += [("assistant", event["said"]), ("user", event["reply"])]
        return [{"role": role, "content": content} for role, content in found]

    def stop(self, reason: str) -> None:
        """Takes off a player that does not answer: time runs out with the first experiment, as in silence."""
        while not self.is_over:
            self._act(0)
        self._note(stopped=reason)

    def record(self) -> dict[str, Any]:
        """Returns the facts that rebuild the episode so far, and its results.

        They are `seed`, or the entry in its place, `episode`, its index, `actions`, `times` and `beliefs`; `level` and
        `digits`; the number of calls that were `refused`, and the discounted `return`.
        """
        return {
            **self._instance,
            "episode": self.index,
            "actions": self.actions.copy(),
            "times": self.times.copy(),
            "beliefs": self.beliefs.copy(),
            **{name: self.events[0]["begun"][name] for name in ("level", "digits")},
            "refused": self.num_refused,
            "return": float(self._task.ledger.returns[0]),
        }

    def _noted(self, name: Any, args: tuple[Any, ...], kwargs: Any) -> str:
        """Calls a tool, and keeps the call."""
        try:
            arguments, reply = self._do(name, args, kwargs)
        except Refusal as refusal:
            known = name if name in TOOLS else checks.shown(name)
            self._note(call=known, arguments=checks.shown(kwargs or args), refused=str(refusal))
            raise
        self._note(call=name, arguments=arguments, reply=reply)
        return reply

    def _do(self, name: Any, args: Sequence[Any], kwargs: Any) -> tuple[dict[str, Any], str]:
        """Calls a tool; returns its arguments by name and its reply."""
        try:
            if not isinstance(name, str) or name not in TOOLS:
                raise Refusal(_unknown(name))
            method = getattr(Episode, name).__wrapped__
            try:
                bound = inspect.signature(method).bind(self, *args, **kwargs).arguments
            except TypeError:
                needed = ", ".join(list(inspect.signature(method).parameters)[1:]) or "none"
                given = checks.shown(kwargs or args)
                raise Refusal(f"{name} was given {given}; its arguments are: {needed}") from None
            if self.is_over:
                raise Refusal("the episode is over; begin another")
            reply: str = method(**bound)
        except Refusal:
            self.num_refused += 1
            raise
        return {key: value for key, value in bound.items() if key != "self"}, reply

    def _note(self, **event: Any) -> None:
        """Adds an event, with the actions that were taken since the one before."""
        moment, taken = self._clock(), self.actions[len(self.times) :]
        self.events.append({"time": moment, **event})
        if taken:
            self.times += [round(1000 * (moment - self.events[0]["time"]))] * len(taken)
            self.events[-1] |= {"actions": taken, **({"ended": self.record()} if self._timestep.last() else {})}
        self._keep(self.events[-1])

    def _repeat(self, events: Sequence[Mapping[str, Any]], begun: Mapping[str, Any]) -> None:
        for event in events:
            self._clock = functools.partial(dict.__getitem__, dict(event), "time")
            match event:
                case {"stopped": reason}:
                    self.stop(reason)
                case {"said": text}:
                    self.say(text)
                case {"call": name, "arguments": arguments, "reply": _}:
                    with contextlib.suppress(Refusal):
                        self.call(name, arguments)
                case _:
                    self.num_refused += "refused" in event
                    self._note(**{name: value for name, value in event.items() if name != "time"})
            expected = event if self.events[1:] else {"time": event["time"], "begun": begun}
            if self.events[-1] != expected:
                raise ValueError(
                    f"this is not the episode whose {len(events)} events are given; another version played"
                )
        self._clock = time.time

    def _act(self, action: int) -> str:
        """Takes an action; returns what it has shown."""
        ledger, label = self._task.ledger, action - self._task.num_interactions
        self._timestep = self.environment.step(action)
        self.actions.append(action)
        self.beliefs.append(self._stated)
        self._stated = None
        if label < 0 and not self._timestep.last():
            return self._teller.told(self._timestep.observation)
        right, verdict = int(ledger.correct_answers[0]), "Time is over."
        if label >= 0:
            right = int(ledger.answers[0, ledger.num_answered[0] - 1])
            verdict = "Right." if label == right else "Wrong."
            self.log_scores.append(None if self._belief is None else math.log2(max(self._belief[right], LEAST_BELIEF)))
            self._belief = None
        if not self._timestep.last():
            return f"{verdict} The next question follows.\n{self._teller.told(self._timestep.observation)}"
        scored = [f"{score:.3f}" for score in self.log_scores if score is not None]
        believed = f" The log score of your belief is {', '.join(scored)} bits." if scored else ""
        earned = f"You have earned {ledger.returns[0]:.4f}, and the episode is over."
        return f"{verdict} The right answer is {self._teller.label(right)}. {earned}{believed}"


def distribution(probabilities: Any, count: int) -> list[float]:
    """Returns a stated belief as floats whose sum, rounded when stated, is 1; raises `Refusal` for what is none."""
    is_list = isinstance(probabilities, (list, tuple)) and len(probabilities) == count
    if not is_list or not all(checks.is_number(one) and one >= 0 for one in probabilities):
        raise Refusal(f"probabilities is {checks.shown(probabilities)}; give a list of {count} numbers from 0 to 1")
    if not abs((total := sum(map(float, probabilities))) - 1) <= _ROUNDING:
        raise Refusal(f"the sum of the probabilities is {total:g}; give numbers whose sum is 1")
    return [probability / total for probability in probabilities]


def _checked(number: Any, count: int) -> int:
    if checks.is_integer(number) and 0 <= number < count:
        return int(number)
    raise Refusal(f"number is {checks.shown(number)}; give an integer from 0 to {count - 1}")


def _unknown(name: Any) -> str:
    """Returns why a call of no tool is refused."""
    if name == "":
        return "there is no call; write one in a line of its own, as in experiment(0)"
    return f"there is no tool {checks.shown(name)}; call {', '.join(TOOLS)}"


def _values(given: str) -> list[Any]:
    """Returns the arguments in the text of a call."""
    try:
        values: list[Any] = json.loads(f"[{given}]")
    except (ValueError, RecursionError):
        return [given]
    return values
