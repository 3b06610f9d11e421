"""Reproducing experiments, as a user does it: resumable, complete, and readable at the end."""

from concurrent import futures
import html
import json
import re
import shutil
import signal

import commands
import numpy as np
from pyarrow import parquet
import pytest
import trainers
from trainers import group
from waiting import wait_until

from physexp.analysis.data import provenance
from physexp.analysis.experiments import EXPERIMENTS, base, claims, conditions, report, reproduce, sweep
from physexp.analysis.training import metrics as metrics_lib
from physexp.analysis.training import records, stopping
from physexp.analysis.training import run as run_lib

NAMES = [f"which_is_heavier-features-difficulty{beta}-discount0.95-seed0" for beta in (3, 5, 10)]


def command(folder, frames, *more):
    options = ["--seeds", 1, "--observations", "features", "--frames", frames, "--results-dir", folder]
    return ["reproduce", "population", *options, *more]


@pytest.fixture(scope="module")
def rehearsed(tmp_path_factory):
    """Results of a rehearsal of one experiment."""
    folder = tmp_path_factory.mktemp("results")
    done = commands.run(*command(folder, 5000), check=True)
    return base.Results(folder), done.stdout


def test_a_reproduction_leaves_runs_episodes_a_figure_and_verdicts(rehearsed):
    results, output = rehearsed
    for name in NAMES:
        run = run_lib.Run(results.path / "runs" / name)
        assert run.is_finished and run.agent_path.exists()
        assert not (run.path / "checkpoints").exists()
        assert (results.path / "episodes" / "learned" / f"{name}.parquet").exists()
    for suffix in ("svg", "png"):
        assert (results.path / "figures" / f"population.{suffix}").stat().st_size > 5000
    assert "0 of 3 agents are done" in output
    assert "time left" in output
    verdicts = [line.split()[0] for line in output.splitlines() if "95 % interval" in line]
    assert len(verdicts) == 3 and set(verdicts) <= {"holds", "fails", "undecided"}


def test_the_stored_rows_are_complete_and_agree_with_one_another(rehearsed):
    results, _ = rehearsed
    path = results.path / "episodes" / "learned" / f"{NAMES[0]}.parquet"
    assert parquet.read_table(path).schema.equals(records.SCHEMA)
    frame = records.read([path], [*records.SCHEMA.names, *records.RECKONED.names, "masses", "mass_gap"])
    assert frame.length.sum() >= 10_000
    assert frame.notna().all(axis=None)
    assert (frame.difficulty == 3).all() and (frame.training_seed == 0).all() and (frame.interaction == "learned").all()
    masses = np.stack(frame.masses.to_numpy())
    np.testing.assert_array_equal(masses.argmax(axis=1), frame.answer)
    np.testing.assert_allclose(np.sort(masses)[:, -1] - np.sort(masses)[:, -2], frame.mass_gap, atol=1e-6)
    assert [len(actions) for actions in frame.actions] == list(frame.length)
    last = np.array([actions[-1] for actions in frame.actions])
    np.testing.assert_array_equal(np.where(last >= 4, last - 4, -1), frame.label)
    pokes = [sum(action < 4 for action in actions) for actions in frame.actions]
    np.testing.assert_array_equal(pokes, frame.interactions)
    np.testing.assert_array_equal(np.where(frame.label == frame.answer, 1, -1), frame.reward)
    np.testing.assert_allclose(frame.time, 0.1 * frame.interactions, rtol=1e-6)
    assert not frame.duplicated(["seed", "episode"]).any()


def test_what_is_done_is_not_done_again(rehearsed):
    results, _ = rehearsed
    files = [path for path in results.path.rglob("*") if path.is_file() and "figures" not in path.parts]
    before = {path: path.stat().st_mtime_ns for path in files}
    done = commands.run(*command(results.path, 5000), check=True)
    assert "3 of 3 agents are done" in done.stdout
    assert {path: path.stat().st_mtime_ns for path in files} == before


def test_an_agent_that_is_here_plays_here_what_it_has_not_played_though_others_are_trained_elsewhere(
    rehearsed, tmp_path
):
    results = base.Results(tmp_path / "results")
    shutil.copytree(rehearsed[0].path, results.path)
    job = sweep.jobs([EXPERIMENTS["population"]], ("features",), lambda kind: 1, 5000)[0]
    (played,) = results.all_episodes(job.config)
    before, agent = played.read_bytes(), results.run(job.config).agent_path.read_bytes()
    played.unlink()
    lines = []
    sweep.run([job], results, 1, lines.append, submit=lambda job: pytest.fail("it was trained again"))
    assert lines[-1].startswith("done: ")
    assert played.read_bytes() == before and results.run(job.config).agent_path.read_bytes() == agent


