"""Ports: a serial device, the virtual board (`sim:`) or the model (`model:`).

This is the only module with real I/O. It imports pyserial when a port is opened or listed; all other
functions work without pyserial. A SerialException of pyserial is an OSError.
"""

from __future__ import annotations

import errno
import os
import re
import sys
from collections.abc import Callable
from contextlib import suppress
from time import perf_counter
from typing import TYPE_CHECKING, Any, Protocol

from .errors import Disconnected, PortError

if TYPE_CHECKING:
    import serial

BASE_BAUD = 115_200
SIM, MODEL, CHAR = "sim:", "model:", "char:"
_WINDOWS = os.name == "nt"
_GONE = "the port went away: check the cable, plug the board in and run the command again"


class Port(Protocol):
    """Byte stream with its own clock, so that a modelled board may run faster than the wall clock."""

    name: str

    def read(self, timeout: float) -> bytes:
        """Return the bytes received; wait up to `timeout` seconds for the first byte.

        Raises Disconnected.
        """

    def write(self, data: bytes) -> None:
        """Send bytes. Raises Disconnected."""

    def set_baud(self, baud: int) -> None:
        """Change the line rate. Raises PortError if the port does not support it."""

    def clock(self) -> float:
        """Return the time in s, which never decreases."""

    def close(self) -> None:
        """Close the port; a second call is allowed."""


class SerialPort:
    """Serial device opened exclusively with pyserial."""

    SLICE = 0.02

    def __init__(self, path: str, baud: int = BASE_BAUD) -> None:
        self.name = path
        try:
            self._serial = self._open(path, baud)
        except (OSError, ValueError) as error:
            raise PortError(_open_error_reason(path, error)) from error

    def _open(self, path: str, baud: int) -> serial.SerialBase:
        import serial

        port = serial.Serial(path, baud, timeout=self.SLICE, write_timeout=2, exclusive=True)
        # Without the low-latency mode, the driver of FTDI adapters keeps the end of an answer for 16 ms. Some
        # systems and adapters do not support this mode.
        with suppress(AttributeError, NotImplementedError, ValueError):
            port.set_low_latency_mode(True)
        return port

    def read(self, timeout: float) -> bytes:
        end = perf_counter() + timeout
        least = int(timeout > 0)
        while True:
            data = self._guarded(lambda: self._serial.read(max(least, self._serial.in_waiting)))
            if data or perf_counter() >= end:
                return data

    def _guarded(self, action: Callable[[], bytes]) -> bytes:
        """Call a function that accesses the port, and return its result. Raises Disconnected if it fails."""
        try:
            return action()
        except (OSError, TypeError) as error:
            raise Disconnected(f"{self.name}: {_GONE}") from error

    def write(self, data: bytes) -> None:
        from serial import SerialTimeoutException

        try:
            self._serial.write(data)
            self._serial.flush()
        except SerialTimeoutException as error:
            raise Disconnected(
                f"{self.name}: the port accepts no bytes: unplug the adapter and try again"
            ) from error
        except (OSError, TypeError) as error:
            raise Disconnected(f"{self.name}: {_GONE}") from error

    def set_baud(self, baud: int) -> None:
        try:
            self._serial.baudrate = baud
        except (OSError, ValueError) as error:
            raise PortError(
                f"{self.name}: the adapter does not support {baud} baud: choose a lower --baud"
            ) from error

    def clock(self) -> float:
        # Before Python 3.13, time.monotonic advances in steps of 16 ms on Windows, longer than some timeouts.
        return perf_counter()

    def close(self) -> None:
        try:
            self._serial.close()
        except OSError:
            pass  # the device has already disappeared


