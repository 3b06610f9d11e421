"""The belief learner: targets by Bayes' rule and Bellman's equation, exploration, the replay, and the best agent."""

import numpy as np
import pytest
from seeds import fresh_seed
import torch

from physexp import suite
from physexp.agents import acting, learning, starting
from physexp.agents import networks as networks_lib
from physexp.agents.belief import acting as belief_acting
from physexp.agents.belief import agent as belief
from physexp.agents.belief import config as config_lib
from physexp.agents.belief import losses, networks, replay

torch.set_num_threads(1)
SMALL = config_lib.BeliefConfig(frames=600, replay_episodes=64)
SIZE, ENSEMBLE = config_lib.NUM_ENVIRONMENTS, networks.ENSEMBLE_SIZE


def load(domain, task, seed, num_environments=SIZE, num_threads=1):
    return suite.load_batch(domain, task, num_environments, {"random": seed}, num_threads)


def make_agent(config=SMALL, domain="which_is_heavier", task="features"):
    return belief.Belief(lambda seed, size, threads: load(domain, task, seed, size), config)


def make_network(environment, seed, config=SMALL):
    network = starting.make_network(networks.BeliefNetwork, environment, config.replace(seed=seed))
    network.calibrate(acting.as_tensors(environment.reset().observation))
    return network


def play(network, environment, number, config=SMALL):
    policy = belief_acting.BehaviourPolicy(network.num_interactions, network.max_interactions, config.seed, number)
    return acting.play_round(network, environment, number, policy.choose, keep_inputs=True)


def room(network, environment, num_rounds):
    """Room for rounds of episodes."""
    longest = network.max_interactions + 1
    return replay.Replay(num_rounds, longest, environment.num_environments, network.num_inputs, np.float32)


# Targets and losses.


def test_a_wrong_answer_keeps_the_relative_probabilities_of_others():
    logits = torch.log(torch.tensor([[0.5, 0.3, 0.2], [0.5, 0.3, 0.2]]))
    found = losses.label_posterior(logits, torch.tensor([1, 1]), torch.tensor([True, False]))
    torch.testing.assert_close(found, torch.tensor([[0.0, 1.0, 0.0], [0.5 / 0.7, 0.0, 0.2 / 0.7]]))


@pytest.mark.parametrize("is_right", [True, False])
def test_a_step_towards_the_posterior_is_one_on_the_likelihood(is_right):
    torch.manual_seed(fresh_seed())
    logits = torch.randn(1, 5, dtype=torch.float64, requires_grad=True)
    answer, are_right = torch.tensor([2]), torch.tensor([is_right])
    labels = losses.label_posterior(logits.detach(), answer, are_right)
    losses.belief_loss(logits[None, None], labels, torch.ones(1, 1, 1, dtype=torch.bool)).sum().backward()
    found, logits.grad = logits.grad, None
    belief_in_answer = logits.softmax(1)[0, 2]
    (-torch.log(belief_in_answer if is_right else 1 - belief_in_answer)).backward()
    torch.testing.assert_close(found, logits.grad)


@pytest.mark.parametrize(("memory", "num_foreseen"), [("attention", 0), ("lstm", 0), ("attention", 2)])
def test_no_step_depends_on_later_ones(memory, num_foreseen):
    torch.manual_seed(fresh_seed())
    members = networks.Members(3, 4, 5, memory, num_foreseen)
    history = torch.randn(ENSEMBLE, 6, 7, 3)
    changed = torch.cat([history[:, :, :4], torch.randn(ENSEMBLE, 6, 3, 3)], dim=2)
    for before, after in zip(members(history), members(changed), strict=True):
        torch.testing.assert_close(before[:, :, :4], after[:, :, :4])
        assert not torch.isclose(before[:, :, 4:], after[:, :, 4:]).all(dim=-1).any()


