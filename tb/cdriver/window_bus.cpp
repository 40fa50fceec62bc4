// SPDX-License-Identifier: Apache-2.0
// Window accesses for the test of the bank's C driver: drives ppmc_bank cycle by cycle, and records the
// pulses of each axis.
#include "window_bus.h"

#include <array>
#include <vector>

#include "Vppmc_bank.h"
#include "clocked.h"
#include "pulses.h"

namespace {

constexpr unsigned kAxes = 8;
constexpr unsigned kWrite = 2, kRead = 6, kPause = 3;  // strobes, and pause between two strobes, in cycles

class Bus : public Clocked<Bus, Vppmc_bank> {
  public:
    Bus() {
        top_->cs_n = top_->rd_n = top_->wr_n = 1;
        top_->l1_n = top_->l2_n = top_->l3_n = top_->l4_n = top_->cnp_n = top_->alm_n = 0xFF;
        reset(false);
    }

    void seen() {
        for (unsigned n = 0; n < kAxes; ++n) {
            if (pout_n_ & ~top_->pout_n & 1u << n) pulses[n].push_back({now_, (top_->dir >> n & 1) != 0});
        }
        pout_n_ = top_->pout_n;
    }

    uint8_t read(unsigned address) {
        select(address);
        top_->rd_n = 0;
        run(kRead);
        const uint8_t value = top_->d_oe ? top_->d_o : 0xFF;
        release();
        return value;
    }

    void write(unsigned address, uint8_t value) {
        select(address);
        top_->d_i = value;
        top_->wr_n = 0;
        run(kWrite);
        release();
    }

    void limit(unsigned axis, bool active) {
        top_->l1_n = static_cast<uint8_t>(active ? top_->l1_n & ~(1u << axis) : top_->l1_n | 1u << axis);
    }

    bool irq() const { return !top_->int_n; }

    std::array<std::vector<Pulse>, kAxes> pulses;

  private:
    void select(unsigned address) {
        top_->a = static_cast<uint16_t>(address);
        clk();
        top_->cs_n = 0;
    }

    void release() {
        top_->cs_n = top_->rd_n = top_->wr_n = 1;
        run(kPause);
    }

    unsigned pout_n_ = 0xFF;
};

Bus& bus() {
    static Bus one;
    return one;
}

// One axis of the bank, in the form that run_pulses() needs.
struct Axis {
    std::vector<Pulse>& pulses;
    void clk() { bus().clk(); }
};

}  // namespace

double sc_time_stamp() { return 0; }

uint8_t window_read(void*, unsigned address) { return bus().read(address); }
void window_write(void*, unsigned address, uint8_t value) { bus().write(address, value); }
void window_reset(bool held) { bus().reset(held); }
void window_run(unsigned clk) { bus().run(clk); }
void window_limit(unsigned axis, bool active) { bus().limit(axis, active); }
bool window_irq() { return bus().irq(); }

void window_run_pulses(unsigned axis, unsigned count) {
    Axis one{bus().pulses[axis]};
    run_pulses(one, count);
}

void window_print_pulses(const char* name, unsigned axis) { print_pulses(name, bus().pulses[axis]); }
