"""The command line as a user runs it: through the entry point, in this process unless a test needs another."""

import contextlib
import dataclasses
import errno
import json
import os
from pathlib import Path
import re
import shlex
import subprocess
import sys

import evaluation_figures
import interpreters
import pytest
from rerun.chunk import RrdReader

import physexp
from physexp import checks, cli, extras, suite
from physexp.agents import files
from physexp.analysis import domains
from physexp.analysis.training import config as config_lib
from physexp.analysis.training import progress
from physexp.cli import commands, doctor, ideal, parsing, printing

PHYSEXP = Path(sys.executable).with_name("physexp")
MISSING = "the following arguments are required:"


@dataclasses.dataclass
class Done:
    """The exit status of a command and its outputs."""

    returncode: int
    stdout: str
    stderr: str


@pytest.fixture
def run(monkeypatch, capsys, tmp_path):
    """A function that runs the command with some arguments in an empty folder."""
    monkeypatch.chdir(tmp_path)

    def run(*arguments):
        monkeypatch.setattr(sys, "argv", ["physexp", *map(str, arguments)])
        capsys.readouterr()
        try:
            cli.main()
            status = 0
        except SystemExit as error:
            status = error.code or 0
        return Done(status, *capsys.readouterr())

    return run


def words_of(text):
    """A help text without its line ends."""
    return " ".join(text.split())


def assert_refused(done, *words):
    """Asserts one line on standard error, exit status 2 and nothing else."""
    assert (done.returncode, done.stdout, len(done.stderr.splitlines())) == (2, "", 1), done
    for word in words:
        assert word in done.stderr


# Help.


def test_help_is_quick_since_it_imports_no_heavy_library():
    found, _ = interpreters.run("""
import contextlib, io, sys
from physexp import cli
from physexp.cli import commands
for words in ([], *([name] for name in commands.COMMANDS)):
    sys.argv = ["physexp", *words, "--help"]
    with contextlib.redirect_stdout(io.StringIO()), contextlib.suppress(SystemExit):
        cli.main()
    for name in ("torch", "mujoco", "dm_control", "scipy", "pyarrow", "rich"):
        if name in sys.modules:
            found.setdefault(name, words)
""")
    assert found == {}


def test_every_argument_has_a_help_text(run):
    assert all(f"  {name} " in run("--help").stdout for name in commands.COMMANDS)
    for name, kind in commands.COMMANDS.items():
        text = words_of(run(name, "--help").stdout)
        for field in dataclasses.fields(kind):
            assert not field.metadata or words_of(field.metadata["help"]) in text, (name, field.name)
    ideals = [domain.ideal.options for domain in domains.DOMAINS.values() if domain.ideal]
    for kind in [*map(suite.options, suite.TASKS_BY_DOMAIN), *config_lib.ALGORITHMS.values(), *ideals]:
        helps = checks.help_of(kind)
        assert all(helps.get(field.name) for field in dataclasses.fields(kind)), kind


@pytest.mark.parametrize("algorithm", config_lib.ALGORITHMS)
def test_help_of_a_task_and_a_learner_tells_the_true_defaults(run, algorithm):
    text = run("train", "towers", "fist_features", "--agent", algorithm, "--help").stdout
    assert f"(default: {config_lib.DEFAULT_ALGORITHM})" in words_of(text)
    preset = config_lib.preset("towers", "fist_features", algorithm=algorithm)
    options = dict(re.findall(r"^  --([\w-]+)(.*(?:\n {10}.*)*)", text, re.MULTILINE))
    for name, value in dataclasses.asdict(preset).items():
        shown = f"{value:g}" if isinstance(value, float) else str(value)
        told = words_of(options[name.replace("_", "-")])
        assert told.endswith(f"(default: {shown})") or value in (False, ()) or isinstance(value, tuple), name
    assert parsing.parse(["train", "towers", "fist_features", "--agent", algorithm]).config == preset


