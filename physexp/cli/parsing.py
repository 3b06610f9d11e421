"""Runs the command that was typed. Heavy libraries are imported by the command that needs them: `--help` is quick."""

from collections.abc import Collection, Sequence
import dataclasses
import difflib
import itertools
import os
import sys
from typing import Annotated, Any, NoReturn, Union, get_type_hints

import tyro
from tyro import _errors as tyro_errors  # Its hook on what it refuses; not public as yet, so setup.cfg bounds tyro.

from physexp import __version__, extras
from physexp.analysis import domains
from physexp.analysis.training import config as config_lib
from physexp.analysis.training import stopping
from physexp.cli import options as options_lib
from physexp.cli import printing, train
from physexp.cli.commands import COMMANDS

_DESCRIPTION = "Environments in which an agent must experiment, and agents that learn to. --version prints the version."
_HELP = ("--help", "-h")


def main() -> None:
    """Runs a command; this is the entry point.

    An error of the user's is one line and exit status 2; Ctrl-C, SIGTERM and SIGHUP are 128 and the signal's number.
    """
    printing.prepare()
    try:
        try:
            _run(sys.argv[1:])
        finally:
            sys.stdout.flush()
    except KeyboardInterrupt as error:
        printing.warn("physexp: interrupted")
        sys.exit(stopping.exit_status(error))
    except BrokenPipeError:  # The reader of the output, `head` for one, has seen enough.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        sys.exit(1)


def _run(arguments: list[str]) -> None:
    if arguments == ["--version"]:
        printing.tell(f"physexp {__version__}")
        return
    try:
        with stopping.raised():
            parse(arguments).run()
    except BrokenPipeError:
        raise
    except (ValueError, OSError, extras.MissingExtraError) as error:
        printing.warn(f"physexp: {error}")
        sys.exit(2)
    except RuntimeError as error:
        printing.warn(f"physexp: {error}")
        sys.exit(1)


def parse(arguments: list[str]) -> Any:
    """Returns the command that the arguments describe, with the options of its domain and learner.

    Raises:
      SystemExit: after printing help, where that is asked for.
      ValueError: if they describe none; one line says what was given and what is allowed.
    """
    if "" in arguments:
        raise ValueError("an argument is empty, as an unset variable of the shell is; give a value or leave it out")
    arguments = [_with_home(argument) for argument in arguments]
    command = _Command(arguments)

    def refuse(event: tyro_errors.ParseErrorEvent) -> NoReturn:
        command.check_owner(event)
        words = ["physexp", command.name, "--help"] if command.name else ["physexp", "--help"]
        raise ValueError(f"{_problem(event, command)}; see {' '.join(words)}")

    with tyro_errors.on_parse_error(refuse):
        return tyro.cli(Union[command.kinds()], prog="physexp", description=_DESCRIPTION, args=command.arguments)  # type: ignore[call-overload] # noqa: UP007


def _with_home(argument: str) -> str:
    """Returns an argument with the home folder for a `~` at its beginning; shells leave that of `--option=~/path`."""
    option, equals, value = argument.partition("=") if argument.startswith("--") else ("", "", argument)
    return option + equals + os.path.expanduser(value)


