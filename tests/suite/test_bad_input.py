"""Bad input is refused with what was given and what is allowed; the environment stays usable, also when it diverges."""

import decimal
import fractions
import logging
import re

import numpy as np
import pytest

from physexp import suite
from physexp.suite import gymnasium as gymnasium_lib
from physexp.suite import stable_baselines

FEATURE_TASKS = suite.tagged("features")
every_feature_task = pytest.mark.parametrize("domain_name, task_name", FEATURE_TASKS)

HEAVIER = ("which_is_heavier", "features")


def _refuses(*fragments: str, error=ValueError):
    """Expects an error whose message has every fragment."""
    return pytest.raises(error, match="".join(f"(?s:(?=.*{re.escape(fragment)}))" for fragment in fragments))


def _same(one: dict, other: dict) -> bool:
    return {name: v.tobytes() for name, v in one.items()} == {name: v.tobytes() for name, v in other.items()}


def _load_twice(domain_name, task_name):
    return tuple(suite.load(domain_name, task_name, {"random": 0}) for _ in range(2))


def _load_two_batches(domain_name, task_name, size):
    return tuple(suite.load_batch(domain_name, task_name, size, {"random": 0}) for _ in range(2))


# Names and keyword arguments.


@pytest.mark.parametrize("load", [suite.load, lambda *names: suite.load_batch(*names, num_environments=2)])
def test_an_unknown_name_is_refused_with_the_choices(load):
    with _refuses("'tower'", "which_is_heavier", "towers"):
        load("tower", "fist_features")
    with _refuses("None", "which_is_heavier", "towers"):
        load(None, "fist_features")
    with _refuses("'features'", "direct_features", "fist_features"):
        load("towers", "features")
    with _refuses("None", "features"):
        load("which_is_heavier", None)


@pytest.mark.parametrize("load", [suite.load, lambda *args: suite.load_batch(*args[:2], 2, *args[2:])])
def test_an_unknown_task_kwarg_is_refused_with_the_allowed_ones(load):
    with _refuses("dificulty", "random", "control_timestep", "time_limit", "difficulty"):
        load(*HEAVIER, {"dificulty": 3})
    with _refuses("difficulty", "random", "control_timestep", "time_limit"):
        load("towers", "fist_features", {"difficulty": 3})


def test_an_unknown_environment_kwarg_is_refused_with_the_allowed_ones():
    with _refuses("flat_observations", "raise_exception_on_physics_error", "flat_observation"):
        suite.load(*HEAVIER, environment_kwargs={"flat_observations": True})
    for name in ("flat_observation", "raise_exception_on_physics_error"):
        with _refuses(name, "'yes'", "True or False"):
            suite.load(*HEAVIER, environment_kwargs={name: "yes"})


@pytest.mark.parametrize("tag", ["zzz", 3])
def test_a_tag_that_no_task_has_is_refused_with_the_choices(tag):
    with _refuses("tag is", repr(tag), "direct", "features", "fist", "pixels"):
        suite.tagged("features", tag)


def test_keyword_arguments_whose_names_are_no_words_are_refused():
    for key in (3, None, (1, 2), "two words", "two\nlines"):
        with _refuses("task_kwargs has", repr(key), "difficulty") as refused:
            suite.load(*HEAVIER, {key: 1})
        assert "\n" not in str(refused.value)


NO_NUMBERS = [
    np.nan,
    np.inf,
    -np.inf,
    "0.5",
    None,
    True,
    np.bool_(True),
    5j,
    [5],
    np.array([5.0]),
    np.float32("nan"),
    10**400,
    np.timedelta64(5),
    np.complex64(5),
    decimal.Decimal(5),
    fractions.Fraction(5),
]


