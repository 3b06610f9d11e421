"""Bad input is refused in one line with what was given and what is allowed, and changes nothing."""

import dataclasses
import decimal
import fractions
import re

import numpy as np
import pytest

from physexp import checks, suite
from physexp.suite import gymnasium as gymnasium_lib
from physexp.suite import stable_baselines

HEAVIER = ("which_is_heavier", "features")


def _refuses(*fragments: str, error=ValueError):
    """Expects an error whose message has every fragment."""
    return pytest.raises(error, match="".join(f"(?s:(?=.*{re.escape(fragment)}))" for fragment in fragments))


def _is_one_line(refused) -> bool:
    return "\n" not in str(refused.value) and len(str(refused.value)) < 300


def _assert_same(one: dict, other: dict) -> None:
    assert {name: v.tobytes() for name, v in one.items()} == {name: v.tobytes() for name, v in other.items()}


# Checks: every option of a task and every hyperparameter has one of these.

NO_INTEGERS = [-1, -(2**70), 1.5, 2.0, np.float64(2), "2", None, True, np.bool_(False), [2], 2**70, np.timedelta64(2)]
NO_INTEGERS += [10**5000]  # Python spells no integer of so many digits.
NO_NUMBERS = [np.nan, np.inf, -np.inf, np.float32("nan"), 10**400, "0.5", None, True, np.bool_(True), 5j, [5], {}]
NO_NUMBERS += [np.array([5.0]), np.complex64(5), np.timedelta64(5), decimal.Decimal(5), fractions.Fraction(5)]
CHECKS = {
    "at least": (checks.at_least(1, "kg"), [1, 1.0, 1e300, np.float32(3), 2**70], [*NO_NUMBERS, 0.9, 0], ">= 1 (kg)"),
    "above": (checks.above(0, "s"), [1e-9, 5, np.int64(7)], [*NO_NUMBERS, 0, 0.0, -0.1], "> 0 (s)"),
    "within": (checks.within(0, 1, "m"), [0, 1, 0.5], [*NO_NUMBERS, -0.1, 1.1], "give a number from 0 to 1 m"),
    "without": (checks.within(0, 9, without=0), [9, 0.1], [*NO_NUMBERS, 0, -1, 10], "from 0 to 9 but not 0"),
    "among": (checks.among(1, 2, 3), [1, 2.0, np.int8(3)], [*NO_NUMBERS, 0, 1.5, 4], "give 1, 2 or 3"),
    "optional": (checks.optional(checks.at_least(1)), [None, 1], [0, "x"], ">= 1"),
    "whole": (checks.whole(0, 9), [0, 9, np.int64(3)], [*NO_INTEGERS, 10], "give an integer >= 0 and <= 9"),
    "large": (checks.whole(0), [0, 2**63 - 1], [*NO_INTEGERS, 2**63], "give an integer >= 0 and < 2**63"),
    "word": (checks.word("cpu", "cuda"), ["cpu"], ["gpu", None, 3, ["cpu"], ""], "choose from cpu, cuda"),
    "flag": (checks.flag, [True, np.bool_(False)], ["no", 1, None, [True]], "give True or False"),
}


@pytest.mark.parametrize("check, good, bad, allowed", CHECKS.values(), ids=CHECKS)
def test_a_check_takes_what_is_allowed_and_says_so_of_the_rest(check, good, bad, allowed):
    for value in good:
        assert check("mass", value) == value and type(check("mass", value)).__module__ == "builtins"
    for value in bad:
        with _refuses("mass is ", allowed) as refused:
            check("mass", value)
        assert _is_one_line(refused), value


def test_a_subclass_that_changes_a_default_keeps_check_and_help():
    @dataclasses.dataclass(frozen=True)
    class Base:
        size: float = checks.checked(2.0, checks.above(0), help="how large")

        def __post_init__(self):
            checks.check_fields(self)

    @dataclasses.dataclass(frozen=True)
    class Small(Base):
        size: float = 1

    assert checks.help_of(Small) == {"size": "how large"} and type(Small().size) is float and Small().size == 1
    with _refuses("size is 0; give a finite number > 0"):
        Small(size=0)


# Names and options.


