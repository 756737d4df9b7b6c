"""
The d-a plane
=============

The paper's Fig. 7 for any robot and stairs: which acceleration is safe at which place between two
nosings. Here Kenaf at 200 mm and 44 degrees, where the experiment saw the body rotate without a fall. The friction
of 2.0 is our choice; the paper prints none.
"""

from math import radians

import kaidan
from kaidan.figures.d_a_figure import d_a_figure

stairs = kaidan.Stairs.inclined(angle=radians(44), nosing_spacing=0.200)
plane = kaidan.plane("kenaf", stairs, friction=2.0, theta_d=0.0, theta_M=0.0)
print(f"stable from {plane.a_min:+.2f} to {plane.a_max:+.2f} m/s2 throughout")

figure = d_a_figure(plane)

# %%
# Just after the lowest nosing has left (state C) the upper limit is lowest; it then rises until the
# next one leaves. Area E lies between that lowest value and the limit itself: an acceleration there
# is safe at some places and not at others.
#
# With the default allowances (dotted) the limit just after state C is below zero: in the worst case
# constant speed is no longer safe.

plane = kaidan.plane("kenaf", stairs, friction=2.0)
with_allowances = d_a_figure(plane)
print(f"{min(plane.curves.a_r0_safe):+.2f} m/s2")
print(kaidan.assess("kenaf", stairs, friction=2.0, model="closed-form").reason)
