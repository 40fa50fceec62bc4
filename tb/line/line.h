// SPDX-License-Identifier: Apache-2.0
// The virtual line: stations, each of which is the RTL of its board, and a master at a pseudo-terminal. The
// line has four wires. On one pair, the stations receive only the bytes of the master. On the other pair, the
// drivers of all stations are wired together and pull the line low; the master receives this pair. Therefore
// each station can be simulated separately for a slice of time in which the levels of the master are known.
#pragma once

#include <cstdint>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "arguments.h"
#include "pace.h"
#include "pty.h"
#include "station.h"
#include "uart.h"

class Line {
   public:
    Line(const Arguments& arguments, uint64_t clk_hz);

    const std::string& port() const { return pty_.path(); }

    // Simulate a slice of time (1/8 ms). While all stations are idle, sleep until the host sends. Return
    // false when the line must be disconnected.
    bool run(int wake_fd);

    // Return "name=value …": see LineStatus in openppmc/sim.
    std::string status() const;

    // Set the levels of the general inputs of a station.
    void inputs(unsigned number, unsigned levels);

   private:
    void serve();
    void simulate(uint64_t end);
    void run_stations(uint64_t end);
    void doze(int wake_fd);
    void hear(std::vector<Change>& changes, uint64_t end);
    bool spoiled() { return noise_ && random_() % noise_ == 0; }
    void spoil(std::vector<uint8_t>& bytes);

    const uint64_t clk_hz_;
    Pty pty_;
    std::vector<std::unique_ptr<Station>> stations_;
    Uart sends_, hears_;
    Pace pace_;
    std::mt19937_64 random_;
    const uint64_t noise_, unplug_;
    const bool echo_;

    uint64_t now_ = 0;
    int low_ = 0;  // number of drivers that pull the line low
    bool sent_ = true, dozing_ = false;
    std::vector<uint8_t> bytes_;
    std::vector<Change> going_, coming_;
    std::vector<Station*> awake_;
    const unsigned threads_;
};
