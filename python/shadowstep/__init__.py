"""Splitting schemes with proved orders, and the modified ("shadow") energy of the trajectories they make.

>>> import shadowstep
>>> kepler = shadowstep.Problem("kepler", eccentricity="3/5")
>>> orbit = shadowstep.integrate(kepler, "yoshida4", h="1/40", until=100, every=10, estimator="bilinear", order=8)
>>> orbit.q.shape
(401, 2)
>>> bool(abs(orbit.energy - orbit.energy[0]).max() > 1e-5)  # the energy oscillates
True
>>> bool(abs(orbit.modified_energy[-1] - orbit.modified_energy[0]) < 1e-6)  # the scheme follows a modified one
True
"""

from .border import InternalError, WrongType  # isort: skip, before all that takes functions from the compiled module
from ._shadowstep import InputError, RunError, __version__
from .chaos import Chaos, Indicator, Indicators, chaos, lyapunov, megno
from .command import command, sweep
from .derivatives import Derivatives, Gradient, derivatives, gradient
from .drift import drift
from .ensemble import Ensemble, ensemble
from .files import open
from .flow import Flow
from .integration import Trajectory, integrate
from .modified_hamiltonian import ModifiedHamiltonian, modified_hamiltonian
from .monitor import Monitor, Report, Sample
from .problem import Problem
from .recorded import Diagnosis, Observer, ShadowEnergy, diagnose, shadow_energy
from .scene import Outcome, run, scene
from .scheme import Proposal, Scheme, schemes
from .search import search
from .work_precision import Advice, Choice, Curve, Measurement, advise, work_precision

__all__ = [
    "Advice",
    "Chaos",
    "Choice",
    "Curve",
    "Derivatives",
    "Diagnosis",
    "Ensemble",
    "Flow",
    "Gradient",
    "Indicator",
    "Indicators",
    "InputError",
    "InternalError",
    "ModifiedHamiltonian",
    "Monitor",
    "Observer",
    "Outcome",
    "Problem",
    "Proposal",
    "Report",
    "Measurement",
    "RunError",
    "Sample",
    "Scheme",
    "ShadowEnergy",
    "Trajectory",
    "WrongType",
    "__version__",
    "advise",
    "chaos",
    "command",
    "derivatives",
    "diagnose",
    "drift",
    "ensemble",
    "gradient",
    "integrate",
    "lyapunov",
    "megno",
    "modified_hamiltonian",
    "open",
    "run",
    "scene",
    "schemes",
    "search",
    "shadow_energy",
    "sweep",
    "work_precision",
]
