"""The instances of a score: its episodes, which all targets play, either public or those of a secret key.

A private instance has a seed of its own, which follows from the key alone. So nothing that an agent has observed in one
episode tells about another.
"""

import dataclasses
import hashlib
import hmac
import json
import os
from pathlib import Path
import secrets
from typing import Any

from physexp import suite
from physexp.agents import files
from physexp.analysis.data import tables

FILE = "instances.json"
"""The file of private instances in the folder of a score, once they are published."""

_SHORTEST = 32  # Characters of a key: 128 bits as hexadecimal digits.
_LEAST_SEED = 2**62  # Seeds of batches, and so those of training, are below 2**32.


@dataclasses.dataclass(frozen=True)
class Public:
    """The episodes of one environment; their seeds are known to everybody.

    Attributes:
      seed: as for `suite.load_batch`.
    """

    seed: int

    @property
    def facts(self) -> dict[str, Any]:
        """The entry that names the instances in the files of a score."""
        return {"seed": self.seed}

    def seed_of(self, task: str, episode: int) -> int:
        """Returns the seed of the environment in an episode of a task."""
        return suite.environment_seed(self.seed, 0)


@dataclasses.dataclass(frozen=True)
class Private:
    """Episodes that follow from a secret key; raises ValueError if the key can be no secret.

    Attributes:
      key: the key.
    """

    key: str = dataclasses.field(repr=False)

    def __post_init__(self):
        if len(self.key) < _SHORTEST or not self.key.isascii():
            raise ValueError(
                f"the key is no secret: it has {len(self.key)} characters; give at least {_SHORTEST} of ASCII, which "
                "are drawn at random"
            )

    @property
    def key_hash(self) -> str:
        """The SHA-256 of the key, hexadecimal."""
        return hashlib.sha256(self.key.encode()).hexdigest()

    @property
    def facts(self) -> dict[str, Any]:
        """The entry that names the instances in the files of a score."""
        return {"key_hash": self.key_hash}

    def seed_of(self, task: str, episode: int) -> int:
        """Returns the seed of the environment in an episode of a task."""
        code = hmac.digest(self.key.encode(), f"{task} {episode}".encode(), "sha256")
        return _LEAST_SEED + int.from_bytes(code[:8], "big") % _LEAST_SEED


Instances = Public | Private


def draw(path: Path | None = None) -> Private:
    """Returns private instances of a new key, or of the one in a file.

    Raises OSError if the file cannot be read, and ValueError if it holds no key.
    """
    if path is None:
        return Private(secrets.token_hex(32))
    tables.check(path, tables.MAX_TEXT)
    return Private(path.read_bytes().decode("ascii", "replace").strip())


def write(path: Path, instances: Private, version: str) -> None:
    """Writes a new file of instances of a protocol, which its owner alone may read.

    Raises ValueError if the file exists, and OSError if it cannot be written.
    """
    content = {"version": version, **instances.facts, "key": instances.key}
    try:
        with open(path, "x", encoding="utf-8", opener=lambda name, flags: os.open(name, flags, 0o600)) as file:
            file.write(json.dumps(content, indent=1) + "\n")
    except FileExistsError:
        raise ValueError(f"{path} exists, and may hold the only copy of a key; give another OUTPUT") from None


def read(path: Path, version: str) -> Private:
    """Returns the instances in a file, which must be of this version of the protocol.

    Raises OSError if it cannot be read, and ValueError if it is faulty, has no key, or its hash is of another key.
    """
    tables.check(path, tables.MAX_TEXT)
    found = files.read_json(path)
    if not isinstance(found, dict) or "key_hash" not in found:
        raise ValueError(f"{path} holds no instances; give a file that `physexp draw-instances` has written")
    if found.get("version") != version:
        raise ValueError(f"{path} has instances of protocol {found.get('version')!r}; give some of {version}")
    if not isinstance(key := found.get("key"), str):
        raise ValueError(f"{path} has no key; its author publishes it when the scores are made")
    instances = Private(key)
    if found["key_hash"] != instances.key_hash:
        raise ValueError(
            f"{path}: key_hash is {found['key_hash']!r}, and the key's is {instances.key_hash}; one of them was "
            "changed, so ask its author"
        )
    return instances
