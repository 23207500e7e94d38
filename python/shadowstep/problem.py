"""What moves: H = T(p) + U(q), and the state at t = 0."""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from difflib import get_close_matches
from numbers import Integral
from types import MappingProxyType
from typing import Any, Union

import numpy as np

from . import _shadowstep
from ._shadowstep import Given, problem_names
from .arguments import check, is_list, naming, path_of, refuse_other
from .border import WrongType
from .by_name import in_order, names_of
from .document import document
from .exact import Number, exact
from .gradient_check import warn_of_gradient

Values = Union[Mapping[str, Number], Sequence[Number], np.ndarray]
Forces = Union[int, Callable[[np.ndarray], "tuple[float, np.ndarray]"]]


class Problem:
    """A system H = T(p) + U(q) with its state at t = 0.

    Numbers may be exact texts such as ``"1/3"``; a float is the decimal that Python prints for it. ``shadowstep scene --explain`` describes
    the keys of [problem], [initial] and [time].

    Parameters
    ----------
    system
        A shipped problem, such as ``"kepler"``; or U(q) as a formula in the coordinates and parameters; or the forces: the address of a C
        function, or a Python function (see below). None where ``pair`` or ``parts`` is given.
    q, p
        Positions and momenta at t = 0, each of d numbers. A mapping has names with values: ``q={"x": 1, "y": 0}``, ``p={"px": 0, "py": 2}`` or
        ``p={"x": 0, "y": 2}``, in any order; with ``momenta=["u", "w"]`` those names. Velocities can be given as ``v`` in place of ``p``. A shipped
        problem has its own.
    masses
        Those of the coordinates, d numbers; 1 by default. T = Σ p_i²/(2 m_i). Of pairs also one number for all bodies, or the name of a property.
    kinetic
        T(p) as a formula, in place of masses.
    pair
        The energy of two bodies i and j as a formula in ``r2``, the square of their distance, or in one dimension ``d`` = q_j − q_i, with
        ``dimensions`` and ``bodies``.
    parts
        How H is split: a name such as ``"wisdom-holman"``, or a list of formulas of H = H_1 + … + H_n.
    time
        The section [time] of a scene as a mapping: steps that become short in close encounters.
    **others
        Parameters by their names, with numbers or texts; ``parameters={"q": 2}`` where a name is one of these arguments. Other keys of [problem] are
        taken as they are: KEYS. A key without what it needs, such as ``coupling`` without ``hamiltonian``, is a parameter where a formula has its
        name. ``body`` is a list of mappings with the keys of [[body]], by elements, by ``q`` and ``v``, or by a table of Horizons. Elements are
        heliocentric, about the first body; ``elements="jacobi"`` takes them about the centre of mass of the bodies before, as REBOUND does by default.

    Own forces
    ----------
    A C function ``double f(const double *q, double *gradient)`` returns U(q) and writes the gradient U_q(q); q and the gradient have d numbers.
    Its address comes from numba (``cfunc(…).address``), ctypes or cffi. The function must live as long as the problem. A Python function gets q
    as an array of shape (d,) and returns (U, gradient). Both compute in double precision. The gradient is compared with differences of U at t = 0, by 13 or 14 calls, and
    a warning says where they differ by more than a thousandth of it, or a few hundredths where U has noise.

    Examples
    --------
    >>> Problem("kepler", eccentricity=0.3)
    Problem('kepler', coordinates x, y)
    >>> Problem(pair="d^2/2", dimensions=1, bodies={"m": [1, 2]}, q=[0, 1], v=[0, 0])
    Problem(pair='d^2/2', coordinates q1, q2)
    >>> Problem("-1/sqrt(x^2 + y^2)", q={"x": "2/5", "y": 0}, p=[0, 2]).energy
    -0.5
    >>> Problem("k*x^2/2", q={"x": 1}, p=[0], k=4).energy
    2.0
    >>> bodies = {"m": [1, "1/1000"]}
    >>> Problem(pair="-m_i*m_j/sqrt(r2)", dimensions=2, bodies=bodies, q=[0, 0, 1, 0], v=[0, 0, 0, 1]).dimension
    4
    >>> star, planet = {"name": "star", "mass": 1}, {"name": "planet", "mass": "1/1000", "a": 1, "e": "1/10"}
    >>> Problem(body=[star, planet], parameters={"g": 1}, parts="wisdom-holman").dimension
    6
    >>> import numpy as np
    >>> def spring(q):
    ...     return 0.5 * q @ q, q
    >>> Problem(spring, q=[1.0, 0.0], p=[0.0, 1.0]).energy
    1.0
    """

    _given: Given
    _sections: Mapping[str, Any] | None = None
    _forces: tuple[Any, ...] | None = None

    def __init__(
        self,
        system: Union[str, Forces, None] = None,
        *,
        q: Values | None = None,
        p: Values | None = None,
        v: Values | None = None,
        masses: Number | Sequence[Number] | np.ndarray | None = None,
        kinetic: str | None = None,
        pair: str | None = None,
        parts: Union[str, Sequence[str], None] = None,
        time: Mapping[str, Any] | None = None,
        **others: Any,
    ) -> None:
        check(Problem.__init__, locals())
        self._system = system
        if system is not None and not isinstance(system, str):
            if not callable(system) and not isinstance(system, Integral):
                raise WrongType(f"system must be a name, a formula, a function for the forces or the address of one, not {type(system).__name__}")
            others = {"kinetic": kinetic, "pair": pair, "parts": parts, "time": time, **others}
            self._forces = _of_forces(system, q, p, v, masses, others)
            self._given = Given.of_forces(*self._forces)
            warn_of_gradient(system, self.initial[0])
            return
        sections = _sections(system, q, p, v, {"masses": masses, "kinetic": kinetic, "pair": pair, "parts": parts}, others)
        # what is given may change later
        self._sections = _copied({**sections, "time": time})
        # what is wrong with a name or a formula has the key of a text
        of_bodies = naming("body", "" if others.get("body") is not None else "(?!)")
        with of_bodies, naming("system", r"^ *\d+ \| (name|potential) = "):
            self._given = Given.of_text(document(self._sections), "problem", True)

    @classmethod
    def from_scene(cls, path: Union[str, os.PathLike[str]], *, allow_outside: bool = False) -> Problem:
        """The system of a scene's file, of which [problem], [initial], [[body]] and [time] are used.

        The files that it names lie in its own folder or below, unless ``allow_outside`` is true.

        Raises
        ------
        InputError
            A file that cannot be read, or faults of its text, each with its line and column.
        """
        check(Problem.from_scene, locals())
        problem = cls.__new__(cls)
        problem._system = path_of(path, "path")
        problem._given = Given.of_file(problem._system, allow_outside)
        return problem

    def __getstate__(self) -> dict[str, Any]:
        if isinstance(self._system, Integral):
            raise TypeError("a problem with the address of a C function belongs to its process: make it again in another one")
        return {**self.__dict__, "_given": self._given.source}

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__dict__.update(state)
        self._given = Given.of_text(*state["_given"]) if state["_given"] else Given.of_forces(*state["_forces"])

    def __deepcopy__(self, memo: dict[int, Any]) -> Problem:
        # nothing of it changes, and an address has no copy
        copied = self.__class__.__new__(self.__class__)
        copied.__dict__.update(self.__dict__)
        return copied

    @property
    def name(self) -> str:
        """The name of the shipped problem, the formula, or another description."""
        return self._system if isinstance(self._system, str) else "formula" if self._system is None else "forces"

    @property
    def sections(self) -> Mapping[str, Any]:
        """The sections of a scene that describe it, which cannot be changed: see `replaced`.

        Raises
        ------
        TypeError
            For a problem of a scene's file or with a function for its forces, which has none.
        """
        if self._sections is None:
            raise WrongType("this needs a problem that is given by its keys, not by a scene's file or a function for the forces")
        frozen: Mapping[str, Any] = _frozen(self._sections)
        return frozen

    def replaced(self, numbers: Mapping[str, Number] = {}, *, q: Values | None = None, p: Values | None = None) -> Problem:
        """The same problem with other numbers, or another state at t = 0.

        Numbers have the names of parameters, or of places in lists and bodies: ``"k"``, ``"m[1]"``, ``"masses[0]"``, ``"body[1].mass"``, ``"body.earth.mass"``.

        Raises
        ------
        InputError
            A name that the problem has not.
        TypeError
            A problem of a scene's file or with a function for its forces.

        Examples
        --------
        >>> spring = Problem("k*x^2/2", q={"x": 1}, p=[0], k=4)
        >>> spring.replaced({"k": 2}).energy, spring.replaced(q=[3]).energy
        (1.0, 18.0)
        """
        check(Problem.replaced, locals())
        sections: dict[str, Any] = _copied(self.sections)
        for name, value in numbers.items():
            if not isinstance(name, str):
                raise WrongType(f"numbers must have names, which are texts, not {name!r}")
            with naming("numbers"):
                container, key = self._place(sections, name)
            container[key] = value
        if q is not None or p is not None:
            if sections.get("body"):
                raise _shadowstep.InputError("the state of this problem is in its bodies: replace numbers such as 'body[1].a'")
            now = self.initial
            q = now[0] if q is None else in_order(q, self.coordinates, "q")
            p = now[1] if p is None else in_order(p, names_of(p, self.momenta, self.coordinates), "p")
            sections["initial"] = {"q": q, "p": p}
        problem = self.__class__.__new__(self.__class__)
        problem.__dict__.update(self.__dict__, _sections=sections, _given=Given.of_text(document(sections), "problem", True))
        return problem

    def number(self, name: str) -> Number:
        """The number of this name, as `replaced` has them, as it was given."""
        check(Problem.number, locals())
        with naming("name"):
            container, key = self._place(_copied(self.sections), name)
        number: Number = container[key]
        return number

    def _place(self, sections: dict[str, Any], name: str) -> tuple[Any, Any]:
        """Where a number is: what contains it, and its key or index there."""
        first, *rest = [word for word in re.split(r"[.\[\]]+", str(name)) if word] or [""]
        problem = sections["problem"]
        if first == "masses" and problem.get("potential") is not None and problem.get("masses") is None and problem.get("kinetic") is None:
            # one for each coordinate of its own: t may be a further one
            problem["masses"] = [1] * len(problem["coordinates"])
        given = (problem.get("parameters"), problem.get("bodies"), problem, sections)
        container: Any = next((content for content in given if isinstance(content, dict) and content.get(first) is not None), None)
        if container is None:
            default = dict(self._given.parameters).get(first)
            if default is None:
                raise self._unknown(name)
            container = problem["parameters"] = {**(problem.get("parameters") or {}), first: default}
        key: Any = first
        for word in rest:
            container = container[key]
            if isinstance(container, list) and not word.isdigit():
                word = next((i for i, body in enumerate(container) if isinstance(body, dict) and body.get("name") == word), word)
            key = int(word) if isinstance(container, list) and re.fullmatch("[0-9]{1,9}", str(word)) else word
            known = range(len(container)) if isinstance(container, list) else container if isinstance(container, dict) else ()
            if key not in known:
                raise self._unknown(name)
        if container[key] is None:
            raise self._unknown(name)
        if isinstance(container[key], (dict, list)):
            raise _shadowstep.InputError(f"{name!r} has several numbers; write one of them, such as {name}[0]")
        return container, key

    def _unknown(self, name: str) -> Exception:
        if name in (*self.coordinates, *self.momenta):
            return _shadowstep.InputError(f"{name!r} is of the state at t = 0: give it as q or p")
        known = [*self.coordinates, *self.momenta, *dict(self._given.parameters)]
        near = get_close_matches(name, known, n=1)
        right = f"did you mean {near[0]!r}?" if near else f"there are {', '.join(known)}, and places such as 'masses[0]' and 'body[1].mass'"
        return _shadowstep.InputError(f"{name!r} is not a number of the problem; {right}")

    @property
    def coordinates(self) -> list[str]:
        """The names of q_1, …, q_d."""
        return self._given.names[0]

    @property
    def momenta(self) -> list[str]:
        """The names of p_1, …, p_d."""
        return self._given.names[1]

    @property
    def dimension(self) -> int:
        """d, the number of coordinates."""
        return len(self.coordinates)

    @property
    def initial(self) -> tuple[np.ndarray, np.ndarray]:
        """q and p at t = 0, of shape (d,), in double precision."""
        q, p = self._given.initial
        return np.array(q), np.array(p)

    @property
    def energy(self) -> float:
        """H at t = 0, in double precision."""
        return self._given.energy

    def __repr__(self) -> str:
        names = self.coordinates
        shown = ", ".join(names if len(names) <= 6 else [*names[:3], "…", names[-1]])
        return f"Problem({self._shown()}, coordinates {shown})"

    def _shown(self) -> str:
        """What the system is, as its argument is written."""
        if isinstance(self._system, str):
            return repr(self._system)
        if isinstance(self._system, Integral):
            return "a C function"
        if self._system is not None:
            return getattr(self._system, "__name__", None) or f"forces of type {type(self._system).__name__}"
        problem = (self._sections or {})["problem"]
        shown = (f"{key}={problem[key]!r}" for key in ("pair", "parts", "hamiltonian") if problem.get(key) is not None)
        bodies = self.sections.get("body")
        return ", ".join([*shown, *([f"{len(bodies)} bodies"] if bodies else [])])


