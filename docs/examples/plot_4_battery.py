"""
Where should the battery go?
============================

Absolem, flippers flat, is to carry 5 kg more up stairs of 45 degrees (ISO 14122-3). Every place of
the load gives another centroid; a sweep judges them all at once.
"""

import matplotlib.pyplot as plt
import numpy as np
import xarray as xr

import kaidan

robot = kaidan.Robot.named("absolem")
bare = robot.stance(kaidan.Posture(front="flat", rear="flat"))
load = 5.0

# places behind the front end of the main track's flat underside, and above it
places = np.linspace(-0.3, 0.8, 111)
heights = np.linspace(0.05, 0.60, 56)
x = xr.DataArray(places, dims="x", coords={"x": places})
z = xr.DataArray(heights, dims="z", coords={"z": heights})

# %%
# The flippers lie in front of that end, so what is measured from it counts from further back on the
# longer underside. Arrays with names of their own keep them through the sweep.

front = (bare.flat_length - robot.track.flat_length) / 2
total = bare.mass + load
table = kaidan.sweep(
    robot,
    "iso-14122-3",
    flippers="flat",
    friction=1.2,
    com_from_front=(bare.mass * bare.com_from_front + load * (x + front)) / total,
    com_height=(bare.mass * bare.com_height + load * z) / total,
    engine="numpy",  # for a few thousand pairs compiling takes longer than computing
)
margin = table.margin_deg.transpose("z", "x")
question = {"flippers": "flat", "friction": 1.2, "model": "closed-form"}  # as a sweep judges
without = kaidan.assess(robot, "iso-14122-3", **question)
print(f"without the load {without.margin_deg:+.1f} deg")
print(f"with it, from {float(margin.min()):+.1f} to {float(margin.max()):+.1f} deg")

figure, axes = plt.subplots(figsize=(7, 4), layout="constrained")
grid = (1e3 * places, 1e3 * heights, margin)
axes.contourf(*grid, [-99, 0], colors="0.92", hatches=["///"])
lines = axes.contour(*grid, np.arange(1, 6), colors="black", linewidths=0.8)
axes.contour(*grid, [0], colors="black", linewidths=2.5)
axes.clabel(lines, fmt="%+g°", fontsize=9)
for text in axes.texts:
    text.set_bbox({"facecolor": "white", "edgecolor": "none", "pad": 1})
axes.set_xlabel("load behind the front end of the main track [mm]")
axes.set_ylabel("load above the underside [mm]")
axes.set_title("smallest margin, less allowances; hatched: no GO", fontsize=10)
plt.show()