@pytest.mark.parametrize("value", [*NO_NUMBERS, {}, (), 0.999, 0, -5])
@pytest.mark.parametrize(
    "domain_name", [name for name in suite.TASKS_BY_DOMAIN if hasattr(suite.options(name), "difficulty")]
)
def test_a_difficulty_that_no_domain_has_is_refused(domain_name, value):
    with _refuses("difficulty is", repr(value)[:100], "; give ") as refused:
        suite.load(domain_name, "features", {"difficulty": value})
    assert "\n" not in str(refused.value) and len(str(refused.value)) < 300


@pytest.mark.parametrize("value", [*NO_NUMBERS, 0.999, 0, -5])
def test_a_difficulty_that_is_not_a_finite_number_from_one_up_is_refused(value):
    with _refuses("difficulty", repr(value)[:100], ">= 1") as refused:
        suite.load(*HEAVIER, {"difficulty": value})
    assert len(str(refused.value)) < 300


@pytest.mark.parametrize("value", [1, 1.0, np.float32(3), np.int64(7), 10**25, 1e300])
def test_any_finite_difficulty_from_one_up_is_played(value):
    assert suite.load(*HEAVIER, {"difficulty": value}).reset().first()


@every_feature_task
@pytest.mark.parametrize("name", ["control_timestep", "time_limit"])
@pytest.mark.parametrize("value", [*NO_NUMBERS, 0, 0.0, -0.1, False])
def test_a_time_that_is_not_a_finite_positive_number_is_refused(domain_name, task_name, name, value):
    with _refuses(name, repr(value)[:100], "> 0"):
        suite.load(domain_name, task_name, {name: value})


@every_feature_task
@pytest.mark.parametrize("value", [0.0137, 0.001, 1e-12, 0.1 + 1e-6])
def test_a_control_step_that_is_no_multiple_of_the_physics_step_is_refused(domain_name, task_name, value):
    physics_timestep = str(suite.options(domain_name).physics_timestep)
    with _refuses("control_timestep", repr(value), "multiple", physics_timestep):
        suite.load(domain_name, task_name, {"control_timestep": value})


@every_feature_task
@pytest.mark.parametrize("value", [np.float32(0.1), np.float32(0.3), 0.1 * 3])
def test_a_control_step_may_be_rounded_as_float32_is(domain_name, task_name, value):
    environment = suite.load(domain_name, task_name, {"control_timestep": value, "time_limit": 10.0})
    assert environment.task.options.control_timestep == round(float(value), 6)
    environment.close()


@every_feature_task
def test_a_control_step_lasts_a_minute_at_most_since_it_is_simulated_in_one_go(domain_name, task_name):
    with _refuses("control_timestep", "60.5", "at most 60 s"):
        suite.load(domain_name, task_name, {"control_timestep": 60.5})
    environment = suite.load(domain_name, task_name, {"control_timestep": 60.0})
    environment.reset()
    assert environment.step(0).last()  # An episode is shorter than that.
    environment.close()


@pytest.mark.parametrize(
    "value", [-1, 2**63, 1.0, "1", True, [1], np.float64(3), np.timedelta64(3), np.random.default_rng(0)]
)
def test_a_seed_that_is_none_is_refused(value):
    with _refuses("random", repr(value), "[0, 2**63)", "RandomState", "None"):
        suite.load(*HEAVIER, {"random": value})
    with _refuses("random", repr(value), "[0, 2**63)", "RandomState", "None"):
        suite.load_batch(*HEAVIER, 2, {"random": value})


NO_INDICES = [
    -1,
    -(2**70),
    1.5,
    2.0,
    np.float64(2),
    "2",
    None,
    True,
    np.bool_(False),
    [2],
    2**70,
    np.timedelta64(2),
    pytest.param(10**5000, id="5001 digits"),
]


@pytest.mark.parametrize("value", NO_INDICES)
def test_a_seed_and_an_index_from_which_another_seed_follows_are_integers_of_63_bits(value):
    for name, arguments in (("seed", (value, 0)), ("index", (0, value))):
        with _refuses(f"{name} is", ">= 0", "< 2**63") as refused:
            suite.environment_seed(*arguments)
        assert "\n" not in str(refused.value) and len(str(refused.value)) < 300
    with _refuses("seed is"):
        suite.environment_seed(2**63, 0)


