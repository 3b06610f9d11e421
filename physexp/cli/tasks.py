"""Commands that list the tasks and examine this machine."""

import dataclasses
import sys

from physexp.cli import printing
from physexp.cli.arguments import Switch


@dataclasses.dataclass
class Tasks:
    """List the tasks: the question, the numbers of actions and steps, the discount that is scored, the observations.

    Attributes:
      json: print JSON.
    """

    json: Switch = False

    def run(self) -> None:
        from physexp import suite

        rows = []
        for domain, name in suite.ALL_TASKS:
            task = suite.load_task(domain, name)
            observations = {
                key: {"shape": list(blank.shape[1:]), "dtype": str(blank.dtype)}
                for key, blank in task.blank_observations(1).items()
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
            printing.show_rows(rows, as_json=True)
            return
        for domain in suite.TASKS_BY_DOMAIN:
            of_domain = [row for row in rows if row["domain"] == domain]
            printing.tell(f"{domain}: {of_domain[0]['question']}")
            shown = ("task", "interactions", "labels", "step_limit")
            printing.show_rows(
                [
                    {
                        **{name: row[name] for name in shown},
                        "discount": f"{row['discount']:g}",
                        "observations": ", ".join(
                            f"{key} {array['dtype']} {array['shape']}" for key, array in row["observations"].items()
                        ),
                    }
                    for row in of_domain
                ],
                as_json=False,
            )
            printing.tell("")


@dataclasses.dataclass
class Doctor:
    """Check versions, GPU and OpenGL, and say what to do about what is missing.

    The exit status is 1 if the environments themselves do not work, else 0.

    Attributes:
      json: print JSON.
    """

    json: Switch = False

    def run(self) -> None:
        from physexp.cli import doctor

        found = doctor.examine()
        if self.json:
            printing.show(found, as_json=True)
        else:
            printing.show_rows(found["checks"], as_json=False)
        if any(check["verdict"] == doctor.BROKEN for check in found["checks"]):
            sys.exit(1)