@pytest.mark.parametrize("every_step", [True, False])
def test_the_belief_is_learned_at_every_step_or_at_the_last_one(every_step, monkeypatch):
    monkeypatch.setattr(belief, "_DROPOUT", 0.0)
    config = SMALL.replace(seed=fresh_seed(), every_step=every_step, answers_revealed=True)
    learner = make_agent(config)
    learner.step()
    episodes, held_out = learner.variables.episodes.sample(np.random.default_rng(config.seed), 16, ENSEMBLE, 1)
    with torch.no_grad():
        inputs, actions = episodes.padded(episodes.inputs.float()), torch.from_numpy(episodes.actions)
        logits = learner.variables.network.unroll(inputs, actions).logits
    means = []
    for member in range(ENSEMBLE):
        costs = [
            -logits.log_softmax(-1)[member, step, episode, episodes.answers[episode]]
            for episode in range(16)
            for step in range(episodes.lengths[episode])
            if held_out[episode] != member and (every_step or step == episodes.lengths[episode] - 1)
        ]
        means.append(sum(costs) / len(costs))
    found = learner._learn(episodes, held_out, 0.0)["belief_loss"]
    assert found == pytest.approx(float(sum(means) / len(means)), rel=1e-4)


def test_foresight_is_measured_on_the_steps_that_count():
    # Huber's loss is half of a squared error below 1, and the error less a half above: 0.5 * 0.5^2 + (3 - 0.5) at the
    # first step of the first episode, 0 at its second; the second episode does not count.
    expected = torch.tensor([[[[0.5, 3.0], [9.0, 9.0]], [[1.0, 1.0], [9.0, 9.0]]]])
    moved = torch.tensor([[[0.0, 0.0], [0.0, 0.0]], [[1.0, 1.0], [0.0, 0.0]]])
    are_counted = torch.tensor([[[True, False], [True, False]]])
    assert losses.foresight_loss(expected, moved, are_counted).item() == pytest.approx((0.125 + 2.5 + 0) / 2)


def test_the_change_to_the_next_observation_is_foreseen():
    learner = make_agent(SMALL.replace(seed=fresh_seed(), frames=3_000, foresight=True), "balance")
    for _ in range(8):
        learner.step()
    episodes, _ = learner.variables.episodes.sample(np.random.default_rng(0), 64, ENSEMBLE, learner.next_episode)
    inputs, actions = episodes.padded(episodes.inputs.float()), torch.from_numpy(episodes.actions)
    expected, moved = learner.variables.network.unroll(inputs, actions).foreseen
    torch.testing.assert_close(moved, torch.diff(inputs, dim=0) / learner.variables.network.log_scale.exp())
    are_counted = torch.from_numpy(episodes.played[1:]).expand(ENSEMBLE, -1, -1)
    found, of_no_change = (
        losses.foresight_loss(changes, moved, are_counted).mean() for changes in (expected, torch.zeros_like(expected))
    )
    assert found < of_no_change / 2, "the place of a block follows from the action"


TARGETS = {
    # Answering, interacting and greedy interactions at each step, the lambda, and the target of the first interaction.
    # Nothing greedy: 0.9 * V of the step that follows, the better of answering and going on.
    "going on is better": ([-0.5, 0.2, 0.8], [0.1, 0.6, 0.0], [False, False, False], 0.5, 0.9 * 0.6),
    # The second interaction is greedy: its own target, 0.9 * 0.8, counts half, V = 0.6 the other half.
    "a greedy one": ([-0.5, 0.2, 0.8], [0.1, 0.6, 0.0], [False, True, False], 0.5, 0.9 * (0.5 * 0.6 + 0.5 * 0.9 * 0.8)),
    # An interaction in place of a better answer counts as the answer.
    "answering is better": ([-0.5, 0.7, 0.8], [0.1, 0.6, 0.0], [False, True, False], 1.0, 0.9 * 0.7),
    # At the last step only the answer counts, however much an interaction seems to be worth.
    "the last step": ([-0.5, 0.8], [0.1, 100.0], [False, True], 1.0, 0.9 * 0.8),
    "the end of an episode": ([0.1], [0.3], [True], 0.5, -1.0),  # Its reward.
}


@pytest.mark.parametrize("case", TARGETS)
def test_targets_of_interactions_follow_from_the_step_after_them(case):
    *columns, lambda_, expected = TARGETS[case]
    answering, interacting, are_greedy = (torch.tensor(column)[:, None] for column in columns)
    are_last = (torch.arange(len(answering)) == len(answering) - 1)[:, None]
    rewards = -are_last.float()
    found = losses.interaction_targets(answering, interacting, are_greedy, are_last, are_last, rewards, 0.9, lambda_)
    assert found[0].item() == pytest.approx(expected)