@pytest.mark.parametrize("value", [*NO_INDICES, 2**62, 2**63 - 1])
def test_the_next_episode_is_an_index_that_others_can_follow(value):
    env = suite.load(*HEAVIER, {"random": 0})
    with _refuses("next_episode is", ">= 0", "< 2**62"):
        env.task.next_episode = value
    env.reset()
    assert env.task.episode == 0


def test_after_the_last_episode_that_can_be_chosen_come_others():
    env = suite.load(*HEAVIER, {"random": 0})
    batch = suite.load_batch(*HEAVIER, 2, {"random": 0})
    env.task.next_episode = 2**62 - 1
    env.reset(), batch.reset(episode=2**62 - 1)
    env.reset(), batch.reset()
    assert env.task.episode == 2**62 and batch.episodes.tolist() == [2**62] * 2


@pytest.mark.parametrize("value", [*NO_INDICES, 0])
def test_numbers_of_environments_and_threads_are_positive_integers(value):
    with _refuses("num_environments is", ">= 1"):
        suite.load_batch(*HEAVIER, value)
    with _refuses("num_threads is", ">= 1"):
        suite.load_batch(*HEAVIER, 2, num_threads=value)


# Actions of one environment.


@every_feature_task
def test_an_action_that_is_none_is_refused_and_nothing_moves(domain_name, task_name):
    env, untold = _load_twice(domain_name, task_name)
    count = env.action_spec().num_values
    out_of_range = [count, -1, -(2**40), np.uint64(2**63), np.int8(-1)]
    no_integers = [2**70, 0.0, 0.5, np.nan, True, np.bool_(True), None, "poke", "", (), {}, [0], np.zeros(2, int)]
    for message, bad in [(str(bad), bad) for bad in out_of_range] + [(repr(bad), bad) for bad in no_integers]:
        for each in (env, untold):
            each.task.next_episode = 0
            each.reset()
        for _ in range(2):
            with _refuses("action", message, str(count - 1)):
                env.step(bad)
            step, expected = env.step(0), untold.step(0)
            assert step.mid() and _same(step.observation, expected.observation), bad
        with _refuses("action", message):
            env.step(bad)
        assert env.step(env.task.num_interactions + env.task.correct_answer).reward == 1, bad


@every_feature_task
@pytest.mark.parametrize("kind", [int, np.int8, np.int32, np.int64, np.uint8, np.array])
def test_an_action_may_be_any_kind_of_integer(domain_name, task_name, kind):
    env = suite.load(domain_name, task_name, {"random": 0})
    env.reset()
    assert env.step(kind(1)).mid()
    assert env.step(kind(env.task.num_interactions + env.task.correct_answer)).reward == 1


@every_feature_task
def test_the_answer_cannot_be_asked_for_before_an_episode_has_begun(domain_name, task_name):
    task = suite.load(domain_name, task_name).task
    for name in ("correct_answer", "hidden"):
        with _refuses("reset()", error=RuntimeError):
            getattr(task, name)


@every_feature_task
@pytest.mark.parametrize("name", ["correct_answers", "hidden"])
def test_the_answers_of_a_batch_cannot_be_asked_for_before_its_episodes_have_begun(domain_name, task_name, name):
    batch = suite.load_batch(domain_name, task_name, 2)
    with _refuses("reset()", error=RuntimeError):
        getattr(batch, name)


# Actions of a batch.


@every_feature_task
def test_actions_of_a_wrong_shape_or_type_are_refused_and_nothing_moves(domain_name, task_name):
    batch, untold = _load_two_batches(domain_name, task_name, 2)
    wrong_shapes = [0, None, "ab", [], [0], [0, 0, 0], [[0, 0]], [[0], [0]]]
    wrong_types = [[0.0, 0.0], [True, False], [0, None], [0, "a"], [2**70, 0], np.zeros(2, object)]
    for bad in wrong_shapes + wrong_types:
        for each in (batch, untold):
            each.reset(episode=0)
        with _refuses("action", repr(bad), "(2,)", str(batch.action_spec().num_values - 1)):
            batch.step(bad)
        step, expected = batch.step([0, 1]), untold.step([0, 1])
        assert _same(step.observation, expected.observation) and (step.step_type == 1).all(), bad