def test_help_after_a_domain_lists_its_options(run):
    for domain in suite.TASKS_BY_DOMAIN:
        names = {field.name.replace("_", "-") for field in dataclasses.fields(suite.options(domain))}
        for arguments in (["train", domain], ["play", domain, "features"], ["evaluate", f"{domain}/features"]):
            text = run(*arguments, "--help").stdout
            assert all(f"--{name}" in text for name in names - {"random", "visualize-reward"})
            assert "--random" not in text and "--visualize-reward" not in text
    text = run("evaluate", "--help").stdout
    assert "--help after it lists" in words_of(text) and "--difficulty" not in text


def test_the_version_is_the_packages(run):
    assert run("--version") == Done(0, f"physexp {physexp.__version__}\n", "")
    module = subprocess.run(
        [sys.executable, "-m", "physexp.cli", "--version"], capture_output=True, text=True, check=True
    )
    assert module.stdout == f"physexp {physexp.__version__}\n"


# Arguments.


@pytest.mark.parametrize(
    "arguments",
    [
        ["which_is_heavier", "features", "--difficulty", "3"],
        ["--run-dir", "towers", "--difficulty=3", "which_is_heavier/features"],
        ["--resume", "which_is_heavier", "--difficulty", "3", "--no-relative-pixels", "features"],
    ],
)
def test_options_of_domain_and_learner_stand_anywhere(arguments):
    train = parsing.parse(["train", *arguments, "--agent", "a3c"])
    assert (train.domain, train.task, train.task_kwargs) == ("which_is_heavier", "features", {"difficulty": 3.0})
    preset = config_lib.preset("which_is_heavier", "features", algorithm="a3c")
    assert train.config == preset.replace(**train.hyperparameters)


@pytest.mark.parametrize(
    ("one", "two"),
    [
        ("train threshold/features --seed 3", "train --seed 3 threshold features"),
        ("ideal strings/features --json", "ideal strings features --json"),
        ("evaluate threshold/features --greedy", "evaluate --greedy threshold features"),
        ("replay towers/fist_features --compare a/b", "replay towers fist_features --compare=a/b"),
        ("score silent --tasks towers/fist_features", "score silent --tasks towers fist_features"),
    ],
)
def test_a_task_is_given_in_one_word_or_in_two(one, two):
    first, second = (parsing.parse(words.split()) for words in (one, two))
    assert {**vars(first), "words": "/".join(getattr(first, "words", ()))} == {
        **vars(second),
        "words": "/".join(getattr(second, "words", ())),
    }


@pytest.mark.parametrize(
    ("line", "words"),
    [
        ("train which_is_heaviest features", ["which_is_heaviest", "which_is_heavier", "towers"]),
        ("train towers feet", ["feet", "fist_features", "direct_features"]),
        ("train which_is_heavier features --difficulty 0.5", ["difficulty is 0.5"]),
        ("train towers fist_features --control-timestep 0.0123", ["0.0123"]),
        ("train towers fist_features --agent a3c --discount 2", ["discount is 2.0; give a number from 0 to 1"]),
        ("train which_is_heavier features --resume --run-dir no/such/run", ["holds no run"]),
        ("play towers feet", ["feet", "fist_features"]),
        ("ideal towers/feet", ["task_name is 'feet'", "fist_features", "direct_features"]),
        ("ideal towers --reveal --resolution 0.001", ["resolution is 0.001", "leave it out with reveal"]),
        ("ideal nowhere", ["'nowhere'", "choose from which_is_heavier"]),
        ("evaluate no/such/run", ["no/such/run", "holds no run"]),
        ("evaluate threshold/features --seed -1", ["the seed, is -1; give an integer"]),
    ],
)
def test_a_command_that_cannot_be_done_is_refused_in_one_line(run, line, words):
    assert_refused(run(*line.split()), *words)
    assert not os.listdir(), "a refused run leaves no folder"


