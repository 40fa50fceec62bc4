// SPDX-License-Identifier: Apache-2.0
// Runs the example BankSpi of the Arduino library on a bank of 4 axes with ppmc_spi, cycle by cycle.
#include "sketch.h"

#include <SPI.h>

#include <array>

#include "BankSpi.ino"
#include "Vppmc_bank_carrier.h"
#include "clocked.h"
#include "pulses.h"

SPIPort SPI;

namespace {

constexpr unsigned kAxes = 4, kSelect = 10, kClkHz = 16'000'000;

class Board : public Clocked<Board, Vppmc_bank_carrier> {
  public:
    Board() {
        top_->spi_cs_n = 1;
        top_->l1_n = top_->l2_n = top_->l3_n = top_->l4_n = top_->cnp_n = top_->alm_n = 0xF;
        reset(false);
        run(64);
    }

    void seen() {
        for (unsigned n = 0; n < kAxes; ++n) {
            if (pout_n_ & ~top_->pout_n & 1u << n) pulses[n].push_back({now_, (top_->dir >> n & 1) != 0});
        }
        pout_n_ = top_->pout_n;
    }

    void select(bool active) {
        top_->spi_cs_n = !active;
        run(1);
    }

    // Mode 0: both sides sample at the rising edge of sck.
    uint8_t transfer(uint8_t value) {
        uint8_t received = 0;
        for (int bit = 7; bit >= 0; --bit) {
            top_->mosi = value >> bit & 1;
            run(half);
            received = static_cast<uint8_t>(received << 1 | (top_->miso_oe ? top_->miso_o : 1));
            top_->sck = 1;
            run(half);
            top_->sck = 0;
        }
        return received;
    }

    std::array<std::vector<Pulse>, kAxes> pulses;
    unsigned half = 0;        // cycles of half a period of sck; 0 outside a transaction
    bool absent = false;      // no bridge answers

  private:
    unsigned pout_n_ = 0xF;
};

Board& board() {
    static Board one;
    return one;
}

}  // namespace

void board_run(unsigned cycles) { board().run(cycles); }

void pinMode(uint8_t pin, PinMode mode) {
    if (pin != kSelect || mode != OUTPUT) violated("a pin that the example does not name");
}

void digitalWrite(uint8_t pin, PinStatus level) {
    if (pin != kSelect) violated("a pin that the example does not name");
    board().select(level == LOW);
}

PinStatus digitalRead(uint8_t) { violated("a pin is read"); }

void SPIPort::beginTransaction(const SPISettings& settings) {
    if (settings.order != MSBFIRST || settings.mode != SPI_MODE0) violated("wrong mode");
    board().half = kClkHz / settings.hz / 2;
}

void SPIPort::endTransaction() { board().half = 0; }

uint8_t SPIPort::transfer(uint8_t value) {
    if (board().half == 0) violated("a byte outside a transaction");
    const uint8_t received = board().transfer(value);
    return board().absent ? 0xFF : received;
}

int main(int argc, char** argv) {
    board().absent = argc > 1 && argv[1][0] == 'a';
    setup();
    for (unsigned n = 0; n < 2; ++n) {
        loop();
        print_pulses("x", board().pulses[0]);
        print_pulses("y", board().pulses[1]);
    }
    std::printf("done\n");
    return 0;
}
