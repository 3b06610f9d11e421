"""The quick LSTM computes what torch's LSTM computes."""

import numpy as np
from seeds import fresh_seed
import torch

from physexp.agents import lstm


def test_unrolled_outputs_and_all_gradients_are_those_of_torch():
    seed = fresh_seed()
    torch.manual_seed(seed)
    lengths = np.sort(np.random.default_rng(seed).integers(1, 12, size=9))[::-1]
    batch_sizes = torch.tensor([(lengths > t).sum() for t in range(lengths[0])])
    inputs = torch.randn(int(batch_sizes.sum()), 4)
    layer = lstm.LSTM(4, 100)
    results = []
    for unroll in (
        lambda x, sizes: layer.unroll(layer.project(x), sizes),
        lambda x, sizes: layer(torch.nn.utils.rnn.PackedSequence(x, sizes))[0].data,
    ):
        layer.zero_grad()
        x = inputs.clone().requires_grad_()
        outputs = unroll(x, batch_sizes)
        outputs.square().sum().backward()
        results.append([outputs.detach(), x.grad, *(parameter.grad.clone() for parameter in layer.parameters())])
    for ours, theirs in zip(*results, strict=True):
        torch.testing.assert_close(ours, theirs, rtol=1e-4, atol=1e-5)


def test_a_step_is_a_step_of_torch():
    torch.manual_seed(fresh_seed())
    layer = lstm.LSTM(4, 100)
    inputs, state = torch.randn(7, 4), (torch.randn(1, 7, 100), torch.randn(1, 7, 100))
    with torch.inference_mode():
        outputs, (hidden, cell) = layer.step(layer.project(inputs), state)
        expected, (expected_hidden, expected_cell) = layer(inputs[None], state)
    torch.testing.assert_close(outputs, expected[0], rtol=1e-5, atol=1e-6)
    torch.testing.assert_close(hidden, expected_hidden, rtol=1e-5, atol=1e-6)
    torch.testing.assert_close(cell, expected_cell, rtol=1e-5, atol=1e-6)