@pytest.mark.parametrize(
    ("line", "message"),
    [
        ("", f"give a command: {', '.join(commands.COMMANDS)}; see physexp --help"),
        ("fly", f"'fly' is no command; choose from {', '.join(commands.COMMANDS)}; see physexp --help"),
        ("train", f"{MISSING} DOMAIN TASK; see physexp train --help"),
        ("evaluate a b", "'b' is one argument too many; see physexp evaluate --help"),
        ("evaluate a --sed=3", "--sed is no option; perhaps --seed; see physexp evaluate --help"),
        ("train towers/fist_features --ZZ 1", "--ZZ is no option; see physexp train --help"),
        (
            "train towers/fist_features --difficulty 3",
            "--difficulty is not an option of towers nor of --agent belief; leave it out; see physexp train --help",
        ),
        (
            "train towers/fist_features --agent ppo --agent a3c --num_minibatches 1",
            "--num-minibatches is not an option of towers nor of --agent a3c; leave it out; see physexp train --help",
        ),
        (
            "ideal towers --num-blocks 3",
            "--num-blocks is not an option of towers; leave it out; see physexp ideal --help",
        ),
        ("evaluate a --episodes many", "--episodes: invalid int value: 'many'; see physexp evaluate --help"),
        ("evaluate a --seed", "--seed: expected one argument; see physexp evaluate --help"),
    ],
)
def test_a_mistyped_command_line_is_answered_in_one_line(run, line, message):
    assert run(*line.split()) == Done(2, "", f"physexp: {message}\n")


def test_a_negative_number_with_an_exponent_is_no_option(run):
    line = "train towers/fist_features --agent a3c --initial-logits"
    for given in (f"{line} -1e-05 1 -2.", f"{line}=-1e-05 --initial-logits 1 -2"):
        assert parsing.parse(given.split()).hyperparameters == {"initial_logits": (-1e-05, 1.0, -2.0)}
    assert_refused(run("train", "threshold/features", "--noise", "-1e-05"), "noise is -1e-05; give a number from 0")


def test_an_empty_argument_is_refused(run):
    assert_refused(run("train", "threshold", "features", "--run-dir", ""), "an argument is empty")
    assert_refused(run("evaluate", "x", "--interaction", "y"), "invalid choice: 'y'", "learned", "random")


@pytest.mark.parametrize(
    ("line", "without", "message"),
    [
        ("reproduce all --cluster local", ["ray"], "ray is not installed; pip install 'physexp[ray]'"),
        ("demo", ["matplotlib"], "matplotlib is not installed; pip install 'physexp[figures]'"),
        (
            "bench peers",
            ["stable_baselines3", "sb3_contrib"],
            "stable_baselines3 and sb3_contrib are not installed; pip install 'physexp[sb3]'",
        ),
    ],
)
def test_a_missing_extra_is_named_before_any_work(run, monkeypatch, line, without, message):
    for module in without:
        monkeypatch.setitem(sys.modules, module, None)  # Cannot be imported or found.
    assert run(*line.split()) == Done(2, "", f"physexp: {message}\n")
    assert not os.listdir()


def test_the_adapters_name_the_extra_that_they_need(monkeypatch):
    adapters = ("gymnasium", "gymnasium", "gymnasium"), ("stable_baselines", "stable_baselines3", "sb3")
    for adapter, library, extra in adapters:
        with monkeypatch.context() as context:
            context.delitem(sys.modules, f"physexp.suite.{adapter}", raising=False)
            context.setitem(sys.modules, library, None)
            with pytest.raises(extras.MissingExtraError, match=rf"pip install 'physexp\[{extra}\]'"):
                __import__(f"physexp.suite.{adapter}")


# Output.


def test_tasks_lists_every_task_with_its_numbers_and_observations(run):
    rows = json.loads(run("tasks", "--json").stdout)
    assert [(row["domain"], row["task"]) for row in rows] == [tuple(names) for names in suite.ALL_TASKS]
    for row in rows:
        task = suite.load_task(row["domain"], row["task"])
        numbers = (task.num_interactions, task.num_labels, task.rules.step_limit, task.discount)
        assert (row["interactions"], row["labels"], row["step_limit"], row["discount"]) == numbers
        assert row["observations"].keys() == task.observation_spec().keys() and row["question"].endswith("?")
    lines = run("tasks").stdout.splitlines()
    assert "towers: How many rigid bodies is the tower made of?" in lines
    (fist,) = [line for line in lines if line.startswith("fist_features")]
    assert words_of(fist) == "fist_features 4 5 26 0.98 positions float32 [5, 3], fist_position float32 [3]"


