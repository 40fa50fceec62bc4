// SPDX-License-Identifier: Apache-2.0
// The virtual board. It connects the simulated RTL, the UART, the plant model and the pace of the simulation.
#pragma once

#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include "dut.h"
#include "options.h"
#include "pace.h"
#include "pins.h"
#include "plant.h"
#include "pty.h"
#include "uart.h"

class Board {
   public:
    Board(const Options& options, uint64_t clk_hz);
    ~Board();

    const std::string& port() const { return pty_.path(); }

    // Simulate a slice of board time (1/8 ms), serve the host, and sleep to keep the pace. If only a
    // character from the host can cause a change, wait until the host sends, `wake_fd` is readable (-1: not
    // used), or 1/4 s has passed.
    void run(int wake_fd);

    // Return the state as "name=value name=value …" (docs/virtual_board.md).
    std::string status() const;

   private:
    void simulate(uint64_t end);
    void change();
    void serve();
    void doze(int wake_fd);
    void trace_window();

    const uint64_t clk_hz_;
    Options options_;
    Pty pty_;
    Dut dut_;
    Plant plants_[kAxes];
    Uart uart_;
    Pace pace_;

    uint64_t now_ = 0;       // number of the next clock edge
    uint64_t wake_ = 0;      // value of next() of the UART
    uint64_t busy_until_ = 0;  // until this cycle, the board does not wait for the host
    bool txd_ = true;
    AxisBits motion_ = 0;  // value of motion_pins() at the last change
    Motors motors_;
    bool dozing_ = false;
    uint64_t trace_from_ = 0, trace_end_ = 0;
    bool tracing_ = false;
    std::FILE* log_ = nullptr;
    std::vector<uint8_t> bytes_;
};
