// SPDX-License-Identifier: Apache-2.0
#include "board.h"

#include <algorithm>
#include <cinttypes>
#include <poll.h>
#include <stdexcept>

namespace {
constexpr size_t kQueue = 256;      // bytes accepted from the host before they are sent, as in a USB adapter
constexpr uint64_t kSlices = 8000;  // slices (steps of the simulation) per second of board time
constexpr uint64_t kRestSeconds = 2;  // longer than any timer that runs while part and bridge are idle
}  // namespace

Board::Board(const Options& options, uint64_t clk_hz)
    : clk_hz_(clk_hz), options_(options), dut_(idle_inputs), uart_(clk_hz), pace_(clk_hz, options.speed) {
    for (unsigned n = 0; n < kAxes; ++n) plants_[n] = Plant(options.plants[n]);
    if (!options_.vcd.empty()) {
        const double clk_per_ms = static_cast<double>(clk_hz) / 1000;
        trace_from_ = static_cast<uint64_t>(options_.vcd_from * clk_per_ms);
        trace_end_ = trace_from_ + static_cast<uint64_t>(options_.vcd_for * clk_per_ms);
    }
    if (!options_.log.empty()) {
        log_ = std::fopen(options_.log.c_str(), "w");
        if (!log_) throw std::runtime_error("cannot write " + options_.log);
        std::fputs(kAxes == 1 ? "# clk dir position\n" : "# clk dir position axis\n", log_);
    }
    set_switches(dut_.top, plants_);
    motion_ = motion_pins(dut_.top);
    busy_until_ = kRestSeconds * clk_hz_;
}

Board::~Board() {
#if VM_TRACE
    dut_.close_trace();
#endif
    if (log_) std::fclose(log_);
}

void Board::run(int wake_fd) {
    serve();
    if (now_ >= busy_until_ && now_ >= trace_end_) {
        doze(wake_fd);
        return;
    }
    trace_window();
    uint64_t end = now_ + clk_hz_ / kSlices;
    if (now_ < trace_end_) end = std::min(end, now_ < trace_from_ ? trace_from_ : trace_end_);
    simulate(end);
    pace_.keep(now_);
}

void Board::simulate(uint64_t end) {
    Vboard& top = dut_.top;
    if (tracing_) {
#if VM_TRACE
        const double ps = 1e12 / static_cast<double>(clk_hz_);
        for (; now_ < end; ++now_) {
            if (now_ >= wake_ || top.uart_txd != txd_ || motion_pins(top) != motion_) change();
            const double at = static_cast<double>(now_) * ps;
            dut_.tick_traced(static_cast<uint64_t>(at), static_cast<uint64_t>(at + ps / 2));
        }
#endif
        return;
    }
    uint64_t now = now_;
    for (; now < end; ++now) {
        if (now >= wake_ || top.uart_txd != txd_ || motion_pins(top) != motion_) {
            now_ = now;
            change();
        }
        dut_.tick();
    }
    now_ = now;
}

// Between two clock edges, the board does only this work in addition to the DUT: it handles a change of the
// UART, or of the pins that the motors follow.
void Board::change() {
    Vboard& top = dut_.top;
    txd_ = top.uart_txd;
    uart_.step(now_, txd_);
    top.uart_rxd = uart_.level();
    wake_ = uart_.next();
    const AxisBits pins = motion_pins(top);
    if (pins == motion_) return;
    const AxisBits stepped = motors_.steps(motion_, pins);
    motion_ = pins;
    encoder_low(top);
    if (!stepped) return;
    for (unsigned n = 0; n < kAxes; ++n) {
        if (!(stepped >> n & 1)) continue;
        const bool dir = motors_.ccw(top, n);
        if (plants_[n].pulse(dir)) encoder_pulse(top, dir);
        if (!log_) continue;
        std::fprintf(log_, "%" PRIu64 " %d %" PRId64, now_ - 1, dir, plants_[n].position());
        if (kAxes > 1) std::fprintf(log_, " %u", n + 1);
        std::fputc('\n', log_);
    }
    set_switches(top, plants_);
}

// Between two slices, transfer bytes from and to the host, and check whether there is any activity.
void Board::serve() {
    const Vboard& top = dut_.top;
    bytes_.clear();
    if (uart_.queued() < kQueue) pty_.read(bytes_, kQueue - uart_.queued());
    if (pty_.open()) uart_.set_rate(pty_.rate());
    const bool spoken = !bytes_.empty();
    if (spoken) {
        uart_.send(bytes_, now_);
        wake_ = uart_.next();
    }
    if (!uart_.received().empty()) {
        pty_.write(uart_.received());
        uart_.received().clear();
    }
    if (spoken || !uart_.idle() || top.hold != kAllAxes || top.led_link || !top.uart_txd) {
        if (dozing_) pace_.rebase(now_);
        dozing_ = false;
        busy_until_ = now_ + kRestSeconds * clk_hz_;
    }
}

// The part is idle, its timers have ended, and the link is silent. Therefore further cycles would change no
// relevant output.
void Board::doze(int wake_fd) {
    if (!dozing_ && log_) std::fflush(log_);
    dozing_ = true;
    const int64_t begin = Pace::wall();
    // If the pseudo-terminal is closed, poll() would return immediately. Therefore only poll again after a
    // short time.
    pollfd fds[2] = {{pty_.open() ? pty_.fd() : -1, POLLIN, 0}, {wake_fd, POLLIN, 0}};
    poll(fds, 2, pty_.open() ? 250 : 20);
    now_ += pace_.clk_in(Pace::wall() - begin);
    busy_until_ = now_;
}

// Open and close the waveform file at the beginning and end of its window.
void Board::trace_window() {
#if VM_TRACE
    const bool wanted = now_ >= trace_from_ && now_ < trace_end_;
    if (wanted && !tracing_) dut_.open_trace(options_.vcd);
    if (!wanted && tracing_) dut_.close_trace();
    tracing_ = wanted;
#endif
}

std::string Board::status() const {
    const Vboard& top = dut_.top;
    char line[300];
    std::snprintf(line, sizeof line,
                  "clk=%" PRIu64 " seconds=%.3f factor=%.3f asleep=%d open=%d rate=%u lost=%" PRIu64
                  " int=%d link=%d",
                  now_, static_cast<double>(now_) / static_cast<double>(clk_hz_), pace_.factor(), dozing_, pty_.open(),
                  pty_.rate(), pty_.lost(), interrupt(top), top.led_link);
    std::string all = line;
    for (unsigned n = 0; n < kAxes; ++n) {
        const Plant& plant = plants_[n];
        const unsigned s = phases(top, n);
        // The names of axis 2 end in 2, as in the options.
        const std::string suffix = n ? std::to_string(n + 1) : "";
        const char* of = suffix.c_str();
        std::snprintf(line, sizeof line,
                      " position%s=%" PRId64 " pulses%s=%" PRIu64
                      " l1%s=%d l2%s=%d l3%s=%d l4%s=%d cnp%s=%d alm%s=%d hold%s=%d phases%s=%d%d%d%d%d",
                      of, plant.position(), of, plant.pulses(), of, plant.l1, of, plant.l2, of, plant.l3, of, plant.l4,
                      of, plant.cnp, of, plant.alm, of, static_cast<int>(top.hold >> n & 1), of, s >> 4 & 1, s >> 3 & 1, s >> 2 & 1,
                      s >> 1 & 1, s & 1);
        all += line;
    }
    return all;
}
