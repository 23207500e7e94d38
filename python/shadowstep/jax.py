"""Runs as functions of JAX, with derivatives backwards by steps back."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np

from .flow import Flow


def flow(*args: Any, **options: Any) -> Callable[..., tuple[jax.Array, jax.Array]]:
    """A function of JAX: from q and p at t = 0, of shape (d,), and the values of the numbers in ``by`` to q and p of the states, of shape (rows, d).

    It takes the arguments of `shadowstep.Flow`. The steps are made by Shadowstep in double precision, outside of compiled code; backwards
    they are made back, so that memory does not grow with their number. With ``jax_enable_x64`` off, results are rounded to single precision.

    Examples
    --------
    >>> import jax, jax.numpy as jnp, shadowstep.jax
    >>> jax.config.update("jax_enable_x64", True)
    >>> spring = shadowstep.Problem("k*x^2/2", q={"x": 1}, p=[0], k=4)
    >>> states = shadowstep.jax.flow(spring, "yoshida4", h="1/100", until=1, every=100, by=["k"])
    >>> def end(k):
    ...     q, p = states(jnp.array([1.0]), jnp.array([0.0]), k)
    ...     return q[-1, 0]
    >>> round(float(jax.grad(end)(jnp.array([4.0]))[0]), 6)  # of cos √k
    -0.227324
    """
    made = Flow(*args, **options)

    def shapes(q: jax.Array) -> tuple[jax.ShapeDtypeStruct, jax.ShapeDtypeStruct]:
        states = jax.ShapeDtypeStruct((made.rows, made.dimension), q.dtype)
        return states, states

    def rounded(arrays: tuple[np.ndarray, ...], dtype: Any) -> tuple[np.ndarray, ...]:
        return tuple(array.astype(dtype) for array in arrays)

    @jax.custom_vjp
    def differentiable(q: jax.Array, p: jax.Array, numbers: jax.Array) -> tuple[jax.Array, jax.Array]:
        def states(*given: Any) -> tuple[np.ndarray, ...]:
            return rounded(made.states(*given), q.dtype)

        found: tuple[jax.Array, jax.Array] = jax.pure_callback(states, shapes(q), q, p, numbers, vmap_method="sequential")
        return found

    def forward(q: jax.Array, p: jax.Array, numbers: jax.Array) -> tuple[Any, Any]:
        return differentiable(q, p, numbers), (q, p, numbers)

    def backward(given: Any, covectors: Any) -> Any:
        def pull_back(*arrays: Any) -> tuple[np.ndarray, ...]:
            return rounded(made.pull_back(*arrays), given[0].dtype)

        like = tuple(jax.ShapeDtypeStruct(array.shape, given[0].dtype) for array in given)
        return jax.pure_callback(pull_back, like, *given, *covectors, vmap_method="sequential")

    differentiable.defvjp(forward, backward)

    def function(q: Any, p: Any, numbers: Any = ()) -> tuple[jax.Array, jax.Array]:
        q, p = jnp.asarray(q, dtype=float), jnp.asarray(p, dtype=float)
        found: tuple[jax.Array, jax.Array] = differentiable(q, p, jnp.asarray(numbers, dtype=float))
        return found

    return function
