// SPDX-License-Identifier: Apache-2.0
// Main program of all simulations under cocotb. In addition to the callbacks of VPI it has a clock and a recorder
// of output levels. They need no callbacks, so a cycle costs only two evaluations of the design. `CppBackend` in
// sim_backend.py calls this program. This file is compiled once for all designs; `top.cpp` contains the calls of
// one design.
// The makefile of Verilator optimises for size; the pragma selects -O2 instead.
#pragma GCC optimize("O2")

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "verilated.h"
#include "verilated_syms.h"
#include "verilated_vpi.h"
#if VM_COVERAGE
#include "verilated_cov.h"
#endif
#if VM_TRACE
#include "verilated_vcd_c.h"
#endif

void top_create();
void top_eval_step();
void top_eval_end_step();
std::uint64_t top_next_time();
void top_final();
#if VM_TRACE
void top_trace(VerilatedVcdC* file);
#endif
extern "C" void vlog_startup_routines_bootstrap(void);

namespace {

constexpr std::uint64_t NEVER = ~0ULL;
std::uint64_t main_time = 0;

// A port of the top module, or one 64-bit word of a port with more than 64 bits.
struct Port {
    void* data;
    std::uint32_t bytes;
    std::uint64_t load() const {
        switch (bytes) {
            case 1: return *static_cast<std::uint8_t*>(data);
            case 2: return *static_cast<std::uint16_t*>(data);
            case 4: return *static_cast<std::uint32_t*>(data);
            default: {
                std::uint64_t value;
                std::memcpy(&value, data, 8);  // words of a wide port are aligned to 4 bytes only
                return value;
            }
        }
    }
    void store(std::uint64_t value) const { std::memcpy(data, &value, bytes); }
};
// sim_backend.py reads and writes these structures as bytes.
struct Row {
    std::uint64_t time, port, value;
};
struct Watched {
    std::uint32_t port;
    std::uint64_t level;
};

std::vector<Port> ports;
std::vector<Watched> watched;
std::vector<Row> seen, taken, deposits;
int clock_port = -1;
std::uint64_t clock_level = 0, clock_next = NEVER, clock_half = 0;
bool dirty = false;  // a port has been written since the last evaluation
bool woken = true;   // a callback has run in this time step

bool value_callbacks() {
    bool any = false;
    while (VerilatedVpi::callValueCbs()) any = true;
    woken |= any;
    return any;
}

void callbacks(std::uint32_t reason) { woken |= VerilatedVpi::callCbs(reason); }

void do_puts() {
    VerilatedVpi::doInertialPuts();
    if (deposits.empty()) return;
    for (const Row& put : deposits) ports[put.port].store(put.value);
    deposits.clear();
    dirty = true;
}

bool eval_needed() { return dirty || VerilatedVpi::evalNeeded(); }

void evaluate() {
    VerilatedVpi::clearEvalNeeded();
    dirty = false;
    top_eval_step();
}

void record() {
    for (Watched& watch : watched) {
        const std::uint64_t level = ports[watch.port].load();
        if (level != watch.level) {
            watch.level = level;
            seen.push_back({main_time, watch.port, level});
        }
    }
}

// An edge of the clock. Assertions are enabled after the first rising edge. Before it, registers hold random
// values, and a reset that such a register already asserts has no edge.
void tick() {
    clock_level ^= 1;
    if (!clock_level) Verilated::assertOn(true);
    ports[clock_port].store(clock_level);
    clock_next += clock_half;
    dirty = true;
}

// Evaluate until all signals are stable, with all callbacks of the time step.
void settle() {
    do {
        do {
            evaluate();
            do_puts();
            value_callbacks();
        } while (eval_needed());
        callbacks(cbReadWriteSynch);
        do_puts();
        value_callbacks();
    } while (eval_needed());
}

#if VM_TRACE
VerilatedVcdC* trace_file = nullptr;
#endif

void close() {
    VerilatedVpi::callCbs(cbEndOfSimulation);
#if VM_TRACE
    if (trace_file) trace_file->close();
#endif
#if VM_COVERAGE
    VerilatedCov::write();
#endif
}

int port_of(const char* name, int* words) {
    const char* const dot = std::strrchr(name, '.');
    const std::string path = dot ? "TOP." + std::string(name, dot) : "TOP";
    const VerilatedScope* const scope = Verilated::threadContextp()->scopeFind(path.c_str());
    const VerilatedVar* const var = scope ? scope->varFind(dot ? dot + 1 : name) : nullptr;
    if (!var || var->udims()) return -1;
    const int first = static_cast<int>(ports.size());
    char* const data = static_cast<char*>(var->datap());
    const std::uint32_t bytes = static_cast<std::uint32_t>(var->entSize());
    for (std::uint32_t at = 0; at < bytes; at += 8) ports.push_back({data + at, bytes - at < 8 ? bytes - at : 8});
    *words = static_cast<int>(ports.size()) - first;
    return first;
}

}  // namespace

