"""A server of the Model Context Protocol (https://modelcontextprotocol.io): clients play episodes in words.

The protocol has no sessions, so each call has the handle of an episode. The server runs no code that it is given, and
writes into the folder of its run alone.
"""

import base64
from collections.abc import Callable, Mapping, Sequence
import inspect
import secrets
import socket
from typing import Any, get_type_hints

import physexp
from physexp import checks, extras, suite
from physexp.analysis.score import protocol, transcripts
from physexp.suite import words

extras.require("mcp")

import anyio  # noqa: E402
from mcp.server import lowlevel, stdio  # noqa: E402
import mcp_types as types  # noqa: E402
import uvicorn  # noqa: E402

HOST = "127.0.0.1"

_BEGIN = "begin"
_TYPES: Mapping[Any, Mapping[str, Any]] = {
    int: {"type": "integer"},
    str: {"type": "string"},
    list[float]: {"type": "array", "items": {"type": "number"}},
}


class Desk:
    """Gives out the episodes of some tasks, and makes the calls of clients.

    Attributes:
      tools: descriptions of all tools, for clients.
    """

    def __init__(
        self,
        run: transcripts.Run,
        questions: Sequence[protocol.Question],
        count: int = transcripts.EPISODES,
        *,
        level: str = "named",
        digits: int | None = None,
    ):
        """Takes the run that keeps the episodes, and the tasks; the others are as for `transcripts.Run.episodes`."""
        self._run, self._count, self._told = run, count, (level, digits)
        self._questions = {question.name: question for question in questions}
        self._begun = dict.fromkeys(self._questions, 0)
        self._playing: dict[str, list[words.Episode]] = {name: [] for name in self._questions}
        self._episodes: dict[str, words.Episode] = {}  # By handle.
        names = [*self._questions]
        self.tools = [
            types.Tool(
                name=_BEGIN,
                description="Begins the next episode of a task; tells its rules, and its handle for other calls.",
                input_schema=_schema({"task": {"type": "string", "enum": names}}),
            ),
            *map(_described, words.TOOLS),
        ]

    def call(self, name: str, arguments: Mapping[str, Any]) -> tuple[str, bytes | None]:
        """Makes a call; returns its text, and the image that is seen, as PNG; raises `words.Refusal`."""
        if name == _BEGIN:
            return self._begin(arguments)
        if name not in words.TOOLS:
            raise words.Refusal(f"there is no tool {checks.shown(name)}; call {', '.join((_BEGIN, *words.TOOLS))}")
        given = dict(arguments)
        handle = given.pop("episode", None)
        episode = self._episodes.get(handle) if isinstance(handle, str) else None
        if episode is None:
            raise words.Refusal(f"episode is {checks.shown(handle)}; give the handle of an episode, which begin tells")
        told = episode.call(name, given)
        return told, episode.image

    def _begin(self, arguments: Mapping[str, Any]) -> tuple[str, bytes | None]:
        name = arguments.get("task")
        if not isinstance(name, str) or name not in self._questions or len(arguments) > 1:
            raise words.Refusal(
                f"arguments is {checks.shown(arguments)}; give task, one of {', '.join(self._questions)}"
            )
        question = self._questions[name]
        while self._begun[name] < self._count:
            environment = self._environment(question)
            episode = self._run.begin(question, environment, self._begun[name], *self._told)
            self._begun[name] += 1
            if not episode.is_over:
                handle = secrets.token_hex(4)
                self._episodes[handle] = episode
                self._playing[name].append(episode)
                story = "\n\n".join(message["content"] for message in episode.messages())
                return f"This is episode {handle}.\n\n{story}", episode.image
        raise words.Refusal(f"all {self._count} episodes of {name} have begun; begin one of another task, or stop")

    def _environment(self, question: protocol.Question) -> suite.Environment:
        """Returns an environment of a task in which no episode goes on."""
        playing = self._playing[question.name]
        for episode in playing:
            if episode.is_over:
                playing.remove(episode)
                return episode.environment
        return protocol.load(question)


def over_streams(desk: Desk) -> None:
    """Serves the client at the standard streams until it closes them."""
    served = server(desk)

    async def serve() -> None:
        async with stdio.stdio_server() as (incoming, outgoing):
            await served.run(incoming, outgoing, served.create_initialization_options())

    anyio.run(serve)


def over_http(desk: Desk, port: int, show: Callable[[str], None]) -> None:
    """Serves programs on this machine until the process is stopped; shows the address.

    Port 0 means any that is free. Raises OSError for one that is not.
    """
    with socket.create_server((HOST, port)) as listener:
        show(f"http://{HOST}:{listener.getsockname()[1]}/mcp")
        config = uvicorn.Config(server(desk).streamable_http_app(host=HOST), log_level="warning")
        uvicorn.Server(config).run([listener])


def server(desk: Desk) -> lowlevel.Server[Any]:
    """Returns the server of a desk, without a transport."""

    async def list_tools(context: Any, params: Any) -> types.ListToolsResult:
        return types.ListToolsResult(tools=desk.tools)

    async def call_tool(context: Any, params: types.CallToolRequestParams) -> types.CallToolResult:
        try:
            text, image = desk.call(params.name, params.arguments or {})
        except words.Refusal as refusal:
            return types.CallToolResult(content=[types.TextContent(text=f"Refused: {refusal}.")], is_error=True)
        content: list[Any] = [types.TextContent(text=text)]
        if image is not None:
            content.append(types.ImageContent(data=base64.b64encode(image).decode(), mime_type="image/png"))
        return types.CallToolResult(content=content)

    told = "Experiments with a hidden property. Begin an episode, experiment, and answer; each step has a price."
    return lowlevel.Server(
        "physexp",
        version=physexp.__version__,
        instructions=told,
        on_list_tools=list_tools,
        on_call_tool=call_tool,
    )


def _described(name: str) -> types.Tool:
    """Returns the description of a tool of an episode, from its docstring and its type hints."""
    method = getattr(words.Episode, name)
    text, _, meanings = (inspect.getdoc(method) or "").partition("\n\nArgs:\n")
    kinds = {key: kind for key, kind in get_type_hints(method).items() if key != "return"}
    properties: dict[str, Any] = {"episode": {"type": "string", "description": "The handle of the episode."}}
    for key, kind in kinds.items():
        properties[key] = {**_TYPES[kind], "description": meanings.partition(f"{key}: ")[2].partition("\n")[0]}
    return types.Tool(name=name, description=text, input_schema=_schema(properties))


def _schema(properties: Mapping[str, Any]) -> dict[str, Any]:
    return {"type": "object", "properties": properties, "required": [*properties], "additionalProperties": False}
