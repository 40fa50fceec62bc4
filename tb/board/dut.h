// SPDX-License-Identifier: Apache-2.0
// The Verilated board, simulated one cycle at a time. A special build can also record waveforms.
#pragma once

#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>

#include "Vboard.h"
#include "Vboard___024root.h"
#include "verilated.h"
#if VM_TRACE
#include "verilated_vcd_c.h"
#endif

class Dut {
   public:
    // idle: function that sets the inputs before the first reset.
    template <class Idle>
    explicit Dut(Idle idle) {
#if VM_TRACE
        context_.traceEverOn(true);
#endif
        top.clk = 0;
        top.uart_rxd = 1;
        idle(top);
        // A reset needs a falling edge of rst_n. Without this edge, flip-flops would keep their initial
        // values.
        top.rst_n = 1;
        top.eval();
        top.rst_n = 0;
        for (int i = 0; i < 16; ++i) tick();
        top.rst_n = 1;
    }

    // Simulate one rising edge of the clock. Afterwards, the outputs are those after the edge.
    void tick() {
        top.clk = 1;
        top.eval();
        rearm(*top.rootp, 0);
    }

#if VM_TRACE
    // Open file `path`, into which tick_traced() then records.
    void open_trace(const std::string& path) {
        trace_ = std::make_unique<VerilatedVcdC>();
        top.trace(trace_.get(), 99);
        trace_->open(path.c_str());
        if (!trace_->isOpen()) throw std::runtime_error("cannot write " + path);
    }
    // Simulate one cycle like tick(), and record both edges. Times are in ps.
    void tick_traced(uint64_t at, uint64_t fall) {
        top.clk = 1;
        top.eval();
        trace_->dump(at);
        top.clk = 0;
        top.eval();
        trace_->dump(fall);
    }
    void close_trace() {
        if (trace_) trace_->close();
        trace_.reset();
    }
#endif

   private:
    VerilatedContext context_;

   public:
    Vboard top{&context_};

   private:
#if VM_TRACE
    std::unique_ptr<VerilatedVcdC> trace_;
#endif

    // All flip-flops use the rising edge. Therefore, at a falling edge, it is sufficient to store in a
    // variable of Verilator that the clock was low. Writing this variable directly saves the evaluation,
    // which is a sixth of the run time. If a version of Verilator uses another name for the variable, the
    // falling edge is evaluated.
    template <class Root>
    auto rearm(Root& root, int) -> decltype(root.__Vtrigprevexpr___TOP__clk__0, void()) {
        root.__Vtrigprevexpr___TOP__clk__0 = 0;
    }
    template <class Root>
    void rearm(Root&, long) {
        top.clk = 0;
        top.eval();
    }
};
