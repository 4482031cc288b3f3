"""Who may speak to the studio: nobody without the token, nobody under another name, no page of somebody else's."""

import pytest

from studio.conftest import HOME, PORT, SOCKET, TOKEN, scene

ROUTES = ("/", "/colours.css", "/page/main.js", "/catalogue", "/no-such-thing")


@pytest.mark.parametrize("route", ROUTES)
def test_without_the_token_nothing_is_told(stranger, route):
    answer = stranger.get(route)
    assert answer.status_code == 403
    assert "lacks its token" in answer.text
    assert stranger.get(route, params={"token": "guessed"}).status_code == 403


def test_the_token_is_needed_once(stranger):
    opened = stranger.get("/", params={"token": TOKEN})
    assert opened.status_code == 200
    assert "HttpOnly" in opened.headers["set-cookie"]
    assert "SameSite=Strict" in opened.headers["set-cookie"]
    assert stranger.get("/page/main.js").status_code == 200


def test_cookies_of_other_servers_on_this_machine_do_no_harm(stranger):
    others = 'a={"b": [1, 2]}; ünfinished="; =; ;'.encode().decode("latin-1")
    cookie = f"{others} pathloom-studio-{PORT}={TOKEN}; pathloom-studio-{PORT + 1}=another"
    assert stranger.get("/", headers={"Cookie": cookie.encode("latin-1")}).status_code == 200
    assert stranger.get("/", headers={"Cookie": f"pathloom-studio-{PORT + 1}={TOKEN}"}).status_code == 403


@pytest.mark.parametrize("host", ["evil.example", f"evil.example:{PORT}", "127.0.0.1", f"127.0.0.1:{PORT + 1}", ""])
def test_a_foreign_host_is_refused_even_with_the_token(client, host):
    answer = client.get("/", params={"token": TOKEN}, headers={"Host": host})
    assert answer.status_code == 403
    assert "set-cookie" not in answer.headers


@pytest.mark.parametrize("origin", ["http://evil.example", "null", f"https://127.0.0.1:{PORT}"])
def test_a_foreign_page_is_refused_even_with_the_cookie(client, origin):
    from starlette.websockets import WebSocketDisconnect

    assert client.post("/look", json=scene(), headers={"Origin": origin}).status_code == 403
    with pytest.raises(WebSocketDisconnect), client.websocket_connect(SOCKET, headers={"Origin": origin}):
        pass


def test_the_socket_wants_the_cookie(stranger):
    from starlette.websockets import WebSocketDisconnect

    with pytest.raises(WebSocketDisconnect), stranger.websocket_connect(SOCKET, headers={"Origin": HOME}):
        pass


def test_every_answer_forbids_the_page_all_but_its_own_files(client):
    for route in ROUTES:
        headers = client.get(route).headers
        policy = dict(part.strip().partition(" ")[::2] for part in headers["content-security-policy"].split(";"))
        assert policy["default-src"] == "'none'"
        assert policy["script-src"] == policy["style-src"] == "'self'"
        assert policy["connect-src"] == f"'self' ws://127.0.0.1:{PORT}"
        assert policy["frame-ancestors"] == "'none'"
        assert headers["x-content-type-options"] == "nosniff"
        assert headers["referrer-policy"] == "no-referrer"


@pytest.mark.parametrize("name", ["../app.py", "..%2fapp.py", "%2e%2e/app.py", "app.py", "__init__.py", "/etc/passwd"])
def test_no_file_but_those_of_the_page_is_served(client, name):
    assert client.get(f"/page/{name}").status_code == 404


def test_the_page_refers_to_nothing_elsewhere():
    from pathlib import Path

    import pathloom

    folder = Path(pathloom.__file__).parent / "studio" / "static"
    pages = {path.name: path.read_text(encoding="utf-8") for path in folder.iterdir()}
    assert {"index.html", "style.css", "main.js"} <= pages.keys()
    for name, text in pages.items():
        for address in ("http://", "https://", "//cdn"):
            allowed = text.count("http://www.w3.org/2000/svg") if address == "http://" else 0
            assert text.count(address) == allowed, name
        assert " style=" not in text, name  # the policy forbids it
        assert "eval(" not in text, name
