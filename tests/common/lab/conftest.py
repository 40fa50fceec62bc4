"""Sets the EPICS variables for Channel Access on a free port of the loopback interface; clients read them
when they start.
"""

from __future__ import annotations

import os
import socket

with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as one, socket.socket(type=socket.SOCK_DGRAM) as two:
    one.bind(("127.0.0.1", 0))
    two.bind(("127.0.0.1", 0))
    os.environ |= {
        "EPICS_CA_ADDR_LIST": "127.0.0.1",
        "EPICS_CA_AUTO_ADDR_LIST": "NO",
        "EPICS_CAS_INTF_ADDR_LIST": "127.0.0.1",
        "EPICS_CAS_BEACON_ADDR_LIST": "127.0.0.1",
        "EPICS_CAS_AUTO_BEACON_ADDR_LIST": "NO",
        "EPICS_CA_SERVER_PORT": str(one.getsockname()[1]),
        "EPICS_CA_REPEATER_PORT": str(two.getsockname()[1]),
        "OPHYD_CONTROL_LAYER": "caproto",
    }
