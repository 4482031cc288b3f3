"""Execute: keep all lanes busy, write down what comes back, and lose nothing.

A lost worker is no planner's failure: its order is sent once more. An order
that loses its worker twice is set aside. A planner's exception is its result.
"""

from collections import Counter, deque
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, CancelledError, wait
from typing import Any

from pathloom.study.lanes import Lane
from pathloom.study.worker import Order, Reply

ATTEMPTS = 2
"""Workers that an order may lose before it is set aside."""
TICK = 0.2
"""Seconds after which the driver looks around at the latest."""
LONGEST = 3600.0
"""Seconds after which an order is ended that has no time limit of its own."""

Answer = tuple[Order, Reply, int]
"""An order, what came of it, and how often it was begun."""


def execute(
    orders: Iterable[Order],
    lanes: Sequence[Lane],
    *,
    parts: Callable[[str], bytes],
    record: Callable[[Sequence[Answer]], None],
    longest: float = LONGEST,
    grace: float = 30.0,
    check: Callable[[], None] = lambda: None,
) -> None:
    """Have all orders carried out.

    Parameters
    ----------
    parts
        Gives the planners and problems that orders name.
    record
        Is given the answers, as they come, a few at a time.
    longest
        Seconds after which an order is ended that has no time limit.
    grace
        Seconds that one with a time limit has to stop by itself when that is over.
    check
        Called all the time between two answers; may raise to end everything.
    """
    _Driver(orders, lanes, parts, record, longest, grace, check).drive()


class _Driver:
    def __init__(
        self, orders: Iterable[Order], lanes: Sequence[Lane], parts: Callable[[str], bytes],
        record: Callable[[Sequence[Answer]], None], longest: float, grace: float, check: Callable[[], None],
    ) -> None:  # fmt: skip
        self.orders: Iterator[Order] = iter(orders)
        self.again: deque[Order] = deque()
        self.lanes = lanes
        self.parts, self.record, self.check = parts, record, check
        self.longest, self.grace = longest, grace
        self.lost: Counter[tuple[object, ...]] = Counter()

    def drive(self) -> None:
        try:
            while self._fill():
                flying = [future for lane in self.lanes for future in lane.flying]
                wait(flying, timeout=TICK, return_when=FIRST_COMPLETED)
                self.check()
                answers = [answer for lane in self.lanes for answer in self._collect(lane)]
                if answers:
                    self.record(answers)
        except BaseException:
            for lane in self.lanes:
                lane.stop()
            raise

    def _fill(self) -> bool:
        """Give every lane what it has room for; say whether anything is under way."""
        for round_ in range(max(lane.room for lane in self.lanes)):  # all lanes get one before any gets two
            for lane in self.lanes:
                if len(lane.flying) == round_ and (order := self._next()) is not None:
                    self._send(lane, order)
        return any(lane.flying for lane in self.lanes)

    def _next(self) -> Order | None:
        return self.again.popleft() if self.again else next(self.orders, None)

    def _send(self, lane: Lane, order: Order) -> None:
        if not lane.ends_by_force:
            order = order._replace(patience=self._patience(order))
        while True:
            try:
                lane.send(order)
            except BrokenExecutor:
                if lane.flying:  # looked after when that comes back
                    self._again([order])
                    return
                lane.renew()  # its worker died idle
            else:
                return

    def _patience(self, order: Order) -> float:
        return self.longest if order.time_limit is None else order.time_limit + self.grace

    def _collect(self, lane: Lane) -> Iterator[Answer]:
        """Yield what came back from a lane, and look after it if its worker is lost or does not stop."""
        broken = False
        for future in [future for future in lane.flying if future.done()]:
            order = lane.flying[future]
            try:
                reply: Reply = future.result()
            except (BrokenExecutor, CancelledError):
                broken = True
                continue
            except Exception as error:  # Dask has lost several workers over it
                reply = Reply(measures=_crashed(f"its worker was lost: {type(error).__name__}"))
            lane.answered(future)
            if reply.missing:
                known = {key: self.parts(key) for key in reply.missing}
                self._send(lane, order._replace(parts=known))
            else:
                yield order, reply, self.lost[_key(order)] + 1
        if broken:
            yield from self._recover(lane)
        elif lane.flying and lane.overdue(self._patience(oldest := next(iter(lane.flying.values())))):
            others = list(lane.flying.values())[1:]
            lane.stop()
            self._again(others)
            said = "it did not stop when its time was over, and was ended"
            yield oldest, Reply(measures={"status": "timeout", "error": said}), self.lost[_key(oldest)] + 1

    def _recover(self, lane: Lane) -> Iterator[Answer]:
        """Renew a lane whose worker is lost; yield the order that lost it, if it did so too often."""
        under_way = list(lane.flying.values())
        blamed = under_way[0] if under_way and lane.tells_the_culprit and lane.began() else None
        lane.renew()
        if blamed is not None:
            self.lost[_key(blamed)] += 1
            if self.lost[_key(blamed)] >= ATTEMPTS:
                under_way = under_way[1:]
                said = f"the planner's process ended without an answer, {ATTEMPTS} times"
                yield blamed, Reply(measures=_crashed(said)), ATTEMPTS
        self._again(under_way)

    def _again(self, orders: Iterable[Order]) -> None:
        self.again.extendleft(reversed([_bare(order) for order in orders]))


def _bare(order: Order) -> Order:
    """Return an order without what one worker was told besides."""
    return order._replace(parts={}, patience=None)


def _key(order: Order) -> tuple[object, ...]:
    return order.job, order.variant, order.instance, order.seed


def _crashed(said: str) -> Mapping[str, Any]:
    return {"status": "crashed", "error": said}
