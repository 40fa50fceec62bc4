// SPDX-License-Identifier: Apache-2.0
// The virtual board as a program. It first prints "port PATH" on standard output; or it prints "error TEXT"
// and ends. Then it answers each line "status" on standard input. The program ends when its standard input
// ends, so it never outlives its parent process.
#include <csignal>
#include <exception>
#include <memory>
#include <string>
#include <unistd.h>

#include "board.h"
#include "words.h"

#ifndef BOARD_CLK_HZ
#error "BOARD_CLK_HZ must be the CLK_HZ of the Verilated board"
#endif

namespace {

volatile std::sig_atomic_t stop = 0;

}  // namespace

int main(int argc, char** argv) {
    // Ctrl-C in a terminal is for the host program, which may have to stop a motor through this board.
    const bool by_hand = isatty(STDIN_FILENO);
    const auto end = [](int) { stop = 1; };
    std::signal(SIGINT, by_hand ? end : SIG_IGN);
    std::signal(SIGTERM, end);
    std::signal(SIGPIPE, SIG_IGN);
    try {
        const auto board = std::make_unique<Board>(parse_options(argc, argv), BOARD_CLK_HZ);
        say("port " + board->port());
        const auto answer = [&](const std::string& words) {
            if (words == "status") say("status " + board->status());
        };
        std::string rest;
        for (unsigned turn = 0; !stop; ++turn) {
            board->run(by_hand ? -1 : STDIN_FILENO);
            if (!by_hand && turn % 16 == 0 && !obey(rest, answer)) break;
        }
    } catch (const std::exception& error) {
        say(std::string("error ") + error.what());
        return 1;
    }
    return 0;
}