@every_feature_task
def test_an_action_out_of_range_is_refused_and_no_environment_moves(domain_name, task_name):
    batch, untold = _load_two_batches(domain_name, task_name, 3)
    count, label = batch.action_spec().num_values, batch.task.num_interactions
    for bad in (-1, count, 2**62):
        for each in (batch, untold):
            each.reset(episode=0)
            each.step([0, label, 1])
        with _refuses(f"action is {bad}", str(count - 1)):
            batch.step([0, 0, bad])  # The second environment's episode is over, and must not start anew.
        step, expected = batch.step([0, 0, 1]), untold.step([0, 0, 1])
        assert _same(step.observation, expected.observation)
        np.testing.assert_array_equal(step.step_type, [1, 0, 1])
        np.testing.assert_array_equal(batch.episodes, untold.episodes)


@every_feature_task
def test_an_environment_whose_episode_is_over_ignores_its_action_even_a_bad_one(domain_name, task_name):
    batch = suite.load_batch(domain_name, task_name, 2, {"random": 0})
    np.testing.assert_array_equal(batch.step([10**6, -1]).step_type, [0, 0])  # Before the first episode.
    np.testing.assert_array_equal(batch.step([batch.task.num_interactions, 0]).step_type, [2, 1])
    np.testing.assert_array_equal(batch.step([10**6, 0]).step_type, [0, 1])
    single = suite.load(domain_name, task_name, {"random": 0})
    assert single.step(10**6).first()
    assert single.step(single.task.num_interactions).last()
    assert single.step(10**6).first()


@pytest.mark.parametrize(
    "bad",
    [
        [1, 0],
        [0, 0],
        [0, 3],
        [-1, 0],
        [0.0, 1.0],
        [True, False, True],
        [],
        1,
        "ab",
        [[0, 1]],
        np.array([0, 2, 1, 2], np.uint64),
    ],
)
def test_environments_are_given_as_increasing_indices(bad):
    batch = suite.load_batch(*HEAVIER, 3, {"random": 0})
    batch.reset()
    with _refuses("environments", repr(bad), "0 to 2"):
        batch.reset(environments=bad)
    with _refuses("environments", repr(bad), "0 to 2"):
        batch.step(np.zeros(np.size(bad), int), environments=bad)
    np.testing.assert_array_equal(batch.episodes, [0, 0, 0])
    np.testing.assert_array_equal(batch.step([0, 1, 2]).step_type, [1, 1, 1])


@pytest.mark.parametrize("bad", [*(value for value in NO_INDICES if value is not None), np.nan, 2**62, 2**63 - 1])
def test_an_episode_is_given_as_an_index(bad):
    batch = suite.load_batch(*HEAVIER, 2, {"random": 0})
    batch.reset()
    with _refuses("episode is", ">= 0", "< 2**62"):
        batch.reset(episode=bad)
    np.testing.assert_array_equal(batch.episodes, [0, 0])


# Whatever steps.


NO_ACTIONS = [
    2.7,
    3.0,
    True,
    "3",
    None,
    np.float64(3),
    np.bool_(True),
    2**70,
    np.timedelta64(1),
    [[0], [0, 1]],
    np.zeros(40),
    np.full((2, 30), "a" * 50),
    "two\nlines",
]


