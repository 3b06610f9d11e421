"""Language models play over the Model Context Protocol: with the library's own client, over both transports."""

import contextlib
import json
import os
import random
import re
import subprocess
import sys

import anyio
import mcp
import psutil
import pytest
from seeds import fresh_seed

from physexp import cli, suite
from physexp.analysis.score import instances, protocol, records, serving, transcripts

ARGUMENTS = ["-m", "physexp.cli", "serve"]
FEATURES = ["/".join(names) for names in suite.tagged("features")]


def over_streams(folder, *arguments):
    """Returns a client of a server of its own, over the standard streams."""
    everything = [*ARGUMENTS, *arguments, "--output", str(folder)]
    return mcp.Client(mcp.StdioServerParameters(command=sys.executable, args=everything, env={**os.environ}))


@contextlib.contextmanager
def serving_http(folder, *arguments):
    """Returns a server that serves HTTP, and its address."""
    everything = [sys.executable, *ARGUMENTS, *arguments, "--output", str(folder), "--http", "0"]
    with subprocess.Popen(everything, stdout=subprocess.PIPE, text=True) as server:
        try:
            yield server, server.stdout.readline().strip()
        finally:
            server.terminate()


async def said(client, tool, **arguments):
    """Returns the text of a call's result."""
    return (await client.call_tool(tool, arguments)).content[0].text


async def begun(client, task):
    """Begins an episode; returns its handle and the text."""
    text = await said(client, "begin", task=task)
    return re.match(r"This is episode (\w+)\.", text)[1], text


async def play_at_random(client, task, generator):
    """Plays an episode of a task from its texts alone; returns the last one."""
    handle, text = await begun(client, task)
    rules = await said(client, "rules", episode=handle)
    assert rules in text
    counts = [len(re.findall(r"^  \d+:", part, re.M)) for part in re.split("Answers:|Readings:", rules)]
    for _ in range(2):
        text = await said(client, "experiment", episode=handle, number=generator.randrange(counts[0]))
        assert "You have done" in text
    return await said(client, "answer", episode=handle, number=generator.randrange(counts[1]))


def test_a_client_plays_every_task_and_the_server_ends_with_it(tmp_path):
    generator = random.Random(fresh_seed())

    async def play():
        async with over_streams(tmp_path, *FEATURES, "--episodes", "1") as client:
            tools = {tool.name: tool for tool in (await client.list_tools()).tools}
            assert tools["experiment"].input_schema["required"] == ["episode", "number"]
            assert all(tool.description for tool in tools.values())
            for task in FEATURES:
                assert "the episode is over" in await play_at_random(client, task, generator)
            (server,) = [child for child in psutil.Process().children() if "serve" in child.cmdline()]
            assert not server.net_connections()
            return server

    server = anyio.run(play)
    assert not server.is_running() or server.status() == psutil.STATUS_ZOMBIE
    records = [json.loads(line) for line in (tmp_path / transcripts.RECORDS).read_text().splitlines()]
    assert [record["task"] for record in records] == [question.name for question in protocol.named(FEATURES)]


def test_clients_play_every_task_over_http_and_see_images(tmp_path):
    generator = random.Random(fresh_seed())
    with serving_http(tmp_path, *FEATURES, "strings/pixels") as (server, address):

        async def play():
            async with mcp.Client(address) as one, mcp.Client(address) as other:
                (mine, _), (theirs, _) = [await begun(client, "strings/features") for client in (one, other)]
                await said(one, "experiment", episode=mine, number=0)
                assert "You have done 1 of" in await said(one, "observe", episode=mine)
                assert "You have done 0 of" in await said(other, "observe", episode=theirs)
                for task in FEATURES:
                    assert "the episode is over" in await play_at_random(other, task, generator)
                result = await one.call_tool("begin", {"task": "strings/pixels"})
                assert [part.type for part in result.content] == ["text", "image"]

        anyio.run(play)
        listening = [one for one in psutil.Process(server.pid).net_connections() if one.status == psutil.CONN_LISTEN]
        assert [one.laddr.ip for one in listening] == ["127.0.0.1"]
    assert server.returncode == 143 and (tmp_path / transcripts.RECORDS).exists()  # 128 and SIGTERM's number.


