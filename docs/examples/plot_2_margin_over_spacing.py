"""
The margin over the nosing spacing
==================================

How steep may stairs be for Kenaf, and how gentle? This is the line of the paper's Fig. 11 with what
follows from it: the lower limit, and the end of the model at half the length of the track.
"""

import matplotlib.pyplot as plt
import numpy as np

import kaidan
from kaidan.mechanics.margin import theta_s_inf, theta_s_sup

kenaf = kaidan.Robot.named("kenaf")
L, C_L, C_N = kenaf.track.flat_length, kenaf.com_from_front, kenaf.com_height
p = np.linspace(0.10, L / 2, 200)
upper = np.degrees(theta_s_sup(L=L, p=p, C_L=C_L, C_N=C_N))
lower = np.degrees(theta_s_inf(p=p, C_L=C_L, C_N=C_N))

# %%
# The functions of `kaidan.mechanics` take numbers or arrays alike. The allowances of Eq. (24) come
# off the line: with the theta_d = 2.6 deg and theta_M = 1.2 to 2.6 deg that the paper measured at
# 150 mm, what is left meets the slopes at which the robot really fell there.

at_150 = float(np.degrees(theta_s_sup(L=L, p=0.150, C_L=C_L, C_N=C_N)))
low, high = at_150 - 2.6 - 2.6, at_150 - 2.6 - 1.2
print(f"predicted {at_150:.1f}, corrected {low:.1f} to {high:.1f}, fell at 55.0 to 57.0 deg")

figure, axes = plt.subplots(figsize=(7, 4.5), layout="constrained")
axes.fill_between(1e3 * p, upper, 80, facecolor="0.9", hatch="///", edgecolor="0.7", linewidth=0)
axes.fill_between(1e3 * p, 0, lower.clip(0), facecolor="0.9", hatch="\\\\\\", edgecolor="0.7")
axes.axvspan(1e3 * L / 2, 260, facecolor="0.8")
axes.plot(1e3 * p, upper, color="black")
axes.plot(1e3 * p, lower.clip(0), color="black", linestyle="--")
axes.plot([150, 150], [55, 57], color="black", linewidth=5, solid_capstyle="butt")
axes.plot(200, 44, "o", color="black", markerfacecolor="white")
style = {"backgroundcolor": "white", "fontsize": 9}
axes.text(182, 68, "tips over its tail", **style)
axes.text(221, 6, "nose\ndrops", ha="center", **style)
axes.text(120, 30, "holds", **style)
axes.text(238, 40, "outside\nthe model", fontsize=9)
axes.annotate("the experiment fell here", (151, 56), (108, 47), arrowprops={"arrowstyle": "-"})
axes.annotate("did not fall, but rotated", (199, 43.5), (142, 38), arrowprops={"arrowstyle": "-"})
axes.set(xlim=(100, 260), ylim=(0, 80))
axes.set_xlabel("nosing spacing p [mm]")
axes.set_ylabel("slope of the stairs [°]")
plt.show()