def test_early_stops_do_not_count_against_the_interaction_before_them():
    # The best that could have followed the stop is worth 0.6; where an answer had to be given, it is the answer's 0.2.
    answering, interacting, rewards = torch.tensor([[[-0.5], [0.2]], [[0.1], [0.6]], [[0.0], [-1.0]]])
    are_last = torch.tensor([[False], [True]])
    for are_final, value in ((torch.zeros(2, 1, dtype=torch.bool), 0.6), (are_last, 0.2)):
        found = losses.interaction_targets(answering, interacting, are_last, are_last, are_final, rewards, 0.9, 0.5)
        assert found[0].item() == pytest.approx(0.9 * value)


@pytest.mark.parametrize("foresight", [True, False])
def test_with_foresight_only_the_cap_of_interactions_ends_an_episode(foresight, monkeypatch):
    monkeypatch.setattr(belief_acting, "_EARLY_STOP_FRACTION", 1.0)
    learner = make_agent(SMALL.replace(seed=fresh_seed(), foresight=foresight, max_interactions=8), "strike")
    learner.step()
    played = learner.last_round
    are_ends, _, _ = learner._label_targets(played, torch.zeros(*played.actions.shape, 7))
    are_final = learner._final_steps(are_ends).expand_as(are_ends)
    steps = torch.arange(len(are_ends))[:, None]
    assert (are_ends & (steps < 8)).any(), "some episodes are stopped early"
    assert torch.equal(are_final & are_ends, are_ends & (steps >= 8) if foresight else are_ends)


def test_beliefs_and_values_belong_to_the_question_that_is_asked():
    """A question ends with its answer, or with the time limit: then nothing is learned about those that are left."""
    kwargs, seed = {"questions": "all", "num_questions": 3, "time_limit": 0.5}, fresh_seed()
    config = SMALL.replace(seed=seed, max_interactions=3)
    learner = belief.Belief(
        lambda seed, size, threads: suite.load_batch("strings", "features", size, {**kwargs, "random": seed}), config
    )
    learner.step()
    played, truth = learner.last_round, learner._environment.ledger.answers
    are_ends, labels, are_counted = learner._label_targets(played, torch.randn(*played.actions.shape, 2))
    for episode, length in enumerate(played.lengths):
        are_answers = played.actions[:length, episode] >= 6
        asked = are_answers.cumsum() - are_answers
        for step in range(length):
            assert are_ends[step, episode] == (are_answers[step] or step == length - 1)
            assert are_counted[step, episode] == are_answers[step:].any()
            if are_counted[step, episode]:
                assert labels[step, episode].tolist() == np.eye(2)[truth[episode, asked[step]]].tolist()
    assert not are_counted[~torch.from_numpy(played.played)].any()


def test_calibration_is_the_mean_distance_of_belief_and_success():
    # Three of four answers of belief 0.95 are right, one of two of belief 0.5: (4 * 0.2 + 2 * 0) / 6.
    beliefs = torch.tensor([0.95] * 4 + [0.5] * 2)
    outcomes = torch.tensor([1.0, 1, 1, 0, 1, 0])
    assert losses.calibration_error(beliefs, outcomes) == pytest.approx(4 * 0.2 / 6, abs=1e-6)
    assert losses.calibration_error(torch.ones(3), torch.ones(3)) == 0


# The network and its behaviour.


