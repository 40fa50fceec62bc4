// SPDX-License-Identifier: Apache-2.0
// A station of the virtual line: the Verilated node (RTL of the board), its time, and the decision whether
// the node must be simulated. The node.h of the device defines the plant at the pins of the node as class
// Node, which has Node(arguments, clk_hz), set_up(top), look(top) (pins to be observed), follow(top) (called
// after a change), named(byte), inputs(top, levels), booted(top), words(top) and linger(clk_hz). linger()
// returns the time for which the node may still act after a character.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "arguments.h"
#include "dut.h"
#include "node.h"

// A level that a wire has from clock edge `at` on.
struct Change {
    uint64_t at;
    bool level;
};

class Station {
   public:
    Station(const StationArguments& arguments, uint64_t clk_hz)
        : node_(arguments, clk_hz),
          dut_([this](Vboard& top) { node_.set_up(top); }),
          linger_(node_.linger(clk_hz)),
          after_reply_(clk_hz / 1000) {
        seen_ = node_.look(dut_.top);
        // A boot with a blank EEPROM takes 60 ms, a reset 2 ms. The limit of 1 s also ends the wait for a
        // node that never boots.
        for (uint64_t clk = 0; clk < clk_hz && !node_.booted(dut_.top); clk += kSlice) {
            std::vector<Change> nothing;
            run(0, kSlice, {}, nothing);
        }
    }

    // Call when the master sends a byte. Return true if the byte may be for this station, so that the station
    // must receive it.
    bool hear(uint8_t byte, uint64_t now) {
        addressed_ = node_.named(byte, addressed_);
        wait(now);
        return addressed_;
    }

    // Keep the station awake while it is receiving a byte that may be for it.
    void wait(uint64_t now) {
        if (addressed_) until_ = now + linger_;
    }

    // Return true if the station need not be simulated from edge `now` on, because it is idle and was not
    // addressed for some time. quiet: the master is sending no character; the station falls asleep only if
    // quiet is true.
    bool asleep(uint64_t now, bool quiet) {
        if (now < until_ || dut_.top.busy || !dut_.top.line)
            asleep_ = false;
        else
            asleep_ = asleep_ || quiet;
        return asleep_;
    }

    // Simulate the edges `from` to `to` - 1: receive `sent`, and append the changes of the driver of the
    // station.
    void run(uint64_t from, uint64_t to, const std::vector<Change>& sent, std::vector<Change>& driven) {
        Vboard& top = dut_.top;
        auto next = sent.begin();
        for (uint64_t now = from; now < to; ++now) {
            for (; next != sent.end() && next->at <= now; ++next) top.uart_rxd = next->level;
            dut_.tick();
            if (top.line != line_) {
                line_ = top.line;
                driven.push_back({now + 1, line_});
                // A reply is being sent. After the reply, the node is idle.
                until_ = now + after_reply_;
            }
            if (const auto pins = node_.look(top); pins != seen_) {
                seen_ = pins;
                node_.follow(top);
            }
        }
        for (; next != sent.end(); ++next) top.uart_rxd = next->level;
    }

    void inputs(unsigned levels, uint64_t now) {
        node_.inputs(dut_.top, levels);
        // The station stays awake for longer than the key filters of a PMC006B4.
        until_ = now + 100 * linger_;
    }

    std::string words() const { return node_.words(dut_.top); }
    unsigned number() const { return node_.number(dut_.top); }

   private:
    static constexpr uint64_t kSlice = 8000;

    Node node_;
    Dut dut_;
    const uint64_t linger_, after_reply_;
    uint64_t until_ = 0;
    uint64_t seen_ = 0;
    bool line_ = true, addressed_ = false, asleep_ = false;
};
