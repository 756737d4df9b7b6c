"""Reading the flights of building models over ifcopenshell's own opening and tessellating of them.

Ifcopenshell's own as a process, start included; kaidan's as a process too, and without its start,
as in a program that runs already (the process of the parser counts). In turn, in time of the
processor. And the time to judge a pair of a robot and a flight that differs from all others. Models
are authored: half-turn staircases of three storeys. A file of your own joins them with --file.
"""

import argparse
import resource
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from record import finish, options

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "tests"))

OWN = """
import sys
import ifcopenshell, ifcopenshell.geom
model = ifcopenshell.open(sys.argv[1], format=".ifc")
kinds = ("IfcStair", "IfcStairFlight", "IfcSlab", "IfcRailing")
drawn = {each.id(): each for kind in kinds for each in model.by_type(kind) if each.Representation}
settings = ifcopenshell.geom.settings()
settings.set("use-world-coords", True)
iterator = ifcopenshell.geom.iterator(settings, model, 1, include=list(drawn.values()))
going = iterator.initialize()
while going:
    shape = iterator.get()
    shape.geometry.verts
    going = iterator.next()
"""
OURS = """
import resource, sys, time
from kaidan.readers.assembly import building_of
from kaidan.readers.formats.ifc import read
from kaidan.readers.hints import Hints
from kaidan.readers.opening import Source
start = time.process_time()
building_of(read(Source.of(sys.argv[1]), Hints()))
parser = resource.getrusage(resource.RUSAGE_CHILDREN)
print(time.process_time() - start + parser.ru_utime + parser.ru_stime)
"""


def town(staircases: int, path: Path) -> Path:
    from ifc_cases import House, monolith

    house = House(storeys=tuple((3.0 * k, f"S{k}") for k in range(4)))
    steps = {"rises": [0.15] * 10, "goings": [0.30] * 9, "last": False}
    for number in range(staircases):
        x, y, z = number // 3 % 10 * 8, number // 30 * 6, 3.0 * (number % 3)
        stair = house.add("IfcStair", f"T{number}", storey=number % 3)
        house.add("IfcStairFlight", "a", [monolith(house, **steps)], at=(x, y, z), parent=stair)
        outline = [(0, -0.5), (1.2, -0.5), (1.2, 1.7), (0, 1.7)]
        house.add("IfcSlab", "landing", [house.slab(outline, 0)], at=(x + 2.7, y, z + 1.5),
                  parent=stair)  # fmt: skip
        house.add("IfcStairFlight", "b", [monolith(house, **steps)], at=(x + 2.7, y + 1.2, z + 1.5),
                  degrees=180, parent=stair)  # fmt: skip
    return Path(house.write(path))


def processor_time(code: str, path: Path) -> tuple[float, str]:
    """Time of the processor for a script and what it starts [s], and what it prints."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run(
        [sys.executable, "-c", code, str(path)], check=True, capture_output=True, text=True
    )
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    spent = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return spent, done.stdout


def ratios(path: Path, runs: int) -> tuple[float, float]:
    """Of both processes, and with kaidan running already."""
    whole, running, own = [], [], []
    for _ in range(runs):
        spent, said = processor_time(OURS, path)
        whole.append(spent)
        running.append(float(said))
        own.append(processor_time(OWN, path)[0])
    floor = statistics.median(own)
    return statistics.median(whole) / floor, statistics.median(running) / floor


def judging(runs: int, flippers: str) -> float:
    """Median time of a pair of a robot and a flight that differs from all others [s]."""
    from kaidan import Question, Robot, Stairs
    from kaidan.assessment import with_plan
    from kaidan.assessment.verdict import conclude

    robot = Robot.named("absolem")
    times = []
    for number in range(runs):
        flight = Stairs(rise=0.15 + 1e-4 * number, going=0.3, steps=10, width=1.0, headroom=2.2)
        start = time.process_time()
        question = Question.of(robot, flight, flippers=flippers, friction=1.0)
        conclude(*with_plan(question)[:2])
        times.append(time.process_time() - start)
    return statistics.median(times)


def main() -> None:
    arguments = options(argparse.ArgumentParser(description=__doc__))
    arguments.add_argument("--staircases", type=int, default=15)
    arguments.add_argument("--runs", type=int, default=3)
    arguments.add_argument("--file", type=Path, action="append", default=[])
    chosen = arguments.parse_args()
    figures, targets = {}, {}
    with tempfile.TemporaryDirectory() as folder:
        authored = town(chosen.staircases, Path(folder) / "town.ifc")
        for name, path in [(f"{2 * chosen.staircases} authored flights", authored),
                           *((each.name, each) for each in chosen.file)]:  # fmt: skip
            whole, running = (f"{name}: {what} / own" for what in ("process", "running"))
            figures[whole], figures[running] = ratios(path, chosen.runs)
            targets[running] = 1.5
    for flippers in ("flat", "best"):
        name = f"judging a pair, flippers {flippers} [ms]"
        figures[name], targets[name] = 1e3 * judging(20, flippers), 30.0
    finish(figures, chosen, targets)


if __name__ == "__main__":
    main()
