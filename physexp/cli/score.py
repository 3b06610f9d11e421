"""Commands that score anything that experiments."""

from collections.abc import Iterator, Mapping
import contextlib
import dataclasses
from pathlib import Path
import shlex
from typing import Any

from physexp import checks, extras
from physexp.analysis.domains import base
from physexp.cli import printing
from physexp.cli.arguments import RESULTS_DIR, option, word

TARGET = (
    "the folder of a run; the file of a published agent (NAME.safetensors); DOMAIN/TASK for the agent of the "
    "package; several of these with commas between, a folder of runs, shipped, or a3c, belief or ppo, for a team, "
    "in which agents of a task that differ in their seeds play in turns; MODULE:FUNCTION "
    "for an agent of your own (docs/score.md); or random, at_once, silent, ideal"
)


@dataclasses.dataclass
class Playing:
    """The options of commands in which a target plays tasks."""

    target: str = word("TARGET", TARGET)
    tasks: tuple[str, ...] = option(
        (),
        "the tasks, each also with options, as DOMAIN/TASK,OPTION=VALUE,OPTION=VALUE; by default its own of a trained "
        "agent, and else those of the track exact that the target can play",
        "DOMAIN/TASK",
    )
    track: tuple[str, ...] = option(
        (),
        f"tracks of tasks: {', '.join(f'{name} ({what})' for name, what in base.TRACKS.items())}; or all",
        "TRACK",
    )
    greedy: bool = option(False, "a trained agent takes its likeliest actions instead of drawing them")
    timeout: float = option(60.0, "limit on the time of each call of an agent of your own, s")
    json: bool = option(False, "print JSON")


@dataclasses.dataclass
class Score(Playing):
    """Play a fixed protocol with anything that experiments: how far it gets to the ideal, and by what it falls short.

    An interrupted score goes on in its folder.
    """

    target: str | None = word("TARGET", TARGET, "?", None)  # type: ignore[assignment]  # --records has players.
    records: Path | None = option(
        None,
        "instead of a target, a file of what people or models have played (docs/page.md): a score of each player, "
        "or with --output the folder of a score, as of a target, of the one player that it has",
    )
    quick: bool = option(False, "100 episodes of each task instead of 1000")
    episodes: int | None = option(None, "number of episodes of each task")
    instances: Path | None = option(None, "the file of private instances, also of records; by default, the public ones")
    algorithm: str | None = option(None, "how your agent was trained, for the report and the leaderboard")
    frames: int | None = option(None, "environment steps of its training")
    minutes: float | None = option(None, "duration of its training, min")
    gamma: float | None = option(None, "discount of its training")
    answers_revealed: bool = option(False, "it was told right answers in its training")
    output: Path | None = option(None, "the folder for the log, the figures and the report; by default under scores/")

    def run(self) -> None:
        """Plays, judges, writes the report and prints the score."""
        if self.records is not None and self.target is None and self.output is None:
            _score_records(self.records, self.instances, self.json)
            return
        extras.require("matplotlib")
        from physexp.analysis.score import instances, playing, protocol, scoring, targets
        from physexp.analysis.training import progress

        which = protocol.PUBLIC if self.instances is None else instances.read(self.instances, protocol.VERSION)
        usual = protocol.QUICK_EPISODES if self.quick else protocol.EPISODES
        count = usual if self.episodes is None else self.episodes
        target = self._find(which, count)
        chosen = target.choose(self.tasks, self.track)
        folder = self.output or playing.unfinished(Path("scores") / targets.file_name(target.name))
        made = self._made()
        with playing_in(folder), progress.bar("episodes", count * len(chosen)) as show:
            found = scoring.score(
                target,
                chosen,
                count,
                folder,
                which=which,
                timeout=self.timeout,
                made=made,
                show=show,
                finish=_write_report,
            )
        if self.json:
            printing.show(found, as_json=True)
            return
        for rows in filter(None, (_of_tasks(found), _of_tracks(found))):
            printing.show(rows)
        printing.tell(str(folder))

    def _find(self, which: Any, count: int) -> Any:
        """Returns the target, or the player of records as one, which has played some instances."""
        from physexp.analysis.score import records, targets

        if self.target is not None and self.records is None:
            return targets.find(self.target, self.greedy)
        if self.records is not None and self.target is None:
            return records.target(self.records, which, count)
        raise ValueError("give a target, or --records FILE; see physexp score --help")

    def _made(self) -> dict:
        """Returns the given facts of how the agent was made; raises ValueError for numbers that make no sense."""
        if self.frames is not None:
            checks.integer("frames", self.frames, 0)
        seconds = None if self.minutes is None else 60 * checks.within(0, 1e9, "min")("minutes", self.minutes)
        gamma = None if self.gamma is None else checks.discount("gamma", self.gamma)
        said = {"algorithm": self.algorithm, "frames": self.frames, "seconds": seconds, "gamma": gamma}
        told = {"answers_revealed": self.answers_revealed} if self.algorithm or self.answers_revealed else {}
        return told | {name: value for name, value in said.items() if value is not None}


