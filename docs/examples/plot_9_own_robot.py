"""
A robot of your own
===================

A data sheet is a TOML file. ``kaidan new robot mine.toml`` writes a commented one to fill in; what
matters most is below. Lengths are in metres, masses in kilograms.
"""

from pathlib import Path
from tempfile import TemporaryDirectory

import matplotlib.pyplot as plt

import kaidan

SHEET = """
name = "mine"
mass = 40.0
com_from_front = 0.37    # from the front end of the flat underside back to the centroid
com_height = 0.12        # from the underside of the track up to the centroid

[track]
flat_length = 0.85
front_radius = 0.10
rear_radius = 0.10

[uncertainty]
com_from_front = 0.005   # one standard deviation, from weighing

[sources]
mass = "V: weighed, bathroom scales"
com_from_front = "V: two scales, front and rear axle"
com_height = "V: tilted until it balanced"
"""

with TemporaryDirectory() as folder:
    file = Path(folder, "mine.toml")
    file.write_text(SHEET)
    mine = kaidan.Robot.named(str(file))

answer = kaidan.assess(mine, kaidan.Stairs(rise=0.17, going=0.29), friction=1.2)
print(f"{answer.verdict}: {answer.reason}")

# %%
# Mind on which nosing spacings such a track can get a GO: up to half its flat length.

print(
    f"up to {1e3 * mine.track.flat_length / 2:.0f} mm; these stairs have "
    f"{1e3 * answer.nosing_spacing_m:.0f} mm"
)

# %%
# A slip of the unit is caught where the number is given, not in a verdict later:

try:
    kaidan.Robot.from_text(SHEET.replace("0.85", "850"), origin="mine.toml")
except kaidan.InputError as error:
    print(error)

# %%
# What a payload does to the centroid, and to the answer:

loads = [0, 4, 8, 12, 16, 20, 24]
answers = [
    kaidan.assess(
        mine,
        kaidan.Stairs(rise=0.17, going=0.29),
        friction=1.2,
        payload=kaidan.Payload(mass=load, from_front=0.60, height=0.50),
    )
    for load in loads
]
figure, axes = plt.subplots(figsize=(7, 3), layout="constrained")
axes.plot(loads, [answer.margin_deg for answer in answers], "o-", color="black")
axes.axhline(0, color="black", linewidth=0.8)
axes.set_xlabel("payload 600 mm behind the front end and 500 mm high [kg]")
axes.set_ylabel("margin at a risk of 1 % [°]")
plt.show()
