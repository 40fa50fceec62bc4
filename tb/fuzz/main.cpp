// SPDX-License-Identifier: Apache-2.0
// Feeds a deframer with the characters of a line, and prints the events that it reports, for
// scripts/measure/fuzz.
// Standard input: words of 16 bits, lowest byte first. Bits 7:0: a character. Bit 8: the character has no
// stop bit. Bit 9: a silence instead of a character.
// Standard output: for each event, the number of the word (32 bits) and the event (64 bits).
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <vector>

#include "Vfuzz.h"

namespace {
constexpr unsigned kBetween = 12, kSilence = 160;  // cycles between two characters; cycles of a silence

class Bench {
  public:
    Bench() {
        dut_.rst_ni = 0;
        clk();
        dut_.rst_ni = 1;
        clk();
    }

    void feed(uint16_t word) {
        const bool silence = word >> 9 & 1;
        dut_.byte_i = word & 0xff;
        dut_.valid_i = !silence && !(word >> 8 & 1);
        dut_.error_i = !silence && (word >> 8 & 1);
        dut_.silence_i = silence;
        clk();
        dut_.valid_i = dut_.error_i = 0;
        for (unsigned n = 1; n < (silence ? kSilence : kBetween); ++n) clk();
        ++index_;
    }

  private:
    // These are the outputs before the edge, with the current inputs.
    void clk() {
        dut_.clk_i = 0;
        dut_.eval();
        if (dut_.event_o && dut_.rst_ni) {
            char row[12];
            const uint64_t what = dut_.what_o;
            std::memcpy(row, &index_, 4);
            std::memcpy(row + 4, &what, 8);
            std::fwrite(row, sizeof row, 1, stdout);
        }
        dut_.clk_i = 1;
        dut_.eval();
    }

    Vfuzz dut_;
    uint32_t index_ = 0;
};
}  // namespace

int main() {
    Bench bench;
    std::vector<uint16_t> words(1 << 16);
    while (const size_t count = std::fread(words.data(), 2, words.size(), stdin))
        for (size_t n = 0; n < count; ++n) bench.feed(words[n]);
}