def made_elsewhere(results, job):
    """The files of an agent, as a machine that does not see the results sends them."""
    folders = [results.run(job.config).path, *(path.parent for path in results.all_episodes(job.config))]
    paths = [
        path for folder in folders for path in folder.rglob("*") if path.is_file() and job.config.name in str(path)
    ]
    return {str(path.relative_to(results.path)): path.read_bytes() for path in paths}


def test_what_another_machine_has_made_is_kept_though_the_rest_is_ended(rehearsed, tmp_path):
    jobs = sweep.jobs([EXPERIMENTS["population"]], ("features",), lambda kind: 1, 5000)[:2]
    made = made_elsewhere(rehearsed[0], jobs[0])
    ready, never = futures.Future(), futures.Future()
    ready.set_result(made)

    def submit(job):
        if job is jobs[0]:
            return ready
        signal.raise_signal(signal.SIGINT)
        return never

    results = base.Results(tmp_path / "results")
    with pytest.raises(stopping.Interrupted):
        sweep.run(jobs, results, 1, print, submit=submit)
    assert made_elsewhere(results, jobs[0]) == made and results.run(jobs[0].config).is_finished


def test_what_cannot_be_written_of_another_machines_agent_is_made_here_the_next_time(rehearsed, tmp_path):
    job = sweep.jobs([EXPERIMENTS["population"]], ("features",), lambda kind: 1, 5000)[0]
    made = made_elsewhere(rehearsed[0], job)
    ready = futures.Future()
    ready.set_result(made)
    results = base.Results(tmp_path / "results")
    results.path.mkdir()
    obstacle = results.path / "episodes"
    obstacle.touch()  # Where a folder is to be.
    with pytest.raises(RuntimeError, match="1 of 1 agents could not be trained: .*episodes"):
        sweep.run([job], results, 1, print, submit=lambda job: ready)
    obstacle.unlink()
    sweep.run([job], results, 1, print, submit=lambda job: pytest.fail("it was trained again"))
    assert made_elsewhere(results, job) == made


def test_runs_with_another_configuration_are_not_mixed_in(rehearsed):
    results, _ = rehearsed
    done = commands.run(*command(results.path, 6000))
    assert done.returncode == 2
    assert done.stderr.count("\n") == 1
    assert "was made with another configuration; move it away or choose another --results-dir" in done.stderr


def test_episodes_of_a_run_that_is_gone_are_not_taken_for_those_of_the_next(rehearsed, tmp_path):
    results, _ = rehearsed
    folder = tmp_path / "results"
    shutil.copytree(results.path, folder)
    shutil.rmtree(folder / "runs" / NAMES[0])
    refused = commands.run(*command(folder, 5000))
    assert refused.returncode == 2
    assert refused.stderr.count("\n") == 1
    played = folder / "episodes" / "learned" / f"{NAMES[0]}.parquet"
    assert f"{played}: the run that played this is gone; move it away" in refused.stderr
    assert played.exists()


@pytest.fixture(scope="module")
def reported(rehearsed):
    """The report of it, as Markdown and as a page, made while another agent begins to train, and one trains."""
    results, _ = rehearsed
    beginning, training = results.path / "runs" / "beginning", results.path / "runs" / "training"
    beginning.mkdir()
    (beginning / ".lock").touch()
    shutil.copytree(results.path / "runs" / NAMES[0], training)
    trainers.set_frames(run_lib.Run(training), 10**9)
    try:
        return report.write(results).read_text(), (results.path / "report.html").read_text()
    finally:
        shutil.rmtree(beginning)
        shutil.rmtree(training)


def test_the_report_has_every_figure_there_is_data_for_and_says_what_is_left_out(rehearsed, reported):
    (results, _), (markdown, page) = rehearsed, reported
    for name in ("mass_gap", "population", "learning_heavier"):  # The runs have curves, too.
        assert f"figures/{name}.png" in markdown and (results.path / "figures" / f"{name}.png").exists()
    assert page.count("data:image/svg+xml;base64,") == markdown.count("![")
    for claim in EXPERIMENTS["population"].claims(EXPERIMENTS["population"].load(results)):
        assert claim.text in markdown and claim.statistic in page
    for name in ("waiting", "random_towers", "individual"):
        assert f"Left out: {name}" in markdown
    condition, _, seed = NAMES[0].rpartition("-seed")
    absent = [str(other) for other in range(conditions.SEEDS["features"]) if str(other) != seed]
    for text in (markdown, page):  # One agent of each condition was trained.
        assert f"{condition} ({', '.join(absent)})" in text and f"{condition} ({seed}" not in text
    assert provenance.commit()[:10] in markdown
    assert f"Agents: {len(NAMES)}, trained by" in markdown  # Who is still in training is none.


