"""A task as data: all that a page needs to play it with MuJoCo alone.

Numbers are exact, so the page computes the same readings as Python. It judges by the answers in the data; for a score,
Python plays the actions again.
"""

from collections.abc import Iterator, Mapping, Sequence
import contextlib
from typing import Any

import numpy as np

from physexp import suite
from physexp.analysis.data import readings as readings_lib
from physexp.analysis.play import tracing
from physexp.analysis.replay import observed
from physexp.analysis.score import protocol
from physexp.suite.engine import apparatus as apparatus_lib
from physexp.suite.engine import contract, episodes

_FRAME = 0.04  # s, between the frames of a film after an answer
_DIGITS = 4  # Of coordinates that are drawn, m.

Data = dict[str, Any]
"""Values that JSON has."""


def export(question: protocol.Question, numbers: Sequence[int], seed: int = protocol.ENVIRONMENT_SEED) -> Data:
    """Returns a task with the instances of some episodes, by their numbers, as the environment of a seed makes them.

    Raises ValueError if it observes pixels, reveals the answer, or has a function that is no expression of arrays.
    """
    task = suite.load_task(question.domain, question.task, {**question.options, "random": seed})
    if task.pixels:
        raise ValueError(f"{question.name} observes pixels, which a page cannot draw bit for bit; give a features task")
    if task.options.reveal:
        raise ValueError(f"{question.name} reveals the answers, which is to check a learner; leave out reveal")
    ledger = episodes.Ledger(task, len(numbers))
    ledger.seeds[:], ledger.next_episodes[:] = seed, numbers
    ledger.begin(np.arange(len(numbers)))
    apparatuses = {each: task.build_apparatus(each) for each in np.unique(ledger.structures).tolist()}
    apparatus = next(iter(apparatuses.values()))
    with _refusing(question.name):
        rules = _rules(task, apparatus)
    return {
        "name": question.name,
        "question": question.question,
        "description": question.description,
        "actions": list(question.action_names),
        "labels": list(question.label_names),
        "interactions": [{"thing": each.thing, "vector": list(map(float, each.vector))} for each in task.interactions],
        "num_questions": question.num_questions,
        "step_limit": question.step_limit,
        "discount": question.discount,
        "tolerance": apparatus_lib.TOUCH_TOLERANCE,
        "seed": seed,
        **rules,
        "structures": {str(each): _structure(task, each, built) for each, built in apparatuses.items()},
        "instances": [
            {"episode": number, **_instance(task, ledger, apparatuses, index)} for index, number in enumerate(numbers)
        ],
        "played_out": _played_out(question, numbers, seed),
    }


@contextlib.contextmanager
def _refusing(name: str) -> Iterator[None]:
    try:
        yield
    except tracing.NotTraced as error:
        raise ValueError(f"{name} cannot be played in a browser: {error}") from error


def _traced(what: str, function: Any, **given: np.ndarray) -> tracing.Rule:
    try:
        return tracing.trace(function, **given)
    except tracing.NotTraced as error:
        raise tracing.NotTraced(f"{what} is no expression of arrays that can be traced: {error}") from error


def _rules(task: contract.Task, apparatus: apparatus_lib.Apparatus) -> Data:
    """Returns the control signals and the readings, which are the same for all structures."""
    model, controls = apparatus.model, task.controls

    def drive(controls: Any, actions: Any, qpos: Any, ctrl: Any) -> Any:
        task.controls = controls
        return task.drive(actions, qpos, ctrl)

    first = dict(actions=np.zeros(1, int), qpos=np.zeros((1, model.nq)), ctrl=np.zeros((1, model.nu)))
    try:
        driven = _traced("its drive", drive, controls=controls, **first)
    finally:
        task.controls = controls
    found = {}
    for shown in readings_lib.shown(task.readings):
        reading = task.readings[shown.name]
        sensors = np.zeros((1, apparatus.readings[shown.name].size))
        found[shown.name] = {
            "meaning": reading.meaning,
            "unit": reading.unit,
            "names": list(shown.names),
            "components": list(shown.components),
            "limits": None if shown.limits is None else shown.limits.tolist(),
            "measure": reading.measure and _traced(f"the measure of {shown.name}", reading.measure, sensors=sensors),
        }
    sizes = [
        indicator.size and _traced(f"the size of {indicator.geom.full_identifier}", indicator.size, value=np.zeros(1))
        for indicator in task.scene.indicators
    ]
    seen = {name: np.zeros((1, *reading.shape)) for name, reading in task.readings.items()}

    def staged(name: str, function: Any) -> tracing.Rule:
        return function and _traced(
            f"the staging of {name}", lambda *values: function(dict(zip(seen, values, strict=True))), **seen
        )

    texts = [each.text for each in task.scene.staged]
    moves = [[staged(s.geom.full_identifier, function) for function in (s.rise, s.lean)] for s in task.scene.staged]
    return {
        "controls": controls.tolist(),
        "drive": driven,
        "readings": found,
        "sizes": sizes,
        "moves": moves,
        "texts": texts,
    }