@pytest.mark.parametrize("load", [suite.load, lambda *args: suite.load_batch(*args[:2], 2, *args[2:])])
@pytest.mark.parametrize(
    "arguments, fragments",
    [
        (("tower", "fist_features"), ("'tower'", "which_is_heavier", "towers")),
        ((None, "fist_features"), ("None", "which_is_heavier", "towers")),
        (("towers", "features"), ("'features'", "direct_features", "fist_features")),
        (("which_is_heavier", None), ("None", "features")),
        ((*HEAVIER, {"dificulty": 3}), ("dificulty", "random", "control_timestep", "time_limit", "difficulty")),
        (("towers", "fist_features", {"difficulty": 3}), ("difficulty", "cube_size")),
        ((*HEAVIER, {(1, 2): 1}), ("task_kwargs has (1, 2)", "difficulty")),
        ((*HEAVIER, {"two\nlines": 1}), ("task_kwargs has 'two\\nlines'", "difficulty")),
        ((*HEAVIER, [1]), ("task_kwargs is [1]; give a dictionary",)),
    ],
)
def test_an_unknown_name_is_refused_with_the_choices(load, arguments, fragments):
    with _refuses(*fragments) as refused:
        load(*arguments)
    assert _is_one_line(refused)


def test_an_unknown_environment_option_is_refused_with_the_choices():
    with _refuses("flat_observations", "raise_exception_on_physics_error", "flat_observation"):
        suite.load(*HEAVIER, environment_kwargs={"flat_observations": True})
    for name in ("flat_observation", "raise_exception_on_physics_error"):
        with _refuses(name, "'yes'", "True or False"):
            suite.load(*HEAVIER, environment_kwargs={name: "yes"})


@pytest.mark.parametrize("tag", ["zzz", 3])
def test_an_unknown_tag_is_refused_with_the_choices(tag):
    with _refuses("tag is", repr(tag), "direct", "features", "fist", "pixels"):
        suite.tagged("features", tag)


@pytest.mark.parametrize(
    "options, fragments",
    [
        ({"control_timestep": 60.5}, ("control_timestep is 60.5", "0 to 60 s")),
        ({"control_timestep": 0.0137}, ("control_timestep is 0.0137 s", "multiple", "0.025")),
        ({"control_timestep": 1e-12}, ("control_timestep is 1e-12 s", "multiple")),
        ({"time_limit": 0}, ("time_limit is 0", "but not 0")),
        ({"variation": 1.1}, ("variation is 1.1", "0 to 1")),
        ({"step_variation": 0.91}, ("step_variation is 0.91", "0 to 0.9")),
        ({"noise": 101}, ("noise is 101", "0 to 100 m")),
        ({"reveal": 1}, ("reveal is 1", "True or False")),
        ({"visualize_reward": "no"}, ("visualize_reward is 'no'", "True or False")),
        ({"difficulty": 0.9}, ("difficulty is 0.9", ">= 1 (the paper's beta)")),
        ({"random": np.timedelta64(3)}, ("random, the seed, is", "[0, 2**63)", "RandomState", "None")),
        ({"random": 2**63}, ("random, the seed, is", "[0, 2**63)")),
    ],
)
def test_an_option_out_of_range_is_refused(options, fragments):
    with _refuses(*fragments) as refused:
        suite.load(*HEAVIER, options)
    assert _is_one_line(refused)