class _Command:
    """The command that some arguments name, and what its options depend on: the domain, the task and the learner.

    Attributes:
      arguments: what was typed, with tasks as the command takes them.
      name: the command's; empty where none is named.
      domains: those whose options go with it.
      options: the dataclass of these options.
    """

    def __init__(self, arguments: list[str]):
        """Finds out what is named.

        Raises:
          ValueError: for a domain that is none.
        """
        self.name = arguments[0] if arguments[:1] and arguments[0] in COMMANDS else ""
        domains_of = getattr(COMMANDS.get(self.name), "domains_of", None)
        if domains_of is options_lib.of_domain:
            self.arguments = _with_tasks_apart(arguments, self._switches(), "task" in _options(COMMANDS[self.name]))
        else:
            self.arguments = _with_tasks_joined(arguments)
        places = _places_of_words(self.arguments, self._switches()) if domains_of else []
        self._words = [self.arguments[place] for place in places]
        self.domains: list[str] = domains_of(self._words) if domains_of else []
        self._options_of = getattr(COMMANDS.get(self.name), "options_of", options_lib.of_task)
        default = "the agent's" if domains_of is options_lib.of_agent else None
        try:
            self.options = options_lib.make(self.domains, default, self._options_of)
        except ValueError:
            if not set(arguments) & set(_HELP):
                raise
            self._words, self.domains, self.options = [], [], options_lib.NoOptions

    def kinds(self) -> tuple[Any, ...]:
        """Returns the types of all commands, for tyro; `train` has the defaults of its task and agent."""
        return tuple(self._kind(name) for name in COMMANDS)

    def _kind(self, name: str) -> Any:
        kind: Any = COMMANDS[name]
        options: Any = self.options if name == self.name else options_lib.NoOptions
        title = self.domains[0] if len(self.domains) == 1 else "domain"
        titled = Annotated[options, tyro.conf.arg(name=title)]
        if kind is train.Train:
            algorithm = self._algorithm()
            preset = config_lib.preset(*(self._words[:2] if name == self.name else ()), algorithm=algorithm)
            default = kind(domain=tyro.MISSING, task=tyro.MISSING, options=options(), config=preset, agent=algorithm)
            return Annotated[kind[type(preset), titled], tyro.conf.subcommand(name, default=default)]
        if hasattr(kind, "domains_of"):
            kind = kind[titled]
        return Annotated[kind, tyro.conf.subcommand(name)]

    def _algorithm(self) -> str:
        """Returns the learner that is named, or else the default."""
        named = self.value("--agent")
        return named if named in config_lib.ALGORITHMS else config_lib.DEFAULT_ALGORITHM

    def unknown_task(self, word: str) -> str:
        """Returns the fault in a word that stands in the place of a domain's task; empty if it stands elsewhere."""
        from physexp import suite

        domain = self.arguments[self.arguments.index(word) - 1]
        tasks = suite.TASKS_BY_DOMAIN.get(domain)
        return f"{domain} has no task {word!r}; choose from {', '.join(tasks)}" if tasks else ""

    def value(self, flag: str) -> str:
        """Returns the value of an option, the last one that was given."""
        parts = [
            part
            for argument in self.arguments
            for part in (argument.split("=", 1) if argument.startswith("--") else [argument])
        ]
        given = [value for name, value in itertools.pairwise(parts) if name.replace("_", "-") == flag]
        return given[-1] if given else "nothing"

    def check_owner(self, event: tyro_errors.ParseErrorEvent) -> None:
        """Names the learner or domain that an unknown option belongs to; that says more than that there is none."""
        if not isinstance(event, tyro_errors.UnrecognizedArgs):
            return
        for flag in _flags(event.tokens) if self.name == "train" else []:
            if learners := _learners_with(flag):
                raise ValueError(
                    f"--{flag} is not an option of --agent {self._algorithm()}; leave it out, or train "
                    f"{' or '.join(f'--agent {name}' for name in learners)}"
                )
        if len(self.domains) != 1:
            return
        from physexp import suite

        of_any = options_lib.offered(list(suite.TASKS_BY_DOMAIN), self._options_of)
        has_its_own = self._options_of is not options_lib.of_task
        owner = f"{self.name} {self.domains[0]}" if has_its_own else self.domains[0]
        for flag in _flags(event.tokens):
            if flag.replace("-", "_") in of_any:
                raise ValueError(f"--{flag} is not an option of {owner}; leave it out")

    def option_names(self) -> list[str]:
        """Returns the command's options as they are typed, without their dashes."""
        names = [*_options(COMMANDS[self.name]), *(field.name for field in dataclasses.fields(self.options))]
        if self.name == "train":
            names += [field.name for kind in config_lib.ALGORITHMS.values() for field in dataclasses.fields(kind)]
        return [name.replace("_", "-") for name in dict.fromkeys(names)]

    def _switches(self) -> set[str]:
        """Returns the options that have no value, as they are typed."""
        kinds: list[Any] = [COMMANDS[self.name], *config_lib.ALGORITHMS.values()]
        names = [
            field.name.replace("_", "-")
            for kind in kinds
            for field in dataclasses.fields(kind)
            if isinstance(field.default, bool)
        ]
        names += options_lib.SWITCHES
        return {*_HELP, *(f"--{prefix}{name}" for name in names for prefix in ("", "no-"))}


