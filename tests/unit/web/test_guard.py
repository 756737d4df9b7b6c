"""Who may ask: host, origin, token, and the headers of every response."""

import time

import httpx
import pytest

from kaidan.errors import InputError
from kaidan.web.server import token_for
from serving import served

QUESTION = {"robot": "kenaf", "stairs": "ibc", "friction": 1.0}


def test_every_response_has_the_headers_that_keep_a_page_to_itself(client):
    for answer in (client.get("/"), client.get("/api/catalogue"), client.get("/api/nothing")):
        policy = answer.headers["content-security-policy"]
        assert "default-src 'none'" in policy
        assert "unsafe" not in policy
        assert "//" not in policy
        assert answer.headers["x-content-type-options"] == "nosniff"
        assert answer.headers["referrer-policy"] == "no-referrer"
    assert client.get("/api/catalogue").headers["cache-control"] == "no-store"
    assert "server" not in client.get("/").headers


@pytest.mark.parametrize("host", ["evil.example", "127.0.0.1.evil.example", "10.0.0.1", ""])
def test_another_name_of_the_server_is_refused(client, host):
    """A name that was made to lead here after the page was loaded (DNS rebinding)."""
    answer = client.get("/api/catalogue", headers={"host": host})
    assert answer.status_code in (400, 421)


def test_its_own_names_are_known(client):
    port = client.base_url.port
    for host in (f"localhost:{port}", f"127.0.0.1:{port}", f"[::1]:{port}", "LOCALHOST"):
        assert client.get("/api/catalogue", headers={"host": host}).status_code == 200


@pytest.mark.parametrize("origin", ["http://evil.example", "null", "http://127.0.0.1:1"])
def test_a_page_of_elsewhere_cannot_post(client, origin):
    answer = client.post("/api/assess", json=QUESTION, headers={"origin": origin})
    assert answer.status_code == 403
    assert answer.json()["kind"] == "origin"


def test_an_origin_that_is_none_is_said_to_be_none(client):
    for method in ("GET", "POST"):
        answer = client.request(method, "/api/catalogue", headers={"origin": "http://["})
        assert answer.status_code == 400
        assert answer.json()["kind"] == "origin"


def test_its_own_page_can_post(client):
    origin = str(client.base_url).rstrip("/")
    assert client.post("/api/assess", json=QUESTION, headers={"origin": origin}).status_code == 200


def test_a_form_of_elsewhere_is_no_question(client):
    """Browsers send text/plain anywhere without a question before it."""
    answer = client.post("/api/assess", content=b"{}", headers={"content-type": "text/plain"})
    assert answer.status_code == 415
    assert answer.json() == {"error": "send application/json", "kind": "input"}


def test_a_token_is_demanded_everywhere_and_kept_by_a_browser():
    with served(token="secret-word") as client:
        for place in ("/", "/api/catalogue", "/api/openapi.json", "/api/jobs"):
            assert client.get(place).status_code == 401
            assert client.get(place, params={"token": "secret"}).status_code == 401
        assert client.post("/api/assess", json=QUESTION).status_code == 401
        bearer = {"authorization": "Bearer secret-word"}
        assert client.post("/api/assess", json=QUESTION, headers=bearer).status_code == 200
        led = client.get("/", params={"token": "secret-word"})
        assert led.status_code == 303
        assert led.headers["location"] == "/"
        cookie = led.headers["set-cookie"].lower()
        assert "httponly" in cookie
        assert "samesite=strict" in cookie
        assert client.get("/").status_code == 200
        address = str(client.base_url).rstrip("/")
        elsewhere = httpx.get(f"{address}//evil.example/?token=secret-word")
        assert elsewhere.headers["location"] == "/evil.example/"
        for odd in ("a{b}=1", "a b=1", "=;=", "expires=1"):  # of another server of this name
            kept = {"cookie": f"{odd}; kaidan_token=secret-word"}
            assert httpx.get(address, headers=kept).status_code == 200
            assert httpx.get(address, headers={"cookie": odd}).status_code == 401
        with httpx.Client(base_url=client.base_url) as other:
            odd = {"authorization": "Bearer ü".encode()}
            assert other.get("/", headers=odd).status_code == 401


def test_a_wrong_token_is_answered_late_and_a_right_one_at_once():
    with served(token="secret-word") as client:
        took = []
        for token in ("secret-work", "secret-word"):
            began = time.monotonic()
            client.get("/api/catalogue", headers={"authorization": f"Bearer {token}"})
            took.append(time.monotonic() - began)
    assert took[0] > 1.0 > took[1]


@pytest.mark.parametrize(
    ("host", "stated", "length"),
    [("127.0.0.1", None, 0), ("127.0.0.1", "short", 5), ("0.0.0.0", None, 32),
     ("::", "", 32), ("tablet", "sixteen-letters!", 16)],
)  # fmt: skip
def test_a_token_for_others_is_long(host, stated, length):
    assert len(token_for(host, stated)) == length
    assert token_for(host, stated) != token_for(host, stated) or stated or not length


def test_a_short_token_for_others_is_refused():
    with pytest.raises(InputError, match="--token has 15 characters: at tablet it needs 16;"):
        token_for("tablet", "fifteen-letters")
