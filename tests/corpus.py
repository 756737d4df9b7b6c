"""What kaidan answers, drawn before a change and compared field by field after it.

``python tests/corpus.py draw FILE`` asks 2,000 questions of every model and verb, reads 40 files
that the tests' own makers write, and writes a JSON line for each; ``draw FILE WORD`` those whose
name has a word. ``python tests/corpus.py compare BEFORE AFTER`` names each field that differs, and
ends with 1 if one does. Numbers are equal to the last bit, but those of the closed form over
arrays, which are equal to 1e-12.
"""

import hashlib
import io
import itertools
import json
import math
import os
import random
import re
import sys
import tempfile
from collections import Counter
from contextlib import chdir, redirect_stderr, redirect_stdout
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parent))

import climbs
import ifc_cases
import reader_files
import robot_files
import scenes
from kaidan import cli, verdicts
from kaidan.assessment import answer_to
from kaidan.cli.schema import KINDS
from question_cases import random_questions

SEED = 29
RANDOM = 1000
"""Random questions, put by sheet; as many again are command lines."""
LAB = "lab"
"""Word before the commands of the laboratory; its absence counts as no difference."""
ROUNDED = ("verdicts ", "margin ", "sweep formulas")
"""What is computed over arrays, whose operations may be ordered otherwise."""
WITHIN = 1e-12
LAB_KINDS = ("agree", "trial", "experiment", "calibration", "yielding-calibration", "theta-m",
             "engagement", "rig-calibration", "grouser-effects", "reproduction",
             "outcomes")  # fmt: skip
APART = "driven-grousers"
"""Trials that are compared apart: --apart leaves them out."""

NOT_TOLD = ("wall_time_s", "digest")
"""Fields that differ from run to run: times, and the digest of a file that names its own hour."""
SOURCE = re.compile(r"models [0-9a-f]{12}")
"""Version of what a store depends on: it differs where a source does."""

FLIPPERED = ("absolem", "marv", "packbot-510", "quince")
ROBOTS = ("absolem", "absolem-flat", "csiro-dtr", "kenaf", "marmotte", "marv", "ozbot-atr",
          "superdroid-hd2", "packbot-510", "quince", "talon", "taurob-tracker")  # fmt: skip
STAIRS = ("ada", "din-dwelling", "din-general", "ibc", "ibc-dwelling", "iso-14122-3",
          "japan-dwelling", "nist-arena", "osha", "schependomlaan", "uk-general",
          "uk-private")  # fmt: skip


def commands():
    """Command lines, about a thousand."""
    draw = random.Random(SEED)
    yield from assessments(draw, 430)
    yield from traverses(draw, 90)
    yield from of_one_verb(draw)
    yield from curves(draw)
    yield from sheets(draw)
    yield from trials(draw, 60)
    yield from research()


def pair(draw):
    """Robot, stairs and how it goes, as people write them."""
    robot = draw.choice(ROBOTS)
    words = [robot]
    if draw.random() < 0.6:
        words.append(draw.choice(STAIRS))
    elif draw.random() < 0.5:
        words += ["--rise", f"{draw.randint(120, 230)}mm", "--going", f"{draw.randint(200, 340)}mm"]
    else:
        words += ["--angle", f"{draw.randint(20, 55)}deg"]
        words += ["--nosing-spacing", f"{draw.choice((120, 150, 180, 220, 280, 320))}mm"]
    if draw.random() < 0.4:
        words += ["--direction", "down"]
    words += draw.choice(([], ["--surface", "concrete-dry"], ["--friction", "0.8"],
                          ["--friction", "1.2"], ["--friction", "2"],
                          ["--friction", "0.6..1.1"]))  # fmt: skip
    return robot, words


def posture(draw, robot):
    if robot not in FLIPPERED:
        return draw.choice(([], ["--facing", "tail-first"]))
    plans = ("flat", "stowed", "20deg,-5deg", "flat/land:-60deg,-20deg", "45deg,30deg")
    return ["--flippers", draw.choice(plans)] if draw.random() < 0.7 else []


