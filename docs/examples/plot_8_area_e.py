"""
Through area E
==============

Beyond the margin at constant speed there is a little room left: brake where the lowest nosing has
just left, speed up before the next one leaves. The paper calls this area semi-unstable. It takes a
drive whose acceleration can follow the position on the stairs; Kenaf's could not, so the drive here
is invented. The areas are the closed form's; the contact model knows no plan.
"""

from math import radians

import kaidan
from kaidan.figures.d_a_figure import d_a_figure

kenaf = kaidan.Robot.named("kenaf")
drive = kenaf.drive.model_copy(update={"acceleration_control": True, "max_speed": 1.0})
agile = kenaf.model_copy(update={"name": "kenaf, agile drive", "drive": drive})
stairs = kaidan.Stairs.inclined(angle=radians(61), nosing_spacing=0.150, steps=6)
question = {"friction": 3.0, "theta_d": 0.0, "theta_M": 0.0}

for robot in (kenaf, agile):
    answer = kaidan.assess(robot, stairs, model="closed-form", **question)
    print(f"{robot.name}: {answer.verdict}. {answer.reason}")

# %%
# The slope is beyond the margin of 60.2 degrees, so at constant speed the robot falls. A plan
# exists if the kinetic energy can be kept between zero and what the largest speed allows, all the
# way up.

plane = kaidan.plane(agile, stairs, accelerate=True, **question)
print(plane.plan.reason)
figure = d_a_figure(plane)

# %%
# How steep could it get with any drive and any friction? Over one nosing spacing the limit must
# leave room for a mean acceleration of zero:

print(f"{plane.plan.semi_stable_angle_deg:.1f} deg")
