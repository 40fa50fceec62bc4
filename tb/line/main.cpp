// SPDX-License-Identifier: Apache-2.0
// The virtual line as a program. It first prints "port PATH" on standard output; or it prints "error TEXT"
// and ends. Then it answers the lines "status" and "inputs NUMBER LEVELS" on standard input. The program ends
// when its standard input ends, so it never outlives its parent process.
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <memory>
#include <string>
#include <unistd.h>

#include "line.h"
#include "words.h"

#ifndef BOARD_CLK_HZ
#error "BOARD_CLK_HZ must be the CLK_HZ of the Verilated stations"
#endif

namespace {

volatile std::sig_atomic_t stop = 0;

void answer(Line& line, const std::string& words) {
    unsigned number;
    char levels[40];
    if (std::sscanf(words.c_str(), "inputs %u %39[01]", &number, levels) == 2)
        line.inputs(number, static_cast<unsigned>(std::strtoul(levels, nullptr, 2)));
    say("status " + line.status());
}

}  // namespace

int main(int argc, char** argv) {
    // Ctrl-C in a terminal is for the host program, which may have to stop a motor through this line.
    std::signal(SIGINT, SIG_IGN);
    std::signal(SIGTERM, [](int) { stop = 1; });
    std::signal(SIGPIPE, SIG_IGN);
    try {
        const auto line = std::make_unique<Line>(Arguments(argc, argv), BOARD_CLK_HZ);
        say("port " + line->port());
        const auto told = [&](const std::string& words) { answer(*line, words); };
        std::string rest;
        while (!stop && line->run(STDIN_FILENO) && obey(rest, told)) {
        }
    } catch (const std::exception& error) {
        say(std::string("error ") + error.what());
        return 1;
    }
    return 0;
}
