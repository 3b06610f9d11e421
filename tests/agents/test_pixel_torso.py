"""The paper's convolutions, their device and their precision."""

from dm_env import specs
import numpy as np
import pytest
from seeds import fresh_seed
import torch

from physexp import suite
from physexp.agents import acting, devices, networks

SCALE = 3.0
# The error of three convolutions and a product in bf16, with 8 bits of precision: a hundredth of the largest output.
BF16_TOLERANCE = 1e-2


def fresh_images(number):
    torch.manual_seed(fresh_seed())
    return torch.randint(256, (number, 84, 84, 3), dtype=torch.uint8)


SPEC = {"pixels": specs.Array((84, 84, 3), np.uint8)}


def make_network():
    return networks.RecurrentActorCritic(SPEC, 9, observation_scale=SCALE)


def test_the_layers_are_the_papers():
    torso = networks.PixelTorso(SPEC, SCALE)
    sizes, x = [], fresh_images(2).permute(0, 3, 1, 2).float()
    for layer in torso.convolutions:
        x = layer(x)
        sizes.append(tuple(x.shape[1:]))
    # 84 pixels: (84 - 8) / 4 + 1 = 20, (20 - 4) / 2 + 1 = 9, 9 - 3 + 1 = 7; each is followed by a ReLU.
    assert sizes == [(32, 20, 20)] * 2 + [(64, 9, 9)] * 2 + [(64, 7, 7)] * 2
    assert torso.num_outputs == 64 * 7 * 7


def test_pixels_are_relative_to_the_first_image_and_scaled():
    images, network = fresh_images(3), make_network()
    torso = network.torso
    for reference in (torch.zeros(84, 84, 3), images[1]):  # Without a reference they are those of the paper.
        expected = torso.convolutions(SCALE / 255 * (images.float() - reference.float()).permute(0, 3, 1, 2)).flatten(1)
        torch.testing.assert_close(torso({"pixels": images}), expected, rtol=1e-4, atol=1e-5)
        network.calibrate({"pixels": images[1:]})


def test_equal_images_pass_the_convolutions_once_and_count_each_time(monkeypatch):
    monkeypatch.setattr(devices, "_has_fast_bfloat16", lambda device_type: False)
    images, network = fresh_images(3), make_network()
    repeated = images[[0, 1, 0, 2, 2, 0]]
    passed = []
    network.torso.convolutions.register_forward_hook(lambda module, inputs, outputs: passed.append(len(inputs[0])))
    outputs = network.encode({"pixels": repeated})
    assert passed == [3]
    weights, parameters = torch.randn_like(outputs), [*network.torso.parameters(), network.lstm.weight_ih_l0]
    once = torch.autograd.grad((outputs * weights).sum(), parameters)
    one_by_one = torch.cat([network.encode({"pixels": image[None]}) for image in repeated])
    torch.testing.assert_close(outputs, one_by_one, rtol=1e-4, atol=1e-4)
    each = torch.autograd.grad((one_by_one * weights).sum(), parameters)
    # Sums are rounded differently beside other images, so that a unit at zero may be on or off.
    for ours, theirs in zip(once, each, strict=True):
        assert difference(ours, theirs) < 1e-2


def test_the_policy_starts_from_its_initial_logits():
    images = fresh_images(4)
    network = make_network()
    before, _ = network.step(network.encode({"pixels": images}), network.initial_state(4))
    prior = torch.arange(9.0)
    network.initialize_policy(prior.tolist())
    after, _ = network.step(network.encode({"pixels": images}), network.initial_state(4))
    torch.testing.assert_close(after.logits - before.logits, prior.expand(4, 9))
    with pytest.raises(ValueError, match="initial_logits has 2 logits; give 9, or none"):
        network.initialize_policy([1.0, 2.0])


@pytest.mark.skipif(torch.cuda.is_available(), reason="needs a machine without a GPU")
def test_a_missing_gpu_is_refused_only_on_request():
    assert devices.choose("auto", sees_images=True).type == devices.choose("auto", sees_images=False).type == "cpu"
    with pytest.raises(ValueError, match="device is cuda, but torch finds no GPU here; choose cpu or auto"):
        devices.choose("cuda", sees_images=True)


def difference(outputs, expected):
    """The root mean square of the differences over that of the expected outputs."""
    return (torch.linalg.vector_norm(outputs - expected) / torch.linalg.vector_norm(expected)).item()


def test_bf16_agrees_with_float32_within_its_precision(monkeypatch):
    images, network = fresh_images(8), make_network()
    monkeypatch.setattr(devices, "_has_fast_bfloat16", lambda device_type: False)
    with torch.no_grad():
        expected = network.encode({"pixels": images})
    monkeypatch.setattr(devices, "_has_fast_bfloat16", lambda device_type: True)
    with torch.no_grad():
        outputs = network.encode({"pixels": images})
    assert outputs.dtype == torch.float32
    assert 0 < difference(outputs, expected) < BF16_TOLERANCE


def test_features_keep_their_precision(monkeypatch):
    torch.manual_seed(0)
    spec = {"heights": specs.Array((4,), np.float32)}
    network = networks.RecurrentActorCritic(spec, num_actions=8, observation_scale=40.0)
    heights = torch.tensor([[0.4, 0, 0, 0], [0.401, 0, 0, 0]])
    found = []
    for is_fast in (False, True):
        monkeypatch.setattr(devices, "_has_fast_bfloat16", lambda device_type, is_fast=is_fast: is_fast)
        with torch.no_grad():
            found.append(network.encode({"heights": heights}))
    assert torch.equal(*found) and not torch.equal(*found[1])


@pytest.mark.skipif(not torch.cuda.is_available(), reason="needs a GPU")
def test_a_gpu_agrees_with_the_processor_within_bf16():
    images, network = fresh_images(8), make_network()
    with torch.no_grad():
        expected = network.encode({"pixels": images})
    inputs = network.torso.to("cuda")({"pixels": images})
    assert inputs.is_cuda
    network.to("cpu")
    batch = suite.load_batch("towers", "fist_pixels", 4, {"random": 0})
    network.to("cuda")
    episodes = acting.play_round(network, batch, 0, acting.drawn(np.random.default_rng(0)))
    batch.close()
    assert episodes.num_frames > 0
    with torch.no_grad():
        projected = network.to("cpu").lstm.project(inputs.float().cpu())
    assert difference(projected, expected) < BF16_TOLERANCE


@pytest.mark.parametrize("names", [[], ["heights", "pixels"], ["left", "right"]])
def test_anything_but_features_or_one_image_is_refused(names):
    image, features = specs.Array((84, 84, 3), np.uint8), specs.Array((4,), np.float32)
    observed = {name: features if name == "heights" else image for name in names}
    with pytest.raises(
        ValueError, match=f"takes features .*, and the observation has {', '.join(names) or 'nothing'};"
    ):
        networks.RecurrentActorCritic(observed, 9, observation_scale=1.0)
