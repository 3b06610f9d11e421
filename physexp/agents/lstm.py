"""An LSTM layer with torch's parameters and torch's results, faster on a CPU.

On a CPU, an LSTM of 100 units spends most of its time not on matrix products but on tanh, which costs several
times as much as the logistic function, and on small gradients of the weights at every time step. Here all four gates
go through one logistic function (tanh x = 2 sigma(2x) - 1), and the gradients of the weights are one product over all
time steps. On a GPU torch's own kernels are used.
"""

from typing import Any

import torch
from torch import nn

State = tuple[torch.Tensor, torch.Tensor]
"""Hidden and cell state, each [1, N, H]."""


class LSTM(nn.LSTM):
    """One layer; `step` and `unroll` agree with what `torch.nn.LSTM` computes."""

    weight_ih_l0: torch.Tensor
    weight_hh_l0: torch.Tensor
    bias_ih_l0: torch.Tensor
    bias_hh_l0: torch.Tensor

    def __init__(self, num_inputs: int, num_units: int):
        super().__init__(num_inputs, num_units)

    def project(self, inputs: torch.Tensor) -> torch.Tensor:
        """Returns the input of `step` and `unroll`, from inputs [N, F].

        On a CPU it is the contribution of inputs and biases to the gates, [N, 4 H]; on a GPU, the inputs themselves. It
        depends on no state, so it is computed once for acting and learning.
        """
        if inputs.is_cuda:  # For torch's kernels.
            return inputs
        return torch.addmm(self.bias_ih_l0 + self.bias_hh_l0, inputs, self.weight_ih_l0.t())

    def step(self, projected: torch.Tensor, state: State) -> tuple[torch.Tensor, State]:
        """Computes one time step of projected inputs, without gradients; returns outputs [N, H] and the next state."""
        if projected.is_cuda:
            outputs, after = self(projected[None], state)
            return outputs[0], after
        hidden, cell = state[0][0], state[1][0]
        hidden, cell, _ = _advance(torch.addmm(projected, hidden, self.weight_hh_l0.t()), cell)
        return hidden, (hidden[None], cell[None])

    def unroll(self, projected: torch.Tensor, batch_sizes: torch.Tensor) -> torch.Tensor:
        """Computes whole sequences from a state of zeros, with gradients; returns packed outputs, [N, H].

        The inputs are what `project` returned for N inputs, packed: the longest sequence first, all first steps, then
        all second steps, and so on. `batch_sizes` has how many sequences have a t-th step, int64 [T].
        """
        if projected.is_cuda:
            outputs: torch.Tensor = self(nn.utils.rnn.PackedSequence(projected, batch_sizes))[0].data
        else:
            outputs = _Unroll.apply(projected, self.weight_hh_l0, batch_sizes.tolist())  # type: ignore[no-untyped-call]
        return outputs


def _advance(gates: torch.Tensor, cell: torch.Tensor | None) -> tuple[torch.Tensor, torch.Tensor, torch.Tensor]:
    """Turns gates before their nonlinearity [n, 4 H], in place, into gates, and returns hidden, cell, tanh(cell)."""
    size = gates.shape[1] // 4
    gates[:, 2 * size : 3 * size].mul_(2)
    gates.sigmoid_()
    gates[:, 2 * size : 3 * size].mul_(2).sub_(1)
    entry, forget, candidate, exit_ = gates.chunk(4, dim=1)
    new_cell = entry * candidate
    if cell is not None:
        new_cell.addcmul_(forget, cell)
    squashed = (2 * new_cell).sigmoid_().mul_(2).sub_(1)
    return exit_ * squashed, new_cell, squashed


class _Unroll(torch.autograd.Function):
    """The recurrence, and its gradient by backpropagation through time (Hochreiter & Schmidhuber, 1997)."""

    @staticmethod
    def forward(ctx: Any, projections: torch.Tensor, weight: torch.Tensor, batch_sizes: list[int]) -> torch.Tensor:
        gates = projections.clone()
        hiddens, cells, squashed = (projections.new_empty(len(gates), weight.shape[1]) for _ in range(3))
        transposed = weight.t().contiguous()
        start, before = 0, 0
        for size in batch_sizes:
            now = slice(start, start + size)
            cell = None
            if start:
                past = slice(before, before + size)
                gates[now].addmm_(hiddens[past], transposed)
                cell = cells[past]
            hiddens[now], cells[now], squashed[now] = _advance(gates[now], cell)
            start, before = start + size, start
        ctx.save_for_backward(gates, weight, hiddens, cells, squashed)
        ctx.batch_sizes = batch_sizes
        return hiddens

    @staticmethod
    def backward(ctx: Any, grad_hiddens: torch.Tensor) -> tuple[torch.Tensor, torch.Tensor, None]:
        gates, weight, hiddens, cells, squashed = ctx.saved_tensors
        sizes = ctx.batch_sizes
        grad_gates = torch.empty_like(gates)  # Before the nonlinearity.
        past_hiddens = torch.zeros_like(hiddens)
        grad_hidden, grad_cell = (hiddens.new_zeros(sizes[0], hiddens.shape[1]) for _ in range(2))
        end = len(gates)
        for step in reversed(range(len(sizes))):
            size = sizes[step]
            now = slice(end - size, end)
            entry, forget, candidate, exit_ = gates[now].chunk(4, dim=1)
            to_entry, to_forget, to_candidate, to_exit = grad_gates[now].chunk(4, dim=1)
            hidden, cell = grad_hidden[:size], grad_cell[:size]  # Shorter sequences join on the way back.
            hidden += grad_hiddens[now]
            cell.addcmul_(hidden * exit_, 1 - squashed[now].square())
            torch.mul(hidden * squashed[now], exit_ * (1 - exit_), out=to_exit)
            torch.mul(cell * candidate, entry * (1 - entry), out=to_entry)
            torch.mul(cell * entry, 1 - candidate.square(), out=to_candidate)
            end -= size
            if step == 0:
                to_forget.zero_()
                break
            past = slice(end - sizes[step - 1], end - sizes[step - 1] + size)
            torch.mul(cell * cells[past], forget * (1 - forget), out=to_forget)
            cell.mul_(forget)
            torch.mm(grad_gates[now], weight, out=hidden)
            past_hiddens[now] = hiddens[past]
        return grad_gates, grad_gates.t() @ past_hiddens, None
