"""A3C on a cluster: workers and the shared variables are actors of Ray, which places, connects and restarts them.

    worker ── pull, push ──> parameter server <── take, save ── driver

A worker sends its gradient together with the record of the round that it is from, so an update is in the variables and
in the records, or in neither, whoever dies when. The driver hands out the records as `Agent.updates`.
"""

from collections.abc import Callable, Collection
import dataclasses
import time
from typing import Any

import numpy as np
import ray
import torch

from physexp.agents import agent as agent_lib
from physexp.agents import learning, networks
from physexp.agents.a3c import agent as a3c_agent
from physexp.agents.a3c import config as config_lib
from physexp.agents.a3c import learning as a3c

_POLL_SECONDS = 0.1  # Between looks at what the workers have done.
_MAX_DEATHS = 5  # Of a worker, with no update of anybody in between.


@dataclasses.dataclass(frozen=True)
class Patience:
    """How long is waited for whom, s.

    Attributes:
      room: for a worker to be placed, until a line says how many are not.
      silent: for a worker's next round, until a line says that it has not ended it.
      answer: for the parameter server; then it is taken for dead.
      stop: when training ends, for the rounds that are under way.
    """

    room: float = 60.0
    silent: float = 120.0
    answer: float = 120.0
    stop: float = 120.0


@dataclasses.dataclass
class Traffic:
    """What the parameter server has done so far.

    Attributes:
      updates: gradients applied.
      dropped: gradients that were too old.
      busy_seconds: time spent on all of them.
      bytes_in, bytes_out: gradients with their records, and parameters.
    """

    updates: int = 0
    dropped: int = 0
    busy_seconds: float = 0.0
    bytes_in: int = 0
    bytes_out: int = 0


@dataclasses.dataclass(frozen=True)
class _Taken:
    """What the parameter server hands to the driver.

    Attributes:
      updates: those since it was asked last.
      rounds: how many each worker has played.
      done: whether all frames are.
    """

    updates: list[agent_lib.Update]
    rounds: list[int]
    done: bool


@dataclasses.dataclass(frozen=True)
class _Reply:
    """What the parameter server answers to a worker: where training stands, and the parameters, float32 [P]."""

    pulled: a3c.Pulled
    parameters: np.ndarray
    goes_on: bool


class ParameterServer:
    """The actor that keeps the variables. It does one thing at a time, so nobody sees half an update."""

    def __init__(self, network: networks.RecurrentActorCritic, tensors, config: config_lib.A3CConfig):
        """Takes up variables.

        Args:
          network: any network of their shapes.
          tensors: what `Variables.save` returned.
          config: the agent's configuration.
        """
        torch.set_num_threads(1)
        self._variables, self._config = learning.Variables(network, config.num_workers), config
        self._variables.restore(tensors)
        self._records: list[agent_lib.Update] = []
        self._traffic = Traffic()
        self._stopped = False

    def exchange(
        self, worker: int, seed: int, gradient: np.ndarray | None, contribution: a3c.Contribution | None
    ) -> _Reply:
        """Applies what a worker has learned, if anything, and gives it the newest parameters.

        The gradient, float32 [P], comes beside the rest: arrays are sent without being copied, tensors are not.
        """
        start = time.perf_counter()
        variables, traffic = self._variables, self._traffic
        if contribution is not None and gradient is not None:
            gradients = _split(torch.from_numpy(gradient.copy()), variables.network)
            counters = a3c.push(
                variables, dataclasses.replace(contribution, gradients=gradients), self._config.max_staleness
            )
            traffic.bytes_in += gradient.nbytes + contribution.episodes.actions.nbytes
            if counters is None:
                traffic.dropped += 1
            else:
                traffic.updates += 1
                metrics = contribution.metrics | counters
                self._records.append(agent_lib.Update(seed, metrics, contribution.episodes))
        pulled = a3c.pull(variables, worker)
        parameters = torch.nn.utils.parameters_to_vector(variables.network.parameters()).detach().numpy()
        traffic.bytes_out += parameters.nbytes
        traffic.busy_seconds += time.perf_counter() - start
        return _Reply(pulled, parameters, not self._is_done() and not self._stopped)

    def restore(self, tensors) -> None:
        self._variables.restore(tensors)

    def take(self) -> _Taken:
        """What has happened since this was called last."""
        records, self._records = self._records, []
        return _Taken(records, self._variables.rounds.tolist(), self._is_done())

    def save(self) -> dict[str, torch.Tensor]:
        return self._variables.save()

    def traffic(self) -> Traffic:
        return self._traffic

    def stop(self) -> None:
        """Lets every worker end with the update that it is at."""
        self._stopped = True

    def _is_done(self) -> bool:
        return int(self._variables.frames) >= self._config.frames


