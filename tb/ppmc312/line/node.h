// SPDX-License-Identifier: Apache-2.0
// Plant of a PPMC-312 on the virtual line: a motor with an encoder, switches, and the straps of the station
// number.
#pragma once

#include <cstdint>
#include <cstdio>
#include <string>

#include "Vboard.h"
#include "arguments.h"
#include "plant.h"

class Node {
   public:
    Node(const StationArguments& its, uint64_t)
        : plant_(plant_text(its)),
          adr_(static_cast<unsigned>(its.whole("number"))),
          mod_(static_cast<unsigned>(its.line().whole("mod"))),
          xtal_hz_(static_cast<uint64_t>(its.line().whole("xtal", 16'000'000))) {}

    void set_up(Vboard& top) {
        top.adr = static_cast<uint8_t>(adr_);
        top.mod = static_cast<uint8_t>(mod_);
        top.epin = top.epdir = 0;
        set_switches(top);
    }

    uint64_t look(const Vboard& top) const { return top.pout; }

    // The motor steps at the rising edges of POUT. For each pulse that the shaft follows, the encoder outputs
    // a pulse of the same length.
    void follow(Vboard& top) {
        top.epin = 0;
        if (!top.pout) return;
        if (plant_.pulse(top.dir)) {
            top.epdir = top.dir;
            top.epin = 1;
        }
        set_switches(top);
    }

    // A control code selects a station. The characters after it are for this station.
    bool named(uint8_t byte, bool before) const { return byte & 0x80 ? (byte & 15) == adr_ : before; }

    // A pause of 320 000 crystal cycles ends a frame. The reply follows a few cycles later.
    uint64_t linger(uint64_t clk_hz) const { return 400'000 * clk_hz / xtal_hz_; }

    bool booted(const Vboard&) const { return true; }
    void inputs(Vboard&, unsigned) {}
    unsigned number(const Vboard&) const { return adr_; }

    std::string words(const Vboard& top) const {
        static const char* const kNames[] = {"INI", "NOR", "ACC", "FIX", "ABN", "WRN"};
        const char* name = "?";
        for (unsigned bit = 0; bit < 6; ++bit)
            if (top.status == 1u << bit) name = kNames[bit];
        return std::to_string(adr_) + ":" + std::to_string(plant_.position()) + ":" + name;
    }

   private:
    static PlantText plant_text(const StationArguments& its) {
        PlantText text;
        for (const auto& [name, field] :
             {std::pair{"start", &PlantText::start}, {"cw", &PlantText::cw}, {"ccw", &PlantText::ccw},
              {"slow_cw", &PlantText::slow_cw}, {"slow_ccw", &PlantText::slow_ccw}, {"origin", &PlantText::origin},
              {"origin_from", &PlantText::origin_from}, {"index", &PlantText::index}})
            text.*field = its.whole(name, text.*field);
        if (its.has("block")) text.block = its.whole("block");
        if (its.has("alarm_from")) text.alarm_from = its.whole("alarm_from"), text.alarm_to = its.whole("alarm_to");
        return text;
    }

    void set_switches(Vboard& top) const {
        top.fl_n = !plant_.l1;
        top.bl_n = !plant_.l2;
        top.fhl_n = !plant_.l3;
        top.bhl_n = !plant_.l4;
        top.org_n = !plant_.cnp;
        top.alm_n = !plant_.alm;
        top.index_n = !plant_.index;
    }

    Plant plant_;
    const unsigned adr_, mod_;
    const uint64_t xtal_hz_;
};
