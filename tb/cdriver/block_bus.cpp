// SPDX-License-Identifier: Apache-2.0
// Bus and line for the test of the PPMC-312 C driver: drives ppmc312 cycle by cycle.
#include "block_bus.h"

#include <vector>

#include "Vppmc312.h"
#include "clocked.h"
#include "line_port.h"
#include "pulses.h"

namespace {

constexpr unsigned kHz = 8'000'000, kBaud = 83'333, kStation = 5;
constexpr unsigned kWrite = 3, kRead = 5, kPause = 3;  // strobes, and pause between two strobes, in cycles

class Bus : public Clocked<Bus, Vppmc312> {
  public:
    Bus() : port(kHz, kBaud) {
        top_->cs_n = top_->we_n = top_->oe_n = 1;
        top_->rxd = top_->hsp = 1;
        top_->mod = 7;
        top_->adr = kStation;
        top_->evt0_n = top_->evt1_n = top_->alm_n = top_->index_n = top_->org_n = top_->run = 1;
        top_->fl_n = top_->bl_n = top_->fhl_n = top_->bhl_n = 1;
        top_->auxi = 0x3C;
        top_->mode = 1;
        reset(false);
    }

    void seen() {
        if (!pout_ && top_->pout) pulses.push_back({now_, top_->dir != 0});
        pout_ = top_->pout;
        top_->rxd = port.seen(now_, top_->txd || !top_->snd);
    }

    void mode(bool line) { top_->mode = !line; }

    uint8_t read(unsigned reg) {
        top_->rs = static_cast<uint8_t>(reg);
        clk();
        top_->cs_n = top_->oe_n = 0;
        run(kRead);
        const uint8_t value = top_->d_oe ? top_->d_o : 0xFF;
        release();
        return value;
    }

    void write(unsigned reg, uint8_t value) {
        top_->rs = static_cast<uint8_t>(reg);
        top_->d_i = value;
        clk();
        top_->cs_n = top_->we_n = 0;
        run(kWrite);
        release();
    }

    void pin(block_pin_t which, bool high) {
        switch (which) {
            case BLOCK_FL: top_->fl_n = high; break;
            case BLOCK_BL: top_->bl_n = high; break;
            case BLOCK_FHL: top_->fhl_n = high; break;
            case BLOCK_ORG: top_->org_n = high; break;
            case BLOCK_ALM: top_->alm_n = high; break;
            case BLOCK_RUN: top_->run = high; break;
            case BLOCK_EVT0: top_->evt0_n = high; break;
            case BLOCK_EVT1: top_->evt1_n = high; break;
        }
    }

    unsigned outputs() const { return top_->auxo_n; }

    std::vector<Pulse> pulses;
    LinePort port;

  private:
    void release() {
        top_->cs_n = top_->we_n = top_->oe_n = 1;
        run(kPause);
    }

    bool pout_ = false;
};

Bus& bus() {
    static Bus one;
    return one;
}

}  // namespace

double sc_time_stamp() { return 0; }

uint8_t block_read(void*, unsigned reg) { return bus().read(reg); }
void block_write(void*, unsigned reg, uint8_t value) { bus().write(reg, value); }
void block_send(void*, const uint8_t* bytes, unsigned count) { bus().port.send(bus(), bytes, count); }

bool block_receive(void*, uint8_t* byte, unsigned milliseconds) {
    return bus().port.receive(bus(), byte, uint64_t{milliseconds} * (kHz / 1000));
}

void block_reset(bool held, bool line) {
    bus().mode(line);
    bus().reset(held);
    bus().run(15'000);  // longer than a reset with DATASHEET timing (1.6 ms)
}

void block_run(unsigned cycles) { bus().run(cycles); }
void block_run_pulses(unsigned count) { run_pulses(bus(), count); }
void block_pin(block_pin_t which, bool high) { bus().pin(which, high); }
void block_damage(unsigned at, uint8_t flip) { bus().port.damage(at, flip); }
unsigned block_outputs() { return bus().outputs(); }
void block_print_pulses(const char* name) { print_pulses(name, bus().pulses); }
