"""The belief learner: what it is trained towards is Bayes' rule and Bellman's equation, and it keeps what it needs."""

import math

import numpy as np
import pytest
from seeds import fresh_seed
import torch

from physexp import suite
from physexp.agents import acting, learning, starting
from physexp.agents.belief import acting as belief_acting
from physexp.agents.belief import agent as belief
from physexp.agents.belief import config as config_lib
from physexp.agents.belief import learning as learning_lib
from physexp.agents.belief import losses, networks, replay

torch.set_num_threads(1)
SMALL = config_lib.BeliefConfig(num_environments=8, units=4, batch_size=16, frames=600, replay_episodes=64)


def load(domain, task, seed, num_environments=8, num_threads=1):
    return suite.load_batch(domain, task, num_environments, {"random": seed}, num_threads)


def make_network(environment, seed, config=SMALL):
    network = starting.make_network(networks.BeliefNetwork, environment, config.replace(seed=seed))
    network.calibrate(acting.as_tensors(environment.reset().observation))
    return network


def play(network, environment, number, config=SMALL):
    explorer = belief_acting.Explorer(network, config, number)
    return acting.play_round(network, environment, number, explorer.choose, keep_inputs=True)


def room(network, environment, num_rounds):
    """Room for rounds of episodes."""
    return replay.Replay(
        num_rounds, SMALL.most_interactions + 1, environment.num_environments, network.num_inputs, np.float32
    )


# What it is trained towards.


def test_a_right_answer_is_the_label_and_a_wrong_one_leaves_the_others_as_they_were_to_each_other():
    logits = torch.log(torch.tensor([[0.5, 0.3, 0.2], [0.5, 0.3, 0.2]]))
    found = losses.hindsight(logits, torch.tensor([1, 1]), torch.tensor([True, False]))
    torch.testing.assert_close(found, torch.tensor([[0.0, 1.0, 0.0], [0.5 / 0.7, 0.0, 0.2 / 0.7]]))


@pytest.mark.parametrize("is_right", [True, False])
def test_a_step_on_the_hindsight_label_is_a_step_on_the_likelihood_of_the_reward(is_right):
    torch.manual_seed(fresh_seed())
    logits = torch.randn(1, 5, dtype=torch.float64, requires_grad=True)
    answer, are_right = torch.tensor([2]), torch.tensor([is_right])
    labels = losses.hindsight(logits.detach(), answer, are_right)
    losses.belief_loss(logits[None, None], labels, torch.ones(1, 1, 1, dtype=torch.bool)).sum().backward()
    found, logits.grad = logits.grad, None
    belief_in_answer = logits.softmax(1)[0, 2]
    (-torch.log(belief_in_answer if is_right else 1 - belief_in_answer)).backward()
    torch.testing.assert_close(found, logits.grad)


def test_every_step_of_an_episode_is_trained_towards_the_label_and_none_beyond_its_end():
    logits = torch.zeros(3, 2, 4)
    logits[2, 1] = 100.0  # Beyond the end of the second episode.
    labels = torch.tensor([[1.0, 0, 0, 0], [0, 1.0, 0, 0]])
    played = torch.arange(3)[:, None] < torch.tensor([3, 2])
    assert losses.belief_loss(logits[None], labels, played[None]).tolist() == pytest.approx([math.log(4)])


@pytest.mark.parametrize("memory", ["attention", "lstm"])
def test_no_step_knows_what_comes_after_it(memory):
    torch.manual_seed(fresh_seed())
    members = networks.Members(2, 3, 4, 5, 64, memory)  # So wide that no step has all its rectifiers shut.
    history = torch.randn(2, 6, 7, 3)
    changed = torch.cat([history[:, :, :4], torch.randn(2, 6, 3, 3)], dim=2)
    for before, after in zip(members(history), members(changed), strict=True):
        torch.testing.assert_close(before[:, :, :4], after[:, :, :4])
        assert not torch.isclose(before[:, :, 4:], after[:, :, 4:]).all(dim=-1).any()