def _with_tasks_apart(arguments: list[str], switches: Collection[str], task_is_option: bool) -> list[str]:
    """Returns the arguments of a command that takes DOMAIN TASK, or DOMAIN --task TASK, with DOMAIN/TASK apart."""
    places = _places_of_words(arguments, switches)
    if not places:
        return arguments
    domain, slash, task = arguments[places[0]].partition("/")
    if slash and domain in domains.DOMAINS:
        arguments = [*arguments[: places[0]], domain, task, *arguments[places[0] + 1 :]]
        places = _places_of_words(arguments, switches)
    if task_is_option and len(places) > 1:
        arguments = [*arguments[: places[1]], "--task", *arguments[places[1] :]]
    return arguments


def _with_tasks_joined(arguments: list[str]) -> list[str]:
    """Returns the arguments of a command that takes DOMAIN/TASK, with DOMAIN TASK joined."""
    found: list[str] = []
    for argument in arguments:
        if found and found[-1] in domains.DOMAINS:
            from physexp import suite

            if argument in suite.TASKS_BY_DOMAIN[found[-1]]:
                found[-1] += f"/{argument}"
                continue
        found.append(argument)
    return found


def _places_of_words(arguments: Sequence[str], switches: Collection[str]) -> list[int]:
    """Returns the indices of the arguments that are neither the command, nor options, nor their values, nor numbers."""
    found = []
    for place, (before, argument) in enumerate(itertools.pairwise(arguments), start=1):
        is_value = before.startswith("--") and "=" not in before and before.replace("_", "-") not in switches
        if not (argument.startswith("-") or is_value or _is_number(argument)):
            found.append(place)
    return found


def _is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True


def _is_positional(kind: Any) -> bool:
    """Returns whether arguments of a type are typed without a name."""
    return tyro.conf.Positional in getattr(kind, "__metadata__", ())


def _options(kind: type) -> list[str]:
    """Returns the fields of a command that are typed with a name."""
    kinds = get_type_hints(kind, include_extras=True)
    return [field.name for field in dataclasses.fields(kind) if not _is_positional(kinds[field.name])]


def _flags(tokens: Sequence[str]) -> list[str]:
    """Returns the options among some arguments, without their dashes and values."""
    return [token.strip("-").partition("=")[0].replace("_", "-") for token in tokens if token.startswith("-")]


def _learners_with(flag: str) -> list[str]:
    """Returns the names of the learners that have an option, which is given without its dashes."""
    name = flag.removeprefix("no-").replace("-", "_")
    return [
        learner
        for learner, kind in config_lib.ALGORITHMS.items()
        if name in (field.name for field in dataclasses.fields(kind))
    ]


def _problem(event: tyro_errors.ParseErrorEvent, command: _Command) -> str:
    """Returns the fault in the arguments of a command, and the arguments that are allowed."""
    match event:
        case tyro_errors.UnrecognizedArgs(tokens=tokens) if not command.name:
            return f"{tokens[0]!r} is no command; choose from {', '.join(COMMANDS)}"
        case tyro_errors.UnrecognizedArgs(tokens=tokens):
            given = [token for token in tokens if token.startswith("-")]
            if not given:
                return command.unknown_task(tokens[0]) or f"{command.name} does not take {tokens[0]!r}"
            close = difflib.get_close_matches(_flags(given)[0], command.option_names(), n=2)
            perhaps = f"; perhaps {' or '.join(f'--{name}' for name in close)}" if close else ""
            return f"{given[0]} is not an option of {command.name}{perhaps}"
        case tyro_errors.MissingSubcommand():
            return f"give a command: {', '.join(COMMANDS)}"
        case tyro_errors.MissingArgs(missing_arguments=missing):
            return f"{command.name} needs {' '.join(_name(found.arg) for found in missing)}"
        case tyro_errors.InvalidChoice(argument=argument, value=value, choices=choices):
            return f"{_name(argument)} is {value!r}; choose from {', '.join(choices)}"
        case tyro_errors.BadValue(argument=argument):
            return f"{_name(argument)} needs a value: {argument.lowered.metavar}"
        case tyro_errors.InstantiationFailure(argument=argument, message=message):
            if argument is None:
                return message
            return f"{_name(argument)} is {command.value(_name(argument))!r}; give {argument.lowered.metavar}"
        case _:
            return f"these arguments do not go together ({type(event).__name__})"


def _name(argument) -> str:
    """Returns an argument as it is typed, or as help calls it where it has no name."""
    return argument.lowered.metavar if argument.is_positional() else argument.display_name()
