"""
Robots against stairs
=====================

All robots of the catalogue on all stairs of the catalogue, flippers flat where there are some.
Without ``flippers="flat"`` a plan is found for each pair. The friction of 1.2 is an assumption, made
so that tipping decides and not slipping; dry concrete has 0.6 to 1.0.
"""

import kaidan
from kaidan.figures.comparison_figure import comparison_figure

table = kaidan.compare(friction=1.2, flippers="flat")
figure = comparison_figure(table)

# %%
# The contact model drives every robot from landing to landing. A margin of −90° means that it does
# not arrive: it falls over or gets stuck. Where the margin of slope is positive and there is no GO
# all the same, something else decides, which is named below the table.
#
# The same table as rows, for a spreadsheet or pandas:

columns = table.columns()
for row in list(zip(columns["robot"], columns["stairs"], columns["verdict"], strict=True))[:3]:
    print(*row)