@contextlib.contextmanager
def playing_in(folder: Path) -> Iterator[None]:
    """Returns a context that tells where the episodes are if the user ends it."""
    try:
        yield
    except KeyboardInterrupt:
        from physexp.analysis.score import playing

        if (folder / playing.FILE).exists():
            printing.warn(f"the episodes that were played are in {folder}; the same command goes on after them")
        raise


def _write_report(folder: Path) -> None:
    """Writes the report of a score; raises OSError if it cannot, which says that the score itself is there."""
    from physexp.analysis.score import report

    try:
        report.write(folder)
    except OSError as error:
        raise OSError(
            f"{error}; the score itself is there: `physexp verify {shlex.quote(str(folder))} --report` draws its report"
        ) from None


def _score_records(path: Path, private: Path | None, as_json: bool) -> None:
    """Plays a file of records again and prints the score of each player in each task."""
    from physexp.analysis.score import instances, protocol, records
    from physexp.analysis.training import progress

    which = None if private is None else instances.read(private, protocol.VERSION)
    read, num_left_out = records.read(path, which)
    with progress.bar("records", len(read)) as show:
        found = records.score(read, show)
    if num_left_out:
        printing.warn(f"{num_left_out} records are of instances that their player had played before; they do not count")
    named = {player: {one.question.name: one.metrics for one in its} for player, its in found.items()}
    rows = [
        {"player": player, "task": name, "episodes": figures["episodes"], **_figures(figures)}
        for player, its in named.items()
        for name, figures in its.items()
    ]
    printing.show(named if as_json else _with_beliefs(rows), as_json)


def _figures(figures: Mapping[str, Any]) -> dict:
    stated = figures.get("beliefs") or {}
    return {
        **_score(figures),
        "right": figures["success_rate"],
        "interactions": figures["mean_interactions"],
        "lost most by": _worst(figures["mistakes"]),
        "log score": stated.get("log_score", ""),
        "bits lost": stated.get("bits_lost", ""),
    }


def _with_beliefs(rows: list[dict]) -> list[dict]:
    """Returns rows without the columns about beliefs if none was stated."""
    if any(row["bits lost"] != "" for row in rows):
        return rows
    return [{name: value for name, value in row.items() if name not in ("log score", "bits lost")} for row in rows]


def _of_tasks(found: dict) -> list[dict]:
    """Returns a line for each task."""
    return _with_beliefs([{"task": name, **_figures(figures)} for name, figures in found["tasks"].items()])


def _of_tracks(found: dict) -> list[dict]:
    """Returns a line for each track."""
    return [
        {
            "track": name,
            **_score(figures),
            "worst domain": " ".join(f"{domain} {score:.4f}" for domain, score in figures["worst"].items()),
            "domains played": f"{figures['played']} of {figures['of']}",
        }
        for name, figures in found["tracks"].items()
    ]


def _score(figures: Mapping[str, Any]) -> dict:
    return {"score": figures["score"], "95 % interval": figures["interval"]}


def _worst(mistakes: dict[str, float]) -> str:
    kind = max(mistakes, key=lambda name: mistakes[name])
    return f"{kind} {mistakes[kind]:.4f}" if mistakes[kind] > 0 else "nothing"


@dataclasses.dataclass
class Verify:
    """Play the actions of a score's log again, bit for bit, and check that the whole folder follows from them."""

    folder: Path = word("FOLDER", "a folder that `physexp score` has written")
    report: bool = option(False, "draw the report again, if everything follows")
    instances: Path | None = option(
        None, "the file of the private instances that it was scored on; by default instances.json in the folder"
    )
    json: bool = option(False, "print JSON")

    def run(self) -> None:
        """Verifies and prints the result."""
        if self.report:
            extras.require("matplotlib")
        from physexp.analysis.score import scoring, verifying
        from physexp.analysis.training import progress

        stored = scoring.read(self.folder)
        count = stored["protocol"]["episodes"] * len(stored["protocol"]["tasks"])
        with progress.bar("episodes", count) as show:
            found = verifying.verify(self.folder, show, self.instances)
        if self.report:
            _write_report(self.folder)
        if self.json:
            printing.show({**found, "complete": stored["complete"]}, as_json=True)
            return
        of_key = (
            f", on the private instances of the key with SHA-256 {found['key_hash']}" if "key_hash" in found else ""
        )
        part = "" if stored["complete"] else f"; it is a part, of {count:,} episodes"
        earned = ", ".join(f"{name} {score:.4f}" for name, score in found["scores"].items())
        printing.tell(
            f"OK: {found['episodes']:,} episodes were played so, by {found['target']}{of_key}; score {earned}{part}"
        )


@dataclasses.dataclass
class Leaderboard:
    """Write leaderboard.md and its figure from the stored scores."""

    results_dir: Path = option(Path("results"), RESULTS_DIR)

    def run(self) -> None:
        """Writes the leaderboard; raises RuntimeError if some folders are no rows of it."""
        extras.require("matplotlib")
        from physexp.analysis.score import leaderboard
        from physexp.analysis.training import progress

        count = len(leaderboard.folders(self.results_dir))
        with progress.bar("rows", count) as show:
            paths, refused = leaderboard.write(self.results_dir, show)
        printing.tell(*map(str, paths))
        if refused:
            printing.warn(*refused)
            raise RuntimeError(f"these {len(refused)} folders are no rows of the leaderboard; mend or remove them")
