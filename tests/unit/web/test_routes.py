"""The service's answers are those of the commands; what is refused says why."""

import json

import pytest

import kaidan
from kaidan.cli import run


def test_an_answer_is_the_json_of_the_command(client, capsys):
    body = {"robot": "absolem", "stairs": "ibc", "flippers": "flat", "surface": "concrete-dry"}
    answer = client.post("/api/assess", json=body)
    assert answer.status_code == 200
    run(["assess", "absolem", "ibc", "--flippers", "flat", "--surface", "concrete-dry", "--json"])
    assert answer.text == json.dumps(json.loads(capsys.readouterr().out))


def test_a_question_may_be_asked_again_with_a_change(client):
    body = {"robot": "absolem", "stairs": "ibc", "flippers": "flat", "friction": 0.8}
    first = client.post("/api/assess", json=body).json()
    again = client.post("/api/assess", json={"question": first["question"], "friction": 1.1})
    assert again.json() == client.post("/api/assess", json=body | {"friction": 1.1}).json()


def test_the_words_are_those_of_the_command(client):
    body = {"robot": "kenaf", "stairs": "ibc", "friction": 0.8}
    said = client.post("/api/text/assess", json=body).json()
    answer = kaidan.assess("kenaf", "ibc", friction=0.8)
    assert said == {"text": str(answer), "short": answer.short()}


def test_the_catalogue_has_every_name_and_each_whole_sheet(client):
    found = client.get("/api/catalogue").json()
    assert {"name": "kenaf", "title": kaidan.Robot.named("kenaf").title} in found["robots"]
    unweighed = {each["name"] for each in found["robots"] if each.get("unweighed")}
    assert "talon" in unweighed
    for each in found["robots"]:
        has_range = kaidan.Robot.named(each["name"]).com_range is not None
        assert (each["name"] in unweighed) == has_range
    sheet = client.get("/api/catalogue/stairs/ibc").json()
    assert sheet == json.loads(kaidan.Stairs.named("ibc").to_json())
    assert client.get("/api/catalogue/stairs/nowhere").json()["kind"] == "not-found"


@pytest.mark.parametrize(
    ("body", "text"),
    [
        ({"robot": "/etc/passwd", "stairs": "ibc"}, "no robot is called '/etc/passwd'"),
        ({"robot": "kenaf", "stairs": "ibc", "frictoin": 1}, "did you mean friction?"),
        ({"robot": "kenaf"}, "assess: no stairs"),
        ({"robot": "kenaf", "stairs": {"rise": 180, "going": 0.28}}, "in millimetres"),
        ({"robot": "kenaf", "stairs": {"angle": 0.5, "nosing_spacing": 0.3, "x": 1}}, "'x'"),
    ],
    ids=["path", "keyword", "missing", "unit", "shape"],
)
def test_what_has_no_meaning_is_refused_in_words(client, body, text):
    answer = client.post("/api/assess", json=body)
    assert answer.status_code == 422
    assert answer.json()["kind"] == "input"
    assert text in answer.json()["error"]
