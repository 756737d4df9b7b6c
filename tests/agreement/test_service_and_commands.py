"""The service and the command line, asked the same in the same words: equal to the last digit."""

import json
import random

import pytest

from kaidan import catalog
from kaidan.cli import run
from kaidan.robot import Robot
from serving import served

STOWED_OR_MORE = ("stowed", "flat", "20deg,-5deg", "flat/land:-30deg,-10deg")


def random_asking(rng):
    """A verb, and what is asked of it by keyword."""
    verb = rng.choices(("assess", "traverse", "plane", "margin"), (6, 2, 2, 2))[0]
    robot = rng.choice([name for name in catalog.names("robots") if Robot.named(name).flippers()])
    both = len(Robot.named(robot).flippers()) == 2
    asked = {"robot": robot, "flippers": rng.choice(STOWED_OR_MORE if both else STOWED_OR_MORE[:2])}
    if verb in ("plane", "margin"):
        asked["flippers"] = rng.choice(STOWED_OR_MORE[:2])
    if verb != "margin":
        asked["stairs"] = rng.choice(catalog.names("stairs"))
        ground = rng.choice(("surface", "friction", "range"))
        if ground == "surface":
            asked["surface"] = rng.choice(catalog.names("surfaces"))
        else:
            mu = round(rng.uniform(0.4, 1.4), 2)
            asked["friction"] = str(mu) if ground == "friction" else f"{mu}..{mu + 0.2:.2f}"
    for name, value in (
        ("facing", rng.choice(("nose-first", "tail-first"))),
        ("direction", rng.choice(("up", "down"))),
        ("theta_d", f"{rng.uniform(0, 1):.1f}deg..2deg"),
        ("override", f"com_height={rng.uniform(90, 160):.0f}mm"),
        ("payload", f"{rng.uniform(1, 6):.1f}kg@200mm,250mm"),
        ("acceleration", f"{rng.uniform(-0.4, 0.4):.2f}m/s2"),
    ):
        if rng.random() < 0.3:
            asked[name] = value
    return verb, asked


def command_of(verb, asked):
    """The same as a command line."""
    values = dict(asked)
    words = [verb, values.pop("robot"), *([values.pop("stairs")] if "stairs" in values else [])]
    return [*words, *(f"--{name.replace('_', '-')}={value}" for name, value in values.items()),
            "--json"]  # fmt: skip


def compare(count, capsys):
    rng = random.Random(12)
    refused = 0
    with served() as client:
        for _ in range(count):
            verb, asked = random_asking(rng)
            answer = client.post(f"/api/{verb}", json=asked)
            code = run(command_of(verb, asked))
            said = capsys.readouterr()
            if code == 2:
                refused += 1
                assert answer.status_code == 422, (verb, asked, said.err)
                line = said.err.removeprefix("kaidan: ").strip()
                assert " ".join(answer.json()["error"].split()) == line
            else:
                assert answer.status_code == 200, (verb, asked, answer.text)
                assert answer.json() == json.loads(said.out), (verb, asked)
    assert refused < count / 2


def test_ten_random_questions(capsys):
    compare(10, capsys)


@pytest.mark.slow
def test_two_hundred_random_questions(capsys):
    compare(200, capsys)
