"""
A first verdict
===============

One robot, one flight of stairs, one answer. Absolem climbs the steepest flight that the
International Building Code allows, on dry concrete; how its flippers lie is found.
"""

import kaidan
from kaidan.figures.findings_figure import findings_figure

answer = kaidan.assess("absolem", "ibc", surface="concrete-dry")
print(answer.verdict.upper())
print(answer.reason)

# %%
# Every failure mode has a margin: of slope in degrees (by how much the stairs could be steeper or
# gentler before it happens), of a fall in millimetres, of an impact in metres a second. A bar goes
# from the worst to the best case of every range; the smallest margin decides. The
# slope requires a friction of 0.64, and that of dry concrete is published as 0.6 to 1.0: at 0.6 the
# robot slides, at 1.0 it does not, so the answer is neither GO nor NO-GO. The plan says which end
# leads and how the flippers lie in each phase:

for step in answer.plan.steps:
    print(step.phase, step.flippers)

# %%

figure = findings_figure(answer)

# %%
# What would help is worked out by changing one thing of the question and judging again:

for change in answer.what_would_help:
    print(f"{change.change}: {change.verdict}")