@pytest.fixture(scope="module")
def all_that_steps():
    """Every way to step an environment, each with how one action is given to it."""
    single, batch = suite.load(*HEAVIER), suite.load_batch(*HEAVIER, 2)
    gym, vector = gymnasium_lib.Environment(*HEAVIER), gymnasium_lib.VectorEnvironment(*HEAVIER, num_envs=2)
    sb3 = stable_baselines.VecEnv(*HEAVIER, num_envs=2)
    return {
        "dm_env": (single, False),
        "batch": (batch, True),
        "gymnasium": (gym, False),
        "vector": (vector, True),
        "stable_baselines": (sb3, True),
    }


@pytest.mark.parametrize("which", ["dm_env", "batch", "gymnasium", "vector", "stable_baselines"])
@pytest.mark.parametrize("bad", NO_ACTIONS, ids=lambda bad: type(bad).__name__)
def test_a_bad_action_is_refused_alike_whatever_steps(all_that_steps, which, bad):
    environment, many = all_that_steps[which]
    environment.reset()
    for given in (bad, [bad, bad]) if many else (bad, [bad]):
        with _refuses("action is ", "give integers of shape (2,)" if many else "give integers of shape ()") as refused:
            environment.step(given)
        assert "\n" not in str(refused.value) and len(str(refused.value)) < 300
    environment.step([np.int64(1)] * 2 if many else np.int64(1))


# Closed environments.


@every_feature_task
def test_a_closed_environment_says_so_and_may_be_closed_again(domain_name, task_name):
    env = suite.load(domain_name, task_name, {"random": 0})
    env.reset()
    env.close()
    env.close()
    for use in (env.reset, lambda: env.step(0)):
        with _refuses("closed", error=RuntimeError):
            use()


@every_feature_task
def test_a_closed_batch_says_so_and_may_be_closed_again(domain_name, task_name):
    batch = suite.load_batch(domain_name, task_name, 2, {"random": 0})
    batch.reset()
    batch.close()
    batch.close()
    for use in (batch.reset, lambda: batch.step([0, 0])):
        with _refuses("closed", error=RuntimeError):
            use()


def test_closing_one_environment_leaves_the_others_open():
    first, second = _load_twice(*HEAVIER)
    second.reset()
    first.close()
    assert second.step(0).mid()


# A simulation that diverges: a velocity is overwritten with something that MuJoCo cannot go on from.


VELOCITIES = (np.nan, np.inf, -1e20)


@every_feature_task
def test_an_episode_that_diverges_ends_without_reward_and_the_next_is_played_as_ever(domain_name, task_name, caplog):
    env, healthy = _load_twice(domain_name, task_name)
    first, expected = env.reset(), healthy.reset()
    for divergences, velocity in enumerate(VELOCITIES, start=1):
        assert first.first() and _same(first.observation, expected.observation)
        for t in range(5):
            step, expected = env.step(t % 3), healthy.step(t % 3)
            assert step.mid() and _same(step.observation, expected.observation)
        env.physics.data.qvel[0] = velocity
        caplog.clear()
        with caplog.at_level(logging.WARNING):
            step = env.step(0)
        assert (step.last(), step.reward, step.discount) == (True, 0, 0)
        assert all(np.isfinite(value).all() for value in step.observation.values())
        assert env.task.num_divergences == divergences
        assert any("invalid" in record.getMessage() for record in caplog.records)
        first, expected = env.step(0), healthy.reset()


def _overwrite_velocity(batch, environment: int, velocity: float) -> None:
    batch.view("qvel", environment)[0] = velocity


