"""The settings of a calling process stay as they are, and results do not depend on them."""

import json

import interpreters
import pytest

ODD = """
import random, signal, warnings
import matplotlib.style, numpy as np, rerun, torch
matplotlib.use("svg")
matplotlib.style.use("dark_background")
matplotlib.rcParams["font.size"] = 23
torch.set_default_dtype(torch.float64)
torch.set_num_threads(3)
torch.set_grad_enabled(False)
torch.manual_seed(7), np.random.seed(7), random.seed(7)
rerun.set_strict_mode(False)
warnings.filterwarnings("ignore", "a warning of the caller's")
for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGUSR1):
    signal.signal(number, lambda *_: None)
"""

# Some libraries change settings when they are imported; they are imported first.
SETTINGS = """
import hashlib, random, signal, sys, warnings
from pathlib import Path
import matplotlib, numpy as np, rerun, torch
import rich.progress, scipy.sparse, scipy.special, stable_baselines3, torch._dynamo
def settings():
    return {
        "torch's random state": hashlib.sha256(torch.get_rng_state().numpy().tobytes()).hexdigest(),
        "numpy's random state": hashlib.sha256(repr(np.random.get_state()).encode()).hexdigest(),
        "Python's random state": hashlib.sha256(repr(random.getstate()).encode()).hexdigest(),
        "threads": torch.get_num_threads(),
        "type": str(torch.get_default_dtype()),
        "gradients": torch.is_grad_enabled(),
        "matplotlib": {name: str(value) for name, value in dict.items(matplotlib.rcParams)},
        "strict": rerun.strict_mode(),
        "numpy's errors": np.geterr(),
        "warnings": [str(entry) for entry in warnings.filters],
        "signals": [str(signal.getsignal(number)) for number in sorted(signal.valid_signals())],
    }
before = settings()
"""

ACTS = {
    "import": """
import physexp.cli.commands, physexp.suite.gymnasium, physexp.suite.stable_baselines
from physexp.agents import pretrained, registry
from physexp.analysis import replay
from physexp.analysis.experiments import report
from physexp.analysis.training import trainer
""",
    "play": """
from physexp import suite
for task in ("features", "pixels"):
    environment = suite.load("threshold", task, {"random": 0})
    timestep = environment.reset()
    environment.render()
    result.append(hashlib.sha256(b"".join(value.tobytes() for value in timestep.observation.values())).hexdigest())
    environment.close()
""",
    "load_pretrained": """
from physexp import agents, suite
from physexp.agents import environment_loop
environment = suite.load("towers", "fist_features", {"random": 0})
actor = agents.load_pretrained("towers", "fist_features", seed=1)
result.append(environment_loop.EnvironmentLoop(environment, actor).run(3))
result.append(actor.policy.tolist())
environment.close()
""",
    "train": """
from physexp.agents.belief import config as belief
from physexp.agents.ppo import config as ppo
from physexp.analysis.training import playing
from physexp.analysis.training import config as config_lib, run as run_lib, trainer
agents = [
    ppo.PPOConfig(num_threads=1, num_environments=16, num_minibatches=2, frames=300),
    belief.BeliefConfig(frames_per_update=64, frames=300),
]
for agent in agents:
    run = run_lib.Run(Path(agent.algorithm))
    trainer.train(run, start=config_lib.TrainConfig(domain="which_is_heavier", task="features", agent=agent))
    tensors, _ = run.checkpointer.latest()
    result.append({name: hashlib.sha256(value.numpy().tobytes()).hexdigest() for name, value in tensors.items()})
    result.append(playing.evaluate(run, 50).summary(0.95))
""",
    "draw": """
from physexp.analysis.data import plots
with plots.style():
    figure, axes = plots.new()
    axes.plot([1, 2, 3], label="a line")
    axes.legend()
result.append(hashlib.sha256(plots.svg(figure) + plots.png(figure)).hexdigest())
""",
    "replay": """
from physexp.analysis import replay
path = replay.replay(["threshold/features"], 1, Path("replay.rrd"))
result.append(path.stat().st_size > 0)
""",
}


def code_of(start, folder):
    """Returns a program that does all acts; `found` has their results, and the settings before and after each."""
    folder.mkdir()
    code = f"import os\nos.chdir({str(folder)!r})\n{start}{SETTINGS}found.update(before=before)\n"
    return code + "".join(f"result = []\n{act}\nfound[{name!r}] = [result, settings()]\n" for name, act in ACTS.items())


@pytest.mark.long
def test_settings_stay_and_results_do_not_depend_on_them(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    odd, _ = interpreters.run(code_of(ODD, tmp_path / "odd"))
    usual = {}  # Of this process, which has imported everything.
    exec(code_of("", tmp_path / "usual"), {"found": usual, "__name__": "acts"})
    usual = json.loads(json.dumps(usual))
    for act in ACTS:
        for found in (usual, odd):
            for name, value in found["before"].items():
                assert found[act][1][name] == value, (act, name)
        assert odd[act][0] == usual[act][0], act