@pytest.mark.parametrize("every_step", [True, False])
def test_the_belief_is_learned_at_every_step_or_where_the_answer_was_given(every_step):
    config = SMALL.replace(seed=fresh_seed(), every_step=every_step, answers_revealed=True, dropout=0.0)
    agent = belief.Belief(lambda seed, size, threads: load("which_is_heavier", "features", seed, size), config)
    learner = agent._learner
    learner.step()
    drawn = learner.variables.episodes.sample(np.random.default_rng(config.seed), 16, config.num_members, 1)
    network = learner.variables.network
    with torch.no_grad():
        inputs = learning_lib._padded(drawn.inputs, drawn.played)
        likelihoods = network.unroll(inputs, drawn.actions)[0].log_softmax(-1)
    means = []
    for member in range(config.num_members):
        costs = [
            -likelihoods[member, step, episode, drawn.answers[episode]]
            for episode in range(16)
            for step in range(int(drawn.lengths[episode]))
            if drawn.judges[episode] != member and (every_step or step == drawn.lengths[episode] - 1)
        ]
        means.append(sum(costs) / len(costs))
    found = learner._learn(drawn, 0.0)["belief_loss"]
    assert found == pytest.approx(float(sum(means) / len(means)), rel=1e-4)


def targets(answering, interacting, are_greedy, length, reward=0.0, trace=0.5):
    columns = [torch.tensor(column)[:, None] for column in (answering, interacting, are_greedy)]
    are_last = (torch.arange(len(answering)) == length - 1)[:, None]
    return losses.interaction_targets(*columns, are_last, torch.tensor([reward]), 0.9, trace)[:, 0]


def test_an_interaction_is_worth_the_discounted_better_of_answering_and_going_on():
    # Two interactions and an answer; nothing greedy, so each target is 0.9 * V of the step that follows.
    found = targets([-0.5, 0.2, 0.8], [0.1, 0.6, 0.0], [False, False, False], 3)
    torch.testing.assert_close(found[:2], torch.tensor([0.9 * 0.6, 0.9 * 0.8]))


def test_the_return_of_greedy_interactions_counts_by_lambda():
    # The second interaction is greedy: its own target, 0.9 * 0.8, counts half, V = 0.6 the other half.
    found = targets([-0.5, 0.2, 0.8], [0.1, 0.6, 0.0], [False, True, False], 3)
    torch.testing.assert_close(found[0], torch.tensor(0.9 * (0.5 * 0.6 + 0.5 * 0.9 * 0.8)))


def test_an_interaction_that_should_have_been_an_answer_counts_as_the_answer():
    found = targets([-0.5, 0.7, 0.8], [0.1, 0.6, 0.0], [False, True, False], 3, trace=1.0)
    torch.testing.assert_close(found[0], torch.tensor(0.9 * 0.7))


def test_at_the_last_step_there_is_nothing_but_the_answer_whatever_interactions_seem_worth():
    low, high = (targets([-0.5, 0.8], [0.1, seeming], [False, True], 2, trace=1.0) for seeming in (0.0, 100.0))
    assert low[0] == high[0] == pytest.approx(0.9 * 0.8)


def test_an_interaction_that_ends_an_episode_is_worth_its_reward():
    assert targets([0.1, 0.2], [0.3, 0.4], [True, True], 2, reward=-1.0)[1] == -1.0


def test_calibration_is_the_mean_distance_of_belief_and_success():
    # Three of four answers of belief 0.95 are right, one of two of belief 0.5: (4 * 0.2 + 2 * 0) / 6.
    beliefs = torch.tensor([0.95] * 4 + [0.5] * 2)
    outcomes = torch.tensor([1.0, 1, 1, 0, 1, 0])
    assert losses.calibration_error(beliefs, outcomes) == pytest.approx(4 * 0.2 / 6, abs=1e-6)
    assert losses.calibration_error(torch.ones(3), torch.ones(3)) == 0


# What it plays with.