def _structure(task: contract.Task, structure: int, apparatus: apparatus_lib.Apparatus) -> Data:
    """Returns a compiled model's text, and the addresses in it."""
    model, placing = apparatus.model, observed.placing(task, apparatus, task.readings)
    names = [model.geom(geom).name for geom in range(model.ngeom)]
    return {
        "xml": task.compose(structure),
        "addresses": {name: _flat(addresses) for name, addresses in apparatus.readings.items()},
        "told": _flat(apparatus.told),
        "start": _start(apparatus.start, 0),
        "held": [{"qpos": _flat(held.qpos), "sensordata": _flat(held.shows["sensordata"])} for held in apparatus.held],
        "geoms": names,
        "things": [readings_lib.owner(name) for name in names],
        "floor": [names.index(geom.full_identifier) for geom in (task.root_entity.floor, task.root_entity.mat)],
        "moving": _flat(apparatus.moving_geoms),
        "placed": np.flatnonzero(placing.are_placed).tolist(),
        "joints": [[address, *told] for address, told in placing.joints.items()],
        "displaced": [[geom, *told] for geom, told in placing.displaced.items()],
        "indicators": [
            [geom, each.reading, each.component, list(map(float, each.travel))] for geom, each in placing.indicators
        ],
        "staged": [names.index(each.geom.full_identifier) for each in task.scene.staged],
    }


def _instance(
    task: contract.Task, ledger: episodes.Ledger, apparatuses: Mapping[int, apparatus_lib.Apparatus], index: int
) -> Data:
    """Returns an episode: how its model and its start differ, its answers, and its marks."""
    structure, row = int(ledger.structures[index]), np.array([index])
    apparatus, hidden = apparatuses[structure], ledger.hidden[row]
    fields, starts = task.begin(apparatus, hidden, ledger.nuisances[row])
    revealed = task.reveal(ledger.hidden[index])
    found: Data = {
        "structure": str(structure),
        "substeps": int(ledger.substeps[index]),
        "answers": ledger.answers[index].tolist(),
        "fields": [_field(apparatus.model, name, *given) for name, given in fields],
        "strength": _flat(starts.strength),
        "told": _told(task, hidden),
        "marks": dict(revealed.marks),
        "joined": [list(pair) for pair in revealed.joined],
        "tied": [list(pair) for pair in revealed.tied],
    }
    if ledger.nuisances.shape[1] or len(apparatus.told):
        found["start"] = _start(starts, 0)
    if task.options.noise:
        found["noise"] = _noise(task, ledger, index)
    return found


def _told(task: contract.Task, hidden: np.ndarray) -> list[list[list[float]]]:
    """Returns the values that an episode tells, by the number of the question and that of the steps taken."""
    steps, numbers = range(task.rules.step_limit + 1), range(task.rules.num_questions)
    return [[_flat(task.tell(hidden, np.array([asked]), np.array([step]))) for step in steps] for asked in numbers]


def _start(starts: apparatus_lib.Starts, row: int) -> Data:
    return {"qpos": _flat(starts.qpos[row]), **{field: _flat(values[row]) for field, values in starts.shown.items()}}


def _field(model: Any, name: str, addresses: np.ndarray, values: np.ndarray) -> list[Any]:
    """Returns a model field with the places that differ, in its flat array, and their values."""
    width = int(np.prod(getattr(model, name).shape[1:], dtype=int))
    return [name, _flat(np.asarray(addresses)[:, None] * width + np.arange(width)), _flat(values[0])]


def _noise(task: contract.Task, ledger: episodes.Ledger, index: int) -> list[dict[str, list[float]]]:
    """Returns the noise of the readings of an episode, step by step."""
    row, size, found = np.array([index]), len(ledger.steps), []
    for step in range(task.rules.step_limit + 1):
        ledger.steps[index] = step
        seen = task.observer.blank(size)
        task.observer.complete(ledger, row, seen)
        found.append({name: _flat(values[index]) for name, values in seen.items() if values.any()})
    ledger.steps[index] = 0
    return found


def _played_out(question: protocol.Question, numbers: Sequence[int], seed: int) -> list[list[list[list[float]]]]:
    """Returns the coordinates to which each label leads in each instance, [instances][labels][frames][nq], for eyes."""
    environment = suite.load(question.domain, question.task, {**question.options, "random": seed})
    task, found = environment.task, []
    stride = max(1, round(_FRAME / task.physics_timestep))
    for number in numbers:
        task.next_episode = number
        environment.reset()
        films = []
        for label in range(len(question.label_names)):
            frames = [
                environment.physics.data.qpos.round(_DIGITS).tolist() for _ in task.play_out(environment.physics, label)
            ]
            films.append(frames[::stride] + frames[-1:])
        if not any(films):
            break
        found.append(films)
    environment.close()
    return found


def _flat(values: Any) -> list[Any]:
    return np.asarray(values).ravel().tolist()