def test_the_report_begins_with_the_claims_of_the_paper_failures_first_and_sanity_checks_last(reported):
    markdown, page = reported
    table = markdown[markdown.index("## Claims of the paper") : markdown.index("![")].split("## Claims of ours")[0]
    verdicts = re.findall(r"^\| \*\*(\w+)( \(sanity check\))?\*\* \|", table, re.MULTILINE)
    order = {"fails": 0, "undecided": 1, "holds": 2}
    keys = [(bool(check), order[verdict]) for verdict, check in verdicts]
    assert keys == sorted(keys)
    counted = [verdict for verdict, check in verdicts if not check]
    assert set(counted) - {"holds"} and len(counted) < len(verdicts), "after so few frames some claims are open"
    tally = f"{counted.count('holds')} holds, {counted.count('undecided')} undecided, {counted.count('fails')} fails"
    for text in (table, page):
        assert f"{tally}; sanity checks: {len(verdicts) - len(counted)}." in text
    assert page.index("Claims of the paper") < page.index("<img")
    for name in set(re.findall(r"\]\(#([\w-]+)\)", markdown)):
        assert f'<a id="{name}">' in markdown and f'<h2 id="{name}">' in page


def test_the_report_begins_with_a_summary_of_its_verdicts(rehearsed, reported):
    (results, _), (markdown, page) = rehearsed, reported
    its = {}
    for name in re.findall(r"!\[[^]]*\]\(figures/(\w+).png\)", markdown):
        found = EXPERIMENTS[name].claims(EXPERIMENTS[name].load(results))
        for claim, verdict in zip(found, claims.corrected(found), strict=True):
            if claim.section != claims.OURS and not claim.is_sanity_check:
                its.setdefault((claim.text, claim.section), set()).add(verdict)
    held = sum(verdicts == {"holds"} for verdicts in its.values())
    failed = sum("fails" in verdicts for verdicts in its.values())
    first = markdown.splitlines()[2]
    assert first.startswith(f"Claims of the paper: {len(its)}. Held in every condition")
    assert f" in which they were tested: {held}. " in first
    assert f"Failed in at least one: {failed}. Undecided in at least one, and failed in none: " in first
    assert html.escape(first) in page
    # The configurations that were rehearsed have a worker each.
    assert f"All {len(NAMES)} A3C agents of these data were trained by a single worker" in first
    # The paper claims the same of several tasks, in sections of their own.
    assert all(f"\n- Section {section}: {text}" in markdown for text, section in its)
    summary, table = markdown.index("Undecided:"), markdown.index("## Claims of the paper")
    assert summary < table < markdown.index("## Provenance") < markdown.index("trained by the source of these commits")


def test_a_report_of_nothing_says_what_to_do(tmp_path):
    with pytest.raises(ValueError, match="nothing is no folder; `physexp reproduce` makes one with results"):
        report.write(base.Results(tmp_path / "nothing"))
    assert not list(tmp_path.iterdir())


@pytest.mark.long
def test_a_killed_sweep_goes_on_where_it_was(tmp_path):
    frames = 30_000  # The second has to be at it for longer than it takes to see that it has begun.
    with commands.start(*command(tmp_path, frames, "--jobs", 1)) as process:
        first, second = (tmp_path / "runs" / name for name in NAMES[:2])
        part = tmp_path / "episodes" / "learned" / f"{NAMES[0]}.parquet"
        wait_until(lambda: part.exists() and (second / "config.json").exists(), "one run done, one begun")
        process.kill()
        process.wait()
        # Nobody is left to want the rest: what the sweep has started ends by itself.
        wait_until(lambda: not group(process.pid), "the sweep's processes end")
    kept = {path: path.stat().st_mtime_ns for path in (first / "agent.safetensors", first / "metrics.csv", part)}
    done = commands.run(*command(tmp_path, frames), check=True)
    assert "1 of 3 agents are done" in done.stdout
    assert {path: path.stat().st_mtime_ns for path in kept} == kept
    for name in NAMES:
        rows = run_lib.Run(tmp_path / "runs" / name).metrics()
        counted = [row["frames"] for row in rows]
        assert counted == sorted(set(counted)) and counted[-1] >= frames