@pytest.mark.parametrize(
    "name, options, fragments",
    [
        ("threshold/features", {"control_timestep": 0.05}, ("control_timestep is 0.05 s; give at least 0.06 s",)),
        ("threshold/features", {"time_limit": 20.0}, ("time_limit is 20.0 s; give at most 10 s",)),
        # 99 control steps of up to 0.14 s before the last.
        ("threshold/features", {"time_limit": 10.0, "step_variation": 0.4}, ("is 10.0 s", "last 13.86 s", "10 s")),
        ("balance/features", {"control_timestep": 0.05}, ("control_timestep is 0.05 s; give at least 0.08 s",)),
        ("balance/features", {"difficulty": 1.5}, ("difficulty is 1.5; give 1, 2 or 3",)),
        ("strings/features", {"control_timestep": 0.09}, ("control_timestep is 0.09 s; give at least 0.1 s",)),
        ("crush/features", {"control_timestep": 0.07}, ("control_timestep is 0.07 s; give at least 0.08 s",)),
        # 89 control steps of up to 0.12 s before the last.
        ("crush/features", {"time_limit": 9.0, "step_variation": 0.2}, ("is 9.0 s", "last 10.68 s", "10 s")),
        ("crush/features", {"num_cans": 4}, ("num_cans is 4; give an integer >= 1 and <= 3",)),
        ("sealed_box/features", {"noise": 0.001}, ("noise is 0.001; give 0",)),
        ("strike/features", {"goal_distance": 0.4}, ("goal_distance is 0.4; give a number from 0.6 to 0.75 m",)),
        ("lump/features", {"difficulty": 4}, ("difficulty is 4; give 1, 2 or 3",)),
        ("threshold/features", {"variation": 0.5}, ("variation is 0.5; give 0 where episodes differ in nothing else",)),
        ("towers/fist_pixels", {"noise": 0.01}, ("noise is 0.01; give 0 where no reading in metres is observed",)),
        ("strings/pixels", {"reveal": True}, ("reveal is True; give False where images are", "a task with features")),
    ],
)
def test_options_that_make_no_question_are_refused(name, options, fragments):
    with _refuses(*fragments):
        suite.load(*name.split("/"), options)


@pytest.mark.parametrize("value", [np.float32(0.1), np.float32(0.3), 0.1 * 3, 60.0])
def test_a_control_step_may_be_rounded_as_float32_is(value):
    environment = suite.load(*HEAVIER, {"control_timestep": value})
    assert environment.task.options.control_timestep == round(float(value), 6)
    environment.close()


def test_seeds_and_indices_of_episodes_are_integers():
    env, batch = suite.load(*HEAVIER, {"random": 0}), suite.load_batch(*HEAVIER, 2, {"random": 0})
    env.reset(), batch.reset()
    for bad in (-1, 1.5, True, None, 2**62):
        with _refuses("next_episode is", ">= 0", "< 2**62"):
            env.task.next_episode = bad
        if bad is not None:
            with _refuses("episode is", ">= 0", "< 2**62"):
                batch.reset(episode=bad)
    for name, arguments in (("seed", (2**63, 0)), ("index", (0, -1))):
        with _refuses(f"{name} is", ">= 0", "< 2**63"):
            suite.environment_seed(*arguments)
    for name, arguments in (("num_environments", (0,)), ("num_threads", (2, None, 0))):
        with _refuses(f"{name} is 0", ">= 1"):
            suite.load_batch(*HEAVIER, *arguments)
    assert env.task.episode == 0 and batch.episodes.tolist() == [0, 0]


def test_the_last_episode_that_can_be_chosen_has_a_successor():
    env = suite.load(*HEAVIER, {"random": 0})
    env.task.next_episode = 2**62 - 1
    env.reset(), env.reset()
    assert env.task.episode == 2**62


# Actions.

NO_ACTIONS = [2.7, 3.0, True, "3", None, np.float64(3), np.bool_(True), 2**70, np.timedelta64(1), [[0], [0, 1]], {}]
NO_ACTIONS += [np.zeros(40), np.full((2, 30), "a" * 50), "two\nlines"]


@pytest.mark.parametrize("bad", [-1, 25, 2**62, 0.0, None])
def test_a_refused_action_moves_no_environment_of_a_batch(bad):
    batch, twin = (suite.load_batch("towers", "direct_features", 3, {"random": 0}) for _ in range(2))
    label = batch.task.num_interactions
    for each in (batch, twin):
        each.reset()
        each.step([0, label, 1])
    with _refuses("action is", "24"):
        batch.step([0, 0, bad])  # The second environment's episode is over, and must not start anew.
    step, expected = batch.step([0, 0, 1]), twin.step([0, 0, 1])
    _assert_same(step.observation, expected.observation)
    np.testing.assert_array_equal(step.step_type, [1, 0, 1])
    np.testing.assert_array_equal(batch.episodes, twin.episodes)


@pytest.mark.parametrize("kind", [int, np.int8, np.int32, np.int64, np.uint8, np.array])
def test_an_action_may_be_any_kind_of_integer(kind):
    env = suite.load(*HEAVIER, {"random": 0})
    env.reset()
    assert env.step(kind(1)).mid()
    assert env.step(kind(env.task.num_interactions + env.task.correct_answer)).reward == 1


