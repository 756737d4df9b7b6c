"""A fleet on a stock of stairs; expected numbers by hand and from single answers of assess."""

import csv
import math

import numpy as np
import pytest

from kaidan import InputError, Question, Robot, Stairs, assess
from kaidan.assessment.verdict import conclude
from kaidan.models import judge
from kaidan.verbs.stock.answer import StockStudy
from kaidan.verbs.stock.flights import Stock
from kaidan.verbs.stock.study import longest, stock_study

CLOSED = {"model": "closed-form", "friction": (0.8, 1.0)}


def written(tmp_path, text):
    path = tmp_path / "stock.csv"
    path.write_text(text)
    return path


# Flights


def test_a_table_of_flights(tmp_path):
    path = written(tmp_path, "\ufeffname,rise_mm,Going,Count,width [cm],flights\n"
                   "a,170,0.29,9,120,3\n\nb,170,290mm,9,120,\nc,7in,29cm,,,2\n")  # fmt: skip
    stock = Stock.of_file(path)
    assert (len(stock), stock.flights.tolist()) == (2, [4.0, 2.0])
    np.testing.assert_allclose(stock.figures["rise"], [0.17, 0.1778])
    np.testing.assert_allclose(stock.figures["going"], [0.29, 0.29])
    assert stock.figures["steps"].tolist() == [9.0, 12.0]  # kaidan's default where none is stated
    np.testing.assert_allclose(stock.figures["width"], [1.2, math.nan])
    assert np.isnan(stock.figures["lower_landing"]).all()


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", "holds no flights"),
        ("rise,going\n", "holds no flights"),
        ("rise,tread\n0.17,0.28\n", "no column going; it has rise, tread"),
        ("rise,going\n0.17,\n", "line 2: going is missing"),
        ("rise,going\n0.17,luck\n", r"line 2: going = 'luck' is no length"),
        ("rise,going\n170,280\n", r"flight 1: rise = 170 m is not within 0.02 to .* rise_mm"),
        ("rise,going,steps\n0.17,0.28,3.5\n", "steps must be whole numbers"),
        ("rise,going,flights\n0.17,0.28,-1\n", "flights must be a positive number"),
        ("rise,going,count,steps\n0.17,0.28,3,4\n", "two columns are steps"),
    ],
)
def test_a_table_of_nonsense_is_refused(tmp_path, text, said):
    with pytest.raises(InputError, match=said):
        Stock.of_file(written(tmp_path, text))
    with pytest.raises(InputError, match="cannot be read"):
        Stock.of_file(tmp_path / "nowhere.csv")


def test_drawn_flights_keep_what_is_known_of_them():
    figures = {"rise": "140mm..200mm", "going": "230mm..370mm", "steps": "3..18"}
    stock = Stock.drawn(figures, 5000, rule=(0.59, 0.65), to=0.01, seed=1)
    rise, going, steps = (stock.figures[name] for name in figures)
    assert stock.flights.sum() == 5000
    assert len(stock) < 5000
    assert (rise.min(), rise.max()) == (0.14, 0.2)
    assert (steps.min(), steps.max()) == (3, 18)
    step = 2 * rise + going
    assert 0.59 - 1e-9 <= step.min() <= step.max() <= 0.65 + 1e-9
    again = Stock.drawn(figures, 5000, rule=(0.59, 0.65), to=0.01, seed=1)
    assert again.figures["rise"].tolist() == rise.tolist()


def test_a_normal_distribution_has_its_middle_and_its_width():
    stock = Stock.drawn({"rise": "172mm+-8mm", "going": (0.28, 0.28)}, 20_000, to=0.0001)
    rise, weights = stock.figures["rise"], stock.flights / stock.flights.sum()
    middle = float(rise @ weights)
    # 20,000 draws know the mean to 8 mm / 141 and the deviation to 8 mm / 200; four times that
    assert middle == pytest.approx(0.172, abs=4 * 0.008 / 141)
    assert math.sqrt((rise - middle) ** 2 @ weights) == pytest.approx(0.008, abs=4 * 0.008 / 200)


