"""A study, in a browser, by a scripted person: nothing is lost, nothing is played twice, broken trials are marked."""

import contextlib
import csv
import functools
import http.server
import io
import json

import browsers
import pytest
import screens

from physexp.agents import environment_loop
from physexp.analysis.data import episodes
from physexp.analysis.play import page, study
from physexp.analysis.score import protocol, records

TASK = "threshold/features"
FIRST_ANSWER = "9"  # The key of the action after eight pushes.


class Host(http.server.SimpleHTTPRequestHandler):
    """A static host that takes files, too, as DataPipe does; the first it refuses."""

    def __init__(self, *args, taken, **kwargs):
        self.taken = taken
        super().__init__(*args, **kwargs)

    def do_POST(self):
        self.taken.append(json.loads(self.rfile.read(int(self.headers["Content-Length"]))))
        self.send_response(503 if len(self.taken) == 1 else 201)
        self.end_headers()

    def log_message(self, *args):
        pass


@contextlib.contextmanager
def hosted(folder):
    """Yields the address of a folder, and a list of the bodies that are sent there."""
    taken = []
    handler = functools.partial(Host, directory=str(folder), taken=taken)
    with browsers.serving(http.server.ThreadingHTTPServer(("127.0.0.1", 0), handler)) as address:
        yield address, taken


def go_on(tab, text, button=0):
    tab.wait(f"document.body?.innerText.includes({json.dumps(text)})")
    tab.click(f".jspsych-btn:nth-of-type({button + 1})")


def pass_quiz(tab, settings, choose):
    for question in settings["quiz"]:
        selector = f"input[value={json.dumps(choose(question))}]"
        tab.wait(f"document.querySelector({json.dumps(selector)}) !== null")
        tab.click(selector)
    tab.click("input[type=submit]")


def press(tab, key, worth):
    """Presses a key when the page waits for an action and the answer is worth something."""
    tab.wait(
        f"document.querySelector('.price b')?.textContent == '{worth}'"
        " && !document.querySelector('aside button[data-action]').disabled"
    )
    tab.press(key)


def files(tab):
    tab.wait("document.querySelectorAll('a[download]').length")
    return tab.evaluate(
        "(async () => Object.fromEntries(await Promise.all([...document.querySelectorAll('a[download]')]"
        ".map(async (a) => [a.download, await (await fetch(a.href)).text()]))))()"
    )