def assessments(draw, count):
    for _ in range(count):
        robot, words = pair(draw)
        words += posture(draw, robot)
        model = draw.choices(("contact", "closed-form", "support-polygon"), (70, 20, 10))[0]
        if model != "contact":
            words += ["--model", model]
        for option, values, share in (
            ("--acceleration", ("0.3m/s2", "-0.5m/s2"), 0.15), ("--speed", ("0.1m/s",), 0.3),
            ("--theta-d", ("1deg", "0deg..2.6deg"), 0.2), ("--theta-m", ("1.2deg",), 0.2),
            ("--uncertainty", ("com_from_front=5mm", "rise=3mm", "friction=0.05"), 0.2),
            ("--risk", ("0.1",), 0.1),
            ("--payload", ("2kg@200mm,300mm",), 0.1), ("--yaw", ("5deg", "-20deg"), 0.1),
            ("--override", ("track.belt=grousers", "com_height=150mm"), 0.2),
        ):  # fmt: skip
            if draw.random() < share:
                words += [option, draw.choice(values)]
        form = draw.choices(("--json", "", "--details", "--short"), (6, 2, 1, 1))[0]
        yield ["assess", *words, *filter(None, [form])]


def traverses(draw, count):
    for number in range(count):
        robot, words = pair(draw)
        words += posture(draw, robot)
        verb = ("traverse", "traverse", "posture")[number % 3]
        if verb == "posture" and "--facing" in words:
            words = words[: words.index("--facing")]
        yield [verb, *words, *(["--json"] if number % 4 else [])]


def of_one_verb(draw):
    """Comparisons, reports, buildings, designs, stocks, sensitivities, sweeps, monitors."""
    for number in range(12):
        names = draw.sample(ROBOTS, 3)
        stairs = [word for name in draw.sample(STAIRS, 3) for word in ("--stairs", name)]
        words = [*names, *stairs, "--friction", draw.choice(("0.8", "1.2")), "--workers", "1"]
        model = ["--model", "closed-form"] if number % 3 else []
        yield ["compare", *words, *model, "--json", "--csv", f"compare{number}.csv"]
    for number in range(10):
        robot, words = pair(draw)
        output = ["--json"] if number % 2 else ["-o", f"report{number}.html"]
        yield ["report", *words, *posture(draw, robot), *output]
    for number in range(8):
        robots = ",".join(draw.sample(ROBOTS, 2))
        more = draw.choice(([], ["--friction", "0.9"], ["--direction", "down"]))
        file = draw.choice(("half_turn.ifc", "door.ifc"))
        words = [file, "--robots", robots, "--flippers", "flat", *more]
        yield ["building", *words, *(["--json"] if number % 2 else ["--html", f"h{number}.html"])]
    for goal in ("margin", "go"):
        for robot in ("kenaf", "csiro-dtr", "superdroid-hd2"):
            free = ["--free", "com_height=60mm..200mm", "--free", "com_from_front=150mm..300mm"]
            few = ["--tries", "40", "--grid", "5", "--scheduler", "threads", "--workers", "1"]
            yield ["design", robot, "ibc", "--friction", "1.2", *free, "--goal", goal, *few,
                   "--json"]  # fmt: skip
    for seed in range(6):
        words = ["--robots", "kenaf,superdroid-hd2", "--draw", "rise=150mm..200mm", "--draw"]
        words += ["going=260mm+-20mm", "--flights", "12", "--friction", "1.0", "--seed", str(seed)]
        only = ["--go-only"] if seed % 2 else []
        yield ["study", "stock", *words, *only, "--scheduler", "threads", "--workers", "1",
               "--json", "--csv", f"stock{seed}.csv"]  # fmt: skip
    for robot in ("kenaf", "superdroid-hd2", "csiro-dtr", "talon"):
        yield ["sensitivity", robot, "ibc", "--surface", "concrete-dry", "--uncertainty",
               "com_from_front=5mm", "--model", "closed-form", "--json"]  # fmt: skip
    for number in range(30):
        robot, words = pair(draw)
        model = draw.choice(("contact", "closed-form"))
        vary = draw.choice(("com_height=80mm..200mm/3", "speed=0.05m/s,0.2m/s", "risk=0.01,0.1"))
        flat = ["--flippers", "flat"] if robot in FLIPPERED else []
        yield ["sweep", *words, *flat, "--model", model, "--vary", vary, "--workers", "1",
               "--json", "--table", f"sweep{number}.csv"]  # fmt: skip
    for number in range(40):
        robot = draw.choice(("kenaf", "absolem", "csiro-dtr", "marmotte"))
        flat = ["--flippers", "flat"] if robot == "absolem" else []
        words = [robot, "--angle", "46deg", "--nosing-spacing", "150mm", f"climb{number % 5}.csv"]
        way = draw.choice(([], ["--changes"], ["--direction", "down"], ["--horizon", "1s"]))
        yield ["monitor", *words, *flat, *way, *(["--json"] if number % 4 else [])]


