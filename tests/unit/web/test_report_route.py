"""Reports over HTTP are those of `kaidan report`."""

import pytest

import kaidan
from kaidan.documents import report_bytes

BODY = {"robot": "kenaf", "stairs": "ibc", "friction": 0.8, "flippers": "stowed"}


@pytest.mark.parametrize("form", ["html", "pdf"])
def test_a_report_is_the_file_of_the_command(client, form):
    answer = client.post("/api/report", json=BODY | {"format": form})
    assert answer.status_code == 200
    assert answer.content == report_bytes(
        kaidan.report("kenaf", "ibc", friction=0.8, flippers="stowed"), form
    )
    assert answer.headers["content-type"].split(";")[0].endswith(form)
    assert answer.headers["content-disposition"] == f'inline; filename="kaidan-report.{form}"'
    assert "script-src" not in answer.headers["content-security-policy"]


def test_several_missions_and_questions_of_answers(client):
    several = client.post(
        "/api/report",
        json={"robots": ["kenaf", "csiro-dtr"], "stairs": ["ibc", "ada"], "format": "json"},
    )
    assert several.text == kaidan.report(["kenaf", "csiro-dtr"], ["ibc", "ada"]).to_json()
    question = client.post("/api/assess", json=BODY).json()["question"]
    again = client.post("/api/report", json={"question": [question], "format": "json"})
    assert again.text == client.post("/api/report", json=BODY | {"format": "json"}).text


@pytest.mark.parametrize(
    ("body", "text"),
    [
        (BODY | {"format": "doc"}, "report: format 'doc' is not known; known: html, pdf, json"),
        (BODY | {"robots": ["kenaf"]}, "report: give robot or robots, not both"),
        ({"stairs": "ibc"}, "report: no robot: give a name of the catalogue or a sheet"),
        ({"robot": "kenaf"}, "report: no stairs: give a name of the catalogue or a sheet"),
        ({"question": [5]}, "question = 5 is not a table"),
        (BODY | {"x": 1}, "report: 'x' is not known"),
        (BODY | {"robot": "../x"}, "no robot is called '../x'"),
    ],
)
def test_refusals(client, body, text):
    answer = client.post("/api/report", json=body)
    assert answer.status_code == 422
    assert text in answer.json()["error"]