@pytest.mark.parametrize(
    ("figures", "others", "said"),
    [
        ({"rise": "170mm"}, {}, "needs rise and going"),
        ({"rise": "170mm", "going": "280mm", "luck": "1"}, {}, "unknown figure 'luck'"),
        ({"rise": "170mm", "going": "280mm"}, {"rule": (0.7, 0.8)}, "hardly a flight keeps"),
        ({"rise": "170", "going": "280mm"}, {}, "has no unit"),
        ({"rise": "170mm", "going": "280mm"}, {"to": 0.0}, "lengths rounded to 0 m"),
        ({"rise": "170mm", "going": "280mm"}, {"count": 0}, "flights = 0 is not within"),
    ],
)
def test_draws_without_meaning_are_refused(figures, others, said):
    with pytest.raises(InputError, match=said):
        Stock.drawn(figures, **{"count": 10, **others})


def test_stairs_of_the_catalogue():
    stock = Stock.of_stairs([Stairs.named("ibc"), Stairs.named("ada"), Stairs.named("ibc")])
    assert sorted(stock.flights.tolist()) == [1.0, 2.0]
    with pytest.raises(InputError, match="are not uniform"):
        Stock.of_stairs([Stairs(rises=(0.1, 0.1), goings=(0.3,))])


def test_flights_as_sheets_for_a_sweep_or_a_design(tmp_path):
    row = "170,290,9,1.2\n"
    path = written(tmp_path, f"rise_mm,going_mm,steps,width\n{row}150,300,,\n{row}")
    low, steep = Stock.of_file(path).stairs()
    assert (low.name, low.steps, low.width) == ("150 x 300 mm, 12", 12, None)
    assert (steep.rise, steep.going, steep.steps, steep.width) == (0.17, 0.29, 9, 1.2)
    from typer.testing import CliRunner

    from kaidan.cli import app_for

    words = ["design", "absolem", str(path), "--model", "closed-form", "--flippers", "flat",
             "--tries", "30", "--friction", "1.2", "--json",
             "--free", "com_height=100mm..300mm"]  # fmt: skip
    done = CliRunner().invoke(app_for(["design"]), words)
    assert done.exit_code == 0, done.output
    assert '"150 x 300 mm, 12"' in done.stdout


# Long flights


@pytest.mark.parametrize("count", [25, pytest.param(400, marks=pytest.mark.slow)])
def test_a_long_flight_says_what_a_short_one_says(count):
    """Same verdict, same mode; margins to 1e-4 deg, since poses lie at other places of a step."""
    draw = np.random.default_rng(3)
    short_ones = 0
    for k in range(count):
        robot = Robot.named(("absolem", "kenaf", "ozbot-atr")[k % 3])
        flippers = str(draw.choice(["flat", "22deg,flat"])) if robot.flippers() else "stowed"
        stairs = Stairs(rise=draw.uniform(0.06, 0.19), going=draw.uniform(0.2, 0.35),
                        steps=int(draw.integers(10, 40)))  # fmt: skip
        (steps,) = Stock.of_stairs([stairs]).shortened(longest(robot)).figures["steps"]
        short_ones += steps < stairs.steps
        found = []
        for each in (stairs.steps, int(steps)):
            question = Question.of(
                robot,
                stairs.model_copy(update={"steps": each}),
                friction=(0.8, 1.2),
                flippers=flippers,
                direction=str(("up", "down")[k % 2]),
            )
            found.append(conclude(question, judge(question)))
        long, short = found
        assert (long.verdict, long.governs) == (short.verdict, short.governs)
        assert math.degrees(long.margin) == pytest.approx(
            math.degrees(short.margin), abs=1e-4, nan_ok=True
        )
    assert short_ones > count / 4


def test_no_posture_is_longer_than_the_longest():
    robot = Robot.named("absolem")
    for flippers in ("flat", "stowed", "20deg,-30deg", "180deg,180deg"):
        question = Question.of(robot, "ibc", flippers=flippers)
        assert sum(question.outline.reach) <= longest(robot)


# Shares