def given_of(problem: Any) -> Given:
    """What an argument ``problem`` is: a problem, or the name of a shipped one."""
    return problem_of(problem)._given


def problem_of(problem: Any) -> Problem:
    """The problem of an argument ``problem``."""
    if isinstance(problem, Problem):
        return problem
    if isinstance(problem, str):
        if problem in problem_names():
            return Problem(problem)
        near = get_close_matches(problem, problem_names(), n=1)
        right = f"did you mean {near[0]!r}?" if near else "write shadowstep.Problem(…) for a formula or other problems"
        raise _shadowstep.InputError(f"problem = {problem!r} is not the name of a shipped problem; {right}")
    raise WrongType(f"problem must be a Problem, or the name of a shipped one such as 'kepler', not {type(problem).__name__}")


# the keys of [problem] with what they need; every other keyword is a parameter
_KEYS: dict[str, list[str]] = dict(_shadowstep.problem_keys())
_ARGUMENTS = ("q", "p", "v", "masses", "kinetic", "pair", "parts", "time", "body")
_OTHERS = [key for key in _KEYS if key not in (*_ARGUMENTS, "name", "potential")]
Problem.__doc__ = str(Problem.__doc__).replace("KEYS", ", ".join(f"``{key}``" for key in _OTHERS))


def _is_key(name: str, given: Mapping[str, Any]) -> bool:
    """Whether an argument is a key of [problem], and not a parameter of a formula."""
    has_needed = all(any(given.get(other.strip("[]")) is not None for other in needs.split("|")) for needs in _KEYS.get(name, []) if "." not in needs)
    return name in _OTHERS and (has_needed or not re.search(rf"\b{name}\b", repr([value for other, value in given.items() if other != name])))


