"""A task of Inspect (https://inspect.aisi.org.uk), around the class that plays in words.

inspect eval inspect_task.py --model MODEL -T name=strings/features plays it, as Inspect plays any task.
python inspect_task.py FOLDER MODEL plays it, too, and writes the records that `physexp score --records` takes; without
a model, a scripted one plays Threshold by halving.
"""

import contextlib
import functools
import json
from pathlib import Path
import sys

import inspect_ai
from inspect_ai import dataset, model, scorer, solver, task, tool

from physexp.analysis.score import protocol
from physexp.suite import words

REPLIES = 60  # Of the model, in an episode.


def as_tool(method):
    """Returns a tool of an episode as one of Inspect, which reads its name, docstring and type hints."""

    @functools.wraps(method)
    async def execute(*args, **kwargs):
        try:
            return method(*args, **kwargs)
        except words.Refusal as refusal:
            raise tool.ToolError(f"{refusal}.") from None

    return tool.ToolDef(execute, name=method.__name__).as_tool()


@solver.solver
def plays():
    """Lets the model play an episode, until it is over or the replies are spent."""

    async def solve(state, generate):
        (question,) = protocol.named([state.metadata["task"]])
        with contextlib.closing(protocol.load(question)) as environment:
            episode = words.Episode(environment, state.metadata["episode"])
            rules, begin = (message["content"] for message in episode.messages())
            state.messages = [model.ChatMessageSystem(content=rules), model.ChatMessageUser(content=begin)]
            state.tools = [as_tool(method) for method in episode.tools]
            for _ in range(REPLIES):
                state = await generate(state, tool_calls="single")
                if episode.is_over:
                    break
                if not state.output.message.tool_calls:
                    state.messages.append(model.ChatMessageUser(content="Call a tool."))
            else:
                episode.stop(f"{REPLIES} replies")
            state.metadata["record"] = episode.record()
        return state

    return solve


@scorer.scorer(metrics=[scorer.mean(), scorer.stderr()])
def discounted_return():
    """Tells the discounted return of the episode."""

    async def score(state, target):
        return scorer.Score(value=state.metadata["record"]["return"], metadata={"record": state.metadata["record"]})

    return score


@task  # By this very name inspect eval finds it.
def experiments(name="strings/features", episodes=50):
    """Has the first episodes of a task of physexp, as the score plays them."""
    samples = [
        dataset.Sample(id=index, input=name, metadata={"task": name, "episode": index}) for index in range(episodes)
    ]
    return inspect_ai.Task(dataset=samples, solver=plays(), scorer=discounted_return())


def records(log):
    """Yields the records of a log of Inspect, with the tokens that it has counted."""
    player = {"player": log.eval.model, "harness": f"inspect_ai {inspect_ai.__version__}", "tools": "none"}
    for sample in log.samples:
        tokens = sum(usage.total_tokens for usage in sample.model_usage.values())
        record = {**sample.scores["discounted_return"].metadata["record"], "told": {"tokens": tokens}}
        yield {**player, "budget": f"{REPLIES} replies an episode", "task": sample.metadata["task"], **record}


def halves(messages, tools, tool_choice, config):
    """Returns the next call of a scripted model, which plays Threshold from the texts: it halves the forces."""
    low, high = 0, 7
    pushes = [message.tool_calls[0].arguments["number"] for message in messages if message.role == "assistant"]
    for push, reply in zip(pushes, (message for message in messages if message.role == "tool"), strict=True):
        low, high = (low, push) if "slid = [1]" in reply.text else (push + 1, high)
    name, number = ("answer", low) if low == high else ("experiment", (low + high) // 2)
    output = model.ModelOutput.for_tool_call("mockllm/model", name, {"number": number})
    output.usage = model.ModelUsage(input_tokens=1, output_tokens=1, total_tokens=2)  # Else Inspect loads a tokenizer.
    return output


if __name__ == "__main__":
    folder, *names = sys.argv[1:]
    player = names[0] if names else model.get_model("mockllm/model", custom_outputs=halves)
    played = experiments("strings/features" if names else "threshold/features")
    (log,) = inspect_ai.eval(played, model=player, log_dir=folder, display="plain")
    lines = [json.dumps(record) + "\n" for record in records(log)]
    Path(folder, "records.jsonl").write_text("".join(lines), encoding="utf-8")
