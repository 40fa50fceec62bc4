"""Test harness of the OpenPPMC parts.

In short, for someone who writes tests:

    # cocotb_tests/ppmc104/tb_stops.py                       (runs inside the simulator)
    import cocotb
    from cocotb_tests.harness.bench import Bench
    from cocotb_tests.harness.bus import HostBus
    from cocotb_tests.harness.config import D16, F16, F11, configs
    from cocotb_tests.harness.verifies import verifies

    @cocotb.test()
    @verifies("P104-STP-01", "AC-20")
    @configs(F16, F11)                                        # optional; default is F16 only
    async def p104_stp_01_immediate_stop(dut):
        "Given a constant-speed move, when 0x40 is taken, then no further pulse comes."
        bench = await Bench.start(dut)                        # clk, reset 1-0-1, monitors; now == 0
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
    ITEMS = cocotb_items("cocotb_tests.ppmc104", "tb_stops", "tb_bus")
    @pytest.mark.parametrize("item", ITEMS)
    def test_ppmc104(item, sim_options):
        run_item(item, sim_options)                           # from cocotb_tests.harness.runner

Modules
    config.py    Config (CLK_HZ, XTAL_HZ, TIMING, PHASE_IDLE; .cyc(n), .w, .us(x), .quanta(n)) and the shared
                 set F16 F8 F11 F25 F48 F50 F100 F16X1 F16X8 D16 D11 D25X8; @configs(...)
    part.py      Part: pins, widths, idle and reset levels, parameters, bus styles; PPMC104, PPMC2104. One bit
                 of a port has a name such as "pout_n[2]", which all pin methods of Bench take
    bench.py     Bench: start/reset, now/until/clocks/align, set/at/pulse_pin/external_clock,
                 edge/nth_fall/level_is, edges/falls/rises/pulses/intervals/low_times/level_at/level,
                 check/check_window/context, recording()
    bus.py       HostBus: write/read/raw, poll/status/command/data/read_data/send/fetch/run/init/move,
                 wait_idle
    drive.py     Drive: an axis as its host sees it: go/move/pulse/idle, result, check_train; Lab and Axis of
                 the parts are made of it
    figures.py   rates, trains, step lists of the motion core by formulas of their own
    elaborate.py check_ranges, ports: parameters and ports of a module
    compare.py   check_against_model(bench): replay into the golden model, compare every output to the clk;
                 on a difference: text report, VCD and PNG in bench.out
    judged.py    judged_test(start, rules, on): a test of a lab, compared with the golden model at its end
    ranges.py    check_ranges(design, ranges, rule): which parameter values elaborate
    host_writer.py, player.py, single_player.py: random hosts, from a seed to actions, and their player
    verifies.py  @verifies(rule IDs), works on pytest tests and on cocotb tests
    collect.py   cocotb_items(package, *modules) -> pytest params
    runner.py    build(part, config), run_item(item, options): cached Verilator build, one process a test
    plugin.py    pytest options --seed N and --clk-hz HZ, build/trace/results.jsonl

Time: everything is counted in rising clk edges; edge 0 is the first that sees rst_n = 1. Pin levels change on
falling edges and are stamped with the rising edge that samples them first; an output edge is stamped with the
rising edge that made it.

On failure: build/failures/<test>/ holds log.txt, dump.vcd (all signals of the design), and for comparisons
compare.txt, compare.vcd, compare.png; the pytest message ends with the line that repeats the test.
"""