@pytest.mark.parametrize(
    ("domain", "task", "memory", "foresight"),
    [
        ("which_is_heavier", "features", "attention", False),
        ("towers", "fist_features", "lstm", False),
        ("strings", "pixels", "attention", False),
        ("balance", "features", "attention", True),
    ],
)
def test_acting_and_training_compute_the_same(domain, task, memory, foresight):
    seed = fresh_seed()
    environment = load(domain, task, seed)
    network = make_network(environment, seed, SMALL.replace(memory=memory, foresight=foresight))
    kept = room(network, environment, 1)
    kept.add(play(network, environment, 0), 0)
    episodes, held_out = kept.sample(np.random.default_rng(seed), 32, ENSEMBLE, 1)
    inputs, actions, played = (
        episodes.padded(episodes.inputs.float()),
        torch.from_numpy(episodes.actions),
        torch.from_numpy(episodes.played),
    )
    with torch.no_grad():
        unrolled = network.unroll(inputs, actions)
        logits, shares = unrolled.logits, unrolled.shares
        for found, every in zip(network.held_out(inputs, actions), (logits, shares), strict=True):
            for row, member in enumerate(held_out):
                torch.testing.assert_close(found[:, row], every[member, :, row], rtol=1e-3, atol=1e-4)
        beliefs = logits.softmax(-1).mean(0)
        values = network.values(beliefs, shares.mean(0))
        state = network.initial_state(32)
        for step, rows in enumerate(played):
            output, state = network.step(inputs[step], state)
            state = network.observe_action(actions[step], state)
            expected = torch.cat([values[step], 2 * beliefs[step] - 1], dim=1)
            if step == network.max_interactions:
                expected[:, : network.num_interactions] = -1
            torch.testing.assert_close(output.action_values[rows], expected[rows], rtol=1e-3, atol=1e-4)
            torch.testing.assert_close(output.beliefs[rows], beliefs[step, rows], rtol=1e-3, atol=1e-4)
    environment.close()


def test_a_new_agent_with_foresight_expects_little_of_interactions():
    seed = fresh_seed()
    environment = load("strike", "features", seed)
    network = make_network(environment, seed, SMALL.replace(foresight=True))
    inputs = network.encode(acting.as_tensors(environment.reset(episode=0).observation))
    output, _ = network.step(inputs, network.initial_state(SIZE))
    interacting, answering = output.action_values.tensor_split([network.num_interactions], dim=1)
    answer = answering.amax(1, keepdim=True)
    shares = (interacting / network.discount - answer) / (1 - answer)
    assert (shares > 0).all() and (shares < 0.2).all()
    environment.close()


@pytest.mark.parametrize("foresight", [False, True])
def test_no_member_learns_from_its_held_out_episodes(foresight, monkeypatch):
    monkeypatch.setattr(belief, "_DROPOUT", 0.0)
    learner = make_agent(SMALL.replace(seed=fresh_seed(), foresight=foresight))
    learner.step()
    episodes, held_out = learner.variables.episodes.sample(np.random.default_rng(0), 32, ENSEMBLE, 1)
    sizes = []

    def measure(network, loss, *_):
        network.zero_grad()
        loss.backward()
        gradients = [parameter.grad for parameter in network.members.parameters()]
        sizes.append([sum(float(each[member].abs().sum()) for each in gradients) for member in range(ENSEMBLE)])
        return [torch.zeros_like(parameter) for parameter in network.parameters()], 1.0

    monkeypatch.setattr(learning, "clipped_gradients", measure)
    for member in range(ENSEMBLE):
        learner._learn(episodes, torch.full_like(held_out, member), 0.0)
    for member, size in enumerate(sizes):
        assert [other for other in range(ENSEMBLE) if size[other] == 0] == [member]


def test_each_environment_has_one_held_out_member():
    seed = fresh_seed()
    environment = load("which_is_heavier", "features", seed)
    network = make_network(environment, seed)
    kept, played = room(network, environment, 1), play(network, environment, 0)
    kept.add(played, 0)
    drawn, held_out = kept.sample(np.random.default_rng(seed), 300, 3, 1)
    assert np.bincount(held_out).tolist() == [100, 100, 100]
    # Environments 0, 3, 6 ... belong to the first member: an episode is known by its actions, answer and reward.
    ends, drawn_ends = played.rewards.sum(axis=0), drawn.rewards.sum(axis=0)
    for row in range(300):
        length = int(drawn.lengths[row])
        fitting = [
            index
            for index in range(SIZE)
            if played.lengths[index] == length
            and (played.actions[:length, index] == drawn.actions[:length, row]).all()
            and (played.answers[index], ends[index]) == (drawn.answers[row], drawn_ends[row])
        ]
        assert int(held_out[row]) in [index % 3 for index in fitting]
    environment.close()


