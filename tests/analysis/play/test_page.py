"""The page, in a browser: it computes the same bits as Python, tells no more than readings do, and writes records."""

import contextlib
import hashlib
import itertools
import json
from pathlib import Path
import re
import select
import socket
import struct
import threading
import urllib.error
import urllib.request

import browsers
import numpy as np
import pytest
import screens
import seeds
import waiting

from physexp import suite
from physexp.analysis.play import exporting, page
from physexp.analysis.score import protocol, records

pytestmark = screens.needs_browser

SOURCES = Path(__file__).parents[3] / "page"
OPTIONS = [
    "which_is_heavier/features,variation=1,noise=0.01",
    "threshold/features,flag_noise=0.2",
    "balance/features,latch=True",
    "balance/features,questions=all",
    "strings/features,num_pucks=4,num_clamps=2",
    "strings/features,questions=held_out,num_questions=3",
    "sealed_box/features,step_variation=0.5",
]
TASKS = [f"{domain}/{task}" for domain, task in suite.tagged("features")] + OPTIONS
EPISODES = [0, 1, 57]
SHORT = 6  # Actions, after which contacts still give equal numbers to 1e-9.


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """A page with some tasks, in one file."""
    tasks = page.prepare(protocol.named(["threshold/features", "strings/features", "balance/features"]), EPISODES)
    return tasks, page.write_single(tmp_path_factory.mktemp("page") / "page.html", tasks)


@pytest.fixture(scope="module")
def tab(made, tmp_path_factory):
    with browsers.tab(tmp_path_factory.mktemp("profile")) as opened:
        opened.open(made[1].as_uri())
        opened.wait("document.body?.dataset.state == 'ready'")
        yield opened


def begin(tab, path, query):
    tab.open(f"{path.as_uri()}?{query}")
    tab.wait("document.body?.dataset.state == 'ready'")


# Plays actions in the instances 0, 1 and so on; returns the readings as hexadecimal float32, and the rewards.
PLAY = """(async () => {
  const {task, played} = %s;
  const world = new physexp.player.world.constructor(physexp.mujoco, task);
  const hex = (seen) => Object.keys(task.readings).map((name) => Array.from(new Uint8Array(seen[name].buffer),
    (byte) => byte.toString(16).padStart(2, "0")).join("")).join("");
  const found = played.map((actions, episode) => {
    const seen = [hex(world.reset(episode)), ...actions.map((action) => hex(world.step(action)))];
    return {seen, rewards: world.judged.rewards, pose: JSON.stringify(world.placed(world.observation))};
  });
  for (const part of [world.drawn, world.data, world.model]) part.delete();
  return found;
})()"""


def python_plays(environment, index, choose):
    """The actions, readings and rewards of an episode in Python."""
    environment.task.next_episode = index
    timestep, actions, rewards = environment.reset(), [], []
    seen = [timestep.observation]
    while not timestep.last():
        actions.append(choose(len(actions)))
        timestep = environment.step(actions[-1])
        rewards.append(timestep.reward)
        seen.append(timestep.observation)
    values = [np.concatenate([each[name].ravel() for name in environment.task.readings]) for each in seen]
    return actions, np.array(values), rewards


