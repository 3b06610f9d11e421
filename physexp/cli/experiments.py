"""Commands about the experiments of the paper and about speed."""

import contextlib
import dataclasses
from pathlib import Path
from typing import Annotated, Literal

import tyro
from tyro.conf import Positional

from physexp import extras
from physexp.analysis import bench, experiments
from physexp.cli import printing
from physexp.cli.arguments import OptionalAddress, OptionalInt, Switch


@dataclasses.dataclass
class Reproduce:
    """Reproduce an experiment of the paper: train its agents, let them play, draw its figure, test its claims.

    What is done already is not done again; what was interrupted continues where it was.

    Attributes:
      seeds: agents in each condition; by default 10 from features and 5 from pixels.
      observations: train the agents that observe features, pixels, or all of them.
      results_dir: the folder of all results.
      jobs: agents trained at a time; by default one for each processor core.
      frames: environment steps of training, for a quick trial; by default each condition's own number.
      cluster: train on a cluster of Ray: HOST:PORT of its head; auto for the one that runs here, or else a local one.
    """

    experiment: Annotated[
        Positional[str], tyro.conf.arg(metavar="EXPERIMENT", help=f"{', '.join(experiments.NAMES)}, or all.")
    ]
    seeds: OptionalInt = None
    observations: Literal["features", "pixels", "all"] = "all"
    results_dir: Path = Path("results")
    jobs: OptionalInt = None
    frames: OptionalInt = None
    cluster: OptionalAddress = None

    def run(self) -> None:
        extras.require("matplotlib", "pandas", *(["ray"] if self.cluster is not None else []))
        from physexp.analysis.experiments import base, conditions, reproduce

        chosen = reproduce.choose(self.experiment)
        with contextlib.ExitStack() as stack:
            submit = None
            if self.cluster is not None:
                from physexp.analysis.experiments import cluster

                stack.enter_context(cluster.joined(self.cluster))
                submit = cluster.submit
            reproduce.run(
                chosen,
                base.Results(self.results_dir),
                observations=conditions.OBSERVATIONS if self.observations == "all" else (self.observations,),
                num_seeds=self.seeds,
                num_processes=self.jobs,
                frames=self.frames,
                submit=submit,
                tell=printing.tell,
            )


@dataclasses.dataclass
class Report:
    """Write report.md and report.html of the stored results: every figure, and every claim with its verdict.

    Attributes:
      results_dir: where the results are.
    """

    results_dir: Path = Path("results")

    def run(self) -> None:
        extras.require("matplotlib", "pandas")
        from physexp.analysis.experiments import base, report

        printing.tell(str(report.write(base.Results(self.results_dir), printing.tell)))


@dataclasses.dataclass
class Bench:
    """Measure speed and the trained agents, each figure beside its reference.

    Attributes:
      sections: sections to measure; all of them by default.
      json: print JSON.
    """

    sections: Annotated[
        Positional[tuple[Literal[tuple(bench.SECTIONS)], ...]],  # type: ignore[valid-type]
        tyro.conf.arg(metavar="[SECTION ...]"),
    ] = tuple(bench.SECTIONS)
    json: Switch = False

    def run(self) -> None:
        extras.require(*bench.extras(self.sections))
        from physexp.analysis.bench import measuring

        rows = []
        for row in bench.run(self.sections):
            rows.append(row)
            if not self.json:
                printing.tell(measuring.line(row))
        if self.json:
            printing.show_rows(rows, as_json=True)
