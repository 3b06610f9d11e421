"""The command that lets language models play."""

import dataclasses
from pathlib import Path
from typing import Literal

from physexp import extras
from physexp.cli import printing
from physexp.cli.arguments import option, word


@dataclasses.dataclass
class Serve:
    """Let a client of the Model Context Protocol play tasks in words, over its standard streams or HTTP.

    It listens on this machine alone. All that is said and done is kept; an interrupted run goes on in its folder.
    """

    tasks: tuple[str, ...] = word("TASK", "the tasks, each also with options, as DOMAIN/TASK,OPTION=VALUE", "+")
    episodes: int | None = option(None, "number of episodes of each task; by default 50")
    output: Path = option(Path("transcripts"), "the folder for the transcript and the records")
    model: str = option("not told", "name and version of the model, for the transcript")
    harness: str = option("not told", "the program that leads it, and its version")
    tools: str = option("not told", "the tools that it has besides")
    budget: str = option("not told", "its limits, such as tokens for each episode")
    level: Literal["named", "neutral", "anonymous"] = option("named", "how much the texts tell: names, or none")
    digits: int | None = option(None, "decimals of readings; by default all that float32 has")
    instances: Path | None = option(None, "the file of private instances to play; by default, the public ones")
    http: int | None = option(None, "serve HTTP at this port of 127.0.0.1 instead; 0 for any that is free", "PORT")

    def run(self) -> None:
        """Serves until the client or the user ends it."""
        extras.require("mcp")
        from physexp.analysis.score import instances, protocol, serving, transcripts

        facts = {name: getattr(self, name) for name in ("model", "harness", "tools", "budget")}
        which = protocol.PUBLIC if self.instances is None else instances.read(self.instances, protocol.VERSION)
        questions, count = protocol.named(self.tasks), self.episodes or transcripts.EPISODES
        with transcripts.run(self.output, instances=which, **facts) as run:
            desk = serving.Desk(run, questions, count, level=self.level, digits=self.digits)
            if self.http is None:
                serving.over_streams(desk)
            else:
                serving.over_http(desk, self.http, printing.tell)
