"""Test harness of the OpenPPMC parts.

In short, for someone who writes tests:

    # cocotb_tests/ppmc104/tb_stops.py                       (runs inside the simulator)
    import cocotb
    from cocotb_tests.harness.bench import Bench
    from cocotb_tests.harness.bus import HostBus
    from cocotb_tests.harness.config import D16, F16, F11, configs
    from cocotb_tests.harness.verifies import verifies
    from .bench import PPMC104

    @cocotb.test()
    @verifies("P104-STP-01", "AC-20")
    @configs(F16, F11)                                        # optional; default is F16 only
    async def p104_stp_01_immediate_stop(dut):
        "Given a constant-speed move, when 0x40 is taken, then no further pulse comes."
        bench = await Bench.start(dut, PPMC104)               # clk, reset 1-0-1, monitors; now == 0
        host = HostBus(bench)
        await host.init(0x0A, 9, 4, 4)                        # or: await host.run("c 0A d 09 d 04 d 04 d 00")
        start = bench.now
        await host.move(0x44, n=1000, rate=99)
        tenth = await bench.nth_fall(10, since=start)         # edge index; now on the next falling edge
        await bench.until(tenth + 400)                        # now == tenth + 400: the stamp of pins set here
        await host.send("40")
        await host.wait_idle()
        bench.check("P104-STP-01", "pulses", len(bench.pulses(start)), 10)
        bench.check("AC-20", "finish status", await host.run("c 80 r"), [0xC4])

    # cocotb_tests/ppmc104/test_part.py                    (runs under pytest)
    ITEMS = cocotb_items("cocotb_tests.ppmc104", "tb_stops", "tb_bus", part=PPMC104)
    @pytest.mark.parametrize("item", ITEMS)
    def test_ppmc104(item, sim_options):
        run_item(item, sim_options)                           # from cocotb_tests.harness.runner

The first line of each module says what it is for (`head -qn1 cocotb_tests/harness/*.py`); docs/testing.md
says how they work together. No module here knows a part: `part.PARTS` come from each part's `bench.py`.

Time: everything is counted in rising clk edges; edge 0 is the first that sees rst_n = 1. Pin levels change on
falling edges and are stamped with the rising edge that samples them first; an output edge is stamped with the
rising edge that made it.

On failure: build/failures/<test>/ holds log.txt, waves/dump.vcd (all signals of the design), and for
comparisons compare.txt, compare.vcd, compare.png; the message ends with the line that repeats the test.
"""
