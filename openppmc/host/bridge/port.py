"""Opening the port that a user names: a serial device, the virtual board (`sim:`), the model (`model:`)."""

from __future__ import annotations

from ..basis.errors import PortError
from ..ports.transport import BASE_BAUD, MODEL, SIM, Port, SerialPort, SimPort, describe_ports


def open_port(spec: str, baud: int = BASE_BAUD) -> Port:
    """Open a port: device path, `sim:plant text` or `model:plant text`. Raises PortError."""
    if not spec:
        raise PortError(f"no port given: name one with --port or OPENPPMC_PORT; {describe_ports()}")
    if spec.startswith(MODEL):
        from .loopback import ModelPort

        return ModelPort(spec.removeprefix(MODEL), baud)
    if spec.startswith(SIM):
        return SimPort(spec.removeprefix(SIM), baud)
    return SerialPort(spec, baud)