class SimPort(SerialPort):
    """Virtual board; opening the port starts its process, closing the port stops it."""

    def __init__(self, text: str, baud: int = BASE_BAUD) -> None:
        try:
            self._board = self._start(text)
        except ImportError as error:
            raise PortError(
                f"sim: the virtual board is not installed ({error}): try model: instead"
            ) from error
        except (OSError, RuntimeError, ValueError) as error:
            raise PortError(f"sim: {error}") from error
        try:
            super().__init__(self._board.port, baud)
        except PortError:
            self._board.close()
            raise
        self.name = SIM + text

    def _start(self, text: str) -> Any:
        from openppmc import sim

        return sim.start(text)

    def close(self) -> None:
        super().close()
        self._board.close()


def serial_ports() -> list[tuple[str, str]]:
    """Return device and description of each serial port of this computer, sorted.

    Raises PortError if the system cannot list them.
    """
    try:
        from serial.tools import list_ports

        ports = sorted(list_ports.comports())  # COM10 follows COM9
    except (OSError, AttributeError) as error:  # Wine lacks some functions of Windows
        raise PortError(f"the serial ports cannot be listed ({error}); name one with --port") from error
    return [(port.device, port.description if port.description != "n/a" else "") for port in ports]


def describe_ports() -> str:
    """Return the serial ports of this computer as text for messages."""
    try:
        found = [device for device, _ in serial_ports()]
    except PortError as error:
        return str(error)
    return (
        f"there are {', '.join(found)}" if found else "this computer shows no serial port (model: needs none)"
    )


def _open_error_reason(path: str, error: Exception) -> str:
    """Return why a port could not be opened, and what to do, as text."""
    text = str(error)
    code = getattr(error, "errno", None) or _windows_code(text)
    refused = code in (errno.EACCES, errno.EPERM)
    if "://" in path:
        return f"{path}: cannot be opened ({' '.join(text.split())}): check address and network"
    if code in (errno.ENOENT, errno.ENXIO, errno.ENODEV) or not (os.path.exists(path) or _WINDOWS):
        return f"{path}: no such port; {describe_ports()}"
    if os.path.isdir(path):
        return f"{path}: not a serial port; {describe_ports()}"
    if "lock" in text or code == errno.EBUSY or (_WINDOWS and refused):
        return f"{path}: another program has this port open: close it first"
    if refused:
        return f"{path}: no permission: {_how_to_get_permission(path)}"
    return f"{path}: not a serial port; {describe_ports()}"


def _windows_code(text: str) -> int | None:
    """Return the number of a Windows error from its message, because pyserial reports only the text.

    >>> _windows_code("could not open port 'COM3': FileNotFoundError(2, 'not found', None, 2)")
    2
    """
    found = re.search(r"Error\((\d+), ", text)
    return int(found[1]) if found else None


def _how_to_get_permission(path: str) -> str:
    if sys.platform == "darwin":
        return f"check owner and mode of the device (ls -l {path})"
    import grp

    try:
        group = grp.getgrgid(os.stat(path).st_gid).gr_name
    except (OSError, KeyError):
        group = "dialout"
    return f"add yourself to its group ({group}): sudo usermod -aG {group} $USER, then log in again"


def virtual(spec: str) -> str:
    """Return `spec` without `char:` if the port is virtual, else "".

    A virtual port is `sim:…` or `model:…`. Without options, the colon may be missing.
    """
    inner = spec.removeprefix(CHAR)
    return inner if f"{inner}:".startswith((MODEL, SIM)) else ""


def open_port(spec: str, baud: int = BASE_BAUD) -> Port:
    """Open a port: device path, `sim:` or `model:` with options, or `char:` with a port. Raises PortError."""
    if spec.startswith(CHAR):
        from .char_port import CharPort

        return CharPort(open_port(spec.removeprefix(CHAR), baud))
    if not spec:
        raise PortError(f"no port given: name one with --port or OPENPPMC_PORT; {describe_ports()}")
    if spec.startswith(MODEL):
        from .model_port import ModelPort

        return ModelPort(spec.removeprefix(MODEL), baud)
    if spec.startswith(SIM):
        return SimPort(spec.removeprefix(SIM), baud)
    return SerialPort(spec, baud)
