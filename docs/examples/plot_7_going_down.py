"""
Going down: nose first or in reverse?
=====================================

On the way down the robot may lead with its nose or its tail. What counts is which end points up the
stairs: with the centroid in the front half, the nose should.
"""

import matplotlib.pyplot as plt
import numpy as np

import kaidan

spacings = np.linspace(0.10, 0.235, 100)
table = {
    facing: kaidan.sweep(
        "kenaf",
        direction="down",
        facing=facing,
        angle=0.5,  # plays no part in the limit itself
        nosing_spacing=spacings,
        engine="numpy",  # for a hundred pairs compiling takes longer than computing
    ).margin_angle_deg
    for facing in ("tail-first", "nose-first")
}

figure, axes = plt.subplots(figsize=(7, 3.8), layout="constrained")
styles = {"tail-first": "-", "nose-first": "--"}
for facing, limit in table.items():
    axes.plot(1e3 * spacings, limit, styles[facing], color="black", label=f"down {facing}")
axes.axhline(0, color="black", linewidth=0.8)
axes.set_xlabel("nosing spacing [mm]")
axes.set_ylabel("steepest slope, no allowances [°]")
axes.legend(frameon=False)
plt.show()

# %%
# A negative limit means that not even level nosings hold the robot. At 150 mm:

for facing, limit in table.items():
    at_150 = float(limit.interp(nosing_spacing=0.150))
    print(f"{facing}: {at_150:.1f} deg")

# %%
# Absolem, flippers flat, on a code's steepest flight: its centroid lies a little behind the middle,
# so nose first, with the centroid further uphill, is the better way down. The closed form also says
# how hard it may brake.

for facing in ("tail-first", "nose-first"):
    answer = kaidan.assess(
        "absolem",
        "ibc",
        direction="down",
        facing=facing,
        flippers="flat",
        friction=1.2,
        model="closed-form",
    )
    print(
        f"{facing}: {answer.verdict}, {answer.margin_deg:+.1f} deg; "
        f"max. braking {answer.closed_form.max_braking:.2f} m/s2"
    )