def test_a_table_in_a_pipe_has_a_line_for_each_row(capsys):
    rows = [{"name": "a", "text": "x" * 500}, {"name": "[b]", "text": "two words"}]
    printing.show(rows)
    assert capsys.readouterr().out == f"name  text\na     {'x' * 500}\n[b]   two words\n"


def test_doctor_advises_on_extras_display_and_threads(run, monkeypatch):
    monkeypatch.delenv("WAYLAND_DISPLAY", raising=False)
    monkeypatch.setenv("DISPLAY", "")
    monkeypatch.setenv("OMP_NUM_THREADS", "100000")
    monkeypatch.setitem(sys.modules, "tensorboard", None)
    done = run("doctor", "--json")
    facts = json.loads(done.stdout)
    assert all(facts[name] for name in ("python", "physexp", "mujoco", "torch", "processors", "gpu", "gl_renderer"))
    found = {check["check"]: check for check in facts["checks"]}
    assert all(bool(check["advice"]) == (check["verdict"] != doctor.OK) for check in found.values())
    missing = {name for name, check in found.items() if check["verdict"] == doctor.MISSING}
    assert done.returncode == 0
    assert {"display", "OMP_NUM_THREADS", "extra tensorboard"} <= missing and "extra figures" not in missing
    assert found["extra tensorboard"]["advice"] == "pip install 'physexp[tensorboard]'"


def test_doctor_ends_with_status_1_only_if_the_core_is_broken(run, monkeypatch):
    monkeypatch.setitem(sys.modules, "rerun", None)
    done = run("doctor")
    assert done.returncode == 1 and f"import rerun {doctor.BROKEN}" in words_of(done.stdout)


def test_evaluate_prints_the_same_statistics_as_text_and_as_json(run, untrained):
    names = [*evaluation_figures.NAMES, *evaluation_figures.IDEAL]
    outputs = []
    for more in ([], [], ["--interaction", "random"], ["--greedy"], ["--seed", 3]):
        found = json.loads(run("evaluate", untrained.path, "--episodes", 40, "--json", *more).stdout)
        assert list(found) == names and found["episodes"] == 40
        low, high = found["success_interval"]
        assert 0 <= low <= found["success_rate"] <= high <= 1
        outputs.append(found)
    assert outputs[0] == outputs[1], "the default seed makes it repeatable"
    assert all(outputs[0] != other for other in outputs[2:]), "each of these options makes a difference"
    lines = run("evaluate", untrained.path, "--episodes", 40).stdout.splitlines()
    assert [line.split()[0] for line in lines] == names


EVALUATE = ("evaluate", "which_is_heavier/features", "--episodes", "200", "--json")


def test_evaluate_finds_the_agents_of_each_difficulty(run):
    hard, easy = (json.loads(run(*EVALUATE, "--difficulty", beta).stdout) for beta in (3, 10))
    # The cards of the two: 0.80 and 0.87; the means of 200 returns of standard deviation 0.3 are off by 0.02.
    assert hard["mean_return"] + 0.02 < easy["mean_return"]
    assert_refused(run("evaluate", "which_is_heavier/features", "--difficulty", 4), "4")
    assert_refused(run("replay", "towers/fist_features", "--difficulty", 3), "difficulty")


def test_a_bar_moves_on_a_terminal_and_nothing_is_shown_elsewhere(tmp_path, monkeypatch):
    monkeypatch.setenv("TERM", "xterm")
    leader, follower = os.openpty()
    with open(follower, "w") as terminal, progress.bar("episodes", 300, terminal) as show:
        show(256)
    shown = b""
    with contextlib.suppress(OSError):  # The other end is closed and everything was read.
        while part := os.read(leader, 10_000):
            shown += part
    os.close(leader)
    assert b"episodes" in shown and b"256/300" in shown
    with open(tmp_path / "log", "w") as file, progress.bar("episodes", 300, file) as show:
        show(256)
    assert (tmp_path / "log").read_text() == ""


