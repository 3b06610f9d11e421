"""The types of the commands' arguments, with the names that help shows for their values."""

from pathlib import Path
from typing import Annotated

import tyro
from tyro.conf import Positional

from physexp.analysis import domains

Domain = Annotated[
    Positional[str],
    tyro.conf.arg(metavar="DOMAIN", help=f"{' or '.join(domains.DOMAINS)}; --help after it lists its options."),
]
Task = Annotated[
    Positional[str], tyro.conf.arg(metavar="TASK", help="a task of the domain; `physexp tasks` lists them.")
]
Agent = Annotated[
    Positional[str],
    tyro.conf.arg(
        metavar="AGENT",
        help="the folder of a run, the card of a published agent (NAME.json), or DOMAIN/TASK for the agent that comes "
        "with the package; --help after it lists the options of its domain.",
    ),
]
Switch = tyro.conf.FlagCreatePairsOff[bool]

# For these, the text says what happens without a value.
OptionalFloat = Annotated[float | None, tyro.conf.arg(metavar="FLOAT", help_behavior_hint="")]
OptionalInt = Annotated[int | None, tyro.conf.arg(metavar="INT", help_behavior_hint="")]
OptionalPath = Annotated[Path | None, tyro.conf.arg(metavar="PATH", help_behavior_hint="")]
OptionalAgent = Annotated[str | None, tyro.conf.arg(metavar="AGENT", help_behavior_hint="")]
OptionalTask = Annotated[str | None, tyro.conf.arg(metavar="TASK", help_behavior_hint="")]
OptionalAddress = Annotated[str | None, tyro.conf.arg(metavar="HOST:PORT", help_behavior_hint="")]
