"""The command line as a user runs it.

Most of it runs in this process, through the entry point: a process of its own would import torch and MuJoCo anew.
"""

import contextlib
import dataclasses
import errno
import json
import os
from pathlib import Path
import re
import resource
import shlex
import subprocess
import sys
from typing import get_args, get_type_hints

import evaluation_figures
import pytest
from rerun.chunk import RrdReader

import physexp as package
from physexp import extras, suite
from physexp.agents import files
from physexp.analysis import bench, experiments
from physexp.analysis.experiments import conditions
from physexp.analysis.training import config as config_lib
from physexp.analysis.training import finding, playing, progress
from physexp.cli import commands, doctor, ideal, options, parsing, printing

PHYSEXP = Path(sys.executable).with_name("physexp")


def physexp(*arguments):
    """Runs the command in a process of its own; returns it, finished."""
    return subprocess.run([PHYSEXP, *map(str, arguments)], capture_output=True, text=True, check=False)


@dataclasses.dataclass
class Done:
    """What a command has left."""

    returncode: int
    stdout: str
    stderr: str


@pytest.fixture
def run(monkeypatch, capsys, tmp_path):
    """A function that runs the command with some arguments, in this process and an empty folder."""
    monkeypatch.chdir(tmp_path)

    def run(*arguments):
        monkeypatch.setattr(sys, "argv", ["physexp", *map(str, arguments)])
        capsys.readouterr()
        try:
            parsing.main()
            status = 0
        except SystemExit as error:
            status = error.code or 0
        return Done(status, *capsys.readouterr())

    return run


def assert_refused(done, *words):
    """One line on standard error that says what is wrong, exit status 2, nothing else."""
    assert done.returncode == 2, done.stderr
    assert done.stdout == ""
    assert len(done.stderr.splitlines()) == 1, done.stderr
    for word in words:
        assert word in done.stderr


def _processor_seconds(function):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    function()
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


@pytest.mark.parametrize("arguments", [["--help"], ["train", "--help"], ["evaluate", "--help"]])
def test_help_costs_little_more_than_the_library_that_writes_it(arguments):
    def help_():
        done = physexp(*arguments)
        assert done.returncode == 0 and "usage" in done.stdout.lower()

    def library():
        subprocess.run([sys.executable, "-c", "import tyro"], check=True)

    # In turns, the best of five each: what else the machine does costs both alike. torch alone would be ten times more.
    pairs = [(_processor_seconds(help_), _processor_seconds(library)) for _ in range(5)]
    mine, theirs = map(min, zip(*pairs, strict=True))
    assert mine < 5 * theirs


def test_help_lists_the_commands_and_train_help_the_configuration():
    text = physexp("--help").stdout
    for command in ("tasks", "train", "evaluate", "bench", "doctor"):
        assert command in text
    text = physexp("train", "--help").stdout
    for option in ("discount", "frames", "seed", "num-environments", "run-dir", "resume"):
        assert f"--{option}" in text


def test_help_imports_nothing_heavy():
    script = (
        "import sys; sys.argv = ['physexp', '--help']\n"
        "from physexp import cli\n"
        "try: cli.main()\n"
        "except SystemExit: pass\n"
        "print([name for name in ('torch', 'mujoco', 'dm_control', 'scipy', 'pyarrow') if name in sys.modules])"
    )
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    assert done.stdout.splitlines()[-1] == "[]"


def words_of(text):
    """A help text without its boxes, line ends and commas."""
    return " ".join(text.replace("│", "").replace(",", "").split())


@pytest.mark.parametrize(
    "arguments",
    [
        ["train", "which_is_heavier"],
        ["play", "which_is_heavier", "features"],
        ["evaluate", "which_is_heavier/features"],
        ["replay", "which_is_heavier/pixels"],
        ["evaluate", "some/run"],
        ["ideal", "which_is_heavier"],
    ],
)
def test_help_says_that_a_larger_difficulty_is_easier(run, arguments):
    text = run(*arguments, "--help").stdout
    assert "--difficulty FLOAT" in text and "the larger the easier" in words_of(text)


