"""Serving the studio until somebody has seen enough."""

import socket
from collections.abc import Callable

import uvicorn

from pathloom.errors import PathloomError
from pathloom.studio.app import application
from pathloom.studio.security import new_token

HOST = "127.0.0.1"
LARGEST_MESSAGE = 4 * 2**20
"""Bytes of a message over the socket; a longer one closes it."""


def serve(port: int, ready: Callable[[str], None]) -> None:
    """Serve the studio on a port of 127.0.0.1 until it is interrupted; 0 takes a free one.

    ``ready``: called with the address as soon as it answers.

    Raises
    ------
    PathloomError
        If the port is taken, or not to be had.
    """
    try:
        listener = socket.create_server((HOST, port))
    except OSError as error:
        found = f"--port: found {port}, which is not to be had ({error.strerror or error})"
        raise PathloomError(f"{found}; another one, or 0, takes a free one") from error
    with listener:
        port, token = listener.getsockname()[1], new_token()
        config = uvicorn.Config(
            application(port=port, token=token), log_level="error", access_log=False, lifespan="off",
            ws_max_size=LARGEST_MESSAGE, timeout_graceful_shutdown=1, ws_per_message_deflate=False, server_header=False,
        )  # fmt: skip
        ready(f"http://{HOST}:{port}/?token={token}")
        uvicorn.Server(config).run(sockets=[listener])
