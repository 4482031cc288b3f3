"""The studio's routes: the page and its files, four questions, and the socket."""

from collections.abc import Awaitable, Callable
from importlib.resources import files
from mimetypes import guess_type
from typing import Any, TypeVar

import msgspec
from starlette.applications import Starlette
from starlette.requests import Request
from starlette.responses import PlainTextResponse, Response
from starlette.routing import Route, WebSocketRoute
from starlette.types import ASGIApp
from starlette.websockets import WebSocket

from pathloom.draw.colours import DARK, LIGHT, Theme
from pathloom.errors import PathloomError
from pathloom.kernel.registry import default_registry
from pathloom.studio.forms import catalogue
from pathloom.studio.saving import saved
from pathloom.studio.scene import look_at, named_map, read_files, refusal
from pathloom.studio.security import Guard
from pathloom.studio.session import Session
from pathloom.studio.wire import Asked, Files, Named, Scene, encode
from pathloom.studio.workers import Workers

LARGEST_REQUEST = 48 * 2**20
"""Bytes of a request: a map's files in base64."""
MOST_PAGES = 16
"""Pages that may be open at once."""

Question = TypeVar("Question")
PAGE = {path.name: path for path in files("pathloom.studio").joinpath("static").iterdir() if path.is_file()}
"""The files of the page, by name: nothing else can be asked for."""
TYPES = {".js": "text/javascript", ".css": "text/css", ".html": "text/html", ".svg": "image/svg+xml"}


def application(*, port: int, token: str) -> ASGIApp:
    """Return the studio as it listens on a port of 127.0.0.1, for whoever knows the token."""
    studio = _Studio()
    routes = [
        Route("/", _index),
        Route("/colours.css", _colours),
        Route("/page/{name}", _named_file),
        Route("/catalogue", studio.catalogue),
        Route("/look", studio.answering(Scene, look_at), methods=["POST"]),
        Route("/map", studio.answering(Named, named_map), methods=["POST"]),
        Route("/files", studio.answering(Files, read_files), methods=["POST"]),
        Route("/config", studio.answering(Asked, saved), methods=["POST"]),
        WebSocketRoute("/live", studio.live),
    ]
    return Guard(Starlette(routes=routes), port=port, token=token)


class _Studio:
    """What the routes share."""

    def __init__(self) -> None:
        self._workers, self._questions, self._open = Workers(), Workers(), 0
        self._catalogue: bytes | None = None

    async def catalogue(self, _: Request) -> Response:
        """Answer with all forms; they are the same for as long as the server runs."""
        if self._catalogue is None:
            found = await self._questions.do(lambda: catalogue(default_registry()))
            self._catalogue = encode(found)
        return _json(self._catalogue)

    def answering(
        self, asked: type[Question], answer: Callable[[Question], Any]
    ) -> Callable[[Request], Awaitable[Response]]:
        """Return a route that reads one question from the body; what is wrong with it is told in one line."""

        async def route(request: Request) -> Response:
            body = bytearray()
            async for chunk in request.stream():
                body += chunk
                if len(body) > LARGEST_REQUEST:
                    return _refused(PathloomError(f"map: found more than {LARGEST_REQUEST} bytes"), 413)
            try:
                question = msgspec.json.decode(bytes(body), type=asked)
                return _json(encode(await self._questions.do(lambda: answer(question))))
            except (PathloomError, msgspec.MsgspecError, RecursionError, UnicodeError) as error:
                return _refused(error, 422)
            except MemoryError:
                return _refused(PathloomError("map: found too little memory for it"), 422)

        return route

    async def live(self, socket: WebSocket) -> None:
        """Serve one open page."""
        await socket.accept()
        if self._open >= MOST_PAGES:
            await socket.close(1013, f"{MOST_PAGES} pages are open already")
            return
        self._open += 1
        try:
            await Session(socket, self._workers).serve()
        finally:
            self._open -= 1


def _json(content: bytes) -> Response:
    return Response(content, media_type="application/json")


def _refused(error: Exception, status: int) -> Response:
    return Response(encode(refusal(error)), status, media_type="application/json")


def _file(name: str) -> Response:
    path = PAGE.get(name)
    if path is None:
        return PlainTextResponse("no such file\n", 404)
    kind = TYPES.get(f".{name.rpartition('.')[2]}") or guess_type(name)[0]
    return Response(path.read_bytes(), media_type=kind)


async def _index(_: Request) -> Response:
    return _file("index.html")


async def _named_file(request: Request) -> Response:
    return _file(request.path_params["name"])


async def _colours(_: Request) -> Response:
    """Answer with the colours of all pathloom's pictures as custom properties."""
    light, dark = _properties(LIGHT), _properties(DARK)
    css = (
        f":root {{ color-scheme: light; {light} }}\n"
        f"@media (prefers-color-scheme: dark) {{ :root {{ color-scheme: dark; {dark} }} }}\n"
        f":root[data-theme='light'] {{ color-scheme: light; {light} }}\n"
        f":root[data-theme='dark'] {{ color-scheme: dark; {dark} }}\n"
    )
    return Response(css, media_type="text/css")


def _properties(theme: Theme) -> str:
    return " ".join(f"--{name}: {colour};" for name, colour in vars(theme).items())