@pytest.mark.parametrize("domain", suite.TASKS_BY_DOMAIN)
def test_help_lists_a_domain_s_options_with_its_own_words_and_defaults_where_the_domain_is_named(run, domain):
    kind = suite.options(domain)
    offered = {field.name for field in dataclasses.fields(kind)} - {"random", "visualize_reward"}
    assert "control_timestep" in offered
    hints = get_type_hints(kind)
    for arguments in (["train", domain], ["play", domain, "features"], ["train", "--agent", "ppo", domain]):
        text = run(*arguments, "--help").stdout
        for name in offered:
            kinds = {float: " FLOAT", int: " INT", str: " TEXT", bool: ""}
            (value,) = {kinds[each] for each in (get_args(hints[name]) or (hints[name],)) if each in kinds}
            assert f"--{name.replace('_', '-')}{value}" in text
        assert "--random" not in text and "--visualize-reward" not in text
        limit = f"{kind().time_limit:g}"
        assert f"rounded up to whole control steps s. (default: {limit})" in words_of(text)


@pytest.mark.parametrize(("command", "what"), [("train", "DOMAIN"), ("play", "DOMAIN"), ("evaluate", "AGENT")])
def test_help_without_a_domain_says_how_to_see_its_options(run, command, what):
    text = run(command, "--help").stdout
    assert "--help after it lists" in words_of(text) and what in text
    assert "--difficulty" not in text and "--control-timestep" not in text


@pytest.mark.parametrize(
    "arguments",
    [
        ["which_is_heavier", "features", "--difficulty", "3"],
        ["--difficulty=3", "which_is_heavier", "features"],
        ["--run-dir", "towers", "--difficulty", "3", "which_is_heavier", "features"],
        ["--resume", "which_is_heavier", "--difficulty", "3", "features"],
        ["--action-prior", "1", "2", "--no-relative-pixels", "which_is_heavier", "features", "--difficulty", "3"],
    ],
)
def test_options_of_the_domain_stand_before_or_after_its_name(arguments):
    train = parsing.parse(["train", *arguments, "--agent", "a3c"])
    assert (train.domain, train.task) == ("which_is_heavier", "features")
    assert options.chosen(train.options) == {"difficulty": 3.0}
    assert train.config.trace == 0.98, "and the preset is the task's"


@pytest.mark.parametrize(
    ("one", "two"),
    [
        ("train threshold/features --seed 3", "train --seed 3 threshold features"),
        ("play strings/features", "play strings features"),
        ("ideal strings/features --json", "ideal strings --task features --json"),
        ("ideal strings features", "ideal strings --task features"),
        ("evaluate threshold/features --greedy", "evaluate --greedy threshold features"),
        ("replay towers/fist_features --view", "replay towers fist_features --view"),
        ("score silent --tasks towers/fist_features", "score silent --tasks towers fist_features"),
        ("export threshold/features --episodes 3", "export threshold features --episodes 3"),
    ],
)
def test_a_task_is_given_in_one_word_or_in_two(one, two):
    first, second = (parsing.parse(words.split()) for words in (one, two))
    assert repr(first) == repr(second)


def test_options_without_a_value_are_known_before_the_domain_is_and_hold_where_they_are_given():
    kinds = [suite.options(domain) for domain in suite.TASKS_BY_DOMAIN]
    switches = {field.name for kind in kinds for field in dataclasses.fields(kind) if isinstance(field.default, bool)}
    assert switches - {"visualize_reward"} == {*options.SWITCHES}
    for arguments in (["--reveal", "strings", "features", "--noise", "0"], ["strings", "features", "--noise=0"]):
        train = parsing.parse(["train", *arguments])
        assert (train.domain, train.task) == ("strings", "features")
        assert options.chosen(train.options) == {"noise": 0.0} | ({"reveal": True} if "--reveal" in arguments else {})


@pytest.mark.parametrize("algorithm", config_lib.ALGORITHMS)
def test_train_has_the_options_and_presets_of_every_learner(run, algorithm):
    train = parsing.parse(["train", "towers", "fist_features", "--agent", algorithm])
    assert train.config == config_lib.preset("towers", "fist_features", algorithm=algorithm)
    text = run("train", "--agent", algorithm, "--help").stdout
    for field in dataclasses.fields(config_lib.ALGORITHMS[algorithm]):
        assert f"--{field.name.replace('_', '-')}" in text