@every_feature_task
def test_a_diverging_environment_of_a_batch_ends_alone_and_its_next_episode_is_played_as_ever(
    domain_name, task_name, caplog
):
    batch, healthy = _load_two_batches(domain_name, task_name, 3)
    for each in (batch, healthy):
        each.reset()
        each.step([0, 1, 2])
    _overwrite_velocity(batch, 1, np.nan)
    with caplog.at_level(logging.WARNING):
        step, expected = batch.step([0, 0, 0]), healthy.step([0, 0, 0])
    np.testing.assert_array_equal(step.step_type, [1, 2, 1])
    np.testing.assert_array_equal(step.reward, [0, 0, 0])
    np.testing.assert_array_equal(step.discount, [1, 0, 1])
    for name, value in step.observation.items():
        assert np.isfinite(value).all()
        np.testing.assert_array_equal(value[[0, 2]], expected.observation[name][[0, 2]])
    assert any("diverged in environments [1]" in record.getMessage() for record in caplog.records)
    np.testing.assert_array_equal(batch.step([0, 10**6, 0]).step_type, [1, 0, 1])
    healthy.step([0, 0], environments=np.array([0, 2]))
    healthy.reset(environments=np.array([1]))
    for t in range(min(8, batch.task.rules.step_limit - 4)):
        step, expected = batch.step(np.full(3, t % 3)), healthy.step(np.full(3, t % 3))
        assert (step.step_type == 1).all() and _same(step.observation, expected.observation)
    assert batch.num_divergences == 1


@every_feature_task
def test_every_divergence_of_an_environment_of_a_batch_is_noticed(domain_name, task_name):
    """Not only the first: the same environment, playing the same episode, diverges again and again."""
    batch = suite.load_batch(domain_name, task_name, 3, {"random": 0})
    for divergences, velocity in enumerate(VELOCITIES, start=1):
        batch.reset(episode=0)
        batch.step([0, 0, 0])
        _overwrite_velocity(batch, 1, velocity)
        np.testing.assert_array_equal(batch.step([0, 0, 0]).step_type, [1, 2, 1])
        assert batch.num_divergences == divergences


@every_feature_task
def test_a_diverged_episode_ends_with_the_same_observation_alone_and_in_a_batch(domain_name, task_name):
    batch = suite.load_batch(domain_name, task_name, 2, {"random": 0})
    single = suite.load(domain_name, task_name, {"random": suite.environment_seed(0, 1)})
    batch.reset()
    single.reset()
    batch.step([0, 0])
    single.step(0)
    _overwrite_velocity(batch, 1, np.nan)
    single.physics.data.qvel[0] = np.nan
    last, expected = batch.step([0, 0]), single.step(0)
    assert last.step_type[1] == expected.step_type == 2
    for name, value in expected.observation.items():
        np.testing.assert_array_equal(last.observation[name][1], value)


def test_a_divergence_raises_where_the_user_asked_for_it():
    env = suite.load(*HEAVIER, {"random": 0}, {"raise_exception_on_physics_error": True})
    env.reset()
    env.physics.data.qvel[0] = np.nan
    with _refuses("invalid", error=RuntimeError):
        env.step(0)
    assert env.task.num_divergences == 1
    assert env.reset().first()
    assert env.step(0).mid()


@pytest.mark.parametrize("name", ["reveal", "visualize_reward"])
@pytest.mark.parametrize("value", ["no", 1, None])
def test_flags_are_true_or_false(name, value):
    with pytest.raises(ValueError, match=f"{name} is .*; give True or False"):
        suite.load("threshold", "features", {name: value})


@pytest.mark.parametrize("way", [{"task_kwargs": {"visualize_reward": True}}, {"visualize_reward": True}])
def test_the_floor_is_green_after_a_right_answer_and_red_after_a_wrong_one(way):
    before, right, again, wrong = _floors(suite.load("threshold", "features", **way))
    assert before == again and len({before, right, wrong}) == 3
    assert right[1] > right[0] and wrong[0] > wrong[1]


def test_the_floor_stays_as_it_is_where_no_colours_are_asked_for():
    assert len({*_floors(suite.load("threshold", "features"))}) == 1


def _floors(environment):
    """Returns the floor's colour before and after a right answer, and before and after a wrong one."""
    task, colors = environment.task, []

    def look():
        colors.append(tuple(environment.physics.bind(task.root_entity.floor).rgba))

    for is_wrong in (False, True):
        environment.reset()
        look()
        environment.step(task.num_interactions + (task.correct_answer + is_wrong) % task.num_labels)
        look()
    return colors
