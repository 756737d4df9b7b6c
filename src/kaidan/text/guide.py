"""What to measure on a robot and on stairs, and how: drawings and steps for a terminal."""

ROBOT_DRAWING = r"""
                           C  centroid
 rear                      |                         front
 .---------------------------------------------------.
(  R                       | C_N                   R  )
 '--o----------------------+------------------------o'
    |<--------------------- L --------------------->|
                           |<-------- C_L --------->|
"""
STAIRS_DRAWING = r"""
                            ________ upper floor    -.
                   ________|  last riser             |
          ________|<------>|                         |  total rise
   ______|        | going  | rise                    |
  |  first riser                                    -'
  lower floor    total going: first to last nosing
"""

ROBOT = f"""\
Find mass, L, C_L and C_N of a robot, with their doubt, and write them into its sheet.

\b{ROBOT_DRAWING}
1. Lay a bar under each tip of the flat underside (o), one of them free to roll, each bar on a
scale. Flippers stowed, robot level: --length, --front-scale, --rear-scale. Or push it over an edge
until it balances, and weigh all of it on one scale: --balance, --mass.

2. Raise the front bar with its scale by blocks until the flat slopes by 15 to 30 deg, scales still
level: --slope, --front-on-slope, --rear-on-slope. Or stand it up on its rear end until it balances:
--tips-at, --rear-radius. Or let it tip on a ramp: --tips-at, --on ramp.

3. Measure the radius R of both ends, belt included: --front-radius, --rear-radius.

--figure alone draws all this.
"""
STAIRS = f"""\
Find rise, going, slope and spacing of stairs, with their doubt, and write their sheet.

\b{STAIRS_DRAWING}
Measure from floor to floor (--total-rise), and level from the first nosing to the last
(--total-going); count the risers. First and last riser often differ: --first-rise, --last-rise.
Check three single rises and goings somewhere: --rise 171mm --rise 168mm ...

Where the way turns on a landing, measure that landing too: the turn (--upper-turn quarter or half),
its clear length along the flight and width across it (--upper-landing, --upper-landing-width), the
clear width of the flight (--width), the leaf of a door opposite that opens onto it (--upper-leaf),
and where a level passage goes on from there its width (--upper-passage). A half turn takes a
landing as wide as both flights side by side. Likewise --lower-turn and so on.
"""

DRAWINGS = {"robot": ROBOT_DRAWING, "stairs": STAIRS_DRAWING, "surface": ""}
"""Drawing by the kind of sheet."""
BEGIN = "Lengths and angles with their unit: 620mm, 45deg. Enter leaves out what is in brackets."
UNWEIGHED = (
    "Nobody weighed it: where may its centroid be? The answers then hold until it is weighed."
)


def question(letter: str, meaning: str, *, low: str, high: str, default: str | None) -> str:
    """One question: its letter in the drawing, what is requested, the plausible range."""
    name = f"{letter}: " if letter else ""
    span = f" ({low} to {high})" if low else ""
    left_out = "" if default is None else f" [{default}]"
    return f"{name}{meaning}{span}{left_out}? "


def ended(name: str) -> str:
    """The answers are fewer than the questions."""
    return f"the answers end before {name}; give one a line, an empty line where it is left out"


def too_many(said: str) -> str:
    """The answers are more than the questions."""
    return f"{said!r} answers no question: a line for each, an empty one where it is left out"


def silent(seconds: float) -> str:
    """Nobody answers."""
    return (
        f"no answer came within {seconds:g} s, and standard input is no terminal: pipe the "
        "answers, one a line, or fill in the sheet (kaidan new without --ask)"
    )
