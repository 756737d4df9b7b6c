"""Both tracks on a measured flight, in words."""

import math

NO_GAUGE = (
    "The nosings differ from left to right, or the robot has a yaw on steps that differ, and the "
    "tracks' distance (track.gauge) is not known: roll is not judged."
)
TOO_SHORT = (
    "The nosings differ from left to right, and nowhere do both tracks have two of them under a "
    "robot that is on the flight alone: roll is not judged."
)


def rolls(roll: float) -> str:
    """How far it rolls on the flight [rad]."""
    return (
        f"With both tracks on the measured nosings it rolls by up to {math.degrees(roll):.1f} deg; "
        "entering and landing are judged in the plane."
    )
