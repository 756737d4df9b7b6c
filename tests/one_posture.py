"""Questions in one posture, stowed and nose first unless stated, for tests that mean just that."""

import kaidan
from kaidan import Question


def assess(robot, stairs=None, **manner):
    return kaidan.assess(Question.in_one_posture(robot, stairs, **manner))
