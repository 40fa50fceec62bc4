// SPDX-License-Identifier: Apache-2.0
// Line for the test of the PMC006B4 C driver: drives pmc006_line cycle by cycle, and records the steps.
#include "frame_bus.h"

#include <vector>

#include "Vpmc006_line.h"
#include "clocked.h"
#include "line_port.h"
#include "pulses.h"

namespace {

constexpr unsigned kHz = 8'000'000, kBaud = 115'200;

class Bus : public Clocked<Bus, Vpmc006_line> {
  public:
    Bus() : port(kHz, kBaud) {
        top_->rxd = top_->ext1 = top_->ext2 = top_->eeprom_on = 1;
        reset(false);
    }

    void seen() {
        if (top_->step) {
            pulses.push_back({now_, !top_->forward});
            if (switch_ != 0 && --switch_ == 0) top_->ext1 = level_;
        }
        top_->rxd = port.seen(now_, top_->line);
    }

    void ext(unsigned number, bool high) { (number == 1 ? top_->ext1 : top_->ext2) = high; }

    void switch_after(unsigned steps, bool high) {
        switch_ = steps;
        level_ = high;
    }

    void eeprom(bool on) { top_->eeprom_on = on; }
    unsigned outputs() const { return top_->gpo; }

    std::vector<Pulse> pulses;
    LinePort port;

  private:
    unsigned switch_ = 0;
    bool level_ = true;
};

Bus& bus() {
    static Bus one;
    return one;
}

}  // namespace

double sc_time_stamp() { return 0; }

void frame_send(void*, const uint8_t* bytes, unsigned count) { bus().port.send(bus(), bytes, count); }

bool frame_receive(void*, uint8_t* byte, unsigned milliseconds) {
    return bus().port.receive(bus(), byte, uint64_t{milliseconds} * (kHz / 1000));
}

void frame_reset() { bus().reset(false); }
void frame_run_steps(unsigned count) { run_pulses(bus(), count); }
void frame_ext(unsigned number, bool high) { bus().ext(number, high); }
void frame_switch(unsigned after, bool high) { bus().switch_after(after, high); }
void frame_eeprom(bool on) { bus().eeprom(on); }
void frame_damage(unsigned at, uint8_t flip) { bus().port.damage(at, flip); }
unsigned frame_outputs() { return bus().outputs(); }
void frame_print_steps(const char* name) { print_pulses(name, bus().pulses); }
