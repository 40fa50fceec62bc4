"""Table read of the PPMC-312."""

from __future__ import annotations

from cocotb_tests.harness.bus import CSR, MWEF
from cocotb_tests.ppmc312.host import Host
from cocotb_tests.ppmc312.messages import message
from openppmc.model.ppmc312.codes import Code


async def read_table(host: Host) -> tuple[list[int], list[list[int]]]:
    """Read the table; return its head and its three lists, fastest stage first."""
    head = bytes.fromhex(await host.ask(message(Code.TABLE_READ)))
    assert head[:3] == bytes.fromhex("020A41")
    lists: list[list[int]] = [[], [], []]
    counts = (head[3], head[4], head[5])
    widths, most = (2, 3, 3), (6, 4, 4)
    while [len(values) for values in lists] != list(counts):
        block = bytes.fromhex(await host.response())
        item = block[2] - 1
        data = block[3:]
        values = [
            int.from_bytes(data[k : k + widths[item]], "big") for k in range(0, len(data), widths[item])
        ]
        lists[item] += values
        left = counts[item] - len(lists[item])
        assert len(values) == most[item] or left == 0
        last = [len(values) for values in lists] == list(counts)
        assert block[0] == last and block[1] == 1 + len(data)
    assert not await host.read(CSR) & MWEF
    return list(head[3:]), lists
