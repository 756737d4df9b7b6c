"""Questions to the closed form: Kenaf, and a robot of round figures.

Tags of the tests that use them: (paper) printed in Endo & Nagatani 2016; (hand) from a calculation
beside it, with `math` only; (limit) a limiting case; (oracle) an independent method. Angles agree
to 1e-9 deg and accelerations to 1e-9 m/s^2 unless said: a dozen operations in double precision.
"""

from functools import partial
from math import radians

import one_posture
from kaidan import Robot, Stairs
from kaidan.robot import Uncertainty

assess = partial(one_posture.assess, model="closed-form")
G = 9.80665
KENAF = Robot.named("kenaf").model_copy(update={"theta_d": None, "theta_M": None})
"""Kenaf (paper) without the allowances that were measured on it."""
L, C_L, C_N = 0.470, 0.196, 0.071
"""Kenaf (paper), Table 1."""
GRIP = 3.0
"""Friction that never decides below 71 degrees."""
BARE = {"theta_d": 0.0, "theta_M": 0.0}
ANGLE = {"rel": 0, "abs": 1e-9}


def flight(angle, p, **more):
    return Stairs.inclined(angle=radians(angle), nosing_spacing=p, **more)


def kenaf(angle, p, **question):
    return assess(KENAF, flight(angle, p), **({"friction": GRIP} | question))


def robot(**changes):
    """A robot of round figures: 10 kg, L 0.5 m, centroid in its middle, 0.1 m high."""
    sheet = {
        "name": "round",
        "mass": 10.0,
        "com_from_front": 0.25,
        "com_height": 0.1,
        "track": {"flat_length": 0.5},
    }
    return Robot.model_validate(sheet | changes)


def doubtful(**sigma):
    """Kenaf with standard uncertainties."""
    return KENAF.model_copy(update={"uncertainty": Uncertainty(**sigma)})


SPREAD = {"com_from_front": 0.004, "com_height": 0.003, "flat_length": 0.002}
"""Standard uncertainties of a robot measured by hand [m]."""