def curves(draw):
    """Margins over spacings, and d-a planes."""
    for number in range(60):
        robot = draw.choice(ROBOTS)
        flat = ["--flippers", "flat"] if robot in FLIPPERED and number % 2 else []
        more = draw.choice(([], ["--direction", "down"], ["--theta-d", "2.6deg"], ["--codes"],
                            ["--acceleration", "0.4m/s2"]))  # fmt: skip
        files = ["--csv", f"margin{number}.csv"] if number % 3 == 0 else []
        yield ["margin", robot, "--points", "40", *flat, *more, *files, "--json"]
    for number in range(60):
        robot, words = pair(draw)
        flat = ["--flippers", "flat"] if robot in FLIPPERED else []
        more = ["--accelerate", "--speed", "0.1m/s"] if number % 3 == 0 else []
        yield ["plane", *words, *flat, *more, *(["--json"] if number % 4 else [])]


def sheets(draw):
    """Catalogues, schemas, measurements, new sheets, files."""
    for kind, names in (("robots", ROBOTS), ("stairs", STAIRS), ("surfaces", ("concrete-dry",))):
        yield [kind]
        for name in names:
            yield [kind, name]
    for kind in sorted({*KINDS} - {*LAB_KINDS}):
        yield ["schema", kind]
    for kind in LAB_KINDS:
        yield [LAB, "schema", kind]
    for number in range(30):
        front, rear = draw.uniform(8, 20), draw.uniform(8, 20)
        words = ["--length", "620mm", "--front-scale", f"{front:.2f}kg", "--rear-scale"]
        words += [f"{rear:.2f}kg", "--front-radius", "90mm", "--rear-radius", "90mm"]
        if number % 3 == 0:
            words += ["--slope", "20deg", "--front-on-slope", f"{front - 2:.2f}kg",
                      "--rear-on-slope", f"{rear + 2:.2f}kg"]  # fmt: skip
        elif number % 3 == 1:
            words += ["--tips-at", f"{draw.randint(50, 75)}deg"]
        yield ["measure", "robot", *words, *(["--json"] if number % 2 else [])]
    for number in range(30):
        risers = draw.randint(4, 18)
        words = ["--total-rise", f"{risers * draw.uniform(0.15, 0.2):.3f}m", "--total-going"]
        words += [f"{(risers - 1) * draw.uniform(0.24, 0.32):.3f}m", "--risers", str(risers)]
        if number % 3 == 0:
            words += ["--rise", "171mm", "--rise", "168mm", "--rise", "170mm"]
        yield ["measure", "stairs", *words, *(["--json"] if number % 2 else [])]
    for what in ("robot", "stairs", "surface"):
        yield ["new", what, f"new_{what}.toml"]
    for file in sorted(FILES):
        yield ["read", file, "--json"]
        yield ["read", file]
    for file in ("stairs.pcd", "stairs.stl", "stairs.tif", "stairs.ply", "stairs.csv"):
        yield ["assess", "superdroid-hd2", file, "--friction", "1.2", "--json"]
    for file in ("tank.urdf", "tank.sdf", "tank.xml"):
        yield ["assess", file, "ibc", "--friction", "1.2", "--flippers", "flat", "--json"]
        yield ["traverse", file, "ada", "--friction", "1.2", "--flippers", "flat", "--json"]


def trials(draw, count):
    """Trials in MuJoCo: the model of `assess`, then the laboratory's own."""
    tracks = (["smooth-belt"], ["yielding-belt"], ["sprung-noses", "--stiffness", "60kN/m"],
              ["driven-grousers"], ["shoe-chain"])  # fmt: skip
    for number in range(count):
        angle = f"{draw.randint(40, 62)}deg"
        words = ["kenaf", "--angle", angle, "--nosing-spacing", draw.choice(("150mm", "200mm"))]
        words += ["--override", "mass=20kg"]
        if number % 4 == 0:
            track = draw.choice(("smooth-belt", "yielding-belt", "driven-grousers"))
            more = ["--trials", str(draw.randint(1, 2)), "--steps", "4"]
            yield ["assess", *words, "--friction", "3", "--model", "physics", "--track", track,
                   *more, "--json"]  # fmt: skip
        elif number % 4 == 1:
            yield [LAB, "physics", "export", *words, "--track", *draw.choice(tracks[:2]),
                   "--file", f"model{number}.xml"]  # fmt: skip
        else:
            words += ["--track", *draw.choice(tracks), "--seed", str(number)]
            log = ["--json", "--log", f"log{number}.csv"] if number % 2 else []
            yield [LAB, "physics", "trial", *words, *log]


