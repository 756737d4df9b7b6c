"""
How well must I know the centroid?
==================================

Kenaf at 50 degrees and 150 mm has 5 degrees to spare with the default allowances. How much of that
is left when the centroid is only known to so many millimetres?
"""

from math import degrees, radians

import matplotlib.pyplot as plt
import numpy as np

import kaidan
from kaidan.mechanics.margin import margin_per_centroid_length

kenaf = kaidan.Robot.named("kenaf")
stairs = kaidan.Stairs.inclined(angle=radians(50), nosing_spacing=0.150)


def judged(sigma: float) -> kaidan.Assessment:
    """Answer when the centroid along the track has a standard uncertainty [m]."""
    doubt = kenaf.uncertainty.model_copy(update={"com_from_front": sigma})
    return kaidan.assess(kenaf.model_copy(update={"uncertainty": doubt}), stairs, friction=2.0)


# %%
# The closed form says what a millimetre costs. This is the slope of the line below, times the
# number of standard deviations that the accepted risk of 1 % asks for.

rate = margin_per_centroid_length(
    L=kenaf.track.flat_length, p=0.150, C_L=kenaf.com_from_front, C_N=kenaf.com_height
)
print(f"{degrees(rate) / 1e3:+.2f} deg per mm")

sigmas = np.linspace(0, 0.014, 15)
answers = [judged(sigma) for sigma in sigmas]
margins = [answer.margin_deg for answer in answers]
goes = [answer.verdict == "go" for answer in answers]
last = max(1e3 * sigma for sigma, go in zip(sigmas, goes, strict=True) if go)
print(f"GO up to a standard uncertainty of {last:.0f} mm")

figure, axes = plt.subplots(figsize=(7, 3.5), layout="constrained")
axes.plot(1e3 * sigmas, margins, color="black")
fill = {"go": "black", "rough": "grey", "no-go": "white"}
for answer, sigma, margin in zip(answers, sigmas, margins, strict=True):
    axes.plot(1e3 * sigma, margin, "o", color="black", markerfacecolor=fill[answer.verdict])
axes.axhline(0, color="black", linewidth=0.8)
axes.set_xlabel("standard uncertainty of the centroid along the track [mm]")
axes.set_ylabel("margin at a risk of 1 % [°]")
axes.set_title("filled: GO; grey: ROUGH; open: NO-GO", fontsize=10)
plt.show()

# %%
# A grey circle is ROUGH and not NO-GO: more than 1 % of the robots rock, and no more than 1 % keep
# less than the reserve to a fall. With a stated uncertainty every failure mode has a probability, too.

answer = judged(0.012)
print(
    f"tipping downhill: probability {answer.findings['tip_downhill'].probability:.3f}, worst case"
)
low, high = answer.margin_interval_deg
print(f"95 % of the margins lie within {low:+.1f} and {high:+.1f} deg")