def _sections(
    system: str | None, q: Values | None, p: Values | None, v: Values | None, arguments: dict[str, Any], others: Mapping[str, Any]
) -> dict[str, Any]:
    if not isinstance(others.get("parameters", {}), Mapping):
        raise WrongType(f"parameters must be a mapping of names to numbers, not {type(others['parameters']).__name__}")
    way = {} if system is None else {"name" if _is_name(system, q) else "potential": system}
    given = {**way, **arguments, "q": q, "p": p, "v": v, **others}
    keys = [key for key in others if _is_key(key, given)]
    problem: dict[str, Any] = {key: others[key] for key in keys}
    for key in ("coordinates", "momenta"):
        if problem.get(key) is not None:
            refuse_other(problem[key], (Iterable[str],), key)
            problem[key] = list(problem[key])
    parameters = {key: value for key, value in others.items() if key not in (*keys, "body")}
    for key, value in parameters.items():
        if isinstance(value, (Mapping, Sequence, np.ndarray)) and not isinstance(value, str):
            near = get_close_matches(key, (*_ARGUMENTS, *_OTHERS), n=1)
            hint = f"did you mean {near[0]!r}?" if near else "a parameter is a number"
            raise _shadowstep.InputError(f"Problem has no argument {key!r} with several values; {hint}")
    if parameters:
        problem["parameters"] = {**problem.get("parameters", {}), **parameters}
    problem |= {**way, **arguments}
    if ("potential" in problem or "hamiltonian" in problem) and "coordinates" not in problem and q is not None:
        if not isinstance(q, Mapping):
            raise _shadowstep.InputError('q must name the coordinates of the formula: q={"x": 1, "y": 0}')
        problem["coordinates"] = [_name(name, "q") for name in q]
    if any(isinstance(values, Mapping) for values in (q, p, v)):
        q, p, v = _by_name(problem, q, p, v)
    initial = {"q": q, "p": p, "v": v}
    return {"problem": problem, "body": others.get("body"), "initial": {key: value for key, value in initial.items() if value is not None}}


