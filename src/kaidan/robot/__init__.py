"""The robot's data sheet: tracks, centroid, flippers, drive, and how well each is known.

::

                                   C  centroid
        rear                       |  com_height                    front
        .-----------------------------------------------------------.
       (   rear_radius             |             front_radius        )
        '--o-----------------------+--------------------------------o
           |<------------------ flat_length ----------------------->|
                                   |<------- com_from_front ------->|
"""

from kaidan.robot.drive import Drive
from kaidan.robot.flippers import FlipperPair, Posture, PostureChange
from kaidan.robot.masses import CentroidRange, Payload, State, Uncertainty
from kaidan.robot.robot import FALL_RESERVE, TOLERATED_IMPACT, Robot, Stance
from kaidan.robot.track import Track, Wheel

__all__ = [
    "FALL_RESERVE",
    "TOLERATED_IMPACT",
    "CentroidRange",
    "Drive",
    "FlipperPair",
    "Payload",
    "Posture",
    "PostureChange",
    "Robot",
    "Stance",
    "State",
    "Track",
    "Uncertainty",
    "Wheel",
]