def test_help_says_how_many_agents_a_condition_has(run):
    said = " and ".join(f"{number} from {kind}" for kind, number in conditions.SEEDS.items())
    assert f"by default {said}" in words_of(run("reproduce", "--help").stdout)


def test_help_lists_the_experiments_and_the_sections_that_there_are(run):
    assert f"{' '.join(experiments.EXPERIMENTS)} or all." in words_of(run("reproduce", "--help").stdout)
    assert " ".join(bench.SECTIONS) in words_of(run("bench", "--help").stdout)
    assert tuple(experiments.EXPERIMENTS) == experiments.NAMES
    assert all(name == experiment.name for name, experiment in experiments.EXPERIMENTS.items())


@pytest.mark.parametrize(
    ("command", "names"),
    [("train", "DOMAIN TASK"), ("play", "DOMAIN TASK"), ("evaluate", "AGENT"), ("reproduce", "EXPERIMENT")],
)
def test_help_names_the_values_that_a_command_takes(run, command, names):
    usage = run(command, "--help").stdout.splitlines()[0]
    assert f" {names}" in usage and "STR" not in usage


def test_the_version_is_the_packages(run):
    assert run("--version") == Done(0, f"physexp {package.__version__}\n", "")


def test_the_package_run_as_a_module_is_the_command():
    done = subprocess.run([sys.executable, "-m", "physexp", "--version"], capture_output=True, text=True)
    assert (done.returncode, done.stdout) == (0, f"physexp {package.__version__}\n")


def test_tasks_lists_every_task_with_its_numbers_question_and_observations(run):
    rows = json.loads(run("tasks", "--json").stdout)
    assert [(row["domain"], row["task"]) for row in rows] == [tuple(names) for names in suite.ALL_TASKS]
    for row in rows:
        environment = suite.load(row["domain"], row["task"])
        rules, spec = environment.task.rules, environment.observation_spec()
        numbers = (rules.num_interactions, rules.num_labels, rules.step_limit)
        assert (row["interactions"], row["labels"], row["step_limit"]) == numbers
        assert row["discount"] == (0.98 if row["domain"] == "towers" else 0.95)
        assert row["observations"] == {
            name: {"shape": list(array.shape), "dtype": str(array.dtype)} for name, array in spec.items()
        }
        assert row["question"].endswith("?")


def test_tasks_prints_each_question_and_a_line_for_each_task(run):
    lines = run("tasks").stdout.splitlines()
    assert "towers: How many rigid bodies is the tower made of?" in lines
    (fist,) = [line for line in lines if line.startswith("fist_features")]
    assert " ".join(fist.split()) == "fist_features 4 5 26 0.98 positions float32 [5, 3], fist_position float32 [3]"


def test_a_table_in_a_pipe_has_a_line_for_each_row_however_long(capsys):
    rows = [{"name": "a", "text": "x" * 500}, {"name": "[b]", "text": "two words"}]
    printing.show_rows(rows, as_json=False)
    assert capsys.readouterr().out == f"name  text\na     {'x' * 500}\n[b]   two words\n"


def test_doctor_names_versions_renderer_threads_and_gpu(run):
    done = run("doctor", "--json")
    assert done.returncode == 0, done.stderr
    facts = json.loads(done.stdout)
    for name in (
        "python",
        "physexp",
        "mujoco",
        "dm-control",
        "torch",
        "numpy",
        "machine",
        "processors",
        "torch_threads",
        "omp_num_threads",
        "gpu",
        "gl_backend",
        "gl_renderer",
    ):
        assert facts[name], name
    for check in facts["checks"]:
        assert bool(check["advice"]) == (check["verdict"] != doctor.OK), check


def verdicts(run):
    """The exit status of `doctor`, and its checks by name."""
    done = run("doctor", "--json")
    return done.returncode, {check["check"]: check for check in json.loads(done.stdout)["checks"]}


def test_doctor_says_which_extra_is_missing_and_how_to_install_it(run, monkeypatch):
    monkeypatch.setitem(sys.modules, "tensorboard", None)  # Cannot be imported, nor found.
    status, checks = verdicts(run)
    assert status == 0
    assert checks["extra tensorboard"] == {
        "check": "extra tensorboard",
        "verdict": "missing",
        "found": "without tensorboard",
        "advice": "pip install 'physexp[tensorboard]'",
    }
    assert checks["extra figures"]["verdict"] == "ok"


