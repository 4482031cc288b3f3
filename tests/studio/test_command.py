"""The command: one line with the address, and a clean end."""

import json
import re
import signal
import socket
import sys
import urllib.error
import urllib.request

import pytest

from studio.conftest import MISSING, scene

pytest.importorskip("uvicorn", reason=MISSING)


def test_it_prints_its_address_and_answers_there_whoever_has_the_token(studios):
    studio = studios()
    address = studio.stdout.readline()
    assert re.fullmatch(r"http://127\.0\.0\.1:\d+/\?token=[\w-]{32}\n", address)
    with urllib.request.urlopen(address.strip()) as answer:
        assert b"<title>pathloom studio</title>" in answer.read()
    with pytest.raises(urllib.error.HTTPError, match="403"):
        urllib.request.urlopen(address.partition("?")[0])


@pytest.mark.skipif(sys.platform == "win32", reason="on Windows Ctrl-C reaches all of a console, these tests as well")
def test_it_ends_at_ctrl_c_in_the_midst_of_a_run(studios):
    from websockets.sync.client import connect

    studio = studios()
    address = studio.stdout.readline()
    asked = {"scene": scene(), "planner": {"use": "imga"}}
    with connect(address.strip().replace("http", "ws").replace("/?", "/live?")) as page:
        page.send(json.dumps({"type": "begin", "lane": 0, "run": 1, "asked": asked}))
        assert json.loads(page.recv())["type"] == "begun"
        studio.send_signal(signal.SIGINT)  # in the midst of a run, with a page open
        out, err = studio.communicate(timeout=20)
    assert (studio.returncode, out, err) == (0, "", "")


def test_a_port_that_is_taken_is_told_in_one_line(studios):
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = taken.getsockname()[1]
        studio = studios("--port", str(port))
        out, err = studio.communicate(timeout=20)
    assert (studio.returncode, out) == (2, "")
    assert re.fullmatch(rf"pathloom: --port: found {port}, which is not to be had \(.+\); .*\n", err)


def test_without_its_libraries_it_says_what_to_install(monkeypatch, capsys):
    from pathloom.cli import main

    monkeypatch.setitem(sys.modules, "pathloom.studio.serving", None)
    monkeypatch.delitem(sys.modules, "pathloom.studio.serving")
    monkeypatch.setitem(sys.modules, "uvicorn", None)
    monkeypatch.setattr(sys, "argv", ["pathloom", "studio", "--no-browser"])
    with pytest.raises(SystemExit) as left:
        main()
    assert left.value.code == 2
    assert capsys.readouterr().err == "pathloom: studio: needs uvicorn; pip install 'pathloom[studio]'\n"
