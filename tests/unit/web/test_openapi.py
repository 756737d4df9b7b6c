"""The description of the service: from the sheets and answers, and whatever fits it is answered."""

import json
import os
import re

import pytest
import schemathesis
from hypothesis import HealthCheck, Phase, given, settings
from jsonschema import Draft202012Validator

from kaidan.web.asking import VERBS
from kaidan.web.workers import Limits
from serving import served


@pytest.fixture(scope="module")
def described(client):
    return client.get("/api/openapi.json").json()


def test_it_is_openapi_3_1_and_every_reference_leads_somewhere(described):
    assert described["openapi"].startswith("3.1")
    places = set(re.findall(r'"\$ref": "#/components/schemas/([^"]+)"', json.dumps(described)))
    assert places <= described["components"]["schemas"].keys()


@pytest.mark.parametrize("verb", VERBS)
def test_a_verb_takes_its_keywords_and_gives_its_answer(described, verb):
    route = described["paths"][f"/api/{verb}"]["post"]
    body = route["requestBody"]["content"]["application/json"]["schema"]
    assert body["properties"].keys() - {"question"} == VERBS[verb].parameters().keys()
    assert all(each["description"] for each in body["properties"].values())
    given = route["responses"]["200"]["content"]["application/json"]["schema"]["$ref"]
    assert given.endswith(VERBS[verb].answers().__name__)


def test_an_answer_fits_its_description(client, described):
    body = {"robot": "absolem", "stairs": "ibc", "flippers": "flat", "friction": "0.6..1.0"}
    for verb in ("assess", "traverse"):
        answer = client.post(f"/api/{verb}", json=body).json()
        route = described["paths"][f"/api/{verb}"]["post"]
        place = route["responses"]["200"]["content"]["application/json"]["schema"]
        Draft202012Validator({**place, "components": described["components"]}).validate(answer)


def faults(examples, *, only=None):
    """Statuses of 500 and more to what fits the description, with what led to them."""
    worst = []
    with served(limits=Limits(seconds=2.0)) as client:
        schema = schemathesis.openapi.from_dict(client.get("/api/openapi.json").json())
        schema.config.base_url = str(client.base_url)
        for found in schema.get_all_operations():
            operation = found.ok()
            if operation.path.endswith("/events"):
                continue  # lasts as long as its job
            if only and operation.path not in only:
                continue

            @settings(
                max_examples=examples, deadline=None, suppress_health_check=list(HealthCheck),
                phases=[Phase.explicit, Phase.generate],
            )  # fmt: skip
            @given(case=operation.as_strategy())
            def ask(case):
                answer = case.call(timeout=60)
                if answer.status_code >= 500:
                    worst.append((case.path, answer.status_code, answer.text, case.body))

            ask()
    return worst


def test_nothing_that_fits_the_description_is_a_fault():
    assert faults(5, only=("/api/assess", "/api/margin", "/api/jobs")) == []


@pytest.mark.slow
def test_nothing_that_fits_the_description_is_a_fault_in_many_tries():
    assert faults(int(os.environ.get("KAIDAN_EXAMPLES", "100"))) == []
