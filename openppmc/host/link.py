"""Connection to a board through a port: wake-up, identity, line rate, scripts, events."""

from __future__ import annotations

from collections.abc import Callable
from types import TracebackType
from typing import Protocol

from .capabilities import name_of
from .errors import (
    Disconnected,
    LinkError,
    NoAnswer,
    PortError,
    ProtocolError,
    Timeout,
    WrongDevice,
    command_error,
)
from .frames import WAKE_UP, Nak, RetriesExhausted, Session
from .port import BASE_BAUD, Port, open_port
from .script import PROTOCOL_VERSION, RATES, Answer, BadAnswer, Build, Identity, Result, Script, parse_answer

DEFAULT_BAUD = 1_000_000
MARGIN = 0.3
"""Time in s after which a request without an answer is repeated.

USB adapters and busy computers need this time. The link adds the transmission time on the line and the waits
of the script.
"""
_SETTLE = 0.02
_QUIET = 0.05
_BITS = 10
_READS = 2
"""Largest number of times that a script is sent until an answer matches it."""
_MISMATCH = "package and bitstream do not fit together: renew the older one"


class LinkProtocol(Protocol):
    """Members of a link that the driver of an axis needs; see `Link`."""

    @property
    def name(self) -> str: ...
    @property
    def identity(self) -> Identity: ...
    def clock(self) -> float: ...
    def pause(self, seconds: float) -> None: ...
    def close(self) -> None: ...
    def execute(self, script: Script) -> Answer: ...
    def check_answer(self, answer: Answer) -> Answer: ...
    def attempt(self, script: Script) -> Answer: ...
    def wait_event(self, timeout: float) -> int | None: ...
    def forget_events(self) -> None: ...