def test_doctor_looks_for_a_display_and_counts_threads(run, monkeypatch):
    monkeypatch.delenv("WAYLAND_DISPLAY", raising=False)
    found = {}
    for display, threads in (("", "1"), (":7", "100000")):
        monkeypatch.setenv("DISPLAY", display)
        monkeypatch.setenv("OMP_NUM_THREADS", threads)
        checks = verdicts(run)[1]
        found[display] = [checks[name]["verdict"] for name in ("display", "OMP_NUM_THREADS")]
    assert found == {"": ["missing", "ok"], ":7": ["ok", "missing"]}


def test_doctor_ends_with_status_1_only_if_the_core_is_broken(run, monkeypatch):
    monkeypatch.setitem(sys.modules, "rerun", None)
    status, checks = verdicts(run)
    assert status == 1 and checks["import rerun"]["verdict"] == "broken"


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["train", "which_is_heaviest", "features"], ["which_is_heaviest", "which_is_heavier", "towers"]),
        (["train", "towers", "feet"], ["feet", "fist_features", "direct_features"]),
        (["train", "which_is_heavier", "features", "--difficulty", "0.5"], ["0.5", "difficulty"]),
        (["train", "towers", "fist_features", "--difficulty", "3"], ["--difficulty is not an option of towers"]),
        (["train", "towers", "fist_features", "--control-timestep", "0.0123"], ["0.0123"]),
        (["play", "towers", "fist_features", "--difficulty", "3"], ["--difficulty is not an option of towers"]),
        (
            ["replay", "towers/fist_features", "--difficulty", "3"],
            ["--difficulty is not an option of towers; leave it"],
        ),
        (["train", "towers", "fist_features", "--random", "3"], ["--random is not an option of train"]),
        (
            ["train", "towers", "fist_features", "--agent", "a3c", "--replay-episodes", "9"],
            ["--replay-episodes is not an option of --agent a3c; leave it out, or train --agent belief"],
        ),
        (
            ["train", "towers", "fist_pixels", "--agent", "belief", "--no-relative-pixels"],
            ["--no-relative-pixels is not an option of --agent belief", "--agent a3c or --agent ppo"],
        ),
        (["ideal", "towers", "--difficulty", "3"], ["--difficulty is not an option of ideal towers"]),
        (["ideal", "towers", "--blocks", "3"], ["--blocks is not an option of ideal towers"]),
        (["ideal", "which_is_heavier", "--resolution", "0"], ["--resolution is not an option"]),
        (["ideal", "which_is_heavier", "--reveal", "--blocks", "3"], ["blocks is 3", "leave it out with reveal"]),
        (["ideal", "nowhere"], ["'nowhere'", "known domains: which_is_heavier"]),
        (["ideal", "towers", "--task", "feet"], ["task is 'feet'", "fist_features", "direct_features"]),
        (["evaluate", "no/such/run"], ["no/such/run", "holds no run"]),
        (["evaluate", __file__], [__file__, "is a file; give the folder of a run"]),
        (["evaluate", "threshold/features", "--seed", "-1"], ["the seed, is -1; give an integer in [0, 2**63)"]),
        (["train", "which_is_heavier", "features", "--resume", "--run-dir", "no/such/run"], ["holds no run"]),
    ],
)
def test_what_cannot_be_done_is_refused_in_one_line(run, arguments, words):
    assert_refused(run(*arguments), *words)
    assert not os.listdir(), "a refused run leaves no folder"


