// SPDX-License-Identifier: Apache-2.0
// The PC side of the serial line: a pseudo-terminal. Its slave may be opened, closed and opened again at any
// time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

class Pty {
   public:
    // Throws std::runtime_error with a message of one line if the system has no free pseudo-terminal.
    Pty();
    ~Pty();
    Pty(const Pty&) = delete;
    Pty& operator=(const Pty&) = delete;

    const std::string& path() const { return path_; }
    int fd() const { return fd_; }

    // Read at most `room` of the bytes that the host has written, and detect whether the host has opened the
    // port. Never blocks.
    void read(std::vector<uint8_t>& to, size_t room);

    // Send bytes to the host. Bytes that do not fit into the receive buffer of the host are discarded. While
    // the port is closed, all bytes are discarded.
    void write(const std::vector<uint8_t>& bytes);

    // Return true if a process had opened the port at the last read().
    bool open() const { return open_; }

    // Return the line rate that the host has set, in bit/s; 0 after a hang-up.
    unsigned rate() const;

    // Return the number of bytes that were discarded because the host did not read them.
    uint64_t lost() const { return lost_; }

   private:
    int fd_ = -1;
    std::string path_;
    bool open_ = false;
    uint64_t lost_ = 0;
};
