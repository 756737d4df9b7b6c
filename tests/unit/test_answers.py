"""The base of all answers: made, written, read back, shown."""

import sys
from types import ModuleType

import jsonschema
import numpy as np
import pytest
from pydantic import ValidationError

import kaidan
from kaidan.answer import Answer, Part, meanings
from kaidan.errors import InputError


class Phase(Part):
    """A part."""

    name: str
    margin_deg: float | None
    """Smallest margin [deg]."""


class Reach(Answer):
    """How far something reaches."""

    text_module = "kaidan.text.reach"
    robot: str
    """Its name."""
    reach_m: float | None
    force: float | None = None
    """Force at its end [N]."""
    places: tuple[float | None, ...] = ()
    phases: tuple[Phase, ...] = ()
    by_name: dict[str, Phase | None]


@pytest.fixture
def reach():
    return Reach(
        robot="kenaf <b>",
        reach_m=float("nan"),
        force=np.float64(2.5),
        places=np.array([1.0, np.inf, 3.0]),
        phases=(Phase(name="enter", margin_deg=np.nan), Phase(name="land", margin_deg=2.0)),
        by_name={"enter": Phase(name="enter", margin_deg=-1.0), "land": None},
    )


@pytest.fixture
def words(monkeypatch):
    module = ModuleType("kaidan.text.reach")
    module.text = lambda answer: f"{answer.robot} reaches\nfar"
    monkeypatch.setitem(sys.modules, "kaidan.text.reach", module)


def test_what_is_no_number_is_none_in_the_object_and_null_in_its_json(reach):
    assert reach.reach_m is None
    assert reach.places == (1.0, None, 3.0)
    assert reach.phases[0].margin_deg is None
    assert reach.to_dict()["places"] == [1.0, None, 3.0]
    assert '"reach_m": null' in reach.to_json()


def test_read_back_it_is_equal(reach):
    assert Reach.from_json(reach.to_json()) == reach
    assert Reach.model_validate(reach.to_dict()) == reach


def test_its_schema_fits_it_and_carries_the_meanings(reach):
    schema = Reach.json_schema()
    jsonschema.validate(reach.to_dict(), schema)
    assert schema["properties"]["force"]["description"] == "Force at its end [N]."
    assert schema["additionalProperties"] is False


def test_meanings_are_inherited_and_need_no_file():
    class Farther(Reach):
        """A farther reach."""

        reach_m: float | None
        """As far as it goes [m]."""

    found = meanings(Farther)
    assert found["reach_m"] == "As far as it goes [m]."
    assert found["force"] == "Force at its end [N]."
    assert found["places"] == ""
    typed = {"__name__": "typed"}
    exec("from kaidan.answer import Part\nclass Typed(Part):\n    x: int\n    'Far.'", typed)
    assert meanings(typed["Typed"]) == {"x": ""}
    assert "description" not in typed["Typed"].model_json_schema()["properties"]["x"]


def test_it_is_frozen_and_knows_no_other_field(reach):
    with pytest.raises(ValidationError):
        reach.robot = "x"
    with pytest.raises(ValidationError):
        Reach(robot="x", reach_m=1.0, colour="red")


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("{", "no Reach: it is not JSON: EOF while parsing an object at line 1 column 1"),
        ('{"robot": "x", "by_name": {}}', "no Reach: reach_m is missing"),
        (
            '{"robot": 3, "reach_m": 1, "by_name": {}}',
            "no Reach: robot is not a text",
        ),
        (
            '{"robot": "x", "reach_m": 1, "by_name": {}, "phases": [{"name": 2}]}',
            "no Reach: phases.0.name is not a text",
        ),
    ],
)
def test_what_is_no_such_answer_is_refused_in_one_line(text, said):
    with pytest.raises(InputError) as refused:
        Reach.from_json(text)
    assert str(refused.value) == said


def test_its_text_is_that_of_its_module(reach, words):
    assert str(reach) == "kenaf <b> reaches\nfar"
    assert repr(reach) == "<Reach: kenaf <b> reaches>"


def test_its_table_has_name_value_and_unit_of_every_field(reach):
    table = reach._repr_html_()
    assert "<tr><td>robot</td><td>kenaf &lt;b&gt;</td><td></td></tr>" in table
    assert "<tr><td>reach_m</td><td>-</td><td>m</td></tr>" in table
    assert "<tr><td>force</td><td>2.5</td><td>N</td></tr>" in table
    assert "<tr><td>phases[1].margin_deg</td><td>2</td><td>deg</td></tr>" in table
    assert "<tr><td>by_name.enter.margin_deg</td><td>-1</td><td>deg</td></tr>" in table
    assert "<tr><td>places</td><td>1, -, 3</td><td></td></tr>" in table


def test_long_lists_are_cut_in_the_table():
    long = Reach(robot="x", reach_m=1.0, places=np.arange(20.0), by_name={})
    assert "0, 1, 2, 3, 4, 5, 6, 7, … (20 in all)" in long._repr_html_()
    phases = [Phase(name=str(index), margin_deg=1.0) for index in range(20)]
    table = Reach(robot="x", reach_m=1.0, phases=phases, by_name={})._repr_html_()
    assert "<td>phases[7].name</td>" in table
    assert "<td>phases[8].name</td>" not in table
    assert "<tr><td>phases[...]</td><td>20 in all</td><td></td></tr>" in table


def test_the_question_in_a_table_shows_sheets_by_their_names():
    table = kaidan.assess("kenaf", "ibc", friction=1.0)._repr_html_()
    assert "<tr><td>question.robot</td><td>kenaf</td><td></td></tr>" in table
    assert "<tr><td>question.direction</td><td>up</td><td></td></tr>" in table
    table = kaidan.traverse("kenaf", "ibc")._repr_html_()
    assert "<td>(-2, 0), (0, 0), (0, 0.178), " in table


@pytest.mark.parametrize(
    "terrain",
    ["ibc", "ibc+ada", kaidan.Profile.of_points([(-2, 0), (0, 0), (0, 0.178), (2, 0.178)])],
    ids=["stairs", "flights", "profile"],
)
def test_a_question_and_its_answer_read_back_are_equal(terrain):
    question = kaidan.Question.of("absolem", terrain, friction=(0.6, 1.0), flippers="20deg,-5deg")
    answer = kaidan.assess(question)
    assert kaidan.Question.model_validate_json(question.model_dump_json()) == question
    assert kaidan.Assessment.from_json(answer.to_json()) == answer