def research():
    """What the laboratory answers."""
    yield [LAB, "reproduce", "--json"]
    yield [LAB, "reproduce", "--out", "paper", "--format", "svg"]
    yield [LAB, "outcomes", "--json"]
    yield [LAB, "outcomes"]
    own = ["kenaf", "--override", "mass=20kg"]
    steep = ["--angle", "50deg", "--nosing-spacing", "150mm", "--steps", "5"]
    for way in ([], ["--direction", "down", "--facing", "tail-first"]):
        yield [LAB, "agree", *own, *steep, *way, "--resolution", "1deg", "--json"]
        yield [LAB, "agree", *own, *steep, *way, "--resolution", "1deg"]
    for track in ("smooth-belt", "yielding-belt"):
        words = ["--spacings", "150mm", "--angles", "52deg..64deg/4", "--trials", "2", "--track"]
        for way in ([], ["--descent"]):
            yield [LAB, "experiment", *own, *words, track, *way, "--workers", "1", "--store",
                   f"store-{track}{len(way)}", "--json"]  # fmt: skip
        yield [LAB, "campaign", "status", f"store-{track}0"]
        yield [LAB, "campaign", "export", f"store-{track}0", f"store-{track}.csv"]
    page = "protocol"
    yield [LAB, "experiment", "kenaf", "--protocol", f"{page}.md", "--trials", "3"]
    yield [LAB, "calibrate", "rig.toml", "--json"]
    yield [LAB, "calibrate", "rig.toml"]


def arrays():
    """The formulas over arrays, with every engine."""
    rng = np.random.default_rng(SEED)
    for number in range(20):
        count = 400
        inputs = {
            "flat_length": rng.uniform(0.3, 1.2, count),
            "com_from_uphill": rng.uniform(0.1, 0.3, count),
            "com_height": rng.uniform(0.03, 0.3, count),
            "nosing_spacing": rng.uniform(0.1, 0.4, count),
            "angle": rng.uniform(0.1, 1.2, count),
            "friction": rng.uniform(0.2, 2.0, count),
            "acceleration": rng.uniform(-1.0, 1.0, count),
        }
        found = verdicts(inputs)
        yield f"verdicts {number}", {name: each.tolist() for name, each in found._asdict().items()}


def _cloud(sensor, seed, **scene):
    flight = scenes.regular(**scene)
    return scenes.seen(scenes.with_stairs(flight), np.random.default_rng(seed), sensor=sensor)


def _stairs_cloud():
    cloud = _cloud("phone", 1).xyz
    return cloud[np.isfinite(cloud).all(axis=1)]


def _mesh(rise=0.17, going=0.28, steps=8, half=0.5):
    """Treads and risers as triangles."""
    outline = [(-2.0, 0.0)]
    for step in range(steps):
        outline += [(step * going, step * rise), (step * going, (step + 1) * rise)]
    outline.append((steps * going + 1.5, steps * rise))
    vertices = np.array([(x, y, z) for x, z in outline for y in (-half, half)])
    faces = [
        face
        for k in range(0, len(vertices) - 2, 2)
        for face in ((k, k + 2, k + 1), (k + 1, k + 2, k + 3))
    ]
    return vertices, faces


def _y_up():
    vertices, faces = _mesh()
    return vertices @ np.array([[1, 0, 0], [0, 0, -1], [0, 1, 0]]), faces


def _heights(steps=8, rise=0.17, going=0.28, cell=0.02):
    x = np.arange(-1.0, steps * going + 1.0, cell)
    z = rise * np.clip(np.floor(x / going) + 1, 0, steps)
    return np.tile(z, (40, 1)), (cell, cell)