def _split(vector: torch.Tensor, network: torch.nn.Module) -> list[torch.Tensor]:
    """The parts of a vector, each in the shape of a parameter."""
    parameters = list(network.parameters())
    parts = torch.split(vector, [parameter.numel() for parameter in parameters])
    return [part.view_as(parameter) for part, parameter in zip(parts, parameters, strict=True)]


class _Remote(a3c.Shared):
    """The parameter server as a worker sees it.

    With `overlaps`, the worker plays on while its gradient is on its way, with the parameters that came last: it looks
    at the answer one round later.
    """

    def __init__(self, server, seed: int, overlaps: bool):
        self._server, self._seed, self._overlaps = server, seed, overlaps
        self._reply: _Reply | None = None  # The last that was looked at.
        self._sent: Any = None  # What has not been answered yet, or not been looked at.
        self._rounds = 0

    @property
    def goes_on(self) -> bool:
        return self._reply is None or self._reply.goes_on

    def pull(self, network, worker):
        if self._reply is None:
            self._reply = self._answer(self._send(worker, None, None))
            self._rounds = self._reply.pulled.rounds
        torch.nn.utils.vector_to_parameters(torch.from_numpy(self._reply.parameters.copy()), network.parameters())
        return dataclasses.replace(self._reply.pulled, rounds=self._rounds)

    def push(self, contribution):
        vector = torch.cat([gradient.flatten().cpu() for gradient in contribution.gradients]).numpy()
        sent = self._send(contribution.worker, vector, dataclasses.replace(contribution, gradients=[]))
        self._rounds += 1
        before, self._sent = (self._sent, sent) if self._overlaps else (sent, None)
        if before is not None:
            self._reply = self._answer(before)
        assert self._reply is not None  # Parameters were pulled before anything could be learned.
        return {"frames": self._reply.pulled.frames, "updates": self._reply.pulled.updates}

    def save(self):
        return ray.get(self._server.save.remote())

    def restore(self, tensors):
        ray.get(self._server.restore.remote(tensors))
        self._reply = self._sent = None

    def flush(self) -> None:
        """Waits until everything that was sent has arrived."""
        if self._sent is not None:
            self._reply, self._sent = self._answer(self._sent), None

    def _send(self, worker: int, gradient: np.ndarray | None, contribution: a3c.Contribution | None):
        return self._server.exchange.remote(worker, self._seed, gradient, contribution)

    def _answer(self, sent) -> _Reply:
        try:
            return ray.get(sent)
        except ray.exceptions.RayActorError as error:
            raise agent_lib.VariablesLostError(f"the parameter server has died: {_first_line(error)}") from None


class Worker:
    """The actor that acts and learns."""

    def ready(self) -> None:
        """Answers once there is a process to do so."""

    def run(
        self,
        server,
        index: int,
        make_environment: agent_lib.EnvironmentFactory,
        config: config_lib.A3CConfig,
        versions: dict[str, str],
        find_versions: Callable[[], dict[str, str]],
    ) -> None:
        """Works until all frames are done or the server stops it.

        Raises:
          AgentError: if this machine has other versions than the driver's, or the loss is not finite.
          VariablesLostError: if the server dies.
        """
        own = find_versions()
        differing = [f"{name} {own[name]}, not {versions[name]}" for name in versions if own[name] != versions[name]]
        if differing:
            raise learning.AgentError(
                f"{ray.util.get_node_ip_address()} has {', '.join(differing)}; install the "
                "versions of the machine that trains"
            )
        torch.set_num_threads(1)
        # Alone, a worker learns the same as on one machine: it waits for what it has learned.
        shared = _Remote(server, agent_lib.worker_seed(config.seed, index), overlaps=config.num_workers > 1)
        a3c_agent.work(index, make_environment, config, shared, lambda: not shared.goes_on)
        shared.flush()


