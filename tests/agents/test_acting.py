"""Actors and learners compute the same; draws follow the policy; rounds depend on nothing but seeds."""

from chance import P_VALUE
import dm_env
import numpy as np
import pytest
from scipy import stats
from seeds import fresh_seed
import torch

from physexp import suite
from physexp.agents import acting, environment_loop, networks, rounds

torch.set_num_threads(1)  # As a worker does; more of them only wait for each other.
TASKS = [("towers", "fist_features"), ("strike", "pixels")]


def make_network(environment, seed, kind=networks.RecurrentActorCritic):
    torch.manual_seed(seed)
    network = kind(environment.observation_spec(), environment.action_spec().num_values, observation_scale=10.0)
    with torch.no_grad():  # A fresh policy is nearly uniform; make observations matter.
        network.policy.weight.mul_(5)
    return network


class Recording(networks.RecurrentActorCritic):
    """Keeps the output of each step."""

    def step(self, inputs, state):
        output, state = super().step(inputs, state)
        self.seen = [*getattr(self, "seen", []), (output.logits.clone(), output.values.clone())]
        return output, state


@pytest.mark.parametrize(("domain", "task"), TASKS)
def test_acting_logits_and_values_equal_those_of_training(domain, task):
    seed = fresh_seed()
    batch = suite.load_batch(domain, task, 24, {"random": seed})
    network = make_network(batch, seed, Recording)
    network.calibrate(acting.as_tensors(batch.reset().observation))
    label = batch.action_spec().num_values - 1

    generator = np.random.default_rng(seed)

    def vary_lengths(output, environments, step):
        """Ends an episode with a probability of 0.1 to 0.3 at each step."""
        drawn = generator.choice([0, label, -1], len(environments), p=[0.7, 0.1, 0.2])
        return np.where(drawn < 0, acting.sample(output.logits, generator), drawn)

    episodes = acting.play_round(network, batch, 0, vary_lengths, keep_inputs=True)
    batch.close()
    lengths = episodes.lengths
    # All of 24 episodes end within two steps with a probability of 0.51^24 = 1e-7 at most.
    assert len(set(lengths)) > 2, "episodes of different lengths make this hard"

    order = np.argsort(-lengths, kind="stable")
    alive = [order[lengths[order] > t] for t in range(lengths.max())]  # Longest first, as packing wants them.
    batch_sizes = torch.tensor([len(rows) for rows in alive])
    selected = episodes.select()
    assert selected.batch_sizes.tolist() == batch_sizes.tolist()
    with torch.no_grad():
        logits, values = network.unroll(selected.inputs, batch_sizes)
    start = 0
    for t, rows in enumerate(alive):
        acted_logits, acted_values = network.seen[t]
        acted = np.flatnonzero(lengths > t)  # Environments step in increasing order.
        where = np.searchsorted(acted, rows)
        stop = start + len(rows)
        torch.testing.assert_close(logits[start:stop], acted_logits[where], atol=1e-5, rtol=1e-5)
        torch.testing.assert_close(values[start:stop], acted_values[where], atol=1e-5, rtol=1e-5)
        start = stop
    assert start == len(logits) == episodes.num_frames


def test_kept_inputs_and_gradients_equal_those_of_a_single_environment():
    # Episodes are rebuilt step by step in the single environment, and encoded anew.
    seed = fresh_seed()
    batch = suite.load_batch("which_is_heavier", "features", 6, {"random": seed})
    network = make_network(batch, seed)
    episodes = acting.play_round(network, batch, 3, acting.drawn(np.random.default_rng(seed)), keep_inputs=True)
    batch.close()
    order = np.argsort(-episodes.lengths, kind="stable")
    seen = [[] for _ in episodes.lengths]
    for i, length in enumerate(episodes.lengths):
        environment = suite.load("which_is_heavier", "features", {"random": suite.environment_seed(seed, i)})
        environment.task.next_episode = 3
        timestep = environment.reset()
        for action in episodes.actions[:length, i]:
            seen[i].append(timestep.observation["heights"])
            timestep = environment.step(action)
        environment.close()
    packed = [seen[i][t] for t in range(episodes.lengths.max()) for i in order if t < episodes.lengths[i]]
    anew = network.encode({"heights": torch.from_numpy(np.stack(packed))})
    acted = episodes.select().inputs
    torch.testing.assert_close(acted, anew, rtol=1e-4, atol=1e-5)
    weights = torch.randn_like(anew)
    ours, theirs = (torch.autograd.grad((each * weights).sum(), network.lstm.weight_ih_l0)[0] for each in (acted, anew))
    torch.testing.assert_close(ours, theirs, rtol=1e-3, atol=1e-4 * theirs.abs().max().item())


def test_packing_orders_all_first_steps_then_all_second_steps():
    # Episode 0 has 1 action, 1 has 3, 2 has 2; the entry of step t of episode b is 10 b + t. From the longest to the
    # shortest (1, 2, 0): first steps 10, 20, 0; second steps 11, 21; third step 12.
    actions = np.array([[0, 10, 20], [-1, 11, 21], [-1, 12, -1]])
    inputs = torch.tensor([[0.0], [10], [20], [11], [21], [12]])  # As they were played: episodes in their own order.
    episodes = rounds.Round(actions, np.zeros((3, 3)), np.array([1, 3, 2]), np.array([7, 8, 9]), inputs)
    assert episodes.num_frames == 6
    selected = episodes.select()
    assert selected.packed(selected.actions).tolist() == [10, 20, 0, 11, 21, 12]
    assert selected.inputs[:, 0].tolist() == [10, 20, 0, 11, 21, 12]
    assert selected.batch_sizes.tolist() == [3, 2, 1]
    assert selected.answers.tolist() == [8, 9, 7]
    # Of episodes 2 and 0 only: first steps 20, 0; second step 21; neither has a third.
    some = episodes.select(np.array([0, 2]))
    assert some.packed(some.actions).tolist() == some.inputs[:, 0].tolist() == [20, 0, 21]
    assert some.actions.shape == (2, 2) and some.answers.tolist() == [9, 7]


