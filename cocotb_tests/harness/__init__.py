"""Test harness of the OpenPPMC parts.

In short, for someone who writes tests:

    # cocotb_tests/ppmc104/tb_stops.py                       (runs inside the simulator)
    from cocotb_tests.harness.config import F11, F16
    from cocotb_tests.harness.directed import directed
    from .figures import INIT_A
    from .lab import Lab

    @directed("P104-STP-01", "AC-20", builds=(F16, F11))      # builds are optional; default is F16 only
    async def p104_stp_01_immediate_stop(dut):
        "Given a constant-speed move, when 0x40 is taken, then no further pulse comes."
        lab = await Lab.start(dut, INIT_A)                    # clk, reset 1-0-1, initialisation
        await lab.go(0x44, 1000, rate=99)
        await lab.pulse(10, 400)                              # 400 clk after the tenth pulse
        await lab.host.command(0x40)
        await lab.idle()
        lab.check("P104-STP-01", "pulses", len(lab.pulses), 10)
        lab.check("AC-20", "finish status", await lab.finish(), 0xC4)
                                                              # here every output edge is compared

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
