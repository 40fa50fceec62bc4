// SPDX-License-Identifier: Apache-2.0
#include "uart.h"

namespace {
constexpr int kFraction = 24;
constexpr uint64_t ceil_clk(uint64_t t) { return (t + (uint64_t{1} << kFraction) - 1) >> kFraction; }
}  // namespace

void Uart::set_rate(unsigned baud) { bit_ = baud ? (clk_hz_ << kFraction) / baud : 0; }

void Uart::send(const std::vector<uint8_t>& bytes, uint64_t now) {
    queue_.insert(queue_.end(), bytes.begin(), bytes.end());
    if (tx_at_ == kNever && !queue_.empty()) {
        tx_base_ = now;
        tx_time_ = 0;
        tx_at_ = now;
    }
}

void Uart::step(uint64_t now, bool txd) {
    if (now >= tx_at_) send_step(now);
    receive_step(now, txd);
}

void Uart::send_step(uint64_t now) {
    if (tx_bit_ == 10) {
        tx_bit_ = 0;
        // Consecutive characters keep their fractions of a cycle. The base is advanced, so that the numbers
        // remain small.
        const uint64_t whole = tx_time_ >> kFraction;
        tx_base_ += whole;
        tx_time_ -= whole << kFraction;
    }
    if (tx_bit_ == 0) {
        if (queue_.empty() || bit_ == 0) {
            queue_.clear();
            tx_at_ = kNever;
            return;
        }
        tx_shift_ = 0x600u | queue_.front() << 1;  // stop bit, data, start bit
        queue_.pop_front();
        tx_bit_len_ = bit_;
        if (tx_base_ + ceil_clk(tx_time_) < now) {
            tx_base_ = now;
            tx_time_ = 0;
        }
    }
    level_ = tx_shift_ & 1;
    tx_shift_ >>= 1;
    ++tx_bit_;
    tx_time_ += tx_bit_len_;
    tx_at_ = tx_base_ + ceil_clk(tx_time_);
}

void Uart::receive_step(uint64_t now, bool txd) {
    if (rx_wait_high_) {
        rx_wait_high_ = !txd;
        return;
    }
    if (rx_bit_ < 0) {
        if (txd || bit_ == 0) return;
        rx_bit_ = 0;
        rx_byte_ = 0;
        rx_begin_ = now;
        rx_bit_len_ = bit_;
        rx_at_ = now + ceil_clk(rx_bit_len_ / 2);
    }
    if (now < rx_at_) return;
    if (rx_bit_ == 0 && txd) {  // the low level was too short for a start bit
        rx_bit_ = -1;
        rx_at_ = kNever;
        return;
    }
    if (rx_bit_ >= 1 && rx_bit_ <= 8) rx_byte_ |= unsigned{txd} << (rx_bit_ - 1);
    if (rx_bit_ == 9) {
        // As in the driver of a PC without parity marking, a character with a low stop bit is passed on like
        // any other.
        received_.push_back(static_cast<uint8_t>(rx_byte_));
        rx_wait_high_ = !txd;
        rx_bit_ = -1;
        rx_at_ = kNever;
        return;
    }
    ++rx_bit_;
    rx_at_ = rx_begin_ + ceil_clk(static_cast<uint64_t>(rx_bit_) * rx_bit_len_ + rx_bit_len_ / 2);
}
