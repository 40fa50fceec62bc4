// SPDX-License-Identifier: Apache-2.0
// I/O accesses for the test of the STMC driver: drives j105_stmc cycle by cycle, and records the steps of its
// phases.
#include "isa_bus.h"

#include <vector>

#include "../board/steps.h"
#include "Vj105_stmc.h"
#include "clocked.h"
#include "pulses.h"

namespace {

constexpr unsigned kStrobe = 9;          // strobe in cycles: 560 ns at 16 MHz, the length of an 8-bit access
constexpr unsigned kPause = 4;

class Bus : public Clocked<Bus, Vj105_stmc> {
  public:
    Bus() {
        top_->ior_n = top_->iow_n = 1;
        top_->l1_n = top_->l2_n = top_->l3_n = top_->l4_n = top_->cnp_n = top_->mon = 1;
        reset(false);
    }

    void seen() {
        if (const int step = phases_.step(top_->s)) pulses.push_back({now_, step < 0});
    }

    void reset(bool held) {
        Clocked::reset(held);
        phases_ = PhaseSteps();
    }

    uint8_t in(unsigned port) {
        top_->sa = port;
        clk();
        top_->ior_n = 0;
        run(kStrobe);
        const uint8_t value = top_->sd_oe ? top_->sd_o : 0xFF;
        top_->ior_n = 1;
        run(kPause);
        return value;
    }

    void out(unsigned port, uint8_t value) {
        top_->sa = port;
        top_->sd_i = value;
        clk();
        top_->iow_n = 0;
        run(kStrobe);
        top_->iow_n = 1;
        run(kPause);
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
    PhaseSteps phases_;
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

void isa_run(unsigned clk) { bus().run(clk); }

void isa_run_steps(unsigned count) { run_pulses(bus(), count); }
void isa_print_steps(const char* name) { print_pulses(name, bus().pulses); }