def test_an_environment_whose_episode_is_over_ignores_its_action():
    batch, single = suite.load_batch(*HEAVIER, 2, {"random": 0}), suite.load(*HEAVIER, {"random": 0})
    np.testing.assert_array_equal(batch.step([10**6, -1]).step_type, [0, 0])  # Before the first episode.
    np.testing.assert_array_equal(batch.step([4, 0]).step_type, [2, 1])
    np.testing.assert_array_equal(batch.step([10**6, 0]).step_type, [0, 1])
    assert single.step(10**6).first() and single.step(4).last() and single.step(10**6).first()


@pytest.mark.parametrize(
    "bad", [[1, 0], [0, 0], [0, 3], [-1, 0], [0.0, 1.0], [True, False, True], [], 1, "ab", [[0, 1]]]
)
def test_environments_are_given_as_increasing_indices(bad):
    batch = suite.load_batch(*HEAVIER, 3, {"random": 0})
    batch.reset()
    with _refuses("environments", repr(bad), "0 to 2"):
        batch.reset(environments=bad)
    with _refuses("environments", repr(bad), "0 to 2"):
        batch.step(np.zeros(np.size(bad), int), environments=bad)
    np.testing.assert_array_equal(batch.episodes, [0, 0, 0])


@pytest.mark.parametrize("which", ["environment", "batch", "gymnasium", "vector", "stable_baselines"])
def test_a_bad_action_is_refused_alike_by_every_interface(which):
    make = {
        "environment": lambda: suite.load(*HEAVIER),
        "batch": lambda: suite.load_batch(*HEAVIER, 2),
        "gymnasium": lambda: gymnasium_lib.Environment(*HEAVIER),
        "vector": lambda: gymnasium_lib.VectorEnvironment(*HEAVIER, num_envs=2),
        "stable_baselines": lambda: stable_baselines.VecEnv(*HEAVIER, num_envs=2),
    }
    environment, is_many = make[which](), which not in ("environment", "gymnasium")
    environment.reset()
    for bad in NO_ACTIONS:
        for given in (bad, [bad, bad]) if is_many else (bad, [bad]):
            with _refuses("action is ", f"give integers of shape {'(2,)' if is_many else '()'}") as refused:
                environment.step(given)
            assert _is_one_line(refused)
    environment.step([np.int64(1)] * 2 if is_many else np.int64(1))


# Before the first episode and after the last.


def test_no_answer_is_told_before_the_first_episode():
    task, batch = suite.load(*HEAVIER).task, suite.load_batch(*HEAVIER, 2)
    for owner, name in ((task, "correct_answer"), (task, "hidden"), (batch, "correct_answers"), (batch, "hidden")):
        with _refuses("reset()", error=RuntimeError):
            getattr(owner, name)


def test_a_closed_environment_says_so_and_leaves_others_open():
    env, batch, other = suite.load(*HEAVIER), suite.load_batch(*HEAVIER, 2), suite.load(*HEAVIER)
    for each in (env, batch, other):
        each.reset()
    for each, action in ((env, 0), (batch, [0, 0])):
        each.close(), each.close()
        for use in (each.reset, lambda each=each, action=action: each.step(action)):
            with _refuses("closed; load another", error=RuntimeError):
                use()
    assert other.step(0).mid()


# Colours of the floor.


@pytest.mark.parametrize("way", [{"task_kwargs": {"visualize_reward": True}}, {"visualize_reward": True}, {}])
def test_the_floor_shows_the_outcome_where_it_is_asked_for(way):
    environment, colours = suite.load("threshold", "features", **way), []
    task = environment.task
    for wrong in (False, True):
        environment.reset()
        colours.append(tuple(environment.physics.bind(task.root_entity.floor).rgba))
        environment.step(task.num_interactions + (task.correct_answer + wrong) % task.num_labels)
        colours.append(tuple(environment.physics.bind(task.root_entity.floor).rgba))
    before, right, again, wrong = colours
    assert before == again and len({before, right, wrong}) == (3 if way else 1)
    assert not way or (right[1] > right[0] and wrong[0] > wrong[1])


def test_a_batch_has_no_floor_to_colour():
    with pytest.raises(ValueError, match="^visualize_reward is True; give False to a batch, or load one environment$"):
        suite.load_batch(*HEAVIER, 2, {"visualize_reward": True})
