"""
A first verdict
===============

One robot, one flight of stairs, one answer. Absolem lays its flippers flat and climbs the steepest
flight that the International Building Code allows, on dry concrete.
"""

import matplotlib.pyplot as plt

import kaidan

answer = kaidan.assess("absolem", "ibc", flippers="flat", surface="concrete-dry")
print(answer.verdict.upper())
print(answer.reason)

# %%
# Every failure mode has a margin: by how many degrees the stairs could be steeper (or gentler)
# before it happens, on the worst reading of what is only known as a range. The smallest one
# decides. The first riser asks for a friction of 0.91, and that of dry concrete is published as 0.6
# to 1.0: at 0.6 the robot slides, at 1.0 it does not, so the answer is neither GO nor NO-GO.

margins = {mode: value for mode, value in answer.margins_deg.items() if value is not None}
figure, axes = plt.subplots(figsize=(7, 2.6), layout="constrained")
names = [name.replace("_", " ") for name in margins]
bars = axes.barh(names, margins.values(), color="0.75", edgecolor="black")
axes.bar_label(bars, fmt="%+.1f°", padding=4)
for bar, value in zip(bars, margins.values(), strict=True):
    bar.set_hatch("" if value > 0 else "////")
axes.axvline(0, color="black")
axes.margins(x=0.15)
axes.invert_yaxis()
axes.set_xlabel("margin on the worst reading [°]; hatched: beyond the limit")
plt.show()

# %%
# What would help is worked out by asking the same question again with something changed:

for change in answer.what_would_help:
    print(f"{change.change}: {change.verdict}")
