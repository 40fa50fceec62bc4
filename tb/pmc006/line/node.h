// SPDX-License-Identifier: Apache-2.0
// Plant of a PMC006B4 on the virtual line: an EEPROM that may be stored in a file, and a carriage between two
// switches that follows the electrical angle. Positions are in 1/16 full steps, forward positive.
#pragma once

#include <cstdint>
#include <fstream>
#include <stdexcept>
#include <string>

#include "Vboard.h"
#include "Vboard___024root.h"
#include "arguments.h"

class Node {
   public:
    Node(const StationArguments& its, uint64_t)
        : way_(its.whole("start") * kStep / kUnit),
          low_(its.whole("low")),
          high_(its.whole("high")),
          gpi_(static_cast<unsigned>(its.whole("gpi", 31))),
          missing_(its.whole("no_eeprom")),
          image_(its.text("image")),
          kept_(its.text("keep")) {}

    void set_up(Vboard& top) {
        top.gpi = static_cast<uint8_t>(gpi_);
        set_switches(top);
        // The model of the EEPROM is initialised by the first evaluation.
        top.eval();
        auto& root = *top.rootp;
        root.line_node__DOT__u_eeprom__DOT__missing = missing_;
        std::ifstream file(image_, std::ios::binary);
        char byte;
        for (unsigned at = 0; at < kSize && file.get(byte); ++at)
            root.line_node__DOT__u_eeprom__DOT__memory[at] = static_cast<uint8_t>(byte);
    }

    uint64_t look(const Vboard& top) const {
        return top.angle | uint64_t{top.rootp->line_node__DOT__u_eeprom__DOT__writes} << 16;
    }

    void follow(Vboard& top) {
        // Difference of two angles: the shorter way around a circle of four full steps.
        const int turned = (top.angle - angle_ + 3 * kTurn / 2) % kTurn - kTurn / 2;
        angle_ = top.angle;
        way_ += turned;
        set_switches(top);
        const uint32_t writes = top.rootp->line_node__DOT__u_eeprom__DOT__writes;
        if (writes != writes_ && !kept_.empty()) keep(top);
        writes_ = writes;
    }

    // The address is known only after a complete frame. Therefore every station receives all characters.
    bool named(uint8_t, bool) const { return true; }

    uint64_t linger(uint64_t clk_hz) const { return clk_hz / 50; }

    bool booted(const Vboard& top) const { return !top.booting; }
    void inputs(Vboard& top, unsigned levels) { top.gpi = static_cast<uint8_t>(levels); }
    unsigned number(const Vboard& top) const { return top.address; }

    std::string words(const Vboard& top) const {
        const char* state = top.booting  ? "boot"
                            : top.moving ? "moving"
                            : top.free   ? "free"
                            : top.locked ? "locked"
                                         : "idle";
        return std::to_string(top.address) + ":" + std::to_string(place()) + ":" + state + ":" +
               bits(top.gpi) + ":" + bits(top.gpo);
    }

   private:
    static constexpr int kStep = 128, kUnit = 16, kTurn = 4 * kStep;
    static constexpr unsigned kSize = 4096;

    int64_t place() const {
        const int64_t all = way_ * kUnit;
        return all >= 0 ? all / kStep : -((-all + kStep - 1) / kStep);
    }

    void set_switches(Vboard& top) const {
        top.ext1 = place() > low_;
        top.ext2 = place() < high_;
    }

    void keep(const Vboard& top) const {
        std::ofstream file(kept_, std::ios::binary);
        for (unsigned at = 0; at < kSize; ++at)
            file.put(static_cast<char>(top.rootp->line_node__DOT__u_eeprom__DOT__memory[at]));
        if (!file.flush()) throw std::runtime_error("cannot write " + kept_);
    }

    static std::string bits(unsigned levels) {
        std::string text;
        for (int bit = 4; bit >= 0; --bit) text += levels >> bit & 1 ? '1' : '0';
        return text;
    }

    int64_t way_;
    const int64_t low_, high_;
    const unsigned gpi_;
    const bool missing_;
    const std::string image_, kept_;
    int angle_ = 64;  // angle after the reset
    uint32_t writes_ = 0;
};
