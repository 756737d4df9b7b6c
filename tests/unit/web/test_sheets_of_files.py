"""What the page takes from a file: sheets that a question takes as they are."""

import pytest

import kaidan

HOUSE = "docs/_static/house.ifc"
PROFILE = "0,0\n1,0\n1,0.18\n1.28,0.18\n1.28,0.36\n3,0.36\n"  # two steps of 180/280 mm


def sent(client, content):
    return client.post("/api/sheets", files={"file": ("a file", content)})


def test_a_sheet_in_toml_is_taken_as_it_is(client):
    kenaf = kaidan.Robot.named("kenaf")
    found = sent(client, kenaf.to_toml().encode()).json()
    assert found["robots"] == [kenaf.model_dump(mode="json")]
    ibc = kaidan.Stairs.named("ibc")
    assert sent(client, ibc.to_toml().encode()).json()["stairs"] == [ibc.model_dump(mode="json")]


def test_a_table_of_points_becomes_a_profile(client):
    (profile,) = sent(client, PROFILE.encode()).json()["stairs"]
    body = {"robot": "kenaf", "stairs": profile, "friction": 1.0}
    answer = client.post("/api/assess", json=body).json()
    assert answer["question"]["terrain"]["name"] == "profile"


def test_flights_of_a_building_model_become_stairs(client, pytestconfig):
    pytest.importorskip("ifcopenshell")
    found = sent(client, (pytestconfig.rootpath / HOUSE).read_bytes()).json()
    flights = found["stairs"][0]
    assert (flights[0]["rise"], flights[0]["going"], flights[0]["steps"]) == (0.15, 0.3, 10)
    body = {"robot": "kenaf", "stairs": flights, "friction": 1.0}
    assert client.post("/api/assess", json=body).json()["verdict"] != "outside-model"


@pytest.mark.parametrize("content", [b"hello", b"a = " + b"[" * 20_000], ids=["text", "deep"])
def test_what_is_no_known_file_is_refused_in_words(client, content):
    answer = sent(client, content)
    assert answer.status_code == 422
    assert "no known format" in answer.json()["error"]


def test_a_pose_map_is_of_one_posture(client):
    body = {"robot": "absolem", "stairs": "ibc", "flippers": "flat", "friction": 1.0}
    found = client.post("/api/pose-map", json=body).json()
    assert (len(found["x_m"]), len(found["inclination_deg"])) == (211, 91)
    refused = client.post("/api/pose-map", json=body | {"flippers": "best"})
    assert "of one posture" in refused.json()["error"]
