// SPDX-License-Identifier: Apache-2.0
// Bus for the test of the C driver: drives ppmc104_example_wishbone cycle by cycle, and records the pulses.
#include "sim_bus.h"

#include <vector>

#include "Vppmc104_example_wishbone.h"
#include "clocked.h"
#include "pulses.h"

namespace {

constexpr unsigned kPatience = 64;        // cycles without a response

class Bus : public Clocked<Bus, Vppmc104_example_wishbone> {
  public:
    Bus() {
        top_->l1_n = top_->l2_n = top_->l3_n = top_->l4_n = top_->cnp_n = top_->alm_n = 1;
        reset(false);
    }

    void seen() {
        if (pout_n_ && !top_->pout_n) pulses.push_back({now_, top_->dir != 0});
        pout_n_ = top_->pout_n;
    }

    uint32_t cycle(unsigned word, bool write, uint8_t value) {
        uint32_t data = 0xFF;
        top_->wb_cyc = top_->wb_stb = 1;
        top_->wb_we = write;
        top_->wb_adr = word;
        top_->wb_sel = 0xF;
        top_->wb_dat_w = value;
        for (unsigned n = 0; n < kPatience; ++n) {
            top_->clk = 0;
            top_->eval();
            const bool answered = top_->wb_ack || top_->wb_err;
            if (answered) {
                data = top_->wb_dat_r;
                ++cycles;
            }
            clk();
            if (answered) break;
        }
        top_->wb_cyc = top_->wb_stb = 0;
        clk();
        return data;
    }

    void set(sim_switch_t which, bool active) {
        const uint8_t level = active ? 0 : 1;
        switch (which) {
            case SIM_L1: top_->l1_n = level; break;
            case SIM_L2: top_->l2_n = level; break;
            case SIM_L3: top_->l3_n = level; break;
            case SIM_L4: top_->l4_n = level; break;
            case SIM_CNP: top_->cnp_n = level; break;
            case SIM_ALM: top_->alm_n = level; break;
        }
    }

    unsigned phases() const { return top_->s; }

    bool irq() const { return top_->irq; }

    std::vector<Pulse> pulses;
    unsigned cycles = 0;

  private:
    uint8_t pout_n_ = 1;
};

Bus& bus() {
    static Bus one;
    return one;
}

}  // namespace

double sc_time_stamp() { return 0; }

uint8_t sim_read(void*, unsigned reg) { return static_cast<uint8_t>(bus().cycle(reg, false, 0)); }
void sim_write(void*, unsigned reg, uint8_t value) { bus().cycle(reg, true, value); }
void sim_reset(bool held) { bus().reset(held); }
void sim_switch(sim_switch_t which, bool active) { bus().set(which, active); }
unsigned sim_phases() { return bus().phases(); }
bool sim_irq() { return bus().irq(); }
uint32_t sim_bridge() { return bus().cycle(2, false, 0); }
unsigned sim_cycles() { return bus().cycles; }
unsigned sim_pulses() { return static_cast<unsigned>(bus().pulses.size()); }
void sim_forget() { bus().pulses.clear(); }

void sim_run(unsigned clk) { bus().run(clk); }

void sim_run_pulses(unsigned count) { run_pulses(bus(), count); }
void sim_print_pulses(const char* name) { print_pulses(name, bus().pulses); }
