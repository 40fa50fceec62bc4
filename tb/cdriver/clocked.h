// SPDX-License-Identifier: Apache-2.0
// A Verilated top with clk and rst_n, driven cycle by cycle. After each cycle, seen() of the derived class
// samples the bus.
#ifndef CLOCKED_H
#define CLOCKED_H

#include <cstdint>
#include <memory>

#include "verilated.h"

template <class Bus, class Top>
class Clocked {
  public:
    void clk() {
        top_->clk = 0;
        top_->eval();
        context_.timeInc(1);
        top_->clk = 1;
        top_->eval();
        context_.timeInc(1);
        ++now_;
        static_cast<Bus*>(this)->seen();
    }

    void run(unsigned count) {
        while (count-- != 0) clk();
    }

    uint64_t now() const { return now_; }

    // Drive rst_n low for four cycles or, with `held`, permanently.
    void reset(bool held) {
        top_->rst_n = 1;
        clk();
        top_->rst_n = 0;
        run(4);
        if (held) return;
        top_->rst_n = 1;
        run(8);
    }

  protected:
    Clocked() : top_(std::make_unique<Top>(&context_)) {}
    ~Clocked() { top_->final(); }

    VerilatedContext context_;
    std::unique_ptr<Top> top_;
    uint64_t now_ = 0;  // number of the current cycle
};

#endif