@pytest.mark.parametrize(
    ("arguments", "line"),
    [
        ([], f"give a command: {', '.join(commands.COMMANDS)}; see physexp --help"),
        (["fly"], f"'fly' is no command; choose from {', '.join(commands.COMMANDS)}; see physexp --help"),
        (["train"], "train needs DOMAIN TASK; see physexp train --help"),
        (["train", "towers"], "train needs TASK; see physexp train --help"),
        (["evaluate", "a", "b"], "evaluate does not take 'b'; see physexp evaluate --help"),
        (
            ["evaluate", "threshold", "fist"],
            "threshold has no task 'fist'; choose from features, pixels; see physexp evaluate --help",
        ),
        # What is close to it, `target`, has no name on a command line.
        (["evaluate", "a", "--targe=3"], "--targe=3 is not an option of evaluate; see physexp evaluate --help"),
        (
            ["evaluate", "a", "--sed=3"],
            "--sed=3 is not an option of evaluate; perhaps --seed; see physexp evaluate --help",
        ),
        (
            ["train", "towers", "fist_features", "--clop", "1", "--agent", "ppo"],
            "--clop is not an option of train; perhaps --clip; see physexp train --help",
        ),
        (["train", "towers", "fist_features", "--ZZ", "1"], "--ZZ is not an option of train; see physexp train --help"),
        # The learner is the one that is named last.
        (
            ["train", "towers", "fist_features", "--agent", "ppo", "--agent", "a3c", "--clip", "1"],
            "--clip is not an option of --agent a3c; leave it out, or train --agent ppo",
        ),
        (["evaluate", "a", "--episodes", "many"], "--episodes is 'many'; give INT; see physexp evaluate --help"),
        (["ideal", "towers", "--discount=low"], "--discount is 'low'; give FLOAT; see physexp ideal --help"),
        (
            ["train", "towers", "fist_features", "--agent", "a3c", "--max_staleness", "x"],
            "--max-staleness is 'x'; give INT; see physexp train --help",
        ),
        (["evaluate", "a", "--seed"], "--seed needs a value: INT; see physexp evaluate --help"),
        (
            ["evaluate", "a", "--interaction", "x"],
            "--interaction is 'x'; choose from learned, random; see physexp evaluate --help",
        ),
        (
            ["train", "towers", "fist_features", "--discount", "2"],
            "discount is 2.0; give a number from 0 to 1 but not 0; see physexp train --help",
        ),
        (
            ["train", "towers", "fist_features", "--agent", "a3c", "--num-workers", "0"],
            "num_workers is 0; give an integer >= 1 and <= 10000; see physexp train --help",
        ),
        (
            ["train", "towers", "fist_features", "--learning-rate", "nan"],
            "learning_rate is nan; give a finite number > 0; see physexp train --help",
        ),
    ],
)
def test_a_mistyped_command_line_is_one_line_that_says_what_was_given_and_what_is_allowed(run, arguments, line):
    done = run(*arguments)
    assert (done.returncode, done.stdout, done.stderr) == (2, "", f"physexp: {line}\n")


@pytest.mark.parametrize(
    ("arguments", "without", "line"),
    [
        (["reproduce", "learning_heavier"], ["pandas"], "pandas is not installed; pip install 'physexp[analysis]'"),
        (["reproduce", "all", "--cluster", "local"], ["ray"], "ray is not installed; pip install 'physexp[ray]'"),
        (["report"], ["matplotlib"], "matplotlib is not installed; pip install 'physexp[figures]'"),
        (["demo"], ["matplotlib"], "matplotlib is not installed; pip install 'physexp[figures]'"),
        (["bench"], ["gymnasium"], "gymnasium is not installed; pip install 'physexp[gymnasium]'"),
        (
            ["bench", "peers"],
            ["stable_baselines3", "sb3_contrib"],
            "stable_baselines3 and sb3_contrib are not installed; pip install 'physexp[sb3]'",
        ),
    ],
)
def test_a_missing_extra_is_named_before_any_work(run, monkeypatch, arguments, without, line):
    for module in without:
        monkeypatch.setitem(sys.modules, module, None)  # Cannot be imported, nor found.
    done = run(*arguments)
    assert (done.returncode, done.stdout, done.stderr) == (2, "", f"physexp: {line}\n")
    assert not os.listdir()


def test_the_adapters_name_the_extra_that_they_need(monkeypatch):
    for adapter, library, extra in (
        ("gymnasium", "gymnasium", "gymnasium"),
        ("stable_baselines", "stable_baselines3", "sb3"),
    ):
        with monkeypatch.context() as context:
            context.delitem(sys.modules, f"physexp.suite.{adapter}", raising=False)
            context.setitem(sys.modules, library, None)
            with pytest.raises(extras.MissingExtraError, match=rf"pip install 'physexp\[{extra}\]'"):
                __import__(f"physexp.suite.{adapter}")


