// SPDX-License-Identifier: Apache-2.0
// UART of the PC, bit by bit: 8 data bits, no parity, 1 stop bit. All times are cycle numbers of the board.
// Fractions of a cycle are kept, so any rate is exact on average.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <vector>

class Uart {
   public:
    static constexpr uint64_t kNever = ~uint64_t{0};

    explicit Uart(uint64_t clk_hz) : clk_hz_(clk_hz) { set_rate(115200); }

    // Set the rate in bit/s of the characters that begin from now on. 0: hung up; the line is high, and no
    // character is received.
    void set_rate(unsigned baud);

    // Queue bytes for the board. `now` is the current cycle.
    void send(const std::vector<uint8_t>& bytes, uint64_t now);
    size_t queued() const { return queue_.size(); }

    // Discard the queued bytes, because the board was reset or the host has closed the port.
    void drop() { queue_.clear(); }

    bool idle() const { return tx_at_ == kNever && rx_bit_ < 0; }

    // Return the level of uart_rxd. The caller drives the pin with it before edge next().
    bool level() const { return level_; }
    uint64_t next() const { return tx_at_ < rx_at_ ? tx_at_ : rx_at_; }

    // Advance transmitter and receiver. Call before clock edge `now` if now == next(), or if uart_txd has
    // changed to `txd`.
    void step(uint64_t now, bool txd);

    // Return the bytes that were received from the board.
    std::vector<uint8_t>& received() { return received_; }

   private:
    void send_step(uint64_t now);
    void receive_step(uint64_t now, bool txd);

    uint64_t clk_hz_;
    uint64_t bit_ = 0;  // length of a bit in 2^-24 cycles; 0: hung up

    std::deque<uint8_t> queue_;
    bool level_ = true;
    unsigned tx_shift_ = 0;   // remaining bits, least significant first
    int tx_bit_ = 0;          // number of bits of the character that have begun; 0: between two characters
    uint64_t tx_bit_len_ = 0;
    uint64_t tx_time_ = 0;    // end of the current bit in 2^-24 cycles after tx_base_
    uint64_t tx_base_ = 0;
    uint64_t tx_at_ = kNever;

    bool rx_wait_high_ = false;
    int rx_bit_ = -1;  // next bit to be sampled, 0: start, 1..8: data, 9: stop; -1: waiting for a start bit
    unsigned rx_byte_ = 0;
    uint64_t rx_begin_ = 0;
    uint64_t rx_bit_len_ = 0;
    uint64_t rx_at_ = kNever;
    std::vector<uint8_t> received_;
};