class DistributedA3C(agent_lib.Agent):
    """Runs the actors and hands out what they do. The cluster must have been joined with `ray.init`.

    Attributes:
      restarts: how often a worker that had died was started again.
    """

    def __init__(
        self,
        make_environment: agent_lib.EnvironmentFactory,
        config: config_lib.A3CConfig,
        find_versions: Callable[[], dict[str, str]],
        report: Callable[[str], None] = lambda line: None,
        patience: Patience = Patience(),
    ):
        """Prepares the variables; the actors start with `updates`.

        Args:
          make_environment: called in each worker; must be picklable, and its module installed on all machines.
          config: the configuration. Workers for which the cluster has no room yet join when it has.
          find_versions: says what is installed; it must say the same on every machine.
          report: called with a line when a worker has died, finds no room, or is silent.
          patience: how long is waited for whom.
        """
        self._make_environment, self._config = make_environment, config
        self._find_versions, self._report, self._patience = find_versions, report, patience
        environment = make_environment(config.seed, 1, 1)
        self._network = agent_lib.initial_network(environment, config)
        environment.close()
        self._tensors = learning.Variables(self._network, config.num_workers).save()
        self._server: Any = None
        self._stopping = False
        self._deaths: dict[int, int] = {}
        self.restarts = 0

    @property
    def frames(self):
        return int(self.save()["frames"])

    def save(self):
        """As `Agent.save`; raises VariablesLostError if the parameter server has died."""
        return self._ask("save") if self._server is not None else dict(self._tensors)

    def restore(self, tensors):
        learning.Variables(self._network, self._config.num_workers).restore(tensors)  # Refuses what does not fit.
        self._tensors = dict(tensors)

    def traffic(self) -> Traffic:
        """What the parameter server has done so far, while `updates` runs."""
        return self._ask("traffic")

    def stop(self):
        self._stopping = True

    def updates(self, poll_seconds=0.5):
        """As `Agent.updates`. A worker that dies is started again; it ends without those that were never placed.

        Raises:
          VariablesLostError: if the parameter server dies, or hangs. Restored, the agent can go on.
        """
        self._server = ray.remote(num_cpus=0)(ParameterServer).remote(self._network, self._tensors, self._config)
        make_worker = ray.remote(num_cpus=1, max_restarts=-1)(Worker)
        workers: list[Any] = [make_worker.remote() for _ in range(self._config.num_workers)]
        self._deaths = dict.fromkeys(range(len(workers)), 0)
        running: dict[Any, int] = {}
        coming: dict[Any, int] = {worker.ready.remote(): index for index, worker in enumerate(workers)}
        watch = _Watch(len(workers), self._patience, self._report)
        waited, deadline, done = time.monotonic(), None, False
        try:
            while running or (coming and not done):
                ended, _ = ray.wait([*running, *coming], timeout=_POLL_SECONDS)
                for reference in ended:
                    if reference in running:
                        index = running.pop(reference)
                        if self._has_finished(reference, index):
                            continue
                    else:
                        index = coming.pop(reference)
                        if _answers(reference):
                            running[self._run(workers[index], index)] = index
                            continue
                        time.sleep(_POLL_SECONDS)
                    coming[workers[index].ready.remote()] = index
                taken = self._ask("take")
                yield from taken.updates
                if taken.updates:
                    waited = time.monotonic()
                    self._deaths = dict.fromkeys(self._deaths, 0)
                elif time.monotonic() - waited > poll_seconds:
                    waited = time.monotonic()
                    yield None
                watch.look(running.values(), coming.values(), taken.rounds)
                done = taken.done or self._stopping
                if done and deadline is None:
                    self._ask("stop")
                    deadline = time.monotonic() + self._patience.stop
                if deadline is not None and time.monotonic() > deadline:
                    self._report(f"{_named(running.values())} did not end within {self._patience.stop:.0f} s: killed")
                    break
            yield from self._ask("take").updates
            self._tensors = self.save()
        finally:
            for actor in (*workers, self._server):
                ray.kill(actor)
            self._server = None

    def _run(self, worker, index: int):
        """Sets a worker to work."""
        return worker.run.remote(
            self._server, index, self._make_environment, self._config, self._find_versions(), self._find_versions
        )

    def _ask(self, question: str) -> Any:
        """Calls a method of the parameter server."""
        try:
            return ray.get(getattr(self._server, question).remote(), timeout=self._patience.answer)
        except ray.exceptions.GetTimeoutError:
            raise agent_lib.VariablesLostError(
                f"the parameter server has not answered for {self._patience.answer:.0f} s"
            ) from None
        except ray.exceptions.RayActorError as error:
            raise agent_lib.VariablesLostError(f"the parameter server has died: {_first_line(error)}") from None

    def _has_finished(self, reference, index: int) -> bool:
        """Whether a worker has ended of itself; one that has died is to be run again."""
        try:
            ray.get(reference)
        except ray.exceptions.RayActorError as error:
            if self._stopping:
                return True
            self.restarts += 1
            self._deaths[index] += 1
            if self._deaths[index] > _MAX_DEATHS:
                raise a3c_agent.WorkerError(
                    f"worker {index} has died {self._deaths[index]} times, and nobody has "
                    f"learned anything meanwhile: {_first_line(error)}"
                ) from None
            self._report(f"worker {index} has died ({_first_line(error)}) and is started again; {self.restarts} so far")
            return False
        except agent_lib.VariablesLostError as error:
            raise _cause(error) from None
        except learning.AgentError as error:
            raise a3c_agent.WorkerError(f"worker {index}: {_cause(error)}", _cause(error).batch) from None
        except ray.exceptions.RayTaskError as error:
            raise a3c_agent.WorkerError(f"worker {index}: {error}") from None
        return True