def first_choices(monkeypatch, action_values, num_interactions, random_starts=False, **constants):
    """Returns the first actions of 6000 episodes in which actions have these values, and the policy."""
    monkeypatch.setattr(config_lib, "NUM_ENVIRONMENTS", 6000)
    for name, value in constants.items():
        monkeypatch.setattr(belief_acting, name, value)
    policy = belief_acting.BehaviourPolicy(num_interactions, 8, fresh_seed(), 0, random_starts=random_starts)
    values = torch.tensor(action_values).repeat(6000, 1)
    output = networks_lib.Output(values, values.max(1).values, values)
    return policy.choose(output, np.arange(6000), 0), policy


def test_the_environments_explore_from_much_to_little(monkeypatch):
    # The first interaction is best by far, so any other was drawn; of the drawn ones, three of four are others.
    values = [1.0, 0, 0, 0, -1, -1, -1, -1]
    actions, policy = first_choices(monkeypatch, values, 4, _EARLY_STOP_FRACTION=0.0, _EVAL_FRACTION=0.5)
    assert policy.are_greedy.tolist() == [True] * 3000 + [False] * 3000 and not actions[:3000].any()
    assert (actions[3000:3100] != 0).mean() == pytest.approx(0.75 * 0.6, abs=0.25)  # Five standard errors.
    assert (actions[-1000:] != 0).mean() < 0.75 * 0.6 / 5


def test_with_random_starts_a_quarter_of_exploring_episodes_has_one(monkeypatch):
    # The first of four interactions is best by far, so three of four random ones are others.
    values, constants = [1.0, 0, 0, 0, -1, -1, -1, -1], {"_EARLY_STOP_FRACTION": 0.0, "_EPSILON_MAX": 0.0}
    for random_starts, share in ((True, 0.75 * 0.25), (False, 0)):
        actions, policy = first_choices(monkeypatch, values, 4, random_starts, **constants)
        assert not actions[policy.are_greedy].any()
        # Five standard errors of a share of 4500 draws: 5 * sqrt(0.19 * 0.81 / 4500) = 0.029.
        assert (actions[~policy.are_greedy] != 0).mean() == pytest.approx(share, abs=0.029 if share else 0)


def test_answers_in_training_are_drawn_from_the_belief_and_some_uniformly(monkeypatch):
    belief_now = np.array([0.5, 0.3, 0.1, 0.1, 0.0, 0.0, 0.0, 0.0])
    values = [-1.0, -1.0, *(2 * belief_now - 1)]
    constants = {"_EARLY_STOP_FRACTION": 0.0, "_EVAL_FRACTION": 0.0, "_EPSILON_MAX": 0.0}
    actions, policy = first_choices(monkeypatch, values, 2, **constants)
    shares = np.bincount(actions - 2, minlength=8) / 6000
    # Five standard errors of a share of 6000 draws: 5 * sqrt(0.5 * 0.5 / 6000) = 0.033.
    np.testing.assert_allclose(shares, 0.9 * belief_now + 0.1 / 8, atol=0.033)
    assert (shares > 0).all()
    np.testing.assert_allclose(policy.beliefs, belief_now[actions - 2], atol=1e-6)


