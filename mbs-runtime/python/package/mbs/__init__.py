"""Describe a mechanism, get its motion.

>>> import mbs
>>> crank = mbs.compile("slider_crank.mbs")
>>> run = crank.simulate(end=0.6, omega="200 rpm")
>>> run.t, run["x3"]

``compile`` reads a declaration of bodies, joints, constraints and forces, and gives a ``Mechanism`` in milliseconds.
Numbers are in the units of the declaration, and texts such as ``"200 rpm"`` have their own; results equal those of the
command line and of compiled Rust to the last bit.
"""

from mbs import errors
from mbs._native import __version__
from mbs.equilibrium import Equilibrium
from mbs.errors import DeclarationError, DoubtWarning, EndedEarly, Error
from mbs.fit import Estimate, Fit
from mbs.gradients import Gradients
from mbs.linear import Linearization, Mode
from mbs.mechanism import Constraint, Mechanism, Quantity, compile
from mbs.run import Event, Run, Summary
from mbs.simulation import Simulation, Simulations
from mbs.sweep import Sweep
from mbs.synthesis import Linkage, Synthesis

__all__ = [
    "Constraint",
    "DeclarationError",
    "DoubtWarning",
    "EndedEarly",
    "Equilibrium",
    "Error",
    "Estimate",
    "Event",
    "Fit",
    "Gradients",
    "Linearization",
    "Linkage",
    "Mechanism",
    "Mode",
    "Quantity",
    "Run",
    "Simulation",
    "Simulations",
    "Summary",
    "Sweep",
    "Synthesis",
    "__version__",
    "compile",
    "errors",
]
