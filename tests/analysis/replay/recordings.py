"""Films of given actions, and the contents of files for the viewer."""

import subprocess

import numpy as np
from rerun.chunk import RrdReader

from physexp import suite
from physexp.analysis import replay
from physexp.analysis.replay import writing


class _Screen:
    """Takes a window's place, and writes into a file."""

    def __init__(self, path):
        self._path = path

    def show(self, stream, layout):
        self.stream = stream
        stream.save(self._path, default_blueprint=layout)

    def flush(self, stream):
        stream.flush()


def play(domain, task, actions, path=None, hidden=None, **task_kwargs):
    """The film of some actions in the first episode; on request with the stream of a viewer beside it, in a file.

    A hidden property takes the place of the one that is drawn.
    """

    def make_task(**_):
        made = suite.load_task(domain, task, {"random": 0, **task_kwargs})
        if hidden is not None:
            made.draw = lambda seeds, episodes: np.repeat(np.asarray(hidden)[None], len(episodes), axis=0)
        return made

    environment, screen = suite.Environment(make_task()), _Screen(path)
    recorder = replay.EpisodeRecorder(domain, task, task_kwargs, agent="you", make_task=make_task)
    observers = [recorder, writing.Live(recorder, screen)] if path else [recorder]
    timestep = environment.reset()
    for observer in observers:
        observer.observe_first(environment, timestep)
    for action in actions:
        timestep = environment.step(action)
        for observer in observers:
            observer.observe(environment, timestep, action)
    if path:
        screen.stream.disconnect()
    film = recorder.episode
    recorder.close()
    environment.close()
    return film


def written(path, film):
    """The contents of a film's file."""
    return contents(writing.write(path, [lambda: [film]]))


def contents(path):
    """The columns of each entity of a file, without the time at which they were made."""
    found = {}
    for chunk in RrdReader(str(path)).stream():
        entity = found.setdefault(str(chunk.entity_path), {})
        for name, values in chunk.to_record_batch().to_pydict().items():
            if not name.startswith(("log_", "rerun")):
                entity.setdefault(name, []).extend(values)
    return {entity: columns for entity, columns in found.items() if not entity.startswith("/__properties")}


def below(rows, root):
    """The names of the entities below another one."""
    return {entity.removeprefix(root) for entity in rows if entity.startswith(root)}


def text_of(path):
    """All of a file as text, its layout too."""
    command = [writing.PROGRAM, "rrd", "print", "-vvv", path]
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout


def verify(path):
    """Fails unless rerun finds a file whole."""
    subprocess.run([writing.PROGRAM, "rrd", "verify", path], check=True, capture_output=True)
