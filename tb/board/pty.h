// SPDX-License-Identifier: Apache-2.0
// The PC side of the serial line: a pseudo-terminal. Its slave may be opened, closed and opened again at any time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

class Pty {
   public:
    // Throws std::runtime_error with one line when the system has no pseudo-terminal left.
    Pty();
    ~Pty();
    Pty(const Pty&) = delete;
    Pty& operator=(const Pty&) = delete;

    const std::string& path() const { return path_; }
    int fd() const { return fd_; }

    // Takes what the host has written, at most `room` bytes, and notices whether it has the port open.
    // Never blocks.
    void read(std::vector<uint8_t>& to, size_t room);

    // Gives bytes to the host. What does not fit is lost, as with a receive buffer that is full; and so is
    // everything while the port is closed.
    void write(const std::vector<uint8_t>& bytes);

    // True while some process has the port open (as of the last read()).
    bool open() const { return open_; }

    // The line rate in bit/s that the host has set; 0 when it has hung up.
    unsigned rate() const;

    // Bytes lost because the host did not fetch them.
    uint64_t lost() const { return lost_; }

   private:
    int fd_ = -1;
    std::string path_;
    bool open_ = false;
    uint64_t lost_ = 0;
};