def test_shares_are_those_of_single_answers():
    rise, going, weights = [0.1, 0.17, 0.19], [0.3, 0.28, 0.22], [5.0, 3.0, 2.0]
    stock = Stock.of_rows(
        "three",
        {"rise": np.array(rise), "going": np.array(going), "steps": np.full(3, 14.0)}
        | dict.fromkeys(("lower_landing", "upper_landing", "width"), np.full(3, np.nan)),
        np.array(weights),
    )
    found, swept = stock_study(["absolem", "kenaf"], stock, **CLOSED)
    assert len(swept) == 6
    assert (found.flights, found.different, found.judged) == (10.0, 3, 6)
    best = np.zeros(3, dtype=bool)
    for each in found.robots:
        answers = [
            assess(each.robot, Stairs(rise=r, going=g, steps=14), **CLOSED)
            for r, g in zip(rise, going, strict=True)
        ]  # fmt: skip
        shares = {"go": each.go, "rough": each.rough, "unsure": each.unsure,
                  "no-go": each.no_go, "outside-model": each.outside_model}  # fmt: skip
        for verdict, share in shares.items():
            expected = sum(w for w, a in zip(weights, answers, strict=True) if a.verdict == verdict)
            assert share == pytest.approx(expected / 10)
        best |= [answer.verdict == "go" for answer in answers]
        assert sum(each.governs.values()) == pytest.approx(1 - each.go)
    assert found.some_robot == pytest.approx(np.array(weights)[best].sum() / 10)
    assert StockStudy.from_json(found.to_json()) == found
    assert [each.go for each in found.robots] == sorted((e.go for e in found.robots), reverse=True)


def test_only_go_keeps_the_share_of_go():
    stock = Stock.drawn({"rise": "140mm..200mm", "going": "230mm..370mm"}, 30, to=0.02)
    robots = ["ozbot-atr", "marmotte"]
    whole, part = (
        stock_study(robots, stock, friction=1.1, go_only=only)[0] for only in (False, True)
    )
    for each in whole.robots:
        other = next(one for one in part.robots if one.robot == each.robot)
        assert (each.go, each.steepest_go_deg) == (other.go, other.steepest_go_deg)
        assert each.rough + each.unsure + each.no_go == pytest.approx(
            other.rough + other.unsure + other.no_go + other.not_go
        )
    assert sum(each.not_go for each in part.robots) > 0


def test_nonsense_is_refused():
    stock = Stock.of_stairs([Stairs.named("ibc")])
    with pytest.raises(InputError, match="no robot: name one"):
        stock_study([], stock)
    with pytest.raises(InputError, match="two robots are called 'kenaf'"):
        stock_study(["kenaf", "kenaf"], stock)


def test_the_command(tmp_path):
    from typer.testing import CliRunner

    from kaidan.cli import app_for

    path = written(tmp_path, "rise,going,count\n0.17,0.29,10\n0.15,0.3,10\n0.2,0.23,3\n")
    words = ["study", "stock", "--robots", "absolem,kenaf", "--stairs", str(path), "--model",
             "closed-form", "--friction", "0.9", "--json", "--scheduler", "threads",
             "--figure", str(tmp_path / "s.png"), "--csv", str(tmp_path / "s.csv"),
             "--table", str(tmp_path / "cells.csv")]  # fmt: skip
    done = CliRunner().invoke(app_for(["study"]), words)
    assert done.exit_code == 0, done.output
    answer = StockStudy.from_json(done.stdout)
    rows = list(csv.DictReader((tmp_path / "s.csv").read_text().splitlines()))
    assert [float(row["go"]) for row in rows] == [each.go for each in answer.robots]
    cells = list(csv.DictReader((tmp_path / "cells.csv").read_text().splitlines()))
    assert len(cells) == 6
    assert {cell["robot"] for cell in cells} == {"absolem", "kenaf"}
    assert "absolem" in str(answer)
    refused = CliRunner().invoke(app_for(["study"]), ["study", "stock", "--robots", "kenaf"])
    assert isinstance(refused.exception, InputError)


def test_many_robots_become_a_curve(tmp_path):
    from kaidan.figures.stock_figure import stock_figure

    base = Robot.named("kenaf")
    fleet = [base.model_copy(update={"name": f"r{k}", "com_height": 0.03 + 0.004 * k})
             for k in range(30)]  # fmt: skip
    stock = Stock.of_stairs([Stairs(rise=0.1, going=0.15), Stairs(rise=0.08, going=0.2)])
    found, _ = stock_study(fleet, stock, **CLOSED)
    assert len(stock_figure(found).axes) == 1
    few = found.model_copy(update={"robots": found.robots[:3]})
    assert len(stock_figure(few).axes) == 2