def test_greedy_episodes_in_training_are_played_like_those_of_the_agent():
    seed = fresh_seed()
    environment = load("which_is_heavier", "features", seed)
    network = make_network(environment, seed)
    training = play(network, environment, 0)
    plain = acting.play_round(network, environment, 0, acting.likeliest)
    for episode in range(SIZE // 4):
        length = plain.lengths[episode]
        assert training.lengths[episode] == length
        np.testing.assert_array_equal(training.actions[:length, episode], plain.actions[:length, episode])
    environment.close()


@pytest.mark.parametrize("greedy", [True, False])
def test_an_episode_has_at_most_the_interactions_of_training(greedy):
    seed = fresh_seed()
    environment = load("which_is_heavier", "features", seed)
    network = make_network(environment, seed)
    network.members.shares.bias.data += 10.0  # It would interact for ever.
    choose = acting.likeliest if greedy else acting.drawn(np.random.default_rng(seed))
    played = acting.play_round(network, environment, 0, choose)
    assert (played.lengths == network.max_interactions + 1).all()
    environment.close()


# The replay and the agent.


@pytest.mark.parametrize(("domain", "task"), [("towers", "fist_features"), ("threshold", "pixels")])
def test_episodes_are_played_again_from_their_actions_to_the_last_bit(domain, task):
    seed = fresh_seed()
    environment = load(domain, task, seed)
    network = make_network(environment, seed)
    kept = room(network, environment, 2)
    for number in range(3):  # The first is forgotten.
        kept.add(play(network, environment, number), number)
    again = room(network, environment, 2)
    again.actions.copy_(kept.actions)

    def play_again(number, choose):
        return acting.play_round(network, environment, number, choose, keep_inputs=True)

    again.restore(play_again, 3)
    drawn, expected = (each.sample(np.random.default_rng(0), 64, ENSEMBLE, 3)[0].arrays() for each in (again, kept))
    for name, array in expected.items():
        np.testing.assert_array_equal(drawn[name], array)
    environment.close()


def test_convolutions_stay_random_and_outputs_are_kept_in_half():
    agent = make_agent(SMALL.replace(seed=fresh_seed()), "strike", "pixels")
    before, learner = agent.save(), agent
    while not int(learner.variables.tensors()["optimizer/projection.weight/step"]):
        learner.step()
    after = agent.save()
    are_same = {name: torch.equal(value, after[name]) for name, value in before.items() if name.startswith("trained/")}
    assert {name for name in are_same if "torso" in name} == {name for name in are_same if are_same[name]}
    episodes, _ = learner.variables.episodes.sample(np.random.default_rng(0), 16, ENSEMBLE, learner.next_episode)
    assert episodes.inputs.dtype == torch.float16 and episodes.inputs.abs().max() > 0


def test_more_than_fits_into_memory_is_refused_with_a_number_that_fits():
    with pytest.raises(ValueError, match=r"episodes to learn from take .* GB, .* give replay_episodes at most \d+$"):
        make_agent(config_lib.BeliefConfig(replay_episodes=10_000_000), "towers", "fist_pixels")


class Revealing:
    """A batch that reveals wrong labels."""

    def __init__(self, batch):
        self._batch = batch

    def __getattr__(self, name):
        return getattr(self._batch, name)

    @property
    def correct_answers(self):
        return (self._batch.correct_answers + 1) % 4


@pytest.mark.parametrize("answers_revealed", [True, False])
def test_right_labels_are_learned_from_only_if_they_are_revealed(answers_revealed):
    config = SMALL.replace(answers_revealed=answers_revealed, seed=fresh_seed(), frames=1, frames_per_update=16)
    agents = [
        make_agent(config),
        belief.Belief(lambda seed, size, threads: Revealing(load("which_is_heavier", "features", seed, size)), config),
    ]
    for agent in agents:
        for _ in agent.updates():
            pass
    truth, other = (agent.save() for agent in agents)
    differing = [name for name in truth if not torch.equal(truth[name], other[name])]
    assert bool(differing) == answers_revealed


def test_windows_of_episodes_that_all_return_the_same_are_compared():
    for steps in range(1, 12):  # For some, the mean square rounds to less than the square of the mean.
        variables, value = make_agent().variables, SMALL.discount**steps
        variables.compare(torch.full((512,), value, dtype=torch.float64))
        best, variance, *_, is_worse = variables.scores.tolist()
        assert best == pytest.approx(value) and 0 <= variance < 1e-12 and not is_worse


def test_the_agent_falls_back_to_the_best_window_after_a_worse_one():
    agent = make_agent()
    variables = agent.variables

    def play_window(mark, *returns):
        """Plays windows of 512 greedy episodes; returns which network is the agent, by the mark of its last weights."""
        for value in returns:
            variables.averaged.members.belief.bias.data.fill_(mark)
            variables.compare(torch.full((512,), value, dtype=torch.float64))
            variables.update_agent()
        return agent.save()["network/members.belief.bias"].flatten()[0]

    assert play_window(1.0, 0.2) == 1.0
    assert play_window(2.0, 0.5) == 2.0
    assert play_window(3.0, 0.4) == 2.0, "the best window's network"
    other = make_agent()
    other.restore(agent.save())
    assert torch.equal(other.variables.scores, variables.scores)
    assert play_window(4.0, 0.6) == 4.0
    variables.scores[:2] = torch.tensor([0.7, 0.01])  # A standard error of 0.1.
    assert play_window(5.0, 0.6) == 5.0, "within two standard errors"
