"""Trained agents that come with the package: weights in half precision, and a card with their provenance."""

from collections.abc import Mapping, Sequence
import contextlib
import dataclasses
import hashlib
import json
import os
from pathlib import Path
from typing import Any

from dm_env import specs
import numpy as np
import torch

from physexp import checks
from physexp.agents import acting, checkpointing, config, files, guests, networks, registry

FOLDER = Path(__file__).with_name("pretrained_agents")
"""The best agent of each task; those of other learners are in a folder of the learner's name."""
_KINDS = {kind.__name__: kind for kind in registry.NETWORKS.values()}
_WAITING = ".next.safetensors"  # Weights of a card that is about to be written, or has just been.


class _MissingError(ValueError):
    """There is no such agent."""


@dataclasses.dataclass(frozen=True)
class Pretrained:
    """A trained agent.

    Attributes:
      network: its network.
      card: its provenance: domain, task, the options that the task had (`task_kwargs`), command, commit, seed,
        frames, time, evaluation, the network's hyperparameters and the specs it was made for.
    """

    network: networks.RecurrentNetwork
    card: dict[str, Any]

    def actor(self, seed: int = 0, greedy: bool = False) -> acting.RecurrentActor:
        """Returns an actor with this network; `seed` determines its actions, `greedy` takes the likeliest ones."""
        return acting.RecurrentActor(self.network, seed, greedy)


def name(domain: str, task: str, options: Mapping[str, Any]) -> str:
    """Returns the name of an agent's files: domain, task, and each option that was chosen for the task."""
    chosen = sorted((option, value) for option, value in options.items() if value is not None)
    return "-".join([domain, task, *(f"{option}{config.shown(value)}" for option, value in chosen)])


def names(folder: Path = FOLDER) -> list[str]:
    """Returns the names of the agents in a folder and in the folders of learners in it, as `a3c/towers-fist_pixels`."""
    cards = [*folder.glob("*.json"), *folder.glob("*/*.json")]
    return sorted(card.relative_to(folder).with_suffix("").as_posix() for card in cards)


def load(
    domain: str, task: str, *values: Any, agent: str | None = None, folder: str | Path = FOLDER, **options: Any
) -> Pretrained:
    """Loads a trained agent.

    Args:
      domain, task: what it plays.
      values: of the options that the task had in training, in the order of the agents' names.
      agent: the learner that trained it, as `a3c`; None for the best agent.
      folder: where the agents are.
      options: the same as `values` by name. By default those of the agent whose card says that it is the task's
        default.

    Raises:
      OSError: if its files cannot be read.
      ValueError: where there is no such agent, and it lists those that there are; or if its files are damaged.
    """
    folder = Path(folder).expanduser()
    for what, value in (("domain", domain), ("task", task), ("agent", agent)):
        if not isinstance(value, str) and (what, value) != ("agent", None):
            raise ValueError(f"{what} is {value!r}; give a name")
    if agent is not None:
        return _load_of(agent, domain, task, values, folder, options)
    positions = options_of(domain, task, folder) if values else []
    given = dict(zip(positions, values, strict=False))
    if twice := sorted({*given} & {*options}):
        raise ValueError(f"{twice[0]} is given twice, {given[twice[0]]!r} and {options[twice[0]]!r}; give it once")
    given |= options
    if len(values) > len(positions) and any(value is not None for value in values[len(positions) :]):
        raise _MissingError(
            f"no trained agent of {domain}/{task} has options {', '.join(map(repr, values))}; there are: "
            f"{', '.join(names(folder)) or 'none'}"
        )
    wanted = name(domain, task, given)
    if wanted == name(domain, task, {}) and wanted not in names(folder):
        wanted = _default(domain, task, folder) or wanted
    return load_named(wanted, folder)


def _load_of(
    learner: str, domain: str, task: str, values: Sequence[Any], folder: Path, options: Mapping[str, Any]
) -> Pretrained:
    """Loads the agent of a learner: from the learner's folder, or the best one, if that is the learner's."""
    for each in (folder / learner, folder):
        with contextlib.suppress(_MissingError):
            found = load(domain, task, *values, folder=each, **options)
            if found.card["agent"]["algorithm"] == learner:
                return found
    raise _MissingError(
        f"no trained agent of {domain}/{task} with these options is {learner}'s; there are: "
        f"{', '.join(names(folder)) or 'none'}"
    )


def options_of(domain: str, task: str, folder: Path = FOLDER) -> list[str]:
    """Returns the names of the options that tell the agents of a task apart, in the order of the agents' names."""
    return sorted({option for card in _with_options(domain, task, folder).values() for option in card["task_kwargs"]})


def _with_options(domain: str, task: str, folder: Path) -> dict[str, dict[str, Any]]:
    """Returns the cards, by name, of the agents of a task for which options were chosen; raises as `load`."""
    prefix = f"{name(domain, task, {})}-"
    return {stem: card_named(stem, folder) for stem in names(folder) if stem.startswith(prefix)}


def _default(domain: str, task: str, folder: Path) -> str | None:
    """Returns the agent to take where no option is given: the only one, or the one whose card says so."""
    cards = _with_options(domain, task, folder)
    return next((stem for stem, card in cards.items() if len(cards) == 1 or card.get("default") is True), None)


def card_named(stem: str, folder: Path = FOLDER) -> dict[str, Any]:
    """Reads the card of the agent whose files have this name, not its network; raises as `load`."""
    return _read_card(_path(stem, folder))