@screens.needs_browser
def test_a_whole_study_loses_nothing_and_plays_nothing_twice(tmp_path):
    tasks = page.prepare(protocol.named([TASK]), range(study.PRACTICE + 2))
    study.write(tmp_path / "study", tasks, 2)
    path = tmp_path / "study" / "study.json"
    settings = json.loads(path.read_text())
    with hosted(tmp_path / "study") as (address, taken), browsers.tab(tmp_path / "profile") as tab:
        settings["datapipe"] = {"address": f"{address}/data", "experiment": "abc"}
        path.write_text(json.dumps(settings))
        tab.open(f"{address}/?participant=no")
        go_on(tab, "I do not agree", 1)
        tab.wait("document.body.innerText.includes('none of your data')")
        assert tab.evaluate("Object.keys(localStorage).length") == 0

        mine = f"{address}/?PROLIFIC_PID=P07&SESSION_ID=s1"
        tab.open(mine)
        go_on(tab, "I agree")
        go_on(tab, "Find out")
        pass_quiz(tab, settings, lambda question: question["options"][1])
        go_on(tab, "Not quite")
        go_on(tab, "Find out")
        pass_quiz(tab, settings, lambda question: question["answer"])
        for _ in range(study.PRACTICE):
            press(tab, FIRST_ANSWER, "1.00")
            tab.wait("document.querySelector('.result')?.innerText.includes('the ideal')")
            tab.photograph(tmp_path / "practice.png")
            tab.click(".next")
            tab.wait("!document.querySelector('.next')")
        go_on(tab, "Now it counts")
        press(tab, "3", "1.00")
        tab.wait("document.querySelector('.price b')?.textContent == '0.95'")
        tab.evaluate("document.body.append(Object.assign(document.createElement('iframe'), {src: location.href}))")
        tab.wait("frames[0]?.document.body?.innerText.includes('another tab')")
        tab.open(mine)  # In the middle of an episode.
        press(tab, "1", "1.00")
        press(tab, FIRST_ANSWER, "0.95")
        saved = files(tab)
        tab.photograph(tmp_path / "end.png")
        tab.open(mine)
        tab.wait("document.body?.innerText.includes('have been saved')")
        tab.open(mine)
        tab.wait("document.body?.innerText.includes('have been saved')")
        simulated = tab.evaluate(SIMULATE)
        assert not tab.errors
    # The first file was refused once; each was taken once.
    assert {sent["filename"]: sent["data"] for sent in taken[1:]} == saved and len(taken) == 1 + len(saved)

    names = sorted(saved)
    assert names == ["participant-P07_session-s1_data.csv", "participant-P07_session-s1_records.jsonl"]
    rows = list(csv.DictReader(io.StringIO(saved[names[0]])))
    described = json.loads((tmp_path / "study" / "dataset_description.json").read_text())["variableMeasured"]
    assert list(rows[0]) == [variable["name"] for variable in described]
    assert {(row["participant"], row["session"], row["order"]) for row in rows} == {("P07", "s1", "1")}
    (_, broken), (_, whole) = settings["orders"][1]
    expected = [("practice", k, k, 8, 0) for k in range(study.PRACTICE)]
    expected += [("trial", 0, broken, 2, 1), ("trial", 1, whole, 0, 0), ("trial", 1, whole, 8, 0)]
    numbers = ["trial", "episode", "action", "interrupted"]
    assert [(row["phase"], *(int(row[name]) for name in numbers)) for row in rows] == expected
    assert all(0 <= int(row["rt_ms"]) <= int(row["time_ms"]) for row in rows)

    (tmp_path / names[1]).write_text(saved[names[1]])
    read, _ = records.read(tmp_path / names[1])
    assert [(record.player, record.episode, record.actions) for record in read] == [("P07", whole, (0, 8))]
    environment = protocol.load(read[0].question)
    played = episodes.play(environment, environment_loop.Repeat([0, 8]), whole)
    environment.close()
    assert [int(row["reward"]) for row in rows[-2:]] == list(played.rewards)

    for data in simulated:
        assert data["over"] and len(data["rewards"]) == len(data["times"]) == len(data["actions"])


# Simulates a trial by its data alone, and one that is shown.
SIMULATE = """(async () => {
  const {PhysexpPlugin, initJsPsych} = await import(`${location.origin}/study.js`);
  const found = [];
  for (const mode of ["data-only", "visual"]) {
    const jsPsych = initJsPsych({display_element: "study"});
    await jsPsych.simulate([{type: PhysexpPlugin, task: "threshold-features", episode: 0}], mode);
    found.push(...jsPsych.data.get().values());
  }
  return found;
})()"""


@pytest.mark.parametrize(("num_tasks", "num_instances"), [(1, 5), (2, 4)])
def test_each_instance_comes_at_each_place_in_as_many_orders(num_tasks, num_instances):
    files = [f"task-{k}" for k in range(num_tasks)]
    found = study.orders(files, num_instances, num_instances)
    trials = {(file, study.PRACTICE + k) for file in files for k in range(num_instances)}
    for order in found:
        assert set(order) == trials and len(order) == len(trials)
    for file in files:
        places = {(order.index((file, each)) % num_instances, each) for order in found for _, each in order}
        assert len(places) == num_instances**2


def test_a_study_that_is_written_again_keeps_its_texts(tmp_path):
    tasks = {"one": {"name": "one", "question": "?", "instances": [{}] * (study.PRACTICE + 3)}}
    study.write(tmp_path, tasks, 1)
    path = tmp_path / "study.json"
    path.write_text(json.dumps({**json.loads(path.read_text()), "consent": "mine"}))
    study.write(tmp_path, tasks, 3)
    found = json.loads(path.read_text())
    assert found["consent"] == "mine" and len(found["orders"]) == 3
