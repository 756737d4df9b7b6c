"""
Where should the battery go?
============================

Absolem, flippers flat, is to carry 5 kg more up stairs of 45 degrees (ISO 14122-3). Every place of
the load gives another centroid: a design study maps them and finds the best one.
"""

import matplotlib.pyplot as plt
import numpy as np

import kaidan

found = kaidan.design(
    "absolem",
    "iso-14122-3",
    flippers="flat",
    friction=1.2,
    payload="5kg@200mm,300mm",
    free={"payload.from_front": "-300mm..800mm", "payload.height": "50mm..600mm"},
    model="closed-form",  # without it the contact model judges, which takes longer
    tries=200,
)
print(found)

# %%
# One command draws it (``kaidan design ... --figure battery.png``); here is a picture of one's own
# from the numbers of the map.

places, heights = (1e3 * np.array(each) for each in (found.map.x_values, found.map.y_values))
margin = np.array(found.map.margins_deg)
best = [1e3 * each.best for each in found.free]

figure, axes = plt.subplots(figsize=(7, 4), layout="constrained")
grid = (places, heights, margin)
axes.contourf(*grid, [-99, 0], colors="0.92", hatches=["///"])
lines = axes.contour(*grid, np.arange(1, 6), colors="black", linewidths=0.8)
axes.contour(*grid, [0], colors="black", linewidths=2.5)
axes.clabel(lines, fmt="%+g°", fontsize=9)
for text in axes.texts:
    text.set_bbox({"facecolor": "white", "edgecolor": "none", "pad": 1})
axes.plot(*best, "*", color="black", markersize=12)
axes.set_xlabel("load behind the front end of the main track [mm]")
axes.set_ylabel("load above the underside [mm]")
axes.set_title(
    "smallest margin, less allowances; hatched: no GO; star: the best place", fontsize=10
)
plt.show()
