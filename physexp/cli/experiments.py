"""Commands about the experiments of the paper and about speed."""

import dataclasses
from pathlib import Path
from typing import Literal

from physexp import extras
from physexp.analysis import bench, experiments
from physexp.cli import printing
from physexp.cli.arguments import CLUSTER, RESULTS_DIR, option, word


@dataclasses.dataclass
class Reproduce:
    """Reproduce an experiment: train its agents, let them play, draw its figure, test its claims.

    Finished steps are skipped, and interrupted ones continue.
    """

    experiment: str = word("EXPERIMENT", f"{', '.join(experiments.NAMES)}, or all")
    seeds: int | None = option(None, "agents in each condition; by default 10 from features and 5 from pixels")
    observations: Literal["features", "pixels", "all"] = option("all", "train agents that observe these")
    results_dir: Path = option(Path("results"), RESULTS_DIR)
    jobs: int | None = option(None, "agents trained at a time; by default one for each processor core")
    frames: int | None = option(None, "environment steps of training, for a trial; by default each condition's own")
    cluster: str | None = option(None, CLUSTER, "HOST:PORT")

    def run(self) -> None:
        """Runs the missing parts of the experiment."""
        extras.require("matplotlib", "pandas", *(["ray"] if self.cluster is not None else []))
        from physexp.analysis.experiments import base, conditions, reproduce

        reproduce.run(
            reproduce.choose(self.experiment),
            base.Results(self.results_dir),
            observations=conditions.OBSERVATIONS if self.observations == "all" else (self.observations,),
            num_seeds=self.seeds,
            num_processes=self.jobs,
            frames=self.frames,
            cluster=self.cluster,
            tell=printing.tell,
        )


@dataclasses.dataclass
class Report:
    """Write the report of the stored results: every figure, and every claim with its verdict."""

    results_dir: Path = option(Path("results"), RESULTS_DIR)

    def run(self) -> None:
        """Writes the report."""
        extras.require("matplotlib", "pandas")
        from physexp.analysis.experiments import base, report

        printing.tell(str(report.write(base.Results(self.results_dir), printing.tell)))


@dataclasses.dataclass
class Bench:
    """Measure speed and the trained agents, each figure beside its reference."""

    sections: tuple[Literal[tuple(bench.SECTIONS)], ...] = word(  # type: ignore[valid-type]
        "[SECTION ...]", f"sections to measure: {', '.join(bench.SECTIONS)}; all by default", "*", tuple(bench.SECTIONS)
    )
    json: bool = option(False, "print JSON")

    def run(self) -> None:
        """Measures and prints a row for each figure."""
        extras.require(*bench.extras(self.sections))
        from physexp.analysis.bench import measuring

        rows = []
        for row in bench.run(self.sections):
            rows.append(row)
            if not self.json:
                printing.tell(measuring.line(row))
        if self.json:
            printing.show(rows, as_json=True)
