"""Runs as functions of PyTorch, with derivatives backwards by steps back."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import torch

from .flow import Flow


def flow(*args: Any, **options: Any) -> Callable[..., tuple[torch.Tensor, torch.Tensor]]:
    """A function of PyTorch: from q and p at t = 0, of shape (d,), and the values of the numbers in ``by`` to q and p of the states, of shape (rows, d).

    It takes the arguments of `shadowstep.Flow`. The steps are made by Shadowstep in double precision on the CPU; backwards they are made
    back, so that memory does not grow with their number.

    Examples
    --------
    >>> import torch, shadowstep.torch
    >>> spring = shadowstep.Problem("k*x^2/2", q={"x": 1}, p=[0], k=4)
    >>> states = shadowstep.torch.flow(spring, "yoshida4", h="1/100", until=1, every=100, by=["k"])
    >>> k = torch.tensor([4.0], dtype=torch.float64, requires_grad=True)
    >>> q, p = states(torch.tensor([1.0]), torch.tensor([0.0]), k)
    >>> q[-1, 0].backward()
    >>> round(float(k.grad[0]), 6)  # of cos √k
    -0.227324
    """
    made = Flow(*args, **options)

    class Differentiable(torch.autograd.Function):
        @staticmethod
        def forward(ctx: Any, *given: torch.Tensor) -> tuple[torch.Tensor, ...]:
            ctx.save_for_backward(*given)
            return tuple(_tensor(array, given[0]) for array in made.states(*map(_array, given)))

        @staticmethod
        def backward(ctx: Any, *covectors: torch.Tensor) -> tuple[torch.Tensor, ...]:
            given = ctx.saved_tensors
            found = made.pull_back(*map(_array, given), *map(_array, covectors))
            return tuple(_tensor(array, like) for array, like in zip(found, given))

    def function(q: torch.Tensor, p: torch.Tensor, numbers: Any = ()) -> tuple[torch.Tensor, torch.Tensor]:
        numbers = numbers if isinstance(numbers, torch.Tensor) else torch.tensor(numbers, dtype=torch.float64)
        found: tuple[torch.Tensor, torch.Tensor] = Differentiable.apply(q, p, numbers)  # type: ignore[no-untyped-call]
        return found

    return function


def _array(tensor: torch.Tensor) -> np.ndarray:
    array: np.ndarray = tensor.detach().cpu().double().numpy()
    return array


def _tensor(array: np.ndarray, like: torch.Tensor) -> torch.Tensor:
    return torch.from_numpy(array.copy()).to(like)