double sc_time_stamp() { return static_cast<double>(main_time); }

// Functions that sim_backend.py calls. Times are steps of the simulation, ports are numbers from openppmc_port().
extern "C" {

// Returns the number of a port, or -1 if there is no such port. *words: number of its 64-bit words, which have
// consecutive numbers.
int openppmc_port(const char* name, int* words) { return port_of(name, words); }

std::uint64_t openppmc_read(int port) { return ports[port].load(); }

std::uint64_t openppmc_time() { return main_time; }

// Works like a deposit of cocotb: the level takes effect at the next evaluation in this time step.
void openppmc_put(int port, std::uint64_t value) {
    deposits.push_back({main_time, static_cast<std::uint64_t>(port), value});
}

// Sets the clock low now; its first rising edge follows after `half`. A start of the clock ends all watches.
void openppmc_clock(int port, std::uint64_t half) {
    watched.clear();
    clock_port = port;
    clock_half = half;
    clock_level = 0;
    clock_next = main_time + half;
    Verilated::assertOn(false);
    openppmc_put(port, 0);
}

// A port that is already watched keeps its single entry: a process may create many benches.
void openppmc_watch(int port) {
    for (Watched& watch : watched) {
        if (watch.port != static_cast<std::uint32_t>(port)) continue;
        watch.level = ports[port].load();
        return;
    }
    watched.push_back({static_cast<std::uint32_t>(port), ports[port].load()});
}

// Returns the changes of watched ports since the last call; they are valid until the next call.
const Row* openppmc_seen(std::uint64_t* count) {
    record();
    taken.swap(seen);
    seen.clear();
    *count = taken.size();
    return taken.data();
}
}

int main(int argc, char** argv) {
    bool traced = false;
    for (int i = 1; i < argc; ++i) traced |= !std::strcmp(argv[i], "--trace");
    Verilated::commandArgs(argc, argv);
    top_create();
    Verilated::fatalOnVpiError(false);
#if VM_TRACE
    Verilated::traceEverOn(true);
    if (traced) {
        trace_file = new VerilatedVcdC;
        top_trace(trace_file);
        trace_file->open("dump.vcd");
    }
#else
    static_cast<void>(traced);
#endif
    vlog_startup_routines_bootstrap();
    Verilated::addExitCb([](void*) { close(); }, nullptr);
    VerilatedVpi::callCbs(cbStartOfSimulation);
    value_callbacks();
    settle();

    std::uint64_t deadline = 0;
    while (!Verilated::gotFinish()) {
        // End of the time step: all signals are stable.
        top_eval_end_step();
        callbacks(cbReadOnlySynch);
        record();
#if VM_TRACE
        if (trace_file) trace_file->dump(main_time);
#endif
        const bool waiting = woken;  // callbacks may wait for the next time step
        woken = false;
        // A scheduled callback may have been cancelled.
        if (waiting || deadline <= main_time) deadline = VerilatedVpi::cbNextDeadline();
        const std::uint64_t timing = top_next_time();
        std::uint64_t next = clock_next < timing ? clock_next : timing;
        if (deadline < next) next = deadline;
        if (next == NEVER) break;
        main_time = next;
        if (waiting || deadline == next) {
            callbacks(cbNextSimTime);
            value_callbacks();
            callbacks(cbAfterDelay);
            value_callbacks();
            // Levels that are set without a delay take effect before all others.
            if (eval_needed()) evaluate();
            do_puts();
        }
        if (clock_next <= next) tick();
        value_callbacks();
        if (woken) {
            settle();
            continue;
        }
        evaluate();
        if (value_callbacks()) {
            do_puts();
            settle();
        }
    }
    top_final();
    close();
    return Verilated::threadContextp()->errorCount() > 0 ? 1 : 0;
}
