"""Bands, causes and what no trial says, in sentences."""


def one_criterion() -> str:
    """Why the static criterion is the same on poses as in closed form."""
    return "one criterion, once as a formula and once on poses: 1e-6 rad"


def other_limits(radius: float) -> str:
    """Why a rotation may be arrested beyond the static criterion [m]."""
    return (
        "other limits: where rotation begins, and where nothing arrests it any more; the end of "
        f"{1e3 * radius:.0f} mm keeps resting on the nosing it leaves, and the tail may land on "
        "the step below"
    )


def falling_takes_time(excess: float, speed: float, room: float) -> str:
    """Why a trial climbs steeper flights than the contact model [deg, m/s, deg]."""
    return (
        f"falling takes time while the robot drives on: up to {excess:.1f} deg at {speed:g} m/s, "
        f"and {room:.1f} deg for both searches"
    )


def rotates_late() -> str:
    """Why a trial rotates less or more than the contact model."""
    return "a trial may drive on before the rotation is complete, or overshoot it by half"


def search_and_rotation(slip: float) -> str:
    """Why the friction that a trial requires is not that of the slope [deg]."""
    return f"{slip:g} deg for the trial's search, and the extra inclination"


def one_plane() -> str:
    """Why the contact model needs the friction of the slope."""
    return "all nosings press on one plane"


def other_planes() -> str:
    """Why it may need any other."""
    return "while it is inclined, contacts on the round end press on other planes: no bound"


def outside(why: str) -> str:
    """Why the closed form and its criterion on poses give no answer."""
    return f"outside the closed form: {why}" if why else "no nosing is lost on the path"


def never_arrives() -> str:
    """Why the contact model has no steepest flight."""
    return "the contact model does not arrive on the gentlest flight of this spacing"


def contact_model(message: str) -> str:
    """Why the contact model gives no answer."""
    return f"contact model: {message}"


NO_TRIAL = {
    "extra": "the trial falls, so its inclination has no largest value",
    "friction": "the trial falls before it slides, or slides with any friction",
    "flight": "trials climb every flight of this spacing that stairs can have, or none",
}
"""Why a trial gives no answer that could be compared."""


OF_THE_FLIGHT = "the trial enters and lands, the contact model's figure is of the flight"


def too_slippery(friction: float) -> str:
    """Likely cause of a difference: the trial slides [1]."""
    return f"friction of {friction:g} is too low: the trial slides"


def too_fast(speed: float) -> str:
    """Likely cause: beyond the speeds of the data [m/s]."""
    return (
        f"at {speed:g} m/s the robot drives on faster than it can fall, further than the excess "
        "over the contact model was ever measured"
    )


def momentum(rotation_deg: float) -> str:
    """Likely cause: the contact model knows no momentum."""
    return f"momentum: a rotation of {rotation_deg:.1f} deg is arrested only if it is slow"


CAUSES = {
    "acceleration": "with an acceleration the trial's speed changes on the path; the contact model "
    "has no speed",
    "landing": "entering or landing: there a rigid belt hits rigid risers, which the quasi-static "
    "model leaves out",
    "flippers": "the flippers: their discs touch elsewhere than the flat, and stand still in the "
    "trial as in the contact model",
    "uneven": "the steps differ from each other; a trial passes two of them only",
    "limit": "the slope is within 2 deg of the limit, where rotations grow without bound",
    "radii": "the ends have two radii, so that another arc than the formula's flat decides",
    "unknown": "no known cause; please report it",
}
"""Likely causes of differences that are not within their bands."""