def load_named(stem: str, folder: Path = FOLDER) -> Pretrained:
    """Loads the trained agent whose files have this name; raises as `load`."""
    path = _path(stem, folder)
    card = _read_card(path)
    with _explained(path), torch.device("meta"):  # Nothing is made that its weights do not fit.
        like = _network(card["network"]).state_dict()
    try:
        weights = _read_weights(path, card, like)
    except ValueError:
        if files.read_json(path) == card:
            raise
        return load_named(stem, folder)  # Another has just been written.
    network = _network(card["network"])
    network.load_state_dict(weights)
    return Pretrained(network.eval(), card)


def _path(stem: str, folder: Path) -> Path:
    """Returns the path of a card."""
    if stem not in names(folder):
        raise _MissingError(f"no trained agent is named {stem}; there are: {', '.join(names(folder)) or 'none'}")
    path = folder / f"{stem}.json"
    return path.resolve() if folder.is_relative_to(FOLDER) else path  # Some installers put links in place of files.


@contextlib.contextmanager
def _explained(path: Path):
    """Returns a context in which it is told in one line that a card is not what was written."""
    try:
        yield
    except (KeyError, TypeError, ValueError, AttributeError, RuntimeError, ArithmeticError) as error:
        what = "lacks " + str(error) if isinstance(error, KeyError) else " ".join(str(error).split())[:200]
        raise ValueError(f"{path} is not what was written: {what}; publish the agent again") from None


def _read_card(path: Path) -> dict[str, Any]:
    """Reads a card; refuses one that was changed since it was written, or belongs to another agent."""
    card = files.read_json(path)
    with _explained(path):
        if card["card_sha256"] != checkpointing.json_digest({**card, "card_sha256": None}):
            raise ValueError("its checksum differs")
        if (found := name(card["domain"], card["task"], card["task_kwargs"])) != path.stem:
            raise ValueError(f"it is of {found}")
    return card


@guests.own_torch()
def _network(facts: dict[str, Any]) -> networks.RecurrentNetwork:
    """Returns the network that the facts on a card describe, with some weights."""
    observation_spec = {
        key: specs.Array(tuple(shape), np.dtype(dtype), key) for key, (shape, dtype) in facts["observations"].items()
    }
    for key, value in facts["hyperparameters"].items():
        if not checks.is_number(value) and not isinstance(value, str):
            raise ValueError(f"{key} is {value!r}")
    return _KINDS[facts["kind"]](observation_spec, facts["num_actions"], **facts["hyperparameters"])


def _read_weights(card_path: Path, card: dict[str, Any], like: dict[str, torch.Tensor]) -> dict[str, torch.Tensor]:
    """Reads the weights that a card is about, under their temporary name where their writer was killed."""
    path, waiting = card_path.with_suffix(".safetensors"), card_path.with_suffix(_WAITING)
    if waiting.exists():
        with contextlib.suppress(ValueError, FileNotFoundError):  # Of another card, or just put in place.
            return checkpointing.read_agent(waiting, like, card["sha256"])
    return checkpointing.read_agent(path, like, card["sha256"])


def save(network: networks.RecurrentNetwork, card: Mapping[str, Any], folder: Path = FOLDER) -> Path:
    """Writes a trained agent; returns the path of its card. Interrupted at any time, it leaves the old one or the new.

    Args:
      network: its network; floating-point weights are kept in half precision.
      card: all that is known of it, with `domain`, `task`, `task_kwargs` and `network` as `load` reads them.
      folder: where the agents are; made when needed.

    Raises:
      OSError: if it cannot be written.
      ValueError: if weights are not finite in half precision; nothing is written then.
    """
    weights = checkpointing.agent_bytes(network.state_dict())
    content = sealed({**card, "sha256": hashlib.sha256(weights).hexdigest()})
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / f"{name(card['domain'], card['task'], card['task_kwargs'])}.json"
    waiting = path.with_suffix(_WAITING)
    with files.locked(folder):
        _put_in_place(path)  # What the last writer was killed over.
        try:
            files.write_atomically(waiting, weights)
            files.write_atomically(path, content)  # From here on, the agent is the new one.
        finally:
            _put_in_place(path)
            waiting.unlink(missing_ok=True)  # Where the card could not be written.
    return path


def _put_in_place(card_path: Path) -> None:
    """Gives the weights that a card is about their final name, where their writer was killed before it did."""
    waiting = card_path.with_suffix(_WAITING)
    # Without a card, or with one that is damaged, they are nobody's.
    with contextlib.suppress(FileNotFoundError, ValueError, KeyError, TypeError):
        wanted = files.read_json(card_path)["sha256"]
        with files.open_plain(waiting) as file:
            found = hashlib.sha256(file.read()).hexdigest()
        if found == wanted:
            os.replace(waiting, card_path.with_suffix(".safetensors"))


def sealed(card: Mapping[str, Any]) -> bytes:
    """Returns a card as it is kept in a file, with a checksum of itself."""
    plain = json.loads(json.dumps({**card, "card_sha256": None}))  # As it will be read: JSON has no tuples.
    return (json.dumps({**plain, "card_sha256": checkpointing.json_digest(plain)}, indent=1) + "\n").encode()


def halved(network: networks.RecurrentNetwork) -> networks.RecurrentNetwork:
    """Rounds a network's weights, in place, to what half precision keeps of them."""
    with torch.no_grad():
        for value in network.state_dict().values():
            if value.is_floating_point():
                value.copy_(value.half().float())
    return network
