// SPDX-License-Identifier: Apache-2.0
// Master of a line at the pins of a simulated station. Only one C++ file includes it, together with the UART.
#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "../board/uart.cpp"

class LinePort {
  public:
    LinePort(uint64_t clk_hz, unsigned baud) : uart_(clk_hz) { uart_.set_rate(baud); }

    // After each cycle, sample the txd level of the station, and return the level of its rxd.
    bool seen(uint64_t now, bool txd) {
        if (uart_.next() <= now || txd != txd_) uart_.step(now, txd);
        txd_ = txd;
        return uart_.level();
    }

    // Damage received byte number `at`, counted from now: invert the bits of `flip`.
    void damage(unsigned at, uint8_t flip) {
        at_ = at;
        flip_ = flip;
    }

    template <class Bus>
    void send(Bus& bus, const uint8_t* bytes, unsigned count) {
        uart_.send(std::vector<uint8_t>(bytes, bytes + count), bus.now());
        while (uart_.queued() || !uart_.idle()) bus.clk();
    }

    template <class Bus>
    bool receive(Bus& bus, uint8_t* byte, uint64_t cycles) {
        auto& received = uart_.received();
        while (received.empty() && cycles-- != 0) bus.clk();
        if (received.empty()) return false;
        *byte = received.front();
        received.erase(received.begin());
        if (flip_ != 0 && at_-- == 0) {
            *byte ^= flip_;
            flip_ = 0;
        }
        return true;
    }

  private:
    Uart uart_;
    bool txd_ = true;
    unsigned at_ = 0;
    uint8_t flip_ = 0;
};
