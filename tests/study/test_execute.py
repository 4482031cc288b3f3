"""The driver: it keeps lanes busy, and no more than that."""

import time
from concurrent.futures import CancelledError, Executor, Future, ThreadPoolExecutor
from concurrent.futures.process import BrokenProcessPool

import pytest

from pathloom.study.execute import execute
from pathloom.study.lanes import Lane
from pathloom.study.worker import Order, Reply, perform


class Script(Executor):
    """Answers each order at once, as a function says: with a reply, or with what is raised."""

    def __init__(self, answer):
        self.answer, self.sent = answer, []

    def submit(self, job, order):
        assert job is perform
        self.sent.append(order)
        future, answer = Future(), self.answer(order, self.sent)
        if isinstance(answer, BaseException):
            future.set_exception(answer)
        else:
            future.set_result(answer)
        return future


class Scripted(Lane):
    """Sends its orders to such an executor, and remembers what else was asked of it."""

    room = 2
    tells_the_culprit = True
    ends_by_force = True

    def __init__(self, pool):
        super().__init__()
        self.pool, self.most, self.renewed, self.stopped = pool, 0, 0, False

    def executor(self):
        return self.pool

    def send(self, order):
        future = super().send(order)
        self.most = max(self.most, len(self.flying))
        return future

    def renew(self):
        self.renewed += 1
        self.flying.clear()

    def stop(self):
        self.stopped = True


def orders(count):
    return [Order("run", "planner", "problem", seed) for seed in range(count)]


def carried_out(script, count=4, lanes=1):
    made = [Scripted(Script(script)) for _ in range(lanes)]
    answers = []
    execute(iter(orders(count)), made, parts=str.encode, record=answers.extend)
    return made, answers


def fine(order, sent):
    return Reply(measures={"status": "found"})


def test_every_order_is_answered_once_and_few_are_under_way():
    lanes, answers = carried_out(fine, count=9, lanes=2)
    assert sorted(order.seed for order, _, _ in answers) == list(range(9))
    assert all(attempts == 1 for _, _, attempts in answers)
    assert max(lane.most for lane in lanes) <= 2


def test_no_lane_has_more_under_way_than_it_has_room_for():
    class Slow(ThreadPoolExecutor):
        def submit(self, job, order):
            return super().submit(lambda: time.sleep(0.002 * (order.seed % 3)) or fine(order, []))

    lanes, answers = [Scripted(Slow(1)), Scripted(Slow(1))], []
    execute(iter(orders(40)), lanes, parts=str.encode, record=answers.extend)
    for lane in lanes:
        lane.pool.shutdown()
    assert [lane.most for lane in lanes] == [2, 2]
    assert sorted(order.seed for order, _, _ in answers) == list(range(40))


def test_orders_are_drawn_only_when_there_is_room():
    drawn = []

    def drawing():
        for order in orders(100):
            drawn.append(order)
            yield order

    def record(answers):
        raise KeyboardInterrupt

    lane = Scripted(Script(fine))
    with pytest.raises(KeyboardInterrupt):
        execute(drawing(), [lane], parts=str.encode, record=record)
    assert len(drawn) == 2
    assert lane.stopped


def test_a_worker_is_told_what_it_does_not_know_and_nothing_else():
    def script(order, sent):
        missing = () if any(o.parts for o in sent) else ("planner", "problem")
        return Reply(missing=missing, measures={} if missing else {"status": "found"})

    (lane,), answers = carried_out(script, count=3)
    told = [order for order in lane.pool.sent if order.parts]
    assert told[0].parts == {"planner": b"planner", "problem": b"problem"}
    assert len(answers) == 3
    assert len(told) <= 2  # those under way when it asked


def test_the_order_that_loses_its_worker_twice_is_set_aside_and_the_other_is_not():
    def script(order, sent):
        return BrokenProcessPool() if order.seed == 0 else fine(order, sent)

    (lane,), answers = carried_out(script, count=3)
    by_seed = {order.seed: (reply.measures["status"], attempts) for order, reply, attempts in answers}
    assert by_seed == {0: ("crashed", 2), 1: ("found", 1), 2: ("found", 1)}
    assert lane.renewed == 2


def test_an_order_that_was_only_waiting_is_not_blamed():
    lost = []

    def script(order, sent):
        if len(lost) < 2:  # both under way are lost with their worker
            lost.append(order.seed)
            return BrokenProcessPool()
        return fine(order, sent)

    _, answers = carried_out(script, count=2)
    assert {order.seed: attempts for order, _, attempts in answers} == {0: 2, 1: 1}


def test_a_cancelled_order_is_sent_again():
    first = []

    def script(order, sent):
        if not first:
            first.append(order)
            return CancelledError()
        return fine(order, sent)

    _, answers = carried_out(script, count=2)
    assert sorted(order.seed for order, _, _ in answers) == [0, 1]


def test_what_check_raises_ends_everything():
    def check():
        raise KeyboardInterrupt

    lane = Scripted(Script(fine))
    with pytest.raises(KeyboardInterrupt):
        execute(iter(orders(5)), [lane], parts=str.encode, record=lambda answers: None, check=check)
    assert lane.stopped
