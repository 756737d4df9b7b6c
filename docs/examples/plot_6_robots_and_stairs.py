"""
Robots against stairs
=====================

All robots of the catalogue on all stairs of the catalogue, flippers flat where there are some. The
friction of 1.2 is an assumption, made so that tipping decides and not slipping.
"""

from kaidan import Robot, Stairs, catalog
from kaidan.assessment import case_of
from kaidan.report.matrix import matrix
from kaidan.report.matrix_figure import matrix_figure

robots = [Robot.named(name) for name in catalog.names("robots")]
flights = [Stairs.named(name) for name in catalog.names("stairs")]
cases = [
    [
        case_of(
            robot,
            flight,
            friction=1.2,
            flippers="flat" if robot.front_flippers else "stowed",
        )
        for robot in robots
    ]
    for flight in flights
]
table = matrix(cases, conditions="Up nose first, constant speed, friction 1.2")
figure = matrix_figure(table)

# %%
# OUTSIDE means that the nosings stand further apart than half the flat length of the track (or, for
# MARV, that there is no track in the middle). The closed form then gives no answer.
#
# The same table as rows, for a spreadsheet or pandas:

columns = table.columns()
for row in list(zip(columns["robot"], columns["stairs"], columns["verdict"], strict=True))[:3]:
    print(*row)