@pytest.mark.parametrize(
    ("domain", "task", "memory"),
    [*((*names, "attention") for names in suite.ALL_TASKS), ("which_is_heavier", "features", "lstm")],
)
def test_acting_and_training_compute_the_same(domain, task, memory):
    seed = fresh_seed()
    environment = load(domain, task, seed)
    network = make_network(environment, seed, SMALL.replace(memory=memory))
    played = play(network, environment, 0)
    episodes = room(network, environment, 1)
    episodes.add(played, 0)
    drawn = episodes.sample(np.random.default_rng(seed), 32, SMALL.num_members, 1)
    with torch.no_grad():
        packed = drawn.inputs
        inputs = torch.zeros(*drawn.played.shape, packed.shape[1])
        inputs[drawn.played] = packed
        logits, shares = network.unroll(inputs, drawn.actions)
        judged_logits, judged_shares = network.judge(inputs, drawn.actions)
        for row, judge in enumerate(drawn.judges):
            torch.testing.assert_close(judged_logits[:, row], logits[judge, :, row], rtol=1e-3, atol=1e-4)
            torch.testing.assert_close(judged_shares[:, row], shares[judge, :, row], rtol=1e-3, atol=1e-4)
        beliefs = logits.softmax(-1).mean(0)
        values = network.values(beliefs, shares.mean(0))
        state = network.initial_state(32)
        for step in range(len(drawn.actions)):
            found, _, state = network.step(inputs[step], state)
            worths = network.worths(found)
            state = network.note(drawn.actions[step], state)
            expected = torch.cat([values[step], 2 * beliefs[step] - 1], dim=1)
            if step == network.most_interactions:
                expected[:, : network.num_interactions] = -1
            rows = drawn.played[step]
            torch.testing.assert_close(worths[rows], expected[rows], rtol=1e-3, atol=1e-4)
    environment.close()


def test_values_lie_between_answering_a_step_later_and_knowing_a_step_later():
    network = make_network(load("which_is_heavier", "features", 0), 0)
    beliefs = torch.tensor([[0.7, 0.1, 0.1, 0.1]])
    found = network.values(beliefs, torch.tensor([[0.0, 0.5, 1.0]]))
    answering = 2 * 0.7 - 1
    expected = network.discount * torch.tensor([[answering, (answering + 1) / 2, 1.0]])
    torch.testing.assert_close(found, expected)


def test_an_episode_is_judged_by_the_member_that_does_not_learn_from_it():
    config = SMALL.replace(dropout=0.0, averaging=1 - 1e-9, num_members=2, seed=fresh_seed())
    agent = belief.Belief(lambda seed, size, threads: load("which_is_heavier", "features", seed, size), config)
    learner = agent._learner
    learner.step()
    variables = learner.variables
    drawn = variables.episodes.sample(np.random.default_rng(0), 64, 2, 1)
    their_own = [replay.Episodes(**{**vars(drawn), "judges": torch.full_like(drawn.judges, judge)}) for judge in (0, 1)]
    gradients = []

    def note(network, loss, *_):
        network.zero_grad()
        loss.backward()
        found = [parameter.grad for parameter in network.members.parameters()]
        gradients.append([sum(float(gradient[member].abs().sum()) for gradient in found) for member in (0, 1)])
        return [torch.zeros_like(parameter) for parameter in network.parameters()], 1.0

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(learning, "clipped_gradients", note)
        for episodes in their_own:
            learner._learn(episodes, 0.0)
        assert gradients[0][0] == gradients[1][1] == 0 < min(gradients[0][1], gradients[1][0])
        # What the judges of the first half think of it changes its targets, and nothing else of them does.
        losses_of = [learner._learn(drawn, 0.0)["value_loss"]]
        inputs = learning_lib._padded(drawn.inputs, drawn.played)
        before = variables.averaged.judge(inputs, drawn.actions)[0]
        for parameter in variables.averaged.members.parameters():
            parameter.data[0].normal_()
        after = variables.averaged.judge(inputs, drawn.actions)[0]
        are_same = [torch.equal(before[:, row], after[:, row]) for row in range(64)]
        assert are_same == (drawn.judges == 1).tolist()
        losses_of.append(learner._learn(drawn, 0.0)["value_loss"])
    assert losses_of[0] != losses_of[1]