def test_an_agent_that_cannot_be_trained_is_named_and_the_others_are_trained(tmp_path):
    results = base.Results(tmp_path)
    jobs = sweep.jobs([EXPERIMENTS["population"]], ["features"], lambda kind: 1, 3000)[:2]
    blocked = results.run(jobs[0].config).path
    blocked.parent.mkdir(parents=True)
    blocked.write_text("a file where the run's folder should be")
    lines = []
    with pytest.raises(RuntimeError, match=f"1 of 2 agents could not be trained: {jobs[0].config.name}"):
        sweep.run(jobs, results, 2, lines.append)
    assert results.episodes_path(base.LEARNED, jobs[1].config).exists()
    assert any(line.startswith(f"FAILED {jobs[0].config.name}") for line in lines)


def test_the_time_that_is_left_is_told_once_it_is_known(tmp_path):
    results = base.Results(tmp_path)
    jobs = sweep.jobs([EXPERIMENTS["population"]], ["features"], lambda kind: 1, 4000)[:2]
    meter = sweep.Meter(jobs, results, 1)
    assert meter.line(2) == "2 agents to go, 0.00 of 0.01 million frames"
    run = results.run(jobs[0].config)
    run.create(jobs[0].config)
    run.append_metrics({**dict.fromkeys(metrics_lib.METRICS, 0.0), "frames": 1000, "seconds": 30.0})
    # The 7000 frames that are left take 30 s for each thousand.
    assert meter.line(1) == "1 agent to go, 0.00 of 0.01 million frames, time left 0:03:30"


def test_experiments_that_need_the_same_agent_train_it_once():
    everything = sweep.jobs(list(EXPERIMENTS.values()), conditions.OBSERVATIONS, lambda kind: 2)
    names = [job.config.name for job in everything]
    assert len(names) == len(set(names))
    # Two seeds of: six conditions of Which is Heavier and four of Towers, each with A3C, with PPO and with the belief
    # learner in both tracks; the paper's own learner; three patient ones of A3C; three ablations in two conditions;
    # four with variation, and one of them with control steps of many lengths; two with a fist at the tower; one with
    # noise; and of each of five other domains, from features, A3C, PPO and the belief learner in both tracks.
    count = (6 + 4) * 4 + 1 + 3 + 3 * 2 + (4 + 1) + 2 + 1 + 5 * 4
    assert len(names) == 2 * count
    assert [job.config.agent.seed for job in everything] == [0] * count + [1] * count
    fist = next(job for job in everything if job.config.task == "fist_features")
    assert {"learned", "random", "evaluation", "timestep0.01", "timestep0.1"} <= {trial.name for trial in fist.trials}


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["waving"], "experiment is 'waving'; choose from all, mass_gap, learning_heavier"),
        (["mass_gap", "--seeds", "0"], "seeds is 0; give an integer >= 1"),
        (["mass_gap", "--jobs", "-1"], "jobs is -1; give an integer >= 1"),
    ],
)
def test_what_makes_no_sense_is_one_readable_line(arguments, message, tmp_path):
    done = commands.run("reproduce", *arguments, "--results-dir", tmp_path / "results")
    assert done.returncode == 2
    assert message in done.stderr and done.stderr.count("\n") == 1
    assert not (tmp_path / "results").exists()


def test_an_experiment_without_agents_takes_no_training(tmp_path):
    lines = []
    reproduce.run([EXPERIMENTS["mass_gap"]], base.Results(tmp_path), observations=["features"], tell=lines.append)
    assert (tmp_path / "figures" / "mass_gap.png").exists()
    assert sum(line.startswith("holds") for line in lines) == 2


def test_the_command_for_the_ideal_prints_its_figures():
    done = commands.run("ideal", "which_is_heavier", "--difficulty", 3, "--discount", 0.95, "--json", check=True)
    figures = json.loads(done.stdout)
    names = ["value", "bound", "accuracy", "mean_interactions", "histogram", "at_once", "random_value"]
    assert list(figures) == names
    assert figures["value"] == pytest.approx(0.8385, abs=1e-3)
    assert sum(figures["histogram"].values()) == pytest.approx(1)
    mean = sum(int(pokes) * share for pokes, share in figures["histogram"].items())
    assert figures["mean_interactions"] == pytest.approx(mean)
