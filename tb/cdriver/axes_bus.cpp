// SPDX-License-Identifier: Apache-2.0
// Bus for the test of the PPMC-2104 C driver: drives ppmc2104 cycle by cycle, and records the pulses.
#include "axes_bus.h"

#include <array>
#include <vector>

#include "Vppmc2104.h"
#include "clocked.h"
#include "pulses.h"

namespace {

constexpr unsigned kStrobe = 4, kPause = 3;  // strobe, and pause between two strobes, in cycles

class Bus : public Clocked<Bus, Vppmc2104> {
  public:
    Bus() {
        top_->cs_n = top_->ds_wrs_n = top_->rw_rds_n = top_->errint_n = 1;
        top_->run = top_->csel = 3;
        top_->fl_n = top_->bl_n = top_->fhl_n = top_->bhl_n = top_->org_n = top_->alm_n = 3;
        top_->auxi = 2;
        reset(false);
    }

    void seen() {
        for (unsigned n = 0; n < 2; ++n) {
            if (pout_n_ & ~top_->pout_n & 1u << n) pulses[n].push_back({now_, (top_->dir >> n & 1) != 0});
        }
        pout_n_ = top_->pout_n;
    }

    uint8_t read(unsigned reg) {
        top_->a0 = reg != 0;
        clk();
        top_->cs_n = top_->rw_rds_n = 0;
        run(kStrobe);
        const uint8_t value = top_->d_oe ? top_->d_o : 0xFF;
        release();
        return value;
    }

    void write(unsigned reg, uint8_t value) {
        top_->a0 = reg != 0;
        top_->d_i = value;
        clk();
        top_->cs_n = top_->ds_wrs_n = 0;
        run(kStrobe);
        release();
    }

    void input(axes_input_t which, unsigned axis, bool active) {
        switch (which) {
            case AXES_FL: set(top_->fl_n, axis, active); break;
            case AXES_BL: set(top_->bl_n, axis, active); break;
            case AXES_FHL: set(top_->fhl_n, axis, active); break;
            case AXES_BHL: set(top_->bhl_n, axis, active); break;
            case AXES_ORG: set(top_->org_n, axis, active); break;
            case AXES_ALM: set(top_->alm_n, axis, active); break;
        }
    }

    void run_pins(unsigned axes) {
        top_->run = static_cast<uint8_t>(axes);
        run(2);
    }

    bool irq() const { return !top_->int_n; }

    std::array<std::vector<Pulse>, 2> pulses;

  private:
    template <class Pins>
    static void set(Pins& pins, unsigned axis, bool active) {
        const unsigned bit = 1u << (axis - 1);
        pins = static_cast<Pins>(active ? pins & ~bit : pins | bit);
    }

    void release() {
        top_->cs_n = top_->rw_rds_n = top_->ds_wrs_n = 1;
        run(kPause);
    }

    unsigned pout_n_ = 3;
};

Bus& bus() {
    static Bus one;
    return one;
}

struct Axis {
    std::vector<Pulse>& pulses;
    void clk() { bus().clk(); }
};

}  // namespace

double sc_time_stamp() { return 0; }

uint8_t axes_read(void*, unsigned reg) { return bus().read(reg); }
void axes_write(void*, unsigned reg, uint8_t value) { bus().write(reg, value); }
void axes_run_pins(void*, unsigned axes) { bus().run_pins(axes); }
void axes_reset(bool held) { bus().reset(held); }
void axes_run(unsigned cycles) { bus().run(cycles); }
void axes_input(axes_input_t which, unsigned axis, bool active) { bus().input(which, axis, active); }
bool axes_irq() { return bus().irq(); }
unsigned axes_pulses(unsigned axis) { return static_cast<unsigned>(bus().pulses[axis - 1].size()); }

void axes_run_pulses(unsigned axis, unsigned count) {
    Axis one{bus().pulses[axis - 1]};
    run_pulses(one, count);
}

void axes_print_pulses(const char* name, unsigned axis) { print_pulses(name, bus().pulses[axis - 1]); }