@pytest.mark.parametrize("name", TASKS)
def test_the_page_observes_the_same_bits_as_python_and_judges_as_it_does(name, tab):
    (question,), generator = protocol.named([name]), np.random.default_rng(seeds.fresh_seed())
    environment = protocol.load(question)
    has_contacts = environment.task.root_entity.mjcf_model.option.flag.contact != "disable"
    count, labels = question.num_interactions, len(question.label_names)

    def choose(step, last):
        is_answer = step + 1 >= last or (question.num_questions > 1 and generator.random() < 0.2)
        return int(generator.integers(count, count + labels) if is_answer else generator.integers(count))

    lasts = [generator.integers(1, SHORT + 1) if has_contacts or k % 2 else question.step_limit for k in range(4)]
    played = [python_plays(environment, k, lambda step, last=last: choose(step, last)) for k, last in enumerate(lasts)]
    asked = {"task": exporting.export(question, range(len(played))), "played": [actions for actions, *_ in played]}
    for (_, values, rewards), found in zip(played, tab.evaluate(PLAY % json.dumps(asked)), strict=True):
        seen = np.array([np.frombuffer(bytes.fromhex(each), np.float32) for each in found["seen"]])
        np.testing.assert_allclose(seen, values, rtol=0, atol=1e-9 if has_contacts else 0)
        assert has_contacts or seen.tobytes() == values.tobytes()
        assert found["rewards"] == rewards
    environment.close()


@pytest.mark.parametrize(
    ("name", "actions"),
    [("strings/features", [0, 1, 2]), ("threshold/features", [3, 1, 5]), ("balance/features", [1, 5, 8])],
)
def test_nothing_drawn_before_the_answer_tells_more_than_the_readings(name, actions, tab):
    (question,) = protocol.named([name])
    data = exporting.export(question, range(24))
    data["played_out"] = []
    found = tab.evaluate(PLAY % json.dumps({"task": data, "played": [actions] * 24}))
    pairs = 0
    for (k, first), (j, second) in itertools.combinations(enumerate(found), 2):
        if first["seen"] == second["seen"]:
            assert first["pose"] == second["pose"]
            pairs += data["instances"][k]["answers"] != data["instances"][j]["answers"]
    assert pairs > 5


# Weighs blocks 0 to 2 on the left pan against the others.
WEIGH = """(() => {
  const {world} = physexp.player;
  const before = world.placed(world.observation);
  for (const action of [1, 4, 7, 11, 14, 17]) physexp.player.pose = world.placed(world.step(action));
  physexp.player.draw();
  const rise = (geom) => physexp.player.pose.positions[3 * geom + 2] - before.positions[3 * geom + 2];
  const marks = [...document.querySelectorAll(".marks > span")];
  return {
    tilt: world.observation.tilt[0],
    rises: Object.fromEntries(world.structure.geoms.map((name, geom) => [name, rise(geom)])),
    places: Object.fromEntries(marks.map((mark) => [mark.textContent, parseFloat(mark.style.left)])),
  };
})()"""


def test_a_pan_rises_with_its_blocks_and_a_board_stands_at_its_number(made, tab):
    begin(tab, made[1], "task=balance/features")
    found = tab.evaluate(WEIGH)
    light, heavy = ("left", "right") if found["tilt"] > 0 else ("right", "left")
    blocks = {"left": range(3), "right": range(3, 6)}
    assert found["rises"][f"{light}_pan"] > 0.01 and found["rises"][f"{heavy}_pan"] == 0
    for side in (light, heavy):
        assert {found["rises"][f"block_{k}/geom"] for k in blocks[side]} == {found["rises"][f"{side}_pan"]}
    assert found["places"]["tilt"] == pytest.approx(found["places"]["1" if light == "left" else "\u22121"], abs=1)