def _by_name(problem: dict[str, Any], q: Any, p: Any, v: Any) -> tuple[Any, Any, Any]:
    """Positions, momenta and velocities in the order of the coordinates."""
    coordinates, momenta = problem.get("coordinates"), problem.get("momenta")
    if "name" in problem:
        shipped = Given.of_text(document({"problem": {key: problem[key] for key in ("name", "parameters") if key in problem}}), "problem", True)
        coordinates, momenta = shipped.names
    if coordinates is None:
        raise _shadowstep.InputError("q, p and v have no names of coordinates here; write them as lists")
    return (
        in_order(q, coordinates, "q"),
        in_order(p, names_of(p, momenta or [f"p{name}" for name in coordinates], coordinates), "p"),
        in_order(v, names_of(v, coordinates, [f"v{name}" for name in coordinates]), "v"),
    )


def _name(name: Any, of: str) -> str:
    if not isinstance(name, str):
        raise WrongType(f"{of} must have names of coordinates, which are texts, not {name!r}")
    return name


def _is_name(system: str, q: Values | None) -> bool:
    # a formula needs q; without it a word is meant as a name, which may be misspelt
    return system in problem_names() or (q is None and re.fullmatch("[a-z][a-z0-9-]*", system) is not None)


def _copied(content: Any) -> Any:
    """A copy of what sections have, whose arrays are lists."""
    if isinstance(content, Mapping):
        return {key: _copied(value) for key, value in content.items()}
    if hasattr(content, "tolist"):  # NumPy
        content = content.tolist()
    return [_copied(value) for value in content] if isinstance(content, (list, tuple)) else content