class _Watch:
    """Tells who has not been placed, and who is silent."""

    def __init__(self, num_workers: int, patience: Patience, report: Callable[[str], None]):
        self._patience, self._report = patience, report
        self._rounds: list[int] = []
        self._heard = [time.monotonic()] * num_workers
        self._silent: set[int] = set()
        self._without_room = 0
        self._crowded = time.monotonic()  # Since when the same number has no room.

    def look(self, running: Collection[int], coming: Collection[int], rounds: list[int]) -> None:
        """Looks at all workers.

        Args:
          running: those that have been placed.
          coming: those that have not, or are being started again.
          rounds: how many each has played.
        """
        now = time.monotonic()
        for index in range(len(self._heard)):
            if index not in running or not self._rounds or rounds[index] != self._rounds[index]:
                self._heard[index] = now
                if index in self._silent:
                    self._silent.remove(index)
                    self._report(f"worker {index} is back")
            elif now - self._heard[index] >= self._patience.silent and index not in self._silent:
                self._silent.add(index)
                self._report(
                    f"worker {index} has been silent for {self._patience.silent:.0f} s; training goes on with "
                    "those that are not"
                )
        self._rounds = rounds
        if not coming:
            self._crowded, self._without_room = now, 0
        elif now - self._crowded >= self._patience.room and len(coming) != self._without_room:
            self._without_room = len(coming)
            processors = ray.cluster_resources().get("CPU", 0)
            self._report(
                f"{len(coming)} of {len(self._heard)} workers find no room on the cluster, which has "
                f"{processors:g} processors; they join when there is some"
            )


def _named(indices: Collection[int]) -> str:
    return f"worker{'s' if len(indices) > 1 else ''} {', '.join(map(str, sorted(indices)))}"


def _answers(reference) -> bool:
    """Whether a worker that was asked is there again."""
    try:
        ray.get(reference)
    except ray.exceptions.RayActorError:
        return False
    return True


def _cause(error: Any) -> learning.AgentError:
    """What a worker raised: Ray wraps it."""
    return error.cause


def _first_line(error: Exception) -> str:
    return next(line.strip() for line in str(error).splitlines() if line.strip())
