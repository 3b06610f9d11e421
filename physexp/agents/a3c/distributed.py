"""A3C on a cluster: workers and the shared variables are actors of Ray, which places, connects and restarts them.

    worker ── pull, push ──> parameter server <── take, save ── driver

A worker sends its gradient together with the record of the round that it is from, so an update is in the variables and
in the records, or in neither, whoever dies when. The driver hands out the records as `Agent.updates`.
"""

from collections.abc import Callable, Collection
import dataclasses
import time
from typing import Any

import ray

from physexp.agents import core, learning, starting
from physexp.agents.a3c import config as config_lib
from physexp.agents.a3c import parameter_server, remote_worker, supervision, watching


@dataclasses.dataclass(frozen=True)
class Patience(watching.Patience):
    """Time limits for workers and the parameter server, s.

    Attributes:
      room: for the cluster to place all workers; after it, a line says how many are not placed.
      answer: for an answer of the parameter server; after it, the server counts as dead.
    """

    room: float = 60.0
    answer: float = 120.0


class DistributedA3C(core.Agent):
    """Runs the actors and yields their updates. The cluster must have been joined with `ray.init`."""

    def __init__(
        self,
        make_environment: core.EnvironmentFactory,
        config: config_lib.A3CConfig,
        find_versions: Callable[[], dict[str, str]],
        tell: Callable[[str], None] = lambda line: None,
        patience: Patience = Patience(),
    ):
        """Prepares the variables; the actors start with `updates`.

        Args:
          make_environment: called in each worker; must be picklable, and its module installed on all machines.
          config: the configuration. Workers for which the cluster has no room yet join when it has.
          find_versions: says what is installed; it must say the same on every machine.
          tell: called with a line when a worker has died, finds no room, or is silent.
          patience: how long is waited for whom.
        """
        self._make_environment, self._config = make_environment, config
        self._find_versions, self._tell, self._patience = find_versions, tell, patience
        environment = make_environment(config.seed, 1, 1)
        self._network = starting.initial_network(environment, config)
        environment.close()
        self._tensors = learning.Variables(self._network, config.num_workers).save()
        self._server: Any = None
        self._is_stopping = False

    @property
    def frames(self):
        return int(self.save()["frames"])

    def save(self):
        """Does what `Agent.save` says; raises VariablesLostError if the parameter server has died."""
        return self._ask("save") if self._server is not None else dict(self._tensors)

    def restore(self, tensors):
        learning.Variables(self._network, self._config.num_workers).restore(tensors)  # Refuses what does not fit.
        self._tensors = dict(tensors)

    def traffic(self) -> parameter_server.Traffic:
        """Returns what the parameter server has done so far, while `updates` runs."""
        return self._ask("traffic")

    def stop(self):
        self._is_stopping = True

    def updates(self, poll_seconds=0.5):
        """Does what `Agent.updates` says.

        A worker that dies is started again; training ends without those that were never placed.

        Raises:
          VariablesLostError: if the parameter server dies, or hangs. Restored, the agent can go on.
        """
        make_server = ray.remote(num_cpus=0)(parameter_server.ParameterServer)
        self._server = make_server.remote(self._network, self._tensors, self._config)
        workers = supervision.Workers(self._config.num_workers, self._run, self._tell)
        try:
            yield from self._updates(workers, poll_seconds)
            yield from self._ask("take").updates
            self._tensors = self.save()
        finally:
            workers.kill()
            ray.kill(self._server)
            self._server = None

    def _updates(self, workers: supervision.Workers, poll_seconds: float):
        """Yields updates while workers are running, or are to come."""
        watch = watching.Watch(self._tensors["rounds"].tolist(), "worker {}".format, self._patience, self._tell)
        room = supervision.RoomWatch(self._config.num_workers, self._patience.room, self._tell)
        waited, deadline, is_done = time.monotonic(), None, False
        while workers.running or (workers.coming and not is_done):
            workers.look(self._is_stopping)
            taken = self._ask("take")
            yield from taken.updates
            if taken.updates:
                waited = time.monotonic()
                workers.forgive()
            elif time.monotonic() - waited > poll_seconds:
                waited = time.monotonic()
                yield None
            watch.look(taken.rounds, workers.running)
            room.look(workers.coming)
            is_done = taken.is_done or self._is_stopping
            if is_done and deadline is None:
                self._ask("stop")
                deadline = time.monotonic() + self._patience.stop
            if deadline is not None and time.monotonic() > deadline:
                self._tell(f"{_named(workers.running)} did not end within {self._patience.stop:.0f} s: killed")
                break

    def _run(self, worker, index: int):
        """Sets a worker to work; returns Ray's reference."""
        return worker.run.remote(
            self._server, index, self._make_environment, self._config, self._find_versions(), self._find_versions
        )

    def _ask(self, question: str) -> Any:
        """Calls a method of the parameter server."""
        try:
            return ray.get(getattr(self._server, question).remote(), timeout=self._patience.answer)
        except ray.exceptions.GetTimeoutError:
            raise core.VariablesLostError(
                f"the parameter server has not answered for {self._patience.answer:.0f} s"
            ) from None
        except ray.exceptions.RayActorError as error:
            raise remote_worker.server_died(error) from None


def _named(indices: Collection[int]) -> str:
    return f"worker{'s' if len(indices) > 1 else ''} {', '.join(map(str, sorted(indices)))}"
