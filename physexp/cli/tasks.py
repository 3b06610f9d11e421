"""The command that lists the tasks."""

import dataclasses
import itertools

from physexp.cli import printing
from physexp.cli.arguments import option


@dataclasses.dataclass
class Tasks:
    """List the tasks: question, numbers of actions and steps, scored discount, observations."""

    json: bool = option(False, "print JSON")

    def run(self) -> None:
        """Prints the table."""
        from physexp import suite

        rows = []
        for domain, name in suite.ALL_TASKS:
            task = suite.load_task(domain, name)
            observations = {
                key: {"shape": list(spec.shape), "dtype": str(spec.dtype)}
                for key, spec in task.observation_spec().items()
            }
            rows.append(
                {
                    "domain": domain,
                    "task": name,
                    "interactions": task.num_interactions,
                    "labels": task.num_labels,
                    "step_limit": task.rules.step_limit,
                    "discount": task.discount,
                    "observations": observations,
                    "question": task.question,
                }
            )
        if self.json:
            printing.show(rows, as_json=True)
            return
        for row in rows:
            arrays = (f"{key} {array['dtype']} {array['shape']}" for key, array in row["observations"].items())
            row |= {"discount": f"{row['discount']:g}", "observations": ", ".join(arrays)}
        for domain, of_domain in itertools.groupby(rows, lambda row: row.pop("domain")):
            table = list(of_domain)
            (question,) = {row.pop("question") for row in table}
            printing.tell(f"{domain}: {question}")
            printing.show(table)
            printing.tell("")
