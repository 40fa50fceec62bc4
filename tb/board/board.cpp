// SPDX-License-Identifier: Apache-2.0
#include "board.h"

#include <algorithm>
#include <cinttypes>
#include <poll.h>
#include <stdexcept>

namespace {
constexpr size_t kQueue = 256;      // bytes taken from the host ahead of the line, as a USB adapter would
constexpr uint64_t kSlices = 8000;  // a second
constexpr uint64_t kRestSeconds = 2;  // longer than any timer of part and bridge that runs while both rest
}  // namespace

Board::Board(const Options& options, uint64_t clk_hz)
    : clk_hz_(clk_hz), options_(options), plant_(options.plant), uart_(clk_hz), pace_(clk_hz, options.speed) {
    if (!options_.vcd.empty()) {
        const double clk_per_ms = static_cast<double>(clk_hz) / 1000;
        trace_from_ = static_cast<uint64_t>(options_.vcd_from * clk_per_ms);
        trace_end_ = trace_from_ + static_cast<uint64_t>(options_.vcd_for * clk_per_ms);
    }
    if (!options_.log.empty()) {
        log_ = std::fopen(options_.log.c_str(), "w");
        if (!log_) throw std::runtime_error("cannot write " + options_.log);
        std::fputs("# clk dir position\n", log_);
    }
    apply_switches();
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
            if (now_ >= wake_ || top.uart_txd != txd_ || top.pout_n != pout_) change();
            const double at = static_cast<double>(now_) * ps;
            dut_.tick_traced(static_cast<uint64_t>(at), static_cast<uint64_t>(at + ps / 2));
        }
#endif
        return;
    }
    uint64_t now = now_;
    for (; now < end; ++now) {
        if (now >= wake_ || top.uart_txd != txd_ || top.pout_n != pout_) {
            now_ = now;
            change();
        }
        dut_.tick();
    }
    now_ = now;
}

// The only work between two clk edges that is not the DUT's: something at the UART or the pulse output has changed.
void Board::change() {
    Vboard& top = dut_.top;
    txd_ = top.uart_txd;
    uart_.step(now_, txd_);
    top.uart_rxd = uart_.level();
    wake_ = uart_.next();
    if (top.pout_n == pout_) return;
    pout_ = top.pout_n;
    if (pout_) return;
    plant_.pulse(top.dir);
    apply_switches();
    if (log_) std::fprintf(log_, "%" PRIu64 " %d %" PRId64 "\n", now_ - 1, top.dir, plant_.position());
}

void Board::apply_switches() {
    Vboard& top = dut_.top;
    top.l1_n = !plant_.l1;
    top.l2_n = !plant_.l2;
    top.l3_n = !plant_.l3;
    top.l4_n = !plant_.l4;
    top.cnp_n = !plant_.cnp;
    top.alm_n = !plant_.alm;
}

// Between two slices: bytes from and to the host, and whether anything is going on at all.
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
    if (spoken || !uart_.idle() || !top.hold || top.led_link || !top.uart_txd || !top.pout_n) {
        if (dozing_) pace_.rebase(now_);
        dozing_ = false;
        busy_until_ = now_ + kRestSeconds * clk_hz_;
    }
}

// The part rests, its timers have ended, the link is silent: simulating more clk would change no output that counts.
void Board::doze(int wake_fd) {
    if (!dozing_ && log_) std::fflush(log_);
    dozing_ = true;
    const int64_t begin = Pace::wall();
    // A closed pseudo-terminal would end poll() at once; look again soon instead.
    pollfd fds[2] = {{pty_.open() ? pty_.fd() : -1, POLLIN, 0}, {wake_fd, POLLIN, 0}};
    poll(fds, 2, pty_.open() ? 250 : 20);
    now_ += pace_.clk_in(Pace::wall() - begin);
    busy_until_ = now_;
}

// Opens and closes the waveform file at the ends of its window.
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
    char line[400];
    std::snprintf(line, sizeof line,
                  "clk=%" PRIu64 " seconds=%.3f factor=%.3f asleep=%d open=%d rate=%u lost=%" PRIu64
                  " position=%" PRId64 " pulses=%" PRIu64
                  " l1=%d l2=%d l3=%d l4=%d cnp=%d alm=%d hold=%d int=%d link=%d phases=%d%d%d%d%d",
                  now_, static_cast<double>(now_) / static_cast<double>(clk_hz_), pace_.factor(), dozing_, pty_.open(),
                  pty_.rate(), pty_.lost(), plant_.position(), plant_.pulses(), plant_.l1, plant_.l2, plant_.l3,
                  plant_.l4, plant_.cnp, plant_.alm, top.hold, !top.int_n, top.led_link, top.s >> 4 & 1, top.s >> 3 & 1,
                  top.s >> 2 & 1, top.s >> 1 & 1, top.s & 1);
    return line;
}
