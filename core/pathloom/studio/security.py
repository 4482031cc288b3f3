"""Who may speak to the studio: whoever knows its token, from a page of its own, by its own name.

The server listens on 127.0.0.1 only. Beyond that a page of somebody else's must
not reach it through the user's browser:

- the ``Host`` has to be this server's, so that no foreign name can be bound to 127.0.0.1 (DNS rebinding);
- the ``Origin``, where a browser sends one, has to be this server's;
- the token of the address that was printed has to be known. The page's first request brings it, and gets a
  cookie that only this server's own pages send.
"""

import secrets
from urllib.parse import parse_qs

from starlette.datastructures import Headers, MutableHeaders
from starlette.responses import PlainTextResponse
from starlette.types import ASGIApp, Message, Receive, Scope, Send

POLICY = (
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:; connect-src 'self'{socket}; "
    "base-uri 'none'; form-action 'none'; frame-ancestors 'none'"
)
"""Content security policy: nothing but the studio's own files, and its own socket."""

UNKNOWN = (
    "pathloom studio: this address lacks its token. Open the whole address that `pathloom studio` printed; "
    "from then on links with a map in them work as well.\n"
)
FOREIGN = "pathloom studio: found a request under another name or from another page.\n"


def new_token() -> str:
    """Return a token that nobody can guess."""
    return secrets.token_urlsafe(24)


class Guard:
    """Lets through what may pass, and says with every answer what the page may do."""

    def __init__(self, app: ASGIApp, *, port: int, token: str) -> None:
        self._app, self._token = app, token
        self._hosts = (f"127.0.0.1:{port}", f"localhost:{port}")
        self._cookie = f"pathloom-studio-{port}"  # cookies know no port, servers side by side do

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] == "lifespan":
            await self._app(scope, receive, send)
            return
        headers = Headers(scope=scope)
        host, origin = headers.get("host", ""), headers.get("origin")
        if host not in self._hosts or (origin is not None and origin != f"http://{host}"):
            await self._refuse(FOREIGN, scope, receive, send)
        elif self._knows_in_query(scope):
            await self._app(scope, receive, self._speaking(send, host, cookie=True))
        elif self._knows_in_cookie(headers):
            await self._app(scope, receive, self._speaking(send, host))
        else:
            await self._refuse(UNKNOWN, scope, receive, send)

    def _knows_in_query(self, scope: Scope) -> bool:
        given = parse_qs(scope["query_string"].decode("latin-1")).get("token", [""])[0]
        return self._is_token(given)

    def _knows_in_cookie(self, headers: Headers) -> bool:
        # By hand: other servers' cookies, which come along, may be any text, and end http.cookies' reading.
        pairs = (part.strip().partition("=") for part in headers.get("cookie", "").split(";"))
        return any(name == self._cookie and self._is_token(value) for name, _, value in pairs)

    def _is_token(self, given: str) -> bool:
        return secrets.compare_digest(given.encode(), self._token.encode())

    def _speaking(self, send: Send, host: str, *, cookie: bool = False) -> Send:
        async def speak(message: Message) -> None:
            if message["type"] == "http.response.start":
                headers = MutableHeaders(scope=message)
                headers["Content-Security-Policy"] = POLICY.format(socket=f" ws://{host}" if host else "")
                headers["Referrer-Policy"] = "no-referrer"
                headers["X-Content-Type-Options"] = "nosniff"
                headers["Cross-Origin-Opener-Policy"] = "same-origin"
                headers["Cross-Origin-Resource-Policy"] = "same-origin"
                headers["Cache-Control"] = "no-store"
                if cookie:
                    headers.append("Set-Cookie", f"{self._cookie}={self._token}; Path=/; HttpOnly; SameSite=Strict")
            await send(message)

        return speak

    async def _refuse(self, text: str, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] == "websocket":
            await receive()
            await send({"type": "websocket.close", "code": 1008})
            return
        await PlainTextResponse(text, status_code=403)(scope, receive, self._speaking(send, ""))
