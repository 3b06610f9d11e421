"""Sweeps on a cluster of Ray, whose one node is on this machine."""

import contextlib
import socket
import subprocess
import sys
import threading

import psutil
import pytest
import ray
from ray import cluster_utils
from waiting import wait_until

from physexp.analysis.experiments import base, cluster, sweep

TASK = "which_is_heavier/features"


@pytest.fixture
def node(monkeypatch):
    """The head of a cluster, with one core: the jobs of a sweep share the imports of one process."""
    monkeypatch.setenv("RAY_worker_niceness", "0")  # Its workers compete with other tests on equal terms.
    head = {"num_cpus": 1, "include_dashboard": False}
    made = cluster_utils.Cluster(initialize_head=True, head_node_args=head)
    yield made.head_node
    ray.shutdown()
    made.shutdown()


def job_process(node):
    """The process of a job; None while there is none."""
    for process in psutil.Process(node.all_processes["raylet"][0].process.pid).children():
        with contextlib.suppress(psutil.NoSuchProcess):
            if " ".join(process.cmdline()).startswith("ray::work_elsewhere"):
                return process
    return None


@pytest.mark.long
def test_a_sweep_gathers_all_rows_from_a_cluster_where_a_job_is_killed(node, tmp_path):
    jobs = sweep.grid([TASK], ["ppo"], range(2), 300, 50)
    results, lines, killed = base.Results(tmp_path), [], []

    def kill_one():
        killed.append(wait_until(lambda: job_process(node), "a job"))
        killed[0].kill()

    killer = threading.Thread(target=kill_one)
    with cluster.Cluster(node.address) as pool:
        killer.start()
        sweep.run(jobs, results, pool, 1, lines.append)
    killer.join()
    assert killed and sum(line.startswith("done: ") for line in lines) == 2
    assert len(results.played()) == len(sweep.table(jobs, results)) == 2
    assert all(results.run(job.config).agent_path.exists() for job in jobs)
    assert sweep.to_do(jobs, results) == []


def test_a_cluster_that_is_not_there_is_an_error(monkeypatch):
    monkeypatch.setattr(cluster, "HEALTH_SECONDS", 1.0)
    with socket.create_server(("127.0.0.1", 0)) as mute:
        address = f"127.0.0.1:{mute.getsockname()[1]}"
        with pytest.raises(ValueError, match=f"cannot join the cluster {address}: no head of Ray answers there"):
            cluster.Cluster(address)
    with pytest.raises(ValueError, match=r"cannot join the cluster 127.0.0.1:1: .*refused"):
        cluster.Cluster("127.0.0.1:1")
    with pytest.raises(ValueError, match="cannot join the cluster nowhere: give HOST:PORT or auto"):
        cluster.Cluster("nowhere")


def test_nothing_but_a_cluster_imports_ray():
    modules = "physexp.cli.commands, physexp.analysis.experiments.reproduce, physexp.analysis.experiments.pools"
    code = f"import sys, {modules}; sys.exit('ray' in sys.modules)"
    subprocess.run([sys.executable, "-c", code], check=True)