def test_each_member_judges_as_many_episodes_as_another_and_each_environment_has_one_judge():
    seed = fresh_seed()
    environment = load("which_is_heavier", "features", seed, 7)
    network = make_network(environment, seed)
    kept = room(network, environment, 1)
    played = play(network, environment, 0, SMALL.replace(num_environments=7))
    kept.add(played, 0)
    drawn = kept.sample(np.random.default_rng(seed), 300, 3, 1)
    assert np.bincount(drawn.judges).tolist() == [100, 100, 100]
    # Environments 0, 3 and 6 have the first judge, 1 and 4 the second, 2 and 5 the third: an episode is known by its
    # actions, its answer and its reward.
    ends = played.rewards.sum(axis=0)
    for row in range(300):
        length = int(drawn.lengths[row])
        fitting = [
            environment
            for environment in range(7)
            if played.lengths[environment] == length
            and (played.actions[:length, environment] == drawn.actions[:length, row].numpy()).all()
            and (played.answers[environment], ends[environment]) == (drawn.answers[row], drawn.rewards[row])
        ]
        assert int(drawn.judges[row]) in [environment % 3 for environment in fitting]
    environment.close()


def test_the_environments_explore_from_much_to_little():
    seed = fresh_seed()
    config = SMALL.replace(num_environments=6000, replay_episodes=6000, greedy=0.5, cut=0.0, exploration=0.6, seed=seed)
    environment = load("which_is_heavier", "features", seed, 1)
    network = make_network(environment, seed, config)
    # The first interaction is best by far, so any other was drawn; of the drawn ones, three of four are others.
    worths = torch.tensor([1.0, 0, 0, 0, -1, -1, -1, -1]).repeat(6000, 1)
    scale = network.worths(torch.ones(1)).item()
    explorer = belief_acting.Explorer(network, config, 0)
    others = explorer.choose(worths / scale, np.arange(6000), 0) != 0
    assert not others[:3000].any()
    assert others[3000:3100].mean() == pytest.approx(0.75 * 0.6, abs=0.25)  # Five standard errors.
    assert others[-1000:].mean() < 0.75 * 0.6 / 5
    environment.close()


def test_the_greedy_share_of_episodes_is_played_as_the_agent_plays_without_learning():
    seed = fresh_seed()
    environment = load("which_is_heavier", "features", seed)
    network = make_network(environment, seed)
    learning = play(network, environment, 0, SMALL.replace(greedy=0.5))
    plain = acting.play_round(network, environment, 0, acting.likeliest)
    for episode in range(4):
        length = plain.lengths[episode]
        assert learning.lengths[episode] == length
        np.testing.assert_array_equal(learning.actions[:length, episode], plain.actions[:length, episode])
    environment.close()


@pytest.mark.parametrize("greedy", [True, False])
def test_an_episode_has_no_more_interactions_than_were_trained_for(greedy):
    seed = fresh_seed()
    environment = load("which_is_heavier", "features", seed)
    network = make_network(environment, seed)
    network.members.shares.bias.data += 10.0  # It would interact for ever.
    choose = acting.likeliest if greedy else acting.drawn(np.random.default_rng(seed))
    played = acting.play_round(network, environment, 0, choose)
    assert (played.lengths == SMALL.most_interactions + 1).all()
    environment.close()


def test_answers_while_it_learns_are_drawn_from_its_belief_and_a_tenth_from_all_labels_alike():
    seed = fresh_seed()
    config = SMALL.replace(num_environments=4000, replay_episodes=4000, greedy=0.0, cut=0.0, exploration=0.0, seed=seed)
    environment = load("threshold", "features", seed, 1)
    network = make_network(environment, seed, config)
    belief_now = torch.tensor([0.5, 0.3, 0.1, 0.1, 0.0, 0.0, 0.0, 0.0]).repeat(4000, 1)
    worths = torch.cat([torch.full((4000, network.num_interactions), -1.0), 2 * belief_now - 1], dim=1)
    scale = network.worths(torch.ones(1)).item()
    explorer = belief_acting.Explorer(network, config, 0)
    answers = explorer.choose(worths / scale, np.arange(4000), 0) - network.num_interactions
    shares = np.bincount(answers, minlength=8) / 4000
    # Five standard errors of a share of 4000 draws: 5 * sqrt(0.5 * 0.5 / 4000) = 0.04.
    np.testing.assert_allclose(shares, 0.9 * belief_now[0] + 0.1 / 8, atol=0.04)
    assert (shares > 0).all()
    np.testing.assert_allclose(explorer.beliefs, belief_now[0][answers], atol=1e-6)
    environment.close()


