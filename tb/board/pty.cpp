// SPDX-License-Identifier: Apache-2.0
#include "pty.h"

// The kernel's termios2 has line rates as plain numbers. Its header cannot be used together with <termios.h>.
#include <asm/termbits.h>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <poll.h>
#include <stdexcept>
#include <sys/ioctl.h>
#include <unistd.h>

Pty::Pty() {
    fd_ = posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC);
    if (fd_ < 0 || grantpt(fd_) || unlockpt(fd_))
        throw std::runtime_error(std::string("no pseudo-terminal to be had: ") + std::strerror(errno));
    path_ = ptsname(fd_);
    fcntl(fd_, F_SETFL, fcntl(fd_, F_GETFL) | O_NONBLOCK);
    // Raw mode from the beginning, so that no character is echoed to the board before the host has set its
    // mode.
    termios2 mode;
    ioctl(fd_, TCGETS2, &mode);
    mode.c_iflag = 0;
    mode.c_oflag = 0;
    mode.c_lflag = 0;
    mode.c_cflag = CS8 | CREAD | CLOCAL | BOTHER;
    mode.c_ispeed = mode.c_ospeed = 115200;
    ioctl(fd_, TCSETS2, &mode);
    // A pseudo-terminal that was never opened does not report a hang-up. Therefore open and close it once.
    ::close(::open(path_.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC));
}

Pty::~Pty() { ::close(fd_); }

void Pty::read(std::vector<uint8_t>& to, size_t room) {
    uint8_t bytes[512];
    while (room) {
        const ssize_t n = ::read(fd_, bytes, room < sizeof bytes ? room : sizeof bytes);
        if (n <= 0) {
            // EIO: no process has opened the port. This is not an error; the port works again after the next
            // open().
            open_ = !(n < 0 && errno == EIO);
            return;
        }
        open_ = true;
        to.insert(to.end(), bytes, bytes + n);
        room -= static_cast<size_t>(n);
    }
}

void Pty::write(const std::vector<uint8_t>& bytes) {
    if (!open_) return;
    size_t done = 0;
    while (done < bytes.size()) {
        const ssize_t n = ::write(fd_, bytes.data() + done, bytes.size() - done);
        if (n < 0 && errno == EINTR) continue;
        if (n <= 0) break;
        done += static_cast<size_t>(n);
    }
    lost_ += bytes.size() - done;
}

unsigned Pty::rate() const {
    termios2 mode;
    if (ioctl(fd_, TCGETS2, &mode)) return 0;
    return (mode.c_cflag & CBAUD) == B0 ? 0 : mode.c_ospeed;
}