def test_buttons_keys_and_things_are_played_and_the_record_is_played_again(made, tab):
    tasks, path = made
    begin(tab, path, "task=threshold/features&episode=1&player=someone")
    tab.click('aside [data-action="3"]')
    tab.wait("physexp.player.times.length == 1 && !physexp.player.isBusy")
    assert tab.evaluate("document.querySelector('.price b').textContent") == "0.95"
    tab.click(".marks .name")  # The block, which eight pushes act on.
    tab.click('.menu [data-action="5"]')
    tab.wait("physexp.player.times.length == 2 && !physexp.player.isBusy")
    tab.press("5")
    tab.wait("physexp.player.times.length == 3 && !physexp.player.isBusy")
    points = tab.evaluate("document.querySelector('.plot polyline').getAttribute('points')").split()
    first, *heights = (float(point.split(",")[1]) for point in points)  # At first nothing pushes.
    assert [(first - height) / (first - heights[1]) for height in heights] == pytest.approx([4 / 6, 1, 5 / 6])
    tab.click('aside [data-action="12"]')
    tab.wait("!physexp.player.result.hidden")
    record = json.loads(tab.evaluate("localStorage.physexp"))[-1]
    assert {**record, "times": 0} == {
        "player": "someone",
        "task": "threshold/features",
        "seed": protocol.ENVIRONMENT_SEED,
        "episode": 1,
        "actions": [3, 5, 4, 12],
        "times": 0,
    }
    assert len(record["times"]) == 4 and min(record["times"]) >= 0
    environment = protocol.load(*protocol.named([record["task"]]))
    moves = iter(record["actions"])
    _, _, rewards = python_plays(environment, record["episode"], lambda step: next(moves))
    environment.close()
    assert tab.evaluate("physexp.player.world.judged.rewards") == rewards
    told = tab.evaluate("document.querySelector('.result').innerText")
    assert ("Right" if rewards[-1] > 0 else "Wrong") in told and "the ideal" in told and "our agent" in told
    assert tab.evaluate("physexp.player.scene.meshes.some((mesh) => mesh?.material.opacity === 0.25)")  # The cover.
    assert not tab.errors
    assert {address.partition("?")[0] for address in tab.requests} <= {path.as_uri(), "data:,"}


def test_a_link_replays_an_episode_and_records_nothing(made, tab):
    tasks, path = made
    before = tab.evaluate("localStorage.physexp ?? ''")
    ideal = tasks["strings-features"]["instances"][2]["others"]["the ideal"]
    begin(tab, path, f"task=strings/features&episode={EPISODES[2]}&actions={','.join(map(str, ideal))}")
    assert tab.evaluate("physexp.player.world.judged.rewards.at(-1)") == 1
    assert tab.evaluate("physexp.player.record().episode") == EPISODES[2]
    assert tab.evaluate("location.href") in tab.evaluate("physexp.link").replace("%3A", ":")
    assert tab.evaluate("localStorage.physexp ?? ''") == before
    assert tab.evaluate("document.querySelector('.result table').innerText").startswith("replay")


@pytest.mark.parametrize(
    ("query", "said"),
    [
        (
            "task=strings/features,num_pucks=4",
            "no task strings/features,num_pucks=4; choose from threshold/features, strings/features, balance/features",
        ),
        ("task=strings/features&episode=2", "no episode 2 of strings/features; choose from 0, 1, 57"),
    ],
)
def test_a_link_to_what_the_page_lacks_lists_what_it_has(query, said, made, tab):
    tab.open(f"{made[1].as_uri()}?{query}")
    tab.wait("document.body?.dataset.state == 'failed'")
    assert tab.evaluate("document.querySelector('main').textContent").endswith(said)
    tab.errors.clear()


@contextlib.contextmanager
def served(tasks, path):
    """Yields the address of a page that keeps records, and the lines that it tells."""
    told = []
    with path.open("w") as file, browsers.serving(page.server(tasks, file, told.append)) as address:
        yield address, told


def answer(tab):
    """Gives the first answer of Threshold by its key, when the page waits for an action."""
    tab.wait("document.body?.dataset.state == 'ready' && !document.querySelector('aside button').disabled")
    tab.press("9")
    tab.wait("!physexp.player.result.hidden")


