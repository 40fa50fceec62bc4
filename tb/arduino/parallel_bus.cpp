// SPDX-License-Identifier: Apache-2.0
// Runs the example ParallelBus of the Arduino library on a PPMC-104, cycle by cycle. A digitalWrite takes one
// cycle, as on a fast controller.
#include "sketch.h"

#include "ParallelBus.ino"
#include "Vppmc104.h"
#include "clocked.h"
#include "pulses.h"

namespace {

constexpr uint8_t kData = 2, kData7 = 9;

class Board : public Clocked<Board, Vppmc104> {
  public:
    Board() {
        top_->cs_n = top_->rd_n = top_->wr_n = top_->csel = top_->vsel = 1;
        top_->l1_n = top_->l2_n = top_->l3_n = top_->l4_n = top_->cnp_n = top_->alm_n = 1;
        reset(false);
        run(64);
    }

    void seen() {
        if (pout_n_ && !top_->pout_n) pulses.push_back({now_, top_->dir != 0});
        pout_n_ = top_->pout_n;
        if (driven_ && top_->d_oe) violated("part and controller drive the data lines");
    }

    void drive(uint8_t pin, bool on) {
        const unsigned bit = 1u << (pin - kData);
        driven_ = on ? driven_ | bit : driven_ & ~bit;
    }

    void write(uint8_t pin, bool level) {
        if (pin >= kData && pin <= kData7) {
            const unsigned bit = 1u << (pin - kData);
            top_->d_i = static_cast<uint8_t>(level ? top_->d_i | bit : top_->d_i & ~bit);
        } else {
            switch (pin) {
                case A0: top_->a0 = level; break;
                case A1: top_->cs_n = level; break;
                case A2: top_->rd_n = level; break;
                case A3: top_->wr_n = level; break;
                default: violated("a pin that the example does not name");
            }
        }
        run(1);
    }

    bool read(uint8_t pin) const {
        if (pin < kData || pin > kData7) violated("a pin that the example does not name");
        return absent || !top_->d_oe || (top_->d_o >> (pin - kData) & 1);
    }

    std::vector<Pulse> pulses;
    bool absent = false;  // no part answers

  private:
    unsigned driven_ = 0;  // data pins that are outputs of the controller
    uint8_t pout_n_ = 1;
};

Board& board() {
    static Board one;
    return one;
}

}  // namespace

void board_run(unsigned cycles) { board().run(cycles); }

void pinMode(uint8_t pin, PinMode mode) {
    if (pin <= kData7) board().drive(pin, mode == OUTPUT);
}

void digitalWrite(uint8_t pin, PinStatus level) { board().write(pin, level == HIGH); }
PinStatus digitalRead(uint8_t pin) { return board().read(pin) ? HIGH : LOW; }

int main(int argc, char** argv) {
    board().absent = argc > 1 && argv[1][0] == 'a';
    setup();
    for (unsigned n = 0; n < 2; ++n) {
        loop();
        print_pulses("axis", board().pulses);
    }
    std::printf("done\n");
    return 0;
}
