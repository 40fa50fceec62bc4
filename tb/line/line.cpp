// SPDX-License-Identifier: Apache-2.0
#include "line.h"

#include <algorithm>
#include <cinttypes>
#include <cstdio>
#include <future>
#include <poll.h>
#include <thread>

namespace {
constexpr size_t kQueue = 256;      // bytes accepted from the host before the line sends them
constexpr uint64_t kSlices = 8000;  // slices (steps of the simulation) per second of line time
}  // namespace

Line::Line(const Arguments& arguments, uint64_t clk_hz)
    : clk_hz_(clk_hz),
      sends_(clk_hz),
      hears_(clk_hz),
      pace_(clk_hz, arguments.real("speed", 1.0)),
      random_(static_cast<uint64_t>(arguments.whole("seed", 1))),
      noise_(static_cast<uint64_t>(arguments.whole("noise"))),
      unplug_(arguments.has("unplug")
                  ? static_cast<uint64_t>(arguments.real("unplug", 0) * static_cast<double>(clk_hz))
                  : Uart::kNever),
      echo_(arguments.whole("echo")),
      threads_(std::max(1u, std::thread::hardware_concurrency())) {
    const auto count = static_cast<unsigned>(arguments.whole("stations", 1));
    for (unsigned place = 0; place < count; ++place)
        stations_.push_back(std::make_unique<Station>(StationArguments(arguments, place), clk_hz));
    pace_.rebase(0);
}

bool Line::run(int wake_fd) {
    if (now_ >= unplug_) return false;
    serve();
    awake_.clear();
    for (const auto& one : stations_)
        if (!one->asleep(now_, sends_.idle())) awake_.push_back(one.get());
    if (awake_.empty() && sends_.idle() && hears_.idle()) {
        doze(wake_fd);
        return true;
    }
    if (dozing_) pace_.rebase(now_);
    dozing_ = false;
    simulate(now_ + clk_hz_ / kSlices);
    pace_.keep(now_);
    return true;
}

// Transfer bytes from and to the host. If a byte may be for a station, wake this station.
void Line::serve() {
    bytes_.clear();
    if (sends_.queued() < kQueue) pty_.read(bytes_, kQueue - sends_.queued());
    if (pty_.open()) {
        sends_.set_rate(pty_.rate());
        hears_.set_rate(pty_.rate());
    }
    if (!bytes_.empty()) {
        spoil(bytes_);
        for (const uint8_t byte : bytes_)
            for (const auto& one : stations_) one->hear(byte, now_);
        sends_.send(bytes_, now_);
    }
    if (!hears_.received().empty()) {
        spoil(hears_.received());
        pty_.write(hears_.received());
        hears_.received().clear();
    }
}

// Damage some characters: invert one bit, or discard the character.
void Line::spoil(std::vector<uint8_t>& bytes) {
    for (auto byte = bytes.begin(); byte != bytes.end();) {
        const unsigned bit = spoiled() ? random_() % 9 : 9;
        if (bit < 8) *byte ^= static_cast<uint8_t>(1u << bit);
        byte = bit == 8 ? bytes.erase(byte) : byte + 1;
    }
}

void Line::simulate(uint64_t end) {
    going_.clear();
    coming_.clear();
    while (sends_.next() < end) {
        const uint64_t at = sends_.next();
        sends_.step(at, true);
        if (sends_.level() != sent_) {
            sent_ = sends_.level();
            going_.push_back({at, sent_});
        }
    }
    if (!sends_.idle())
        for (Station* const one : awake_) one->wait(end);
    run_stations(end);
    if (echo_) coming_.insert(coming_.end(), going_.begin(), going_.end());
    hear(coming_, end);
    now_ = end;
}

// Run the stations separately, distributed over the processors.
void Line::run_stations(uint64_t end) {
    const unsigned shares = std::min<unsigned>(threads_, static_cast<unsigned>(awake_.size()));
    const auto work = [this, end, shares](unsigned share) {
        std::vector<Change> driven;
        for (size_t n = share; n < awake_.size(); n += shares) awake_[n]->run(now_, end, going_, driven);
        return driven;
    };
    std::vector<std::future<std::vector<Change>>> others;
    for (unsigned share = 1; share < shares; ++share)
        others.push_back(std::async(std::launch::async, work, share));
    if (shares) coming_ = work(0);
    for (auto& one : others) {
        const std::vector<Change> driven = one.get();
        coming_.insert(coming_.end(), driven.begin(), driven.end());
    }
}

// Run the receiver of the master up to `end`. It samples the changes of the drivers that pull the line low,
// in order of time.
void Line::hear(std::vector<Change>& changes, uint64_t end) {
    const auto before = [](const Change& a, const Change& b) { return a.at < b.at; };
    std::stable_sort(changes.begin(), changes.end(), before);
    for (const Change& change : changes) {
        while (hears_.next() < change.at) hears_.step(hears_.next(), low_ == 0);
        low_ += change.level ? -1 : 1;
        hears_.step(change.at, low_ == 0);
    }
    while (hears_.next() < end) hears_.step(hears_.next(), low_ == 0);
}

// All stations are idle and the line is silent, so further cycles would not change any state.
void Line::doze(int wake_fd) {
    dozing_ = true;
    const int64_t begin = Pace::wall();
    pollfd fds[2] = {{pty_.open() ? pty_.fd() : -1, POLLIN, 0}, {wake_fd, POLLIN, 0}};
    poll(fds, 2, pty_.open() ? 250 : 20);
    now_ += pace_.clk_in(Pace::wall() - begin);
}

void Line::inputs(unsigned number, unsigned levels) {
    for (const auto& one : stations_)
        if (one->number() == number) one->inputs(levels, now_);
}

std::string Line::status() const {
    char line[200];
    std::snprintf(line, sizeof line, "seconds=%.3f factor=%.3f lost=%" PRIu64 " stations=",
                  static_cast<double>(now_) / static_cast<double>(clk_hz_), dozing_ ? 1.0 : pace_.factor(),
                  pty_.lost());
    std::string all = line;
    for (const auto& one : stations_) all += (one == stations_.front() ? "" : ",") + one->words();
    return all;
}