def test_a_reader_that_closes_the_pipe_is_no_error():
    with subprocess.Popen([PHYSEXP, "tasks"], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
        process.stdout.close()  # As `head` does.
        process.stdout = None
        _, errors = process.communicate()
    assert errors == "" and process.returncode == 1


# Work.

TINY = ("train", "towers/fist_features", "--agent=ppo", "--num-environments=32", "--num-minibatches=2", "--frames=1500")


def test_training_writes_replays_as_often_as_told_and_warns_if_it_failed(run):
    always = (*TINY, "--checkpoint-seconds", 0.01, "--learning-rate", 1e-9)
    done = run(*always, "--replay-every", 500, "--run-dir", "often")
    assert done.returncode == 0 and done.stdout.splitlines()[-1] == "often", done
    assert "no better than chance" in done.stderr or "fell silent" in done.stderr, done.stderr
    assert 1 <= len(list(Path("often/replays").glob("*.rrd"))) <= 3
    assert run(*always, "--replay-every", 0, "--frames", 100, "--run-dir", "never").returncode == 0
    assert not Path("never/replays").exists()
    assert_refused(run(*always, "--run-dir", "never"), "never", "--resume")
    assert_refused(run("train", "threshold/features", "--run-dir", "never", "--resume"), "towers/fist_features")


def test_the_return_of_an_ideal_is_told_in_a_sentence(run, monkeypatch):
    # Three pushes halve eight levels three times: 0.95^3.
    sentence = "The ideal experimenter of threshold/features earns 0.8574 (discounted return, gamma 0.95)."
    text = run("ideal", "threshold").stdout
    assert text.startswith(sentence) and "An answer without any interaction earns -0.7500." in text
    assert "earn 0.8574 (score 1.000)" in text and "Plans of at most 1, 2, 4 interactions" in text
    monkeypatch.delitem(ideal._IDEALS, "strings")
    assert_refused(run("ideal", "strings"), "no ideal experimenter is known of 'strings'; choose from which_is_heavier")


def test_a_score_is_greedy_or_quick_if_asked(run):
    score = ("score", "threshold/features", "--json", "--output")
    greedy = json.loads(run(*score, "greedy", "--episodes", 50, "--greedy").stdout)
    quick = json.loads(run(*score, "quick", "--quick").stdout)
    counts = [found["tasks"]["threshold/features"]["episodes"] for found in (greedy, quick)]
    assert counts == [50, 100] and [found["greedy"] for found in (greedy, quick)] == [True, False]
    assert Path("quick/report.html").exists()


def test_a_replay_has_chosen_episodes_or_two_agents(run):
    done = run("replay", "which_is_heavier/features", "--select", "wrong", "--interaction", "random", "--episodes", 1)
    assert done.returncode == 0 and "wrong" in done.stderr + done.stdout
    done = run("replay", "towers/fist_features", "--compare", "a3c/towers-fist_features", "--output", "both.rrd")
    assert done.returncode == 0, done.stderr
    both = RrdReader("both.rrd")
    names = {str(chunk.entity_path) for chunk in both.stream(store=both.recordings()[0])}
    assert {"/A/belief/value", "/B/belief/value"} <= names


def test_a_report_that_found_a_full_disk_is_drawn_later_by_verify(run, monkeypatch):
    write = files.write_atomically

    def write_small_files(path, content):
        if path.suffix == ".html":
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC), str(path))
        write(path, content)

    with monkeypatch.context() as full:
        full.setattr(files, "write_atomically", write_small_files)
        done = run("score", "silent", "--tasks", "threshold/features", "--episodes", 20, "--output", "it's")
    assert_refused(done, 'No space left on device: "it\'s/report.html"', "--report` draws its report")
    command = re.search("`physexp (verify .*)`", done.stderr)[1]
    done = run(*shlex.split(command))
    assert done.returncode == 0, done.stderr
    assert {"report.html", "report.png"} <= {*os.listdir("it's")}