FILES = {
    "stairs.pcd": lambda _: reader_files.pcd(_stairs_cloud()),
    "ascii.pcd": lambda _: reader_files.pcd(_stairs_cloud()[::7], "ascii"),
    "packed.pcd": lambda _: reader_files.pcd(_stairs_cloud()[::3], "binary_compressed"),
    "few.pcd": lambda _: reader_files.pcd(reader_files.cloud()),
    "stairs.ply": lambda _: reader_files.ply(_stairs_cloud()),
    "big.ply": lambda _: reader_files.ply(_stairs_cloud()[::3], "binary_big_endian"),
    "mesh.ply": lambda _: reader_files.ply(_mesh()[0], faces=_mesh()[1]),
    "ascii.ply": lambda _: reader_files.ply(_mesh()[0], "ascii", _mesh()[1]),
    "stairs.npy": lambda _: reader_files.npy(_stairs_cloud()),
    "heights.npz": lambda _: reader_files.npz(heights=_heights()[0], cell=np.array(0.02)),
    "stairs.csv": lambda _: reader_files.table(_stairs_cloud()[::5], ",", "x,y,z\n"),
    "stairs.xyz": lambda _: reader_files.table(_stairs_cloud()[::5]),
    "stairs.las": lambda _: reader_files.las(_stairs_cloud()),
    "stairs.laz": lambda _: reader_files.las(_stairs_cloud()[::2], packed=True),
    "stairs.e57": lambda path: reader_files.e57(_stairs_cloud()[::2], path),
    "stairs.stl": lambda _: reader_files.stl(*_mesh()),
    "text.stl": lambda _: reader_files.stl_text(*_mesh()),
    "stairs.obj": lambda _: reader_files.obj(*_mesh()),
    "stairs.glb": lambda _: reader_files.gltf(*_y_up()),
    "stairs.gltf": lambda _: reader_files.gltf(*_y_up(), binary=False),
    "stairs.dae": lambda _: reader_files.dae(*_mesh()),
    "inches.dae": lambda _: reader_files.dae(_mesh()[0] / 0.0254, _mesh()[1], "0.0254"),
    "stairs.tif": lambda _: reader_files.geotiff(*_heights()),
    "steep.stl": lambda _: reader_files.stl(*_mesh(0.21, 0.21)),
    "three.stl": lambda _: reader_files.stl(*_mesh(steps=3)),
    "phone.pcd": lambda _: reader_files.pcd(_cloud("phone", 2, steps=5, rise=0.2).xyz[::2]),
    "lidar.pcd": lambda _: reader_files.pcd(_cloud("lidar", 3).xyz[::2]),
    "lidar.ply": lambda _: reader_files.ply(_cloud("lidar", 4, steps=6).xyz),
    "tank.urdf": lambda _: robot_files.tank_urdf(),
    "bare.urdf": lambda _: robot_files.tank_urdf(flipper=""),
    "arm.urdf": lambda _: robot_files.arm_of_four(),
    "tank.sdf": lambda _: robot_files.tank_sdf(),
    "relative.sdf": lambda _: robot_files.tank_sdf("1.9", relative=True),
    "tank.xml": lambda _: robot_files.tank_mjcf(),
    "half_turn.ifc": lambda path: _house(ifc_cases.half_turn_house(), path),
    "wide.ifc": lambda path: _house(ifc_cases.half_turn_house(1.6, width=1.3), path),
    "door.ifc": lambda path: _house(ifc_cases.house_with_a_door(), path),
    "old.ifc": lambda path: _house(ifc_cases.house_with_a_door(schema="IFC2X3"), path),
    "nothing.pcd": lambda _: b"# .PCD v0.7\nVERSION 0.7\n",
    "nothing.ifc": lambda _: b"ISO-10303-21;\n",
}
"""What writes each file; none of them is found anywhere else."""

RIG = """robot = "kenaf"
mass = 20.0
press = [{force = 50.0, travel = 0.001}, {force = 100.0, travel = 0.0021}]

[[trials]]
nosing_spacing = 0.15
angle = 1.0
results = "hhhhf"
[[trials]]
nosing_spacing = 0.15
angle = 1.05
results = "hffff"
"""


def _house(house, path):
    house.write(path)
    return path.read_bytes()


def write_files():
    numbers = itertools.count(1)
    ifc_cases.ifcopenshell.guid.new = lambda: f"{next(numbers):022d}"
    for name, made in FILES.items():
        path = Path(name)
        content = made(path)
        path.write_bytes(content)
    for number in range(5):
        rows = climbs.climb(5.0 + number, 20.0 + 5 * number)
        Path(f"climb{number}.csv").write_text(climbs.csv_of(rows))
    Path("rig.toml").write_text(RIG)


