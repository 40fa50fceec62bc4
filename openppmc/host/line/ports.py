"""Ports of a line with several stations: anything pyserial opens, the modelled line (`model:`), one in a
process of its own (`sim:`)."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from ..basis.errors import PortError
from ..ports.transport import MODEL, SIM, Port, SerialPort, SimPort, describe_ports

if TYPE_CHECKING:
    import serial
    from serial.rs485 import RS485Settings

SIM_PATIENCE = 0.25
"""The virtual line answers through two processes."""
_SHORT, _LONGEST = 0.05, 30.0


class UrlPort(SerialPort):
    """A device or URL through pyserial. rs485: how RTS switches the driver, None: it does not."""

    def __init__(self, spec: str, baud: int, rs485: RS485Settings | None = None) -> None:
        self._rs485 = rs485
        super().__init__(spec, baud)

    def _open(self, path: str, baud: int) -> serial.SerialBase:
        import serial

        own = {} if "://" in path else {"exclusive": True}
        port = serial.serial_for_url(path, baud, timeout=self.SLICE, write_timeout=2, **own)
        if self._rs485 is not None:
            try:
                port.rs485_mode = self._rs485
            except (OSError, ValueError, NotImplementedError, AttributeError) as error:
                port.close()
                raise PortError(
                    f"{path}: this port cannot switch a driver by RTS ({error}): leave rs485 out"
                ) from error
        return port


class SimLinePort(SimPort):
    """The virtual line: started here, stopped with the port. A read that has to wait counts the line's time,
    which may be slower than real time."""

    patience = SIM_PATIENCE

    def __init__(self, text: str, baud: int, part: str) -> None:
        self._rate, self._part = baud, part
        super().__init__(text, baud)

    def read(self, timeout: float) -> bytes:
        data = super().read(timeout)
        if data or timeout < _SHORT:
            return data
        factor = self._pace()
        return super().read(min(timeout / factor - timeout, _LONGEST)) if 0 < factor < 1 else data

    def _pace(self) -> float:
        """Line time / wall time; 1 while nothing moves."""
        from ...sim import SimError

        try:
            return float(self._board.status().factor)
        except SimError:
            return 1.0

    def _start(self, text: str) -> Any:
        from ...sim import start_line
        from ...sim.common.lines import line_kind

        return start_line(line_kind(self._part).at_rate(text, self._rate), self._part)


def open_line(spec: str, baud: int, part: str, rs485: RS485Settings | None = None) -> Port:
    """Open a port for a line. part: of the stations, for virtual ones. Raises PortError."""
    if not spec:
        raise PortError(f"no port given: name one with --port or OPENPPMC_PORT; {describe_ports()}")
    name = spec if ":" in spec else spec + ":"
    if name.startswith(MODEL):
        from .loopback import ModelLine

        return ModelLine(name.removeprefix(MODEL), baud, part)
    if name.startswith(SIM):
        return SimLinePort(name.removeprefix(SIM), baud, part)
    return UrlPort(spec, baud, rs485)
