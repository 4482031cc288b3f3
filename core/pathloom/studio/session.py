"""A session: one open page, with up to two runs side by side."""

import asyncio
from contextlib import suppress

import msgspec
from starlette.types import Message
from starlette.websockets import WebSocket, WebSocketDisconnect

from pathloom.studio.lane import Lane
from pathloom.studio.wire import Begin, More, Refused, Said, Stop, encode, heard
from pathloom.studio.workers import Workers


class Session:
    """Hears what a page asks, and lets its lanes answer. When the page goes, so do they."""

    def __init__(self, socket: WebSocket, workers: Workers) -> None:
        self._socket, self._workers = socket, workers
        self._lanes: dict[int, Lane] = {}
        self._speaking = asyncio.Lock()

    async def serve(self) -> None:
        """Answer until the page is closed."""
        try:
            while True:
                await self._hear(await self._socket.receive())
        except WebSocketDisconnect:
            pass
        finally:
            for lane in self._lanes.values():
                lane.stop()

    async def _hear(self, event: Message) -> None:
        if event["type"] == "websocket.disconnect":
            raise WebSocketDisconnect
        text = event.get("text")
        try:
            if not isinstance(text, str):
                raise msgspec.ValidationError("bytes")
            message = heard(text)
        except (msgspec.MsgspecError, RecursionError, UnicodeError) as error:
            said = " ".join(str(error).split())[:300]
            await self._say(Refused("", f"found a message that the studio does not know: {said}"))
            return
        lane = self._lanes.get(message.lane)
        if isinstance(message, Begin):
            if lane is not None:
                lane.stop()
            self._lanes[message.lane] = Lane(message, self._workers, self._say)
        elif isinstance(message, More) and lane is not None and lane.run == message.run:
            lane.more(message.generations)
        elif isinstance(message, Stop) and lane is not None:
            lane.stop()
            del self._lanes[message.lane]

    async def _say(self, message: Said) -> None:
        async with self._speaking:
            with suppress(WebSocketDisconnect, RuntimeError):  # the page went while something was on its way
                await self._socket.send_text(encode(message).decode())