def asked(words):
    """What a command prints, writes and ends with."""
    before = set(Path().rglob("*"))
    said, wrong = io.StringIO(), io.StringIO()
    with redirect_stdout(said), redirect_stderr(wrong):
        code = cli.run(words)
    made = [path for path in set(Path().rglob("*")) - before if path.is_file()]
    text = said.getvalue()
    answer = {"code": code, "error": wrong.getvalue()}
    answer["said"] = _read(text) if "--json" in words and text.startswith("{") else text
    answer["files"] = {str(path): _content(path) for path in sorted(made) if _compared(path)}
    return answer


def _read(text):
    """One JSON object, or a list of one a line."""
    try:
        return json.loads(text)
    except ValueError:
        return [json.loads(line) for line in text.splitlines()]


def _compared(path):
    """Not of a store, which says when and by which process."""
    return not any(part.startswith("store") for part in path.parts)


def _content(path):
    if path.suffix in (".csv", ".md") and path.stat().st_size < 100_000:
        return path.read_text()
    return hashlib.sha256(path.read_bytes()).hexdigest()


def answers():
    """Each question's name, and a function that answers it."""
    for number, question in enumerate(random_questions(RANDOM, SEED)):
        yield f"random {number}", lambda q=question: json.loads(answer_to(q).to_json())
    for number, words in enumerate(commands()):
        shown = " ".join(word for word in words if word != LAB)
        yield f"{number} {shown}", lambda w=words: asked(w)
    for name, found in arrays():
        yield name, lambda f=found: f


def drawn(file, word=""):
    """Write an answer a line; of questions whose name has a word."""
    with tempfile.TemporaryDirectory() as folder, file.open("w") as out, chdir(folder):
        write_files()
        for name, ask in answers():
            if word not in name:
                continue
            out.write(json.dumps({"asked": name, "answer": ask()}) + "\n")
            out.flush()


def compared(before, after, *, apart):
    """How many answers differ; each differing field on a line."""
    one, other = (
        {
            each["asked"]: each["answer"]
            for each in map(json.loads, Path(file).read_text().splitlines())
        }
        for file in (before, after)
    )
    different, verbs = 0, Counter()
    for name in one.keys() | other.keys():
        verbs[_verb(name)] += 1
        if apart and APART in name:
            continue
        close = any(word in name for word in ROUNDED)
        fields = list(_differences(one.get(name), other.get(name), "", close))
        different += bool(fields)
        for field in fields[:5]:
            print(f"{name}: {field}")
    print(f"{len(one)} before, {len(other)} after, {different} differ; "
          + ", ".join(f"{verb} {count}" for verb, count in sorted(verbs.items())))  # fmt: skip
    return different


def _verb(name):
    return re.sub(r"^\d+ ", "", name).split()[0]


def _differences(one, other, where, close):
    if isinstance(one, dict) and isinstance(other, dict):
        for key in (one.keys() | other.keys()) - {*NOT_TOLD}:
            yield from _differences(one.get(key), other.get(key), f"{where}.{key}", close)
    elif isinstance(one, list) and isinstance(other, list) and len(one) == len(other):
        for number, (a, b) in enumerate(zip(one, other, strict=True)):
            yield from _differences(a, b, f"{where}[{number}]", close)
    elif isinstance(one, float) and isinstance(other, float):
        both = one == other or (math.isnan(one) and math.isnan(other))
        if not both and not (close and math.isclose(one, other, rel_tol=WITHIN, abs_tol=WITHIN)):
            yield f"{where}: {one!r} {other!r}"
    elif isinstance(one, str) and isinstance(other, str):
        if SOURCE.sub("", one) != SOURCE.sub("", other):
            yield f"{where}: {_parted(one, other)}"
    elif one != other:
        yield f"{where}: {str(one)[:100]!r} {str(other)[:100]!r}"


def _parted(one, other):
    """Two texts from where they part."""
    at = next((k for k, (a, b) in enumerate(zip(one, other, strict=False)) if a != b), 0)
    return f"{one[max(0, at - 30) : at + 60]!r} {other[max(0, at - 30) : at + 60]!r}"


if __name__ == "__main__":
    os.environ["COLUMNS"] = "200"
    match sys.argv[1:]:
        case ["draw", file, *word]:
            drawn(Path(file).resolve(), *word)
        case ["compare", before, after, *rest]:
            sys.exit(bool(compared(before, after, apart="--apart" in rest)))
        case _:
            sys.exit(__doc__)