def _frozen(content: Any) -> Any:
    """The same content of sections, which cannot be changed."""
    if isinstance(content, dict):
        return MappingProxyType({key: _frozen(value) for key, value in content.items()})
    return tuple(_frozen(value) for value in content) if isinstance(content, list) else content


# No function is in the first page of the memory.
_LEAST_ADDRESS = 4096


def _of_forces(forces: Forces, q: Values | None, p: Values | None, v: Values | None, masses: Any, others: Mapping[str, Any]) -> tuple[Any, ...]:
    given = [name for name, value in others.items() if value is not None]
    if given:
        raise WrongType(f"`{given[0]}` goes with a formula or a shipped problem, not with a function for the forces")
    if q is None or p is None:
        raise WrongType("a function for the forces needs q and p, the state at t = 0" + ("; give p = m v in place of v" if v is not None else ""))
    if any(isinstance(values, Mapping) for values in (q, p)):
        raise WrongType("q and p of a function for the forces are lists, in the order in which the function has the coordinates")
    if isinstance(forces, Integral) and not _LEAST_ADDRESS <= int(forces) < 2**64:
        raise WrongType(f"system = {forces} is not the address of a function")
    texts = {name: _texts(values, name) for name, values in (("q", q), ("p", p), ("masses", masses)) if values is not None}
    for name, what in (("p", "momenta"), ("masses", "masses")):
        if len(texts.get(name, texts["q"])) != len(texts["q"]):
            raise _shadowstep.InputError(f"{name}: there are {len(texts['q'])} coordinates and {len(texts[name])} {what}: give one for each coordinate")
    return forces, texts["q"], texts["p"], texts.get("masses")


def _texts(values: Values, name: str) -> list[str]:
    if not is_list(values):
        raise WrongType(f"{name} must be numbers, such as [1, 0], not {values!r}")
    return [exact(value, name) for value in values]
