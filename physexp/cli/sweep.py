"""The command that trains many agents."""

import dataclasses
from pathlib import Path
import shlex

from physexp import extras
from physexp.analysis.training import config as config_lib
from physexp.cli import printing
from physexp.cli.arguments import CLUSTER, RESULTS_DIR, option, word

_LARGEST = 1_000_000


@dataclasses.dataclass
class Sweep:
    """Train, evaluate and compare agents: tasks x learners x seeds, several at a time or on a cluster.

    Finished runs are skipped, and interrupted ones continue. All rows are in the tables of the results.
    """

    tasks: tuple[str, ...] = word("DOMAIN/TASK", "the tasks; `physexp tasks` lists them", "+")
    learners: tuple[str, ...] = option(
        (config_lib.DEFAULT_ALGORITHM,), f"the learners: {', '.join(config_lib.ALGORITHMS)}", "LEARNER"
    )
    seeds: int = option(3, "runs of each task and learner")
    first_seed: int = option(0, "the seed of the first of them")
    frames: int | None = option(None, "environment steps of training; by default those of each task's preset")
    episodes: int = option(10_000, "episodes of each evaluation")
    results_dir: Path = option(Path("results"), RESULTS_DIR)
    jobs: int | None = option(None, "runs at a time; by default one for each processor core")
    cluster: str | None = option(None, CLUSTER, "HOST:PORT")
    print: bool = option(False, "print a shell command for each run that is not done, and train nothing")
    json: bool = option(False, "print the final table as JSON")

    def run(self) -> None:
        """Trains and evaluates the missing runs, and prints a row for each."""
        extras.require("pandas", *(["ray"] if self.cluster is not None else []))
        from physexp.agents import processes
        from physexp.analysis.experiments import base, pools, sweep

        for name in ("seeds", "jobs", "frames", "episodes"):
            value = getattr(self, name)
            if value is not None and not 1 <= value <= (10**12 if name == "frames" else _LARGEST):
                raise ValueError(f"{name} is {value}; give an integer >= 1")
        if unknown := set(self.learners) - set(config_lib.ALGORITHMS):
            raise ValueError(f"learners has {min(unknown)!r}; choose from {', '.join(config_lib.ALGORITHMS)}")
        seeds = range(self.first_seed, self.first_seed + self.seeds)
        jobs = sweep.grid(self.tasks, self.learners, seeds, self.frames, self.episodes)
        results = base.Results(self.results_dir)
        if self.print:
            printing.tell(*(self._command(job.config) for job in sweep.to_do(jobs, results)))
            return
        num_processes = self.jobs or processes.num_cores()
        with pools.opened(num_processes, self.cluster) as pool:
            sweep.run(jobs, results, pool, num_processes, printing.warn)
        printing.show(sweep.table(jobs, results), self.json)

    def _command(self, config: config_lib.TrainConfig) -> str:
        """Returns the shell command of one run."""
        learner, seed = config.agent.algorithm, config.agent.seed
        line = f"physexp sweep {config.task_name} --learners {learner} --seeds 1 --first-seed {seed}"
        line += f" --episodes {self.episodes} --jobs 1 --results-dir {shlex.quote(str(self.results_dir))}"
        return line + (f" --frames {self.frames}" if self.frames else "")
