"""Training on a cluster of Ray, two nodes on this machine, whoever dies meanwhile."""

import functools
import math
import os
from pathlib import Path
import signal
import socket
import subprocess
import sys
import tempfile
import threading
import time
import types

import commands
import pytest
import ray
from ray import cluster_utils
from seeds import fresh_seed
import torch
import trainers
from trainers import PHYSEXP
from waiting import Patience, wait_until

from physexp.agents import core, learning, rounds, starting
from physexp.agents.a3c import config as a3c_config
from physexp.agents.a3c import distributed
from physexp.agents.a3c import learning as a3c
from physexp.analysis.data import provenance
from physexp.analysis.experiments import EXPERIMENTS, base, cluster, reproduce
from physexp.analysis.training import playing, trainer
from physexp.analysis.training import run as run_lib

pytestmark = pytest.mark.long

QUICK = {"envs_per_worker": 64, "entropy_cost": 0.15, "final_entropy_cost": 0.03, "checkpoint_seconds": 1.0}
LEARNED = 0.6  # Chance is 0.25: 1000 guesses stay below 0.33.


@pytest.fixture(scope="module", autouse=True)
def not_nice():
    """Lets Ray's workers compete with other tests on equal terms; by default they wait until nobody else computes."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("RAY_worker_niceness", "0")
        yield


class Nodes:
    """A cluster of two nodes with one processor each."""

    def __init__(self):
        self.cluster = cluster_utils.Cluster(
            initialize_head=True, head_node_args={"num_cpus": 1, "include_dashboard": False}
        )

    @property
    def other(self):
        """The node that is not the head."""
        (node,) = self.cluster.worker_nodes
        return node

    def be_two(self):
        """Adds or removes what a test has left too few or too many."""
        while len(self.cluster.worker_nodes) > 1:
            self.cluster.remove_node(next(iter(self.cluster.worker_nodes)), allow_graceful=False)
        if not self.cluster.worker_nodes:
            self.cluster.add_node(num_cpus=1)
        self.cluster.wait_for_nodes(timeout=600)

    def processes(self, title):
        """Process ids of actors of a class, on both nodes."""
        raylets = {node.all_processes["raylet"][0].process.pid for node in self.cluster.list_all_nodes()}
        found = []
        for entry in Path("/proc").iterdir():
            if entry.name.isdigit():
                try:
                    parent = int((entry / "stat").read_text().rpartition(")")[2].split()[1])
                    command = (entry / "cmdline").read_bytes().decode()
                except (FileNotFoundError, ProcessLookupError):
                    continue
                if parent in raylets and command.startswith(f"ray::{title}"):
                    found.append(int(entry.name))
        return found


@pytest.fixture(scope="module")
def made_nodes(not_nice):
    made = Nodes()
    yield made
    made.cluster.shutdown()


@pytest.fixture
def nodes(made_nodes):
    """The cluster, which tests use in turn: each finds two nodes on which nobody works."""
    made_nodes.be_two()
    ray.init(address=made_nodes.cluster.address, logging_level="ERROR", log_to_driver=False)
    yield made_nodes
    ray.shutdown()  # With all actors and tasks of this test.
    working = ("Worker", "ParameterServer", "work_elsewhere")
    wait_until(lambda: not any(made_nodes.processes(title) for title in working), "the end of what has worked")


def train_meanwhile(run, disturb):
    """Trains on the cluster while something happens; returns what training told.

    `disturb` is given what training tells, and a way to wait until training has come so far.
    """
    told, failed = [], []

    def train():
        try:
            trainer.train(run, on_cluster=True, tell=told.append)
        except BaseException as error:
            failed.append(error)

    def wait_for(condition, what):
        wait_until(lambda: condition() or not training.is_alive(), what)
        assert training.is_alive(), f"training was over before {what}: {failed or told}"

    training = threading.Thread(target=train, daemon=True)
    training.start()
    disturb(told, wait_for)
    wait_until(lambda: not training.is_alive(), "the end of training", busy_seconds=3600.0)
    assert not failed, failed
    return told


def assert_learned_and_recorded(run):
    tensors, facts = run.checkpointer.latest()
    frames = [row["frames"] for row in run.metrics()]
    assert frames == sorted(set(frames)) and frames[-1] == int(tensors["frames"]) >= run.config.agent.frames
    assert run.metrics()[-1]["updates"] == int(tensors["updates"]) == int(tensors["rounds"].sum())
    # Every update is one round: none was lost, none was recorded twice.
    assert run.metrics()[-1]["episodes"] == facts["episodes"] == 64 * int(tensors["updates"])
    figures = playing.evaluate(run, 1000).summary(0.95)
    print(figures)
    assert figures["success_rate"] > LEARNED


def has_trained(run, frames):
    rows = run.checkpointer.paths()
    return bool(rows) and int(rows[-1].stem) > frames


def test_whoever_dies_training_ends_as_if_nobody_had(nodes, tmp_path):
    # One after the other: a worker, the parameter server, and a node with whatever runs there.
    # However old a gradient is, it is applied: a worker that has just started may be slower than a hundred updates.
    run = trainers.create(
        tmp_path / "run", frames=400_000, num_workers=2, max_staleness=10**9, seed=fresh_seed(), **QUICK
    )

    def disturb(told, wait_for):
        wait_for(lambda: has_trained(run, 0), "a checkpoint")
        wait_for(lambda: len(nodes.processes("Worker")) == 2, "two workers")
        (victim, other) = nodes.processes("Worker")
        os.kill(victim, signal.SIGKILL)
        killed = time.monotonic()
        wait_for(lambda: len(set(nodes.processes("Worker")) - {victim, other}) == 1 and told, "another worker")
        print("another worker after", time.monotonic() - killed, "s")
        (server,) = nodes.processes("ParameterServer")
        os.kill(server, signal.SIGKILL)
        wait_for(lambda: nodes.processes("ParameterServer") not in ([], [server]), "another server")
        killed = int(run.checkpointer.paths()[-1].stem)
        wait_for(lambda: has_trained(run, killed), "a checkpoint after the server was killed")
        nodes.cluster.remove_node(nodes.other, allow_graceful=False)
        nodes.cluster.add_node(num_cpus=1)

    told = train_meanwhile(run, disturb)
    print(told)
    assert any("worker" in line and "has died" in line and "1 so far" in line for line in told)
    assert any("the parameter server has died" in line and "goes on from the last checkpoint" in line for line in told)
    assert_learned_and_recorded(run)


@pytest.mark.parametrize("task, frames", [("features", 20_000), ("pixels", 2_000)])
def test_one_worker_on_a_cluster_learns_the_same_as_here_to_the_last_bit(nodes, tmp_path, task, frames):
    seed = fresh_seed()
    here, there = (trainers.create(tmp_path / name, task=task, frames=frames, seed=seed) for name in ("here", "there"))
    trainer.train(here)
    trainer.train(there, on_cluster=True)
    for name, value in here.checkpointer.latest()[0].items():
        assert torch.equal(value, there.checkpointer.latest()[0][name]), name


def test_workers_that_find_no_room_join_when_there_is_some(nodes, tmp_path):
    run = trainers.create(tmp_path / "run", frames=10**9, num_workers=3, seed=fresh_seed(), **QUICK)
    agent = trainer.make_agent(run.config, on_cluster=True)
    seen, added = set(), False
    patience = Patience()
    for update in agent.updates():
        assert not patience.is_over(), patience
        if update is None:
            continue
        seen.add(update.seed)
        if len(seen) == 2 and not added:  # Two processors, three workers.
            nodes.cluster.add_node(num_cpus=1)
            added = True
        if len(seen) == 3:
            agent.stop()
    assert seen == {starting.worker_seed(run.config.agent.seed, worker) for worker in range(3)}


def test_a_machine_with_other_versions_is_refused_in_one_line_that_names_both(nodes, tmp_path):
    run = trainers.create(tmp_path / "run", frames=10_000)
    environments = functools.partial(trainer.make_environment, run.config)
    trainer_pid = os.getpid()
    agent = distributed.DistributedA3C(
        environments, run.config.agent, lambda: {"mujoco": "3.17.0" if os.getpid() == trainer_pid else "3.16.0"}
    )
    with pytest.raises(core.WorkerError, match=r"has mujoco 3\.16\.0, not 3\.17\.0; install") as caught:
        list(agent.updates())
    assert "\n" not in str(caught.value)


def test_a_loss_that_is_not_a_number_stops_training_and_leaves_the_batch(nodes, tmp_path):
    run = trainers.create(tmp_path / "run", frames=10**9)
    trainers.save_first_checkpoint(run, poison=True)
    with pytest.raises(RuntimeError, match="worker 0: loss -?(inf|nan).*failed_batch.npz.*last checkpoint"):
        trainer.train(run, on_cluster=True)
    assert (run.path / "failed_batch.npz").exists()


def test_ppo_on_a_cluster_is_refused(tmp_path):
    run = trainers.create(tmp_path / "run", "ppo")
    with pytest.raises(ValueError, match="agent is ppo, which has one process; on a cluster train a3c"):
        trainer.train(run, on_cluster=True)


def test_a_gradient_that_is_too_old_is_not_applied():
    batch_config = a3c_config.A3CConfig(num_workers=1, max_staleness=2)
    network = torch.nn.Linear(2, 1)
    variables = learning.Variables(network)
    gradients = [torch.ones_like(parameter) for parameter in network.parameters()]
    episodes = rounds.Round(
        actions=torch.zeros(1, 1).numpy(),
        rewards=torch.zeros(1, 1).numpy(),
        lengths=torch.ones(1, dtype=int).numpy(),
        answers=torch.zeros(1).numpy(),
    )
    variables.updates += 3

    def push(updates):
        contribution = a3c.Contribution(0, a3c.Pulled(0, updates, 0), gradients, 0.1, {}, episodes)
        return a3c.push(variables, contribution, batch_config.max_staleness)

    before = network.weight.clone()
    assert push(0) is None  # Three others have come in between.
    assert torch.equal(network.weight, before) and int(variables.frames) == 0
    assert int(variables.rounds[0]) == 1, "the round is over all the same"
    assert push(1)["staleness"] == 2
    assert not torch.equal(network.weight, before) and int(variables.frames) == 1


def test_a_sweep_gathers_what_the_cluster_made_and_survives_a_killed_task(nodes, tmp_path):
    results, lines, killed = base.Results(tmp_path), [], []

    def kill_one():
        wait_until(lambda: nodes.processes("work_elsewhere"), "a task")
        killed.append(nodes.processes("work_elsewhere")[0])
        os.kill(killed[0], signal.SIGKILL)

    def sweep():
        reproduce.run(
            [EXPERIMENTS["population"]],
            results,
            observations=("features",),
            num_seeds=1,
            frames=5_000,
            submit=cluster.submit,
            tell=lines.append,
        )

    killer = threading.Thread(target=kill_one)
    killer.start()
    sweep()
    killer.join()
    assert killed
    assert sum(line.startswith("done: ") for line in lines) == 3
    assert not any(line.startswith("FAILED") for line in lines)
    assert len(list(tmp_path.glob("runs/*/agent.safetensors"))) == 3
    assert not list(tmp_path.rglob("checkpoints"))
    assert (tmp_path / "figures" / "population.png").exists()
    lines.clear()
    sweep()
    assert lines[0] == "3 of 3 agents are done"


def test_training_ends_without_workers_that_find_no_room_and_says_how_many(nodes, tmp_path):
    config = trainers.create(tmp_path / "run", frames=10**9, num_workers=3, envs_per_worker=8).config
    lines = []
    agent = distributed.DistributedA3C(
        functools.partial(trainer.make_environment, config),
        config.agent,
        provenance.versions,
        lines.append,
        distributed.Patience(room=0.0),
    )
    updates, num_updates = agent.updates(poll_seconds=0.05), 0
    # Two processors, three workers: the two that are placed were without room for as long as they took to start.
    sought = "1 of 3 workers find no room on the cluster, which has 2 processors; they join when there is some"
    patience = Patience()
    while sought not in lines or not num_updates:
        assert not patience.is_over(), (patience, lines)
        num_updates += next(updates) is not None
    agent.stop()
    num_updates += sum(update is not None for update in updates)
    assert num_updates == int(agent.save()["updates"])


def test_stopped_processes_of_a_cluster_hang_nobody(nodes, tmp_path):
    config = trainers.create(tmp_path / "run", frames=10**9, num_workers=1, envs_per_worker=2).config
    lines = []
    patience = types.SimpleNamespace(room=math.inf, silent=math.inf, stop=math.inf, answer=150.0)
    agent = distributed.DistributedA3C(
        functools.partial(trainer.make_environment, config), config.agent, provenance.versions, lines.append, patience
    )
    updates = agent.updates(poll_seconds=0.05)
    assert any(update is not None for update in updates)
    (worker,) = nodes.processes("Worker")
    os.kill(worker, signal.SIGSTOP)
    patience.silent = patience.stop = 0.3
    assert any("worker 0 has been silent since" in line for _ in updates for line in lines)
    agent.stop()
    list(updates)
    assert lines[-1] == "worker 0 did not end within 0 s: killed"
    wait_until(lambda: not Path(f"/proc/{worker}").exists(), "the end of a stopped worker")


def test_a_parameter_server_that_does_not_answer_counts_as_dead(nodes, tmp_path):
    config = trainers.create(tmp_path / "run", frames=10**9, num_workers=1, envs_per_worker=2).config
    patience = types.SimpleNamespace(room=math.inf, silent=math.inf, stop=math.inf, answer=150.0)
    agent = distributed.DistributedA3C(
        functools.partial(trainer.make_environment, config), config.agent, provenance.versions, patience=patience
    )
    updates = agent.updates(poll_seconds=0.05)
    assert any(update is not None for update in updates)
    (server,) = nodes.processes("ParameterServer")
    os.kill(server, signal.SIGSTOP)
    patience.answer = 0.3
    with pytest.raises(core.VariablesLostError, match="the parameter server has not answered for 0 s"):
        list(updates)
    wait_until(lambda: not Path(f"/proc/{server}").exists(), "the end of a stopped server")


def test_the_command_trains_on_a_cluster_that_it_starts_itself_and_that_only_this_machine_reaches(tmp_path):
    command = [
        PHYSEXP,
        "train",
        "which_is_heavier",
        "features",
        "--agent",
        "a3c",
        "--frames",
        "2000",
        "--envs-per-worker",
        "32",
        "--run-dir",
        tmp_path / "run",
        "--cluster",
        "local",
    ]
    addresses, modes = set(), set()
    with tempfile.TemporaryDirectory(prefix="T") as short:  # Names of sockets have at most 107 letters.
        environment = {**os.environ, "HOME": str(tmp_path), "TMPDIR": short}
        with subprocess.Popen(list(map(str, command)), stdout=subprocess.PIPE, text=True, env=environment) as process:
            while process.poll() is None:
                addresses |= {address for address, _ in commands.listening(process.pid)}
                modes |= {folder.stat().st_mode & 0o777 for folder in Path(short).glob("ray*")}
                time.sleep(0.1)
            output = process.stdout.read()
        assert modes == {0o700}, "no other user reaches its sockets"
        assert not list(Path(short).glob("ray*"))
    assert process.returncode == 0
    assert output.splitlines()[-1] == str(tmp_path / "run")
    assert run_lib.Run(tmp_path / "run").is_finished
    assert addresses and addresses <= {"127.0.0.1", "::1", "::ffff:127.0.0.1"}
    assert (tmp_path / ".ray" / "auth_token").stat().st_mode & 0o077 == 0


def test_a_head_that_does_not_answer_is_one_readable_line(monkeypatch):
    monkeypatch.setattr(cluster, "HEALTH_SECONDS", 3.0)
    with socket.create_server(("127.0.0.1", 0)) as mute:
        address = f"127.0.0.1:{mute.getsockname()[1]}"
        message = f"cannot join the cluster {address}: no head of Ray answers there within 3 s"
        with pytest.raises(ValueError, match=message), cluster.joined(address):
            pass


@pytest.mark.parametrize("address, words", [("127.0.0.1:1", "refused"), ("nowhere", "give HOST:PORT, auto or local")])
def test_a_cluster_that_is_not_there_is_one_readable_line(address, words, tmp_path):
    options = ["--agent", "a3c", "--run-dir", tmp_path / "run", "--cluster", address]
    done = commands.run("train", "which_is_heavier", "features", *options)
    assert done.returncode == 2, done.stderr
    assert done.stderr.count("\n") == 1
    assert f"cannot join the cluster {address}" in done.stderr and words in done.stderr


def test_nothing_but_a_cluster_imports_ray():
    modules = "physexp.cli, physexp.analysis.training.trainer, physexp.analysis.experiments.reproduce"
    code = f"import sys, {modules}; sys.exit('ray' in sys.modules)"
    subprocess.run([sys.executable, "-c", code], check=True)
