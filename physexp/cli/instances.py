"""The command that draws private instances for a score."""

import dataclasses
from pathlib import Path

from physexp.cli import printing
from physexp.cli.arguments import option, word


@dataclasses.dataclass
class DrawInstances:
    """Draw private instances for a score, all from one secret key; prints the key's hash, to publish beforehand."""

    output: Path = word("OUTPUT", "the new file of the instances with their key, a secret until the scores are made")
    key: Path | None = option(
        None, "a file that holds the key of instances to draw again; by default a new key is drawn"
    )
    json: bool = option(False, "print JSON")

    def run(self) -> None:
        """Writes the file and prints the hash."""
        from physexp.analysis.score import instances, protocol

        drawn = instances.draw(self.key)
        instances.write(self.output, drawn, protocol.VERSION)
        if self.json:
            printing.show(drawn.facts, as_json=True)
        else:
            printing.tell(f"The SHA-256 of the key in {self.output} is {drawn.key_hash}.")