@contextlib.asynccontextmanager
async def in_memory(folder):
    """Returns a client of a server in this process."""
    with transcripts.run(folder, model="m", harness="h", tools="none", budget="none") as run:
        desk = serving.Desk(run, protocol.named(["strings/features"]), 2)
        async with mcp.Client(serving.server(desk)) as client:
            yield client


def test_senseless_calls_are_refused_and_a_new_server_goes_on(tmp_path):
    generator = random.Random(fresh_seed())
    values = [0.5, True, None, "", "x" * 9999, [], {}, [[[]]], {"a": {"b": []}}, 10**400]

    async def play():
        async with in_memory(tmp_path) as client:
            before = await client.call_tool("experiment", {"episode": "none", "number": 0})
            assert before.is_error and "give the handle of an episode, which begin tells" in before.content[0].text
            handle, _ = await begun(client, "strings/features")
            for _ in range(300):
                name = generator.choice(["begin", "experiment", "answer", "believe", "nonsense", "note", ""])
                keys = generator.sample(["number", "task", "probabilities", "self", "episode", "more"], 2)
                given = {key: generator.choice(values) for key in keys}
                result = await client.call_tool(name, {"episode": handle, **given} if name != "begin" else given)
                text = result.content[0].text
                assert result.is_error and re.match(r"Refused: [^\n]*(give|call|begin|arguments are)[^\n]*\.$", text), (
                    text
                )
            return await said(client, "experiment", episode=handle, number=1)

    async def go_on(last):
        async with in_memory(tmp_path) as client:
            _, text = await begun(client, "strings/features")
            assert text.endswith(last) and "experiment(1)" in text
            await begun(client, "strings/features")
            return await said(client, "begin", task="strings/features")

    assert "all 2 episodes of strings/features have begun" in anyio.run(go_on, anyio.run(play))


def test_private_instances_are_judged_and_nothing_tells_their_key(tmp_path, monkeypatch, capsys):
    private = instances.draw()
    instances.write(tmp_path / "secret.json", private, protocol.VERSION)
    (question,) = protocol.named(["threshold/features"])
    folder, replies = tmp_path / "run", []

    async def play():
        chosen = ("--episodes", "2", "--instances", str(tmp_path / "secret.json"))
        async with over_streams(folder, question.name, *chosen) as client:
            for _ in range(2):
                handle, text = await begun(client, question.name)
                calls = [("experiment", 3), ("experiment", 8), ("answer", 0)]
                told = [await said(client, tool, episode=handle, number=number) for tool, number in calls]
                replies.extend([text, await said(client, "answer", number=0, episode=private.key_hash), *told])

    anyio.run(play)
    environment, seeds = protocol.load(question), [private.seed_of(question.name, index) for index in range(2)]
    for index, seed in enumerate(seeds):
        environment.task.reseed(seed)
        environment.task.next_episode = index
        environment.reset()
        assert f"The right answer is {environment.task.correct_answer}," in replies[5 * index + 4]
    path = folder / transcripts.RECORDS
    assert [json.loads(line)["key_hash"] for line in path.read_text().splitlines()] == [private.key_hash] * 2
    kept = [path.read_text(), (folder / transcripts.TRANSCRIPT).read_text(), *replies]
    assert not [secret for secret in (private.key, *map(str, seeds), '"seed"') for text in kept if secret in text]

    (known, other), _ = records.read(path, private)
    assert [known.seed, other.seed] == seeds
    arguments = ["score", "--records", str(path), "--instances", str(tmp_path / "secret.json"), "--json"]
    monkeypatch.setattr(sys, "argv", ["physexp", *arguments])
    cli.main()
    assert json.loads(capsys.readouterr().out)["not told"][question.name]["episodes"] == 2
    with pytest.raises(ValueError, match=f"line 1: key_hash, .* is '{private.key_hash}'; give their --instances FILE"):
        records.read(path)
    with pytest.raises(ValueError, match=f"is '{private.key_hash}'; that of the instances is "):
        records.read(path, instances.draw())


def test_the_extra_is_named_where_it_is_missing(monkeypatch):
    monkeypatch.setitem(sys.modules, "mcp", None)
    with pytest.raises(ModuleNotFoundError, match=r"pip install 'physexp\[mcp\]'"):
        from physexp import extras

        extras.require("mcp")
