// SPDX-License-Identifier: Apache-2.0
// Protocol between a virtual board or line and its parent process: the program writes lines of text to
// standard output, and answers each line of standard input in order.
#pragma once

#include <cstdio>
#include <poll.h>
#include <string>
#include <unistd.h>

inline void say(const std::string& line) {
    std::puts(line.c_str());
    std::fflush(stdout);
}

// Pass each complete line of standard input to `answer`. `rest` stores an incomplete line. Return false at
// the end of the file.
template <typename Answer>
bool obey(std::string& rest, Answer answer) {
    pollfd in{STDIN_FILENO, POLLIN, 0};
    while (poll(&in, 1, 0) > 0) {
        char text[256];
        const ssize_t n = read(STDIN_FILENO, text, sizeof text);
        if (n <= 0) return false;
        rest.append(text, static_cast<size_t>(n));
        for (size_t end; (end = rest.find('\n')) != std::string::npos; rest.erase(0, end + 1))
            answer(rest.substr(0, end));
    }
    return true;
}