def test_a_served_page_sends_its_records_and_shows_the_mistakes_in_them(made, tab, tmp_path):
    path, mistakes = tmp_path / "records.jsonl", "document.querySelector('.mistakes')"
    with served(made[0], path) as (address, told):
        tab.open(f"{address}/?task=threshold/features&episode=0")
        answer(tab)
        tab.wait(f"{mistakes}.querySelector('table') !== null")
        shown = tab.evaluate(f"{mistakes}.innerText").split()
        tab.evaluate("AbortSignal.timeout = () => AbortSignal.abort(new DOMException('', 'TimeoutError'))")
        tab.click(".next")
        answer(tab)
        tab.wait(f"{mistakes}.innerText == 'The moves are not judged: it takes too long here.'")
        assert "the ideal" in tab.evaluate("document.querySelector('.result').innerText")
        tab.wait("performance.getEntriesByName(`${location.origin}/records`).length == 2")
    assert not told and not tab.errors
    kept, _ = records.read(path)
    assert [(record.episode, record.actions) for record in kept] == [(EPISODES[0], (8,)), (EPISODES[1], (8,))]
    question = kept[0].question
    by_chance = 2 / len(question.label_names) - 1  # All answers are equally likely.
    cost = protocol.ideal(question).value - by_chance
    assert " ".join(shown).startswith(
        f"Mistakes, and what each cost 1. {question.action_names[8]} early: an answer when"
    )
    assert shown[-1] == f"\u2212{cost:.2f}"


TWICE = b'"seed": 0, "episode": 0, "actions": [8, 8], "times": [0, 0]'


@pytest.mark.parametrize(
    ("service", "content", "said"),
    [
        ("records", b'{"player": "me", "task"', "a record of the page is no object of JSON"),
        ("records", b'{"player": "me", "task": "lump", "actions": [], "times": []}', "task is 'lump'; choose from"),
        ("mistakes", b'{"player": "me", "task": "threshold/features", %s}' % TWICE, "ends after 1 of its 2 actions"),
    ],
)
def test_a_record_that_is_none_is_refused_in_one_line(service, content, said, made, tmp_path):
    path = tmp_path / "records.jsonl"
    with served(made[0], path) as (address, told):
        sent = urllib.request.Request(f"{address}/{service}", content, {"Origin": address})
        with pytest.raises(urllib.error.HTTPError, match="400") as refused:
            urllib.request.urlopen(sent)
        answered = refused.value.read().decode()
        with pytest.raises(urllib.error.HTTPError, match="403"):
            urllib.request.urlopen(urllib.request.Request(sent.full_url, content, {"Origin": "http://elsewhere"}))
    assert said in answered and "\n" not in answered
    assert told == [f"refused: {answered}"] and path.read_text() == ""


def test_a_page_that_no_longer_waits_for_its_mistakes_leaves_no_traceback(made, tmp_path, capfd):
    with served(made[0], tmp_path / "records.jsonl") as (address, told):
        before, (host, port) = threading.active_count(), address.removeprefix("http://").split(":")
        body = b'{"player": "me", "task": "threshold/features", "times": [0], "seed": 0, "episode": 0, "actions": [8]}'
        lines = [
            "POST /mistakes HTTP/1.1",
            f"Host: {host}:{port}",
            f"Origin: {address}",
            f"Content-Length: {len(body)}",
        ]
        with socket.create_connection((host, int(port))) as closed:
            closed.sendall("\r\n".join([*lines, "", ""]).encode() + body)

            def is_taken():
                return threading.active_count() > before or select.select([closed], [], [], 0)[0]

            waiting.wait_until(is_taken, "the request is taken")
            closed.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))  # It is reset.
        waiting.wait_until(lambda: threading.active_count() == before, "the request is done")
    assert not told and not capfd.readouterr().err


def test_the_built_page_is_of_the_sources_which_name_no_domain():
    files = sorted(SOURCES.glob("src/*"))
    names = [SOURCES / name for name in ("build.js", "package-lock.json", "package.json")] + files
    built = (page.SITE / "sources.sha256").read_text().strip()
    assert hashlib.sha256(b"".join(path.read_bytes() for path in names)).hexdigest() == built, "run `make page`"
    words = {word for path in files for word in re.findall(r"\w+", path.read_text())}
    assert not words & set(suite.TASKS_BY_DOMAIN)
