"""Trained agents that come with the package: one file each, with the weights in half precision and a model card."""

from collections.abc import Mapping
import dataclasses
from pathlib import Path
from typing import Any

from dm_env import specs
import numpy as np
import torch

from physexp import checks
from physexp.agents import acting, config, core, devices, files, networks, registry
from physexp.agents import tensors as tensors_lib

FOLDER = Path(__file__).with_name("pretrained_agents")
"""The best agent of each task; those of other learners are in a folder of the learner's name."""
_KINDS = {kind.__name__: kind for kind in registry.NETWORKS.values()}


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
    """Returns the name of an agent's file: domain, task, and each option that was chosen for the task."""
    chosen = sorted((option, value) for option, value in options.items() if value is not None)
    return "-".join([domain, task, *(f"{option}{config.shown(value)}" for option, value in chosen)])


def names(folder: Path = FOLDER) -> list[str]:
    """Returns the names of the agents in a folder and in the folders of learners in it, as `a3c/towers-fist_pixels`."""
    paths = [*folder.glob("*.safetensors"), *folder.glob("*/*.safetensors")]
    return sorted(path.relative_to(folder).with_suffix("").as_posix() for path in paths)


def load(
    domain: str, task: str, *, agent: str | None = None, folder: str | Path = FOLDER, **options: Any
) -> Pretrained:
    """Loads a trained agent from a folder; for the other arguments see `agents.load_pretrained`.

    Without options it is the only agent of the task, or the one whose card says that it is the task's default. Raises
    OSError if its file cannot be read, and ValueError if it is damaged, or if there is no such agent.
    """
    folder = Path(folder).expanduser()
    wanted = name(domain, task, options)
    for place in (folder,) if agent is None else (folder / agent, folder):
        stem = wanted
        if wanted == name(domain, task, {}) and wanted not in names(place):
            cards = _cards(domain, task, place)
            stem = next((each for each, card in cards.items() if len(cards) == 1 or card.get("default")), wanted)
        if stem in names(place) and agent in (None, card_named(stem, place)["agent"]["algorithm"]):
            return load_named(stem, place)
    learner = "" if agent is None else f" of {agent}"
    raise ValueError(f"no trained agent{learner} is named {wanted}; there are: {', '.join(names(folder)) or 'none'}")


def options_of(domain: str, task: str, folder: Path = FOLDER) -> set[str]:
    """Returns the names of the options in which the agents of a task differ."""
    return {option for card in _cards(domain, task, folder).values() for option in card["task_kwargs"]}


def _cards(domain: str, task: str, folder: Path) -> dict[str, dict[str, Any]]:
    """Returns the cards of a task's agents for which options were chosen, by name."""
    prefix = f"{name(domain, task, {})}-"
    return {stem: card_named(stem, folder) for stem in names(folder) if stem.startswith(prefix)}


def card_named(stem: str, folder: Path = FOLDER) -> dict[str, Any]:
    """Returns the card of the agent whose file has this name, without reading its weights; raises as `load`."""
    return tensors_lib.read_facts(folder / f"{stem}.safetensors")


def load_named(stem: str, folder: Path = FOLDER) -> Pretrained:
    """Loads the agent whose file has this name; raises as `load`."""
    return load_file(folder / f"{stem}.safetensors")


def load_file(path: Path) -> Pretrained:
    """Loads the agent in a file; raises as `load`."""
    weights, card = tensors_lib.read(path)
    try:
        with torch.device("meta"):  # Memory is taken only for a network of the size of these weights.
            like = _make(card["network"]).state_dict()
        frozen = card["network"].get("frozen", {"seed": 0, "names": []})
        tensors_lib.check(weights, {each: value for each, value in like.items() if each not in frozen["names"]})
        network = halve(_make(card["network"], frozen["seed"]))
        network.load_state_dict(weights, strict=False)
        if frozen["names"] and _digest(network, frozen["names"]) != frozen["sha256"]:
            raise ValueError(f"torch {torch.__version__} draws other convolutions from seed {frozen['seed']}")
    except (KeyError, TypeError, ValueError, AttributeError, RuntimeError, ArithmeticError) as error:
        what = f"its card lacks {error}" if isinstance(error, KeyError) else files.reason(error)
        raise core.DamagedError(f"{path} holds no agent of this version ({what}); publish the agent again") from None
    return Pretrained(network.eval(), card)


def _make(facts: Mapping[str, Any], seed: int = 0) -> networks.RecurrentNetwork:
    """Returns the network that the facts on a card describe, with weights drawn from a seed."""
    observation_spec = {
        key: specs.Array(tuple(shape), np.dtype(dtype), key) for key, (shape, dtype) in facts["observations"].items()
    }
    for key, value in facts["hyperparameters"].items():
        if not checks.is_number(value) and not isinstance(value, (str, bool)):
            raise ValueError(f"{key} is {value!r}")
    with devices.own_torch():
        torch.default_generator.manual_seed(seed)
        return _KINDS[facts["kind"]](observation_spec, facts["num_actions"], **facts["hyperparameters"])


def save(network: networks.RecurrentNetwork, card: Mapping[str, Any], folder: Path = FOLDER) -> Path:
    """Writes a trained agent in place of the one that has its name, if there is one; returns the path of its file.

    Floating-point weights are kept in half precision. Frozen parameters that follow from the agent's seed are not
    stored but drawn again when the agent is loaded. The card has `domain`, `task`, `task_kwargs`, `seed` and `network`
    as `load` reads them. Raises ValueError, and writes nothing, if weights are not finite in half precision.
    """
    weights = tensors_lib.halved(network.state_dict())
    drawn = halve(_make(card["network"], card["seed"])).state_dict()
    frozen = [each for each, value in network.named_parameters() if not value.requires_grad]
    if frozen and all(torch.equal(weights[each].float(), drawn[each]) for each in frozen):
        weights = {each: value for each, value in weights.items() if each not in frozen}
        follows = {"seed": card["seed"], "names": frozen, "sha256": _digest(network, frozen)}
        card = {**card, "network": {**card["network"], "frozen": follows}}
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / f"{name(card['domain'], card['task'], card['task_kwargs'])}.safetensors"
    tensors_lib.write(path, weights, card)
    return path


def _digest(network: networks.RecurrentNetwork, names_: list[str]) -> str:
    variables = network.state_dict()
    return tensors_lib.digest({each: variables[each].half() for each in names_})


def halve(network: networks.RecurrentNetwork) -> networks.RecurrentNetwork:
    """Rounds a network's weights, in place, to half precision; raises ValueError if they are not finite then."""
    network.load_state_dict(tensors_lib.halved(network.state_dict()))
    return network