def test_a_folder_that_holds_a_run_is_not_overwritten(run, untrained):
    before = (untrained.path / "config.json").read_bytes()
    done = run("train", "which_is_heavier", "features", "--run-dir", untrained.path)
    assert_refused(done, str(untrained.path), "--resume")
    assert (untrained.path / "config.json").read_bytes() == before


def test_a_run_is_not_resumed_as_another_task(run, untrained):
    done = run("train", "towers", "fist_features", "--run-dir", untrained.path, "--resume")
    assert_refused(done, "which_is_heavier/features")


def test_an_argument_that_is_empty_is_refused(run):
    assert_refused(run("evaluate", ""), "an argument is empty, as an unset variable of the shell is")
    assert_refused(run("train", "threshold", "features", "--run-dir", ""), "an argument is empty")
    assert list(Path.cwd().iterdir()) == []


def test_what_is_in_the_folder_of_a_run_is_not_taken_for_an_agent(run, untrained):
    file = untrained.path / "config.json"
    assert_refused(
        run("evaluate", file), f"{file} is a file; give the folder of a run, or the card of a published agent"
    )


def test_a_second_trainer_in_the_same_folder_is_refused(run, untrained):
    with untrained.locked():  # As a trainer does: this process is the first one.
        done = run("train", "which_is_heavier", "features", "--run-dir", untrained.path, "--resume")
    assert_refused(done, str(untrained.path), "another process is training")


def test_evaluate_prints_exactly_its_figures_as_json(run, untrained):
    outputs = []
    for extra in ([], [], ["--interaction", "random"], ["--greedy"], ["--seed", 3]):
        done = run("evaluate", untrained.path, "--episodes", 40, "--json", *extra)
        assert done.returncode == 0, done.stderr
        figures = json.loads(done.stdout)
        assert list(figures) == [*evaluation_figures.NAMES, *evaluation_figures.IDEAL]
        assert figures["episodes"] == 40
        assert figures["share_of_ideal"] == figures["mean_return"] / figures["ideal_return"]
        low, high = figures["success_interval"]
        assert 0 <= low <= figures["success_rate"] <= high <= 1
        outputs.append(figures)
    assert outputs[0] == outputs[1], "the default seed makes it repeatable"
    assert all(outputs[0] != other for other in outputs[2:]), "each of these options makes a difference"


def test_evaluate_without_json_prints_the_same_names(run, untrained):
    lines = run("evaluate", untrained.path, "--episodes", 20).stdout.splitlines()
    assert [line.split()[0] for line in lines] == [*evaluation_figures.NAMES, *evaluation_figures.IDEAL]


def test_evaluate_finds_the_agents_of_each_difficulty(run):
    returns = [
        json.loads(
            run("evaluate", "which_is_heavier/features", "--difficulty", difficulty, "--episodes", 200, "--json").stdout
        )["mean_return"]
        for difficulty in (3, 10)
    ]
    # The cards of the two: 0.80 and 0.87; the means of 200 returns of standard deviation 0.3 are off by 0.02.
    assert returns[0] + 0.02 < returns[1]
    assert_refused(run("evaluate", "which_is_heavier/features", "--difficulty", 4), "4")
    assert_refused(run("evaluate", "towers/fist_features", "--difficulty", 3), "difficulty")
    assert_refused(run("replay", "which_is_heavier/features", "--difficulty", 4), "4")


def test_a_bar_moves_on_a_terminal_and_nothing_is_shown_elsewhere(tmp_path, monkeypatch):
    monkeypatch.setenv("TERM", "xterm")
    leader, follower = os.openpty()
    with open(follower, "w") as terminal, progress.bar("episodes", 300, terminal) as show:
        show(256)
    shown = b""
    with contextlib.suppress(OSError):  # Nobody is left at the other end, and nothing to read.
        while part := os.read(leader, 10_000):
            shown += part
    os.close(leader)
    shown = shown.decode()
    assert "episodes" in shown and "256/300" in shown
    with open(tmp_path / "log", "w") as file, progress.bar("episodes", 300, file) as show:
        show(256)
    assert (tmp_path / "log").read_text() == ""


def test_an_evaluation_tells_how_many_episodes_are_played(untrained):
    told = []
    playing.play(finding.load_network(untrained), untrained.config, 300, show=told.append)
    assert told == [256, 300]  # A round is 256 episodes.


