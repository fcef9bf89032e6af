"""How can this mechanism move, and why? A mobility analyzer for spatial mechanisms with closed loops.

>>> import kutzbach
>>> hinge = kutzbach.Builder("hinge").joint("turn", "revolute", "ground", "door", axis=(0, 0, 1)).build()
>>> kutzbach.analyse(hinge).verdict
'mobile'
"""

from ._answers import (
    Analysis,
    Branch,
    Configurations,
    Depth,
    Idle,
    Proof,
    Simulation,
    analyse,
    assemble,
    exact,
    explain,
    simulate,
)
from ._ask import Exact, Value
from ._errors import Interrupted, MechanismError
from ._kutzbach import __version__
from ._mechanism import Joint, Mechanism, Side, load
from ._motion import Trace, trace
from .build import Builder
from .mujoco import from_mujoco
from .pinocchio import from_pinocchio
from .sweeps import Sweep, sweep
from .usd import from_usd

__all__ = [
    "Analysis",
    "Branch",
    "Builder",
    "Configurations",
    "Depth",
    "Exact",
    "Idle",
    "Interrupted",
    "Joint",
    "Mechanism",
    "MechanismError",
    "Proof",
    "Side",
    "Simulation",
    "Sweep",
    "Trace",
    "Value",
    "__version__",
    "analyse",
    "assemble",
    "exact",
    "explain",
    "from_mujoco",
    "from_pinocchio",
    "from_usd",
    "load",
    "simulate",
    "sweep",
    "trace",
]