# What it keeps.


@pytest.mark.parametrize(("domain", "task"), [("towers", "fist_features"), ("threshold", "pixels")])
def test_what_was_played_is_played_again_from_its_actions_to_the_last_bit(domain, task):
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
    drawn, expected = (
        each.sample(np.random.default_rng(0), 64, SMALL.num_members, 3).arrays() for each in (again, kept)
    )
    for name, array in expected.items():
        np.testing.assert_array_equal(drawn[name], array)
    environment.close()


def test_convolutions_stay_as_they_were_drawn_and_what_they_make_of_images_is_kept_in_half_precision():
    config = SMALL.replace(seed=fresh_seed())
    agent = belief.Belief(lambda seed, size, threads: load("strike", "pixels", seed, size), config)
    before = agent.save()
    learner = agent._learner
    while not int(learner.variables.optimizer.state[learner.variables.network.projection.weight]["step"]):
        learner.step()
    after = agent.save()
    are_same = {name: torch.equal(value, after[name]) for name, value in before.items() if name.startswith("trained/")}
    assert {name for name in are_same if "torso" in name} == {name for name in are_same if are_same[name]}
    played = learner.last_round
    drawn = learner.variables.episodes.sample(np.random.default_rng(0), 16, config.num_members, learner.next_episode)
    assert drawn.inputs.dtype == torch.float16 and played.inputs.abs().max() > 0
    kept = {row.numpy().tobytes() for row in drawn.inputs}
    assert {row.numpy().tobytes() for row in played.inputs.half()} & kept  # Some of the last round's are among them.


def test_more_than_fits_into_memory_is_refused_with_a_number_that_fits():
    with pytest.raises(ValueError, match=r"episodes to learn from take .* GB, .* give replay_episodes at most \d+$"):
        belief.Belief(
            lambda seed, size, threads: load("towers", "fist_pixels", seed, size),
            config_lib.BeliefConfig(replay_episodes=10_000_000),
        )


class Revealing:
    """A batch whose right labels are not what they are."""

    def __init__(self, batch):
        self._batch = batch

    def __getattr__(self, name):
        return getattr(self._batch, name)

    @property
    def correct_answers(self):
        return (self._batch.correct_answers + 1) % 4


@pytest.mark.parametrize("answers_revealed", [True, False])
def test_right_labels_are_learned_from_only_where_they_are_revealed(answers_revealed):
    config = SMALL.replace(answers_revealed=answers_revealed, seed=fresh_seed())
    made = [
        lambda seed, size, threads: load("which_is_heavier", "features", seed, size),
        lambda seed, size, threads: Revealing(load("which_is_heavier", "features", seed, size)),
    ]
    agents = [belief.Belief(make_environment, config) for make_environment in made]
    for agent in agents:
        for _ in agent.updates():
            pass
    truth, other = (agent.save() for agent in agents)
    differing = [name for name in truth if not torch.equal(truth[name], other[name])]
    assert bool(differing) == answers_revealed


def test_what_is_handed_out_is_the_best_once_the_last_has_become_worse():
    agent = belief.Belief(lambda seed, size, threads: load("which_is_heavier", "features", seed, size), SMALL)
    learner = agent._learner
    variables = learner.variables
    learner.step()
    named = {name: value for name, value in variables.tensors().items() if value.is_floating_point()}
    for prefix in ("averaged", "network"):
        torch.testing.assert_close(named[f"{prefix}/members.belief.bias"], variables.averaged.members.belief.bias)
    variables.best.members.belief.bias.data.fill_(7.0)
    variables.scores[5] = 1.0  # Worse.
    variables.hand_out()
    assert (agent.save()["network/members.belief.bias"] == 7.0).all()
    assert not (agent.save()["averaged/members.belief.bias"] == 7.0).any()
