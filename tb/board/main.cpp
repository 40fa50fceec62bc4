// SPDX-License-Identifier: Apache-2.0
// The virtual board as a program. Says on standard output "port PATH" first, or "error TEXT" and ends; then answers
// each line "status" on standard input. It ends with its standard input, so it never outlives the one who started it.
#include <csignal>
#include <cstdio>
#include <exception>
#include <memory>
#include <poll.h>
#include <string>
#include <unistd.h>

#include "board.h"

#ifndef BOARD_CLK_HZ
#error "BOARD_CLK_HZ must be the CLK_HZ of the Verilated board"
#endif

namespace {

volatile std::sig_atomic_t stop = 0;

void say(const std::string& line) {
    std::puts(line.c_str());
    std::fflush(stdout);
}

// Obeys the lines on standard input; false at its end.
bool obey(const Board& board, std::string& rest) {
    pollfd in{STDIN_FILENO, POLLIN, 0};
    while (poll(&in, 1, 0) > 0) {
        char text[256];
        const ssize_t n = read(STDIN_FILENO, text, sizeof text);
        if (n <= 0) return false;
        rest.append(text, static_cast<size_t>(n));
        for (size_t end; (end = rest.find('\n')) != std::string::npos; rest.erase(0, end + 1))
            if (rest.compare(0, end, "status") == 0) say("status " + board.status());
    }
    return true;
}

}  // namespace

int main(int argc, char** argv) {
    // Ctrl-C in a terminal is meant for the host program, which may have to stop a motor through this board.
    const bool by_hand = isatty(STDIN_FILENO);
    const auto end = [](int) { stop = 1; };
    std::signal(SIGINT, by_hand ? end : SIG_IGN);
    std::signal(SIGTERM, end);
    std::signal(SIGPIPE, SIG_IGN);
    try {
        const auto board = std::make_unique<Board>(parse_options(argc, argv), BOARD_CLK_HZ);
        say("port " + board->port());
        std::string rest;
        for (unsigned turn = 0; !stop; ++turn) {
            board->run(by_hand ? -1 : STDIN_FILENO);
            if (!by_hand && turn % 16 == 0 && !obey(*board, rest)) break;
        }
    } catch (const std::exception& error) {
        say(std::string("error ") + error.what());
        return 1;
    }
    return 0;
}