@pytest.mark.parametrize("arguments", [["--help"], ["tasks"]])
def test_a_reader_that_has_seen_enough_is_no_error_of_ours(arguments):
    with subprocess.Popen([PHYSEXP, *arguments], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
        process.stdout.close()  # As `head` does.
        process.stdout = None
        _, errors = process.communicate()
    assert errors == "" and process.returncode == 1


TINY = ("--agent", "ppo", "--num-environments", 32, "--num-epochs", 1, "--num-minibatches", 2, "--frames", 1500)


def test_training_writes_replays_as_often_as_it_is_told_and_says_where_nothing_was_learned(run):
    always = ("--checkpoint-seconds", 0.01, "--learning-rate", 1e-9)
    done = run("train", "towers", "fist_features", *TINY, *always, "--replay-every", 500, "--run-dir", "often")
    assert done.returncode == 0 and done.stdout.splitlines()[-1] == "often"
    assert "no better than chance" in done.stderr or "fell silent" in done.stderr, done.stderr
    assert 1 <= len(list(Path("often/replays").glob("*.rrd"))) <= 3
    done = run("train", "towers", "fist_features", *TINY, *always, "--replay-every", 0, "--run-dir", "never")
    assert done.returncode == 0 and not Path("never/replays").exists()


def test_a_domain_without_an_ideal_is_told_so(monkeypatch):
    monkeypatch.delitem(ideal._IDEALS, "strings")
    command = ideal.Ideal(domain="strings", options=options.NoOptions())
    with pytest.raises(ValueError, match="^no ideal experimenter is known of strings; choose from which_is_heavier, "):
        command.run()


def test_the_return_of_an_ideal_is_told_in_a_sentence_with_its_unit(run):
    done = run("ideal", "threshold")
    # Three pushes halve eight levels three times: 0.95^3.
    sentence = "The ideal experimenter of threshold/features earns 0.8574 (discounted return, gamma 0.95)."
    assert done.stdout.startswith(sentence) and "An answer without any interaction earns -0.7500." in done.stdout


def test_a_score_is_of_likeliest_actions_or_of_a_hundred_episodes_where_that_is_asked_for(run):
    usual = ("score", "threshold/features", "--json", "--output")
    few = json.loads(run(*usual, "few", "--episodes", 50).stdout)
    greedy = json.loads(run(*usual, "greedy", "--episodes", 50, "--greedy").stdout)
    quick = json.loads(run(*usual, "quick", "--quick").stdout)
    counts = [found["tasks"]["threshold/features"]["episodes"] for found in (few, greedy, quick)]
    assert counts == [50, 50, 100]
    assert [found["greedy"] for found in (few, greedy, quick)] == [False, True, False]
    assert (Path("quick") / "report.html").exists()


def test_a_replay_is_of_chosen_episodes_or_of_two_agents(run):
    done = run("replay", "which_is_heavier/features", "--select", "wrong", "--interaction", "random", "--episodes", 1)
    assert done.returncode == 0 and "wrong" in done.stderr + done.stdout
    done = run("replay", "towers/fist_features", "--compare", "a3c/towers-fist_features", "--output", "both.rrd")
    assert done.returncode == 0, done.stderr
    both = RrdReader("both.rrd")
    names = {str(chunk.entity_path) for chunk in both.stream(store=both.recordings()[0])}
    assert {"/A/belief/value", "/B/belief/value"} <= names


def test_a_report_for_which_the_disk_had_no_room_is_drawn_from_what_was_played(run, monkeypatch):
    write = files.write_atomically

    def write_what_is_small(path, content):
        if path.suffix == ".html":
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC), str(path))
        write(path, content)

    with monkeypatch.context() as full:
        full.setattr(files, "write_atomically", write_what_is_small)
        done = run("score", "silent", "--tasks", "threshold/features", "--episodes", 20, "--output", "it's")
    assert_refused(done, 'No space left on device: "it\'s/report.html"', "--report` draws its report")
    command = re.search("`physexp (verify .*)`", done.stderr)[1]
    done = run(*shlex.split(command))
    assert done.returncode == 0, done.stderr
    assert {"report.html", "report.png"} <= {*os.listdir("it's")}