@pytest.mark.parametrize(("domain", "task"), TASKS)
def test_behaviour_data_have_the_probabilities_and_values_of_acting(domain, task):
    seed = fresh_seed()
    batch = suite.load_batch(domain, task, 12, {"random": seed})
    network = make_network(batch, seed)
    played = acting.play_round(network, batch, 0, acting.drawn(np.random.default_rng(seed)), keep_behaviour=True)
    batch.close()
    some = played.select(np.array([3, 7, 1, 11, 5]))
    with torch.no_grad():
        logits, values = network.unroll(network.encode(some.observation), some.batch_sizes)
    taken = torch.log_softmax(logits, -1).gather(1, some.packed(some.actions)[:, None])[:, 0]
    # Convolutions add up in another order for another number of images: 9e-5 were seen.
    tolerance = 1e-3 if "pixels" in suite.tags(domain, task) else 1e-5
    for found, expected in ((taken, some.log_probabilities), (values, some.values)):
        torch.testing.assert_close(found, expected, atol=tolerance, rtol=tolerance)


def test_draws_follow_the_softmax_of_the_logits():
    seed = fresh_seed()
    generator = np.random.default_rng(seed)
    logits = torch.from_numpy(generator.normal(size=6).astype(np.float32))
    drawn = acting.sample(logits.expand(50_000, 6), generator)
    expected = torch.softmax(logits.double(), 0).numpy() * len(drawn)
    counts = np.bincount(drawn, minlength=6)
    assert len(counts) == 6
    # A right sampler fails this once in a million runs.
    assert stats.chisquare(counts, expected * counts.sum() / expected.sum()).pvalue > P_VALUE


def test_the_lstm_starts_every_episode_from_zero():
    seed = fresh_seed()
    environment = suite.load("which_is_heavier", "features", {"random": seed})
    network = make_network(environment, seed, Recording)
    actor = acting.RecurrentActor(network, seed=seed)
    timestep = environment.reset()
    later = timestep._replace(step_type=dm_env.StepType.MID)
    for _ in range(2):
        actor.observe_first(timestep)
        for _ in range(4):
            actor.observe(actor.select_action(timestep.observation), later)
    environment.close()
    logits = torch.cat([seen[0] for seen in network.seen])
    torch.testing.assert_close(logits[:4], logits[4:], atol=0, rtol=0)
    assert not torch.equal(logits[0], logits[1]), "the state has to move on within an episode"


def test_a_greedy_actor_takes_the_likeliest_action_with_any_seed():
    seed = fresh_seed()
    environment = suite.load("which_is_heavier", "features", {"random": seed})
    network = make_network(environment, seed, Recording)
    taken = []
    for actor_seed in (0, 1):
        environment.task.next_episode = 0
        timestep = environment.reset()
        actor = acting.RecurrentActor(network, seed=actor_seed, greedy=True)
        actor.observe_first(timestep)
        actions = []
        while not timestep.last():
            actions.append(actor.select_action(timestep.observation))
            timestep = environment.step(actions[-1])
            actor.observe(actions[-1], timestep)
        taken.append(actions)
    environment.close()
    assert taken[0] == taken[1] == [int(logits.argmax()) for logits, _ in network.seen[: len(taken[0])]]


def test_a_loop_without_observe_first_or_observe_is_refused():
    environment = suite.load("threshold", "features", {"random": 0})
    actor = acting.RecurrentActor(make_network(environment, 0))
    timestep = environment.reset()
    for _ in range(2):  # At the start, and after an episode.
        for act, *words in ((actor.select_action, timestep.observation), (actor.observe, 0, timestep)):
            with pytest.raises(RuntimeError, match=r"call observe_first\(timestep\) after each reset"):
                act(*words)
        actor.observe_first(timestep)
        while not timestep.last():
            action = actor.select_action(timestep.observation)
            with pytest.raises(RuntimeError, match=r"call observe\(action, timestep\) after each step"):
                actor.select_action(timestep.observation)
            timestep = environment.step(action)
            actor.observe(action, timestep)
        timestep = environment.reset()
    environment.close()


def test_an_actor_refuses_observations_of_another_task():
    fist, direct = (suite.load("towers", f"{actuator}_features", {"random": 0}) for actuator in ("fist", "direct"))
    for trained, played in ((fist, direct), (direct, fist)):
        actor = acting.RecurrentActor(make_network(trained, 0))
        with pytest.raises(
            ValueError, match=r"^observed is .*positions \(5, 3\).*; give one that was trained in this "
        ):
            environment_loop.EnvironmentLoop(played, actor).run(1)
        loop = environment_loop.EnvironmentLoop(trained, actor)
        assert len(loop.run(1)) == 1
        with pytest.raises(ValueError, match="num_episodes is 0; give a number >= 1"):
            loop.run(0)
    flat = suite.load("towers", "fist_features", {"random": 0}, environment_kwargs={"flat_observation": True})
    with pytest.raises(ValueError, match=r"^observed is observations \(18,\), and the agent was trained with fist_pos"):
        environment_loop.EnvironmentLoop(flat, acting.RecurrentActor(make_network(fist, 0))).run(1)
