// SPDX-License-Identifier: Apache-2.0
// I/O cycles for the STMC driver's test: drives j105_stmc clk by clk, records the steps of its phases.
#include "isa_bus.h"

#include <memory>
#include <vector>

#include "../board/steps.h"
#include "Vj105_stmc.h"
#include "pulses.h"
#include "verilated.h"

namespace {

constexpr unsigned kStrobe = 9;          // clk: 560 ns at 16 MHz, as an 8-bit cycle lasts
constexpr unsigned kPause = 4;

class Bus {
  public:
    Bus() : top_(std::make_unique<Vj105_stmc>(&context_)) {
        top_->ior_n = top_->iow_n = 1;
        top_->l1_n = top_->l2_n = top_->l3_n = top_->l4_n = top_->cnp_n = top_->mon = 1;
        reset(false);
    }

    ~Bus() { top_->final(); }

    void clk() {
        top_->clk = 0;
        top_->eval();
        context_.timeInc(1);
        top_->clk = 1;
        top_->eval();
        context_.timeInc(1);
        ++now_;
        if (const int step = phases_.step(top_->s)) pulses.push_back({now_, step < 0});
    }

    void reset(bool held) {
        top_->rst_n = 1;
        clk();
        top_->rst_n = 0;
        for (int n = 0; n < 4; ++n) clk();
        phases_ = PhaseSteps();
        if (held) return;
        top_->rst_n = 1;
        for (int n = 0; n < 8; ++n) clk();
    }

    uint8_t in(unsigned port) {
        top_->sa = port;
        clk();
        top_->ior_n = 0;
        for (unsigned n = 0; n < kStrobe; ++n) clk();
        const uint8_t value = top_->sd_oe ? top_->sd_o : 0xFF;
        top_->ior_n = 1;
        for (unsigned n = 0; n < kPause; ++n) clk();
        return value;
    }

    void out(unsigned port, uint8_t value) {
        top_->sa = port;
        top_->sd_i = value;
        clk();
        top_->iow_n = 0;
        for (unsigned n = 0; n < kStrobe; ++n) clk();
        top_->iow_n = 1;
        for (unsigned n = 0; n < kPause; ++n) clk();
    }

    void level(isa_input_t which, bool high) {
        switch (which) {
            case ISA_L1: top_->l1_n = high; break;
            case ISA_L2: top_->l2_n = high; break;
            case ISA_L3: top_->l3_n = high; break;
            case ISA_L4: top_->l4_n = high; break;
            case ISA_CNP: top_->cnp_n = high; break;
            case ISA_MON: top_->mon = high; break;
        }
    }

    bool irq() const { return top_->irq; }

    std::vector<Pulse> pulses;

  private:
    VerilatedContext context_;
    std::unique_ptr<Vj105_stmc> top_;
    PhaseSteps phases_;
    uint64_t now_ = 0;
};

Bus& bus() {
    static Bus one;
    return one;
}

}  // namespace

double sc_time_stamp() { return 0; }

uint8_t isa_in(unsigned port) { return bus().in(port); }
void isa_out(unsigned port, uint8_t value) { bus().out(port, value); }
void isa_reset(bool held) { bus().reset(held); }
void isa_level(isa_input_t which, bool high) { bus().level(which, high); }
bool isa_irq() { return bus().irq(); }
unsigned isa_steps() { return static_cast<unsigned>(bus().pulses.size()); }

void isa_run(unsigned clk) {
    while (clk-- != 0) bus().clk();
}

void isa_run_steps(unsigned count) { run_pulses(bus(), count); }
void isa_print_steps(const char* name) { print_pulses(name, bus().pulses); }