class Link:
    """Connection to a bridge at the selected line rate. A link is a context manager.

    Attributes:
        spec: device path, `sim:…` or `model:…`.
        baud: one of the line rates of the bridge (115200 to 3000000). If board or adapter does not support
            this rate, the link works at 115200.
        part: number that the part must have, `None` for any.

    Raises:
        PortError, NoAnswer, WrongDevice, Disconnected: the connection failed.
    """

    def __init__(self, spec: str | Port, baud: int = DEFAULT_BAUD, part: int | None = None) -> None:
        if baud not in RATES:
            raise PortError(f"{baud} baud is not a rate of the bridge: it has {', '.join(map(str, RATES))}")
        self.port = open_port(spec) if isinstance(spec, str) else spec
        self.baud = BASE_BAUD
        self.refusal: Callable[[Answer], Exception] = lambda answer: command_error(answer.last)
        """Creates the exception for a rejected command.

        Drivers of parts with other error numbers replace this function.
        """
        self._session = Session()
        self._closed = False
        try:
            self.identity = self._identify()
            self._check(part)
            if baud != BASE_BAUD:
                self._raise_rate(baud)
            self.execute(Script().events(True))
        except BaseException:
            self.port.close()
            raise

    @property
    def name(self) -> str:
        """Port as the user named it."""
        return self.port.name

    @property
    def repeats(self) -> int:
        """Number of requests repeated since the link was opened."""
        return self._session.repeats

    def clock(self) -> float:
        """Return the time of the port in s; the time of `model:` is virtual."""
        return self.port.clock()

    # ------------------------------------------------------------------ opening and closing

    def _identify(self) -> Identity:
        """Wake the bridge up at 115 200 baud and read its identity."""
        received = 0
        for _ in range(3):
            self.port.write(WAKE_UP)
            received += self._drain()
            self._session.restart()
            try:
                return Identity.parse(self._run(Script().ident(), attempts_margin=MARGIN).values[0])
            except NoAnswer as error:
                received += error.args[1] if len(error.args) > 1 else 0
            except BadAnswer as error:
                raise WrongDevice(
                    f"{self.name}: the device that answers is no PPMC bridge ({error}): check the port"
                ) from error
        if received:
            raise WrongDevice(
                f"{self.name}: {received} bytes received, but no answer of a PPMC bridge: check the port, "
                f"and that the board's UART starts at {BASE_BAUD} baud"
            )
        raise NoAnswer(
            f"{self.name}: no answer: is the board powered and its bitstream loaded, are TXD and RXD crossed?"
        )

    def _drain(self) -> int:
        """Discard received bytes until the line is idle, for a limited time; return their number."""
        received = 0
        end = self.clock() + 10 * _QUIET
        while (data := self.port.read(_QUIET)) and self.clock() < end:
            received += len(data)
        # The wake-up itself may cause two NAKs, 16 bytes at most. They are not counted.
        return max(0, received - 16)

    def _check(self, part: int | None) -> None:
        identity = self.identity
        if identity.version != PROTOCOL_VERSION:
            newer = "this package" if identity.version > PROTOCOL_VERSION else "the board's bitstream"
            raise WrongDevice(
                f"{self.name}: the bridge speaks protocol version {identity.version}, this package "
                f"{PROTOCOL_VERSION}: renew {newer}"
            )
        if part is not None and identity.part != part:
            raise WrongDevice(
                f"{self.name}: the part is a {name_of(identity.part)}, not a {name_of(part)}: "
                "name the right one with --part, or use its own driver"
            )

    def build(self) -> Build | None:
        """Return the build of the bitstream; `None` if the bitstream does not report it or is too old."""
        answer = self.attempt(Script().version())
        return Build.parse(answer.values[0]) if answer.result is Result.DONE else None

    def use_rate(self, baud: int) -> bool:
        """Switch to another line rate of RATES; return True if board and adapter support it.

        Otherwise return False; the link then works at 115200.
        """
        if baud != self.baud:
            self._raise_rate(baud)
            if self.baud == baud:
                self.execute(Script().events(True))
        return self.baud == baud

    def _raise_rate(self, baud: int) -> None:
        """Switch to another line rate if board and adapter support it.

        Otherwise return to 115 200 baud.
        """
        if RATES.index(baud) > self.identity.best_rate:
            return
        try:
            self._request_rate(Script().rate(RATES.index(baud)))
            self.port.read(_SETTLE)
            self.port.set_baud(baud)
            self.baud = baud
            Identity.parse(self._run(Script().ident(), attempts_margin=0.1).values[0])
        except (NoAnswer, PortError, ProtocolError, BadAnswer):
            self.baud = BASE_BAUD
            self.port.set_baud(BASE_BAUD)
            self.identity = self._identify()

    def _request_rate(self, script: Script) -> None:
        """Execute the operation RATE.

        If the answer is lost, the bridge may already use the new rate. Then a wake-up returns it to 115 200
        baud, and the operation is executed again.
        """
        try:
            self.execute(script)
        except (NoAnswer, ProtocolError):
            self.identity = self._identify()
            self.execute(script)

    def close(self) -> None:
        """Switch events off, return to 115 200 baud and close the port.

        The call never raises an exception, and may be called twice.
        """
        if self._closed:
            return
        self._closed = True
        try:
            if not self._session.busy:
                self._run(Script().events(False).rate(0), attempts_margin=0.1)
        except (LinkError, BadAnswer):
            pass
        finally:
            self.port.close()

    def __enter__(self) -> Link:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    # ------------------------------------------------------------------ scripts

    def execute(self, script: Script) -> Answer:
        """Execute a script completely.

        Raises:
            CommandRefused: the part rejected a command.
            Timeout: a wait of the script exceeded its time limit.
            ProtocolError: the answer is invalid.
            NoAnswer, Disconnected: the link failed.
        """
        return self.check_answer(self.attempt(script))

    def check_answer(self, answer: Answer) -> Answer:
        """Return the answer if all operations were executed, otherwise raise the exceptions of `execute`."""
        if answer.result is Result.DONE:
            return answer
        if answer.result is Result.REFUSED:
            raise self.refusal(answer)
        where = f"{self.name}: {answer.failed.name if answer.failed else 'script'}"
        if answer.result is Result.TIMED_OUT:
            raise Timeout(
                f"{where}: the part did not react in time (it reads {answer.last:#04x}): is it in reset?"
            )
        if answer.result is Result.INTERRUPTED:
            raise ProtocolError(f"{where}: a wait was cut short by noise on the line: try again")
        raise ProtocolError(f"{where}: refused (result {int(answer.result)}): {_MISMATCH}")

    def attempt(self, script: Script) -> Answer:
        """Execute a script and return its answer for any result. Raises only LinkErrors."""
        if self._closed:
            raise Disconnected(f"{self.name}: the link is closed: open it again")
        try:
            return self._run(script)
        except BadAnswer as error:
            raise ProtocolError(f"{self.name}: bad answer ({error}): {_MISMATCH}") from error

    def _run(self, script: Script, attempts_margin: float = MARGIN) -> Answer:
        session, port = self._session, self.port
        line_time = (len(bytes(script)) + script.response_size + 24) * 2 * _BITS / self.baud
        patience = script.patience + line_time + attempts_margin
        busy = session.busy
        try:
            request = session.request(bytes(script), patience, self.clock())
            for left in reversed(range(_READS)):
                port.write(request)
                body = self._await()
                try:
                    return parse_answer(script, body)
                except BadAnswer:
                    if not left:
                        raise
                # If a last byte 00 of an answer is lost or doubled, the CRC may still be valid.
                request = session.repeat(self.clock())
            raise AssertionError
        finally:
            # A signal handler may raise an exception at any call, so a request is cancelled without a call.
            if not busy:
                session.outstanding = None

    def _await(self) -> bytes:
        """Return the answer to the outstanding request.

        The request is repeated until its attempts are used up.
        """
        session, port = self._session, self.port
        while True:
            deadline = session.deadline
            assert deadline is not None
            data = port.read(max(0.0, deadline - self.clock()))
            body = session.receive(data, self.clock())
            if body is not None:
                return body
            try:
                again = session.tick(self.clock())
            except RetriesExhausted as gone:
                raise NoAnswer(_silence(self.name, gone), gone.received) from gone
            if again:
                port.write(again)

    # ------------------------------------------------------------------ events

    def wait_event(self, timeout: float) -> int | None:
        """Return the pin byte of the next event (UB-MSG-01).

        The call returns None after `timeout` seconds without an event.
        """
        session = self._session
        end = self.clock() + timeout
        while not session.events:
            left = end - self.clock()
            if left <= 0:
                return None
            session.receive(self.port.read(left), self.clock())
        return session.events.popleft()

    def forget_events(self) -> None:
        """Discard the events received so far."""
        self._session.events.clear()

    def pause(self, seconds: float) -> None:
        """Wait for a number of seconds, measured with the clock of the port; keep received events."""
        end = self.clock() + seconds
        while (left := end - self.clock()) > 0:
            self._session.receive(self.port.read(left), self.clock())


def _silence(name: str, gone: RetriesExhausted) -> str:
    """Return the error message for a request that had no answer in any attempt."""
    if gone.naks:
        reason = Nak(gone.naks[-1]).name.lower().replace("_", " ") if gone.naks[-1] in set(Nak) else "unknown"
        return (
            f"{name}: the bridge could not read any of {gone.attempts} requests (last complaint: {reason}): "
            "check the cable and ground, or use a lower --baud"
        )
    if gone.received:
        received, attempts = gone.received, gone.attempts
        return (
            f"{name}: {received} bytes received, but no answer in {attempts} attempts: check rate and device"
        )
    return f"{name}: no answer in {gone.attempts} attempts: is the board still powered and connected?"
