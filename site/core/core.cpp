// SPDX-License-Identifier: Apache-2.0
// A Verilated part as a WebAssembly module (or as a program, for the comparison of speeds): its clock, a queue of
// scheduled pin changes, a recorder of all pins, and motors with their switches. This file is the same for all
// parts: pins.h, which scripts/site/wasm.py writes, has the ports as words of 32 bits and their connections.
//
// Times are in cycles: t is the number of the next rising edge. A level put at t is valid on edge t; the row of an
// output at t has its level after edge t. Edge 0 is the first one with rst_n high. A recording of the harness
// follows the same rules.
#include <cstdint>
#include <vector>

#include "part.h"
#include "pins.h"
#include "plant.h"
#include "steps.h"
#include "verilated.h"

#ifdef __wasm__
#define EXPORT(name) extern "C" __attribute__((export_name(#name), visibility("default")))
#else
#define EXPORT(name) extern "C" __attribute__((visibility("default")))
#endif

namespace {

struct Row {
    double t;
    uint32_t pin;  // word of an output; kInput + word of an input; kStep + axis: a step, value 1 = CCW
    uint32_t value;
};
struct Later {
    double t;
    uint32_t pin, value;
};
constexpr uint32_t kInput = 1 << 16;
constexpr uint32_t kStep = 1 << 17;
constexpr uint32_t kRows = 1 << 15;
constexpr uint32_t kResetClk = 8;
constexpr uint32_t kQueue = 1 << 16;

struct Motor {
    Plant plant;
    PhaseSteps phases;
};

VerilatedContext* context;
Top* top;
Row rows[kRows];
uint32_t count;
Later queue[kQueue];
uint32_t queue_at, queue_end;
int64_t now;
uint32_t user[kInputs], applied[kInputs], level[kOutputs];
uint32_t pulled_low[kInputs], pulled_high[kInputs];  // bits that the plant drives
// A square wave on a pin: cycles low, cycles high, time of the next edge.
struct Wave {
    uint32_t pin, mask;
    int64_t low, high, next;
};
constexpr uint32_t kWaves = 4;
Wave waves[kWaves];
int64_t wave_next = INT64_MAX;
Motor motors[kAxes];
bool plant_on;
uint32_t moved, moved_by[kAxes];  // steps since power-up: of all motors, of each motor

void note(uint32_t pin, uint32_t value) { rows[count++] = {static_cast<double>(now), pin, value}; }

void apply(uint32_t pin) {
    const uint32_t value = (user[pin] & ~pulled_low[pin]) | pulled_high[pin];
    if (value == applied[pin]) return;
    applied[pin] = value;
    set_input(*top, pin, value);
    note(kInput + pin, value);
}

void pull(uint32_t* pulled, const Bit& bit, bool on) {
    if (bit.word < 0) return;
    const uint32_t mask = 1u << bit.place;
    pulled[bit.word] = on ? pulled[bit.word] | mask : pulled[bit.word] & ~mask;
    apply(bit.word);
}

bool high(const Bit& bit) { return level[bit.word] >> bit.place & 1; }

void pull_switches(uint32_t axis) {
    const Plant& plant = motors[axis].plant;
    const Switches& to = kSwitches[axis];
    const bool active[] = {plant.l1, plant.l2, plant.l3, plant.l4, plant.cnp, plant.alm};
    for (uint32_t n = 0; n < 6; ++n) pull(pulled_low, to.at[n], plant_on && active[n]);
}

// Move the motors that step with this change of an output.
void follow(uint32_t pin, uint32_t before) {
    for (uint32_t axis = 0; axis < kAxes; ++axis) {
        const Drive& drive = kDrives[axis];
        if (drive.step.word != static_cast<int>(pin)) continue;
        bool stepped = false, ccw = false;
        if (drive.phases) {
            const int step = motors[axis].phases.step(level[pin] >> drive.step.place & 31);
            stepped = step != 0;
            ccw = step < 0;
        } else {
            const bool was = before >> drive.step.place & 1, is = high(drive.step);
            stepped = was != is && is == drive.rises;
            ccw = drive.dir.word >= 0 && high(drive.dir) == drive.ccw;
            if (was != is) pull(pulled_high, drive.encoder, plant_on && stepped);
        }
        if (!stepped) continue;
        ++moved;
        ++moved_by[axis];
        if (drive.encoder_dir.word >= 0) pull(pulled_high, drive.encoder_dir, plant_on && ccw);
        motors[axis].plant.pulse(ccw);
        note(kStep + axis, ccw);
        if (plant_on) pull_switches(axis);
    }
}

// Read the outputs, and record and follow each change.
void look() {
    uint32_t is[kOutputs];
    get_outputs(*top, is);
    for (uint32_t n = 0; n < kOutputs; ++n) {
        if (is[n] == level[n]) continue;
        const uint32_t before = level[n];
        level[n] = is[n];
        note(n, is[n]);
        follow(n, before);
    }
}

}  // namespace

#ifdef __wasm__
// One thread: its objects exist as long as the module.
extern "C" int __cxa_thread_atexit(void (*)(void*), void*, void*) { return 0; }
#endif

// $fatal and failed assertions: the module traps after it has written the message to standard output.
void vl_stop(const char*, int, const char*) VL_MT_UNSAFE { __builtin_trap(); }
void vl_fatal(const char* file, int line, const char*, const char* text) VL_MT_UNSAFE {
    VL_PRINTF("%s:%d: %s\n", file, line, text);
    __builtin_trap();
}
void vl_finish(const char*, int, const char*) VL_MT_UNSAFE { __builtin_trap(); }

// Create the part as after power-up: eight cycles of reset, then t = 0. The queue, the rows and the levels set
// by the user are cleared.
EXPORT(power_up) void power_up() {
    delete top;
    delete context;
    context = new VerilatedContext;
    top = new Top{context};
    count = queue_at = queue_end = 0;
    now = -static_cast<int64_t>(kResetClk);
    for (uint32_t n = 0; n < kInputs; ++n) {
        pulled_low[n] = pulled_high[n] = 0;
        user[n] = applied[n] = kIdle[n];
        set_input(*top, n, kIdle[n]);
    }
    power_on(*top);
    set_reset(*top, false);
    for (; now < 0; ++now) {
        rise(*top);
        rearm(*top);
    }
    get_outputs(*top, level);
    set_reset(*top, true);
    for (Motor& motor : motors) motor.phases = PhaseSteps{};
    moved = 0;
    for (Wave& one : waves) one = {};
    wave_next = INT64_MAX;
    for (uint32_t& steps : moved_by) steps = 0;
    for (uint32_t axis = 0; axis < kAxes; ++axis) pull_switches(axis);
    count = 0;
}

// Set the positions of the carriage and of the switches of an axis, in pulses; CW is positive.
EXPORT(place) void place(uint32_t axis, double start, double ccw, double slow_ccw, double origin, double slow_cw, double cw) {
    PlantText text;
    text.start = static_cast<int64_t>(start);
    text.ccw = static_cast<int64_t>(ccw);
    text.slow_ccw = static_cast<int64_t>(slow_ccw);
    text.origin = static_cast<int64_t>(origin);
    text.slow_cw = static_cast<int64_t>(slow_cw);
    text.cw = static_cast<int64_t>(cw);
    motors[axis].plant = Plant(text);
    if (top) pull_switches(axis);
}
EXPORT(plant) void plant(uint32_t on) {
    plant_on = on;
    for (uint32_t axis = 0; axis < kAxes; ++axis) {
        pull_switches(axis);
        if (!on) {
            pull(pulled_high, kDrives[axis].encoder, false);
            pull(pulled_high, kDrives[axis].encoder_dir, false);
        }
    }
}
EXPORT(position) double position(uint32_t axis) { return static_cast<double>(motors[axis].plant.position()); }
EXPORT(steps) uint32_t steps(uint32_t axis) { return moved_by[axis]; }

// Set a level from the next edge on.
EXPORT(put) void put(uint32_t pin, uint32_t value) {
    if (pin == kInputs) {
        set_reset(*top, value);
        note(kInput + pin, value);
        settle(*top);
        return;
    }
    user[pin] = value;
    apply(pin);
}
// Start a square wave on the bits of `mask`: low for `low` cycles, then high for `high` cycles; 0 and 0 stop it.
// number: 0 to 3.
EXPORT(wave) void wave(uint32_t number, uint32_t pin, uint32_t mask, double low, double high) {
    Wave& one = waves[number % kWaves];
    one = {pin, mask, static_cast<int64_t>(low), static_cast<int64_t>(high), now + static_cast<int64_t>(low)};
    put(pin, user[pin] & ~mask);
    wave_next = INT64_MAX;
    for (const Wave& each : waves)
        if (each.low && each.next < wave_next) wave_next = each.next;
}
// Scheduled levels: write at most kQueue rows in order of time at queue_rows(), then call queued() with their number.
// Rows that are still pending are discarded.
EXPORT(queue_rows) Later* queue_rows() { return queue; }
EXPORT(queued) void queued(uint32_t rows_written) {
    queue_at = 0;
    queue_end = rows_written;
}
EXPORT(output) uint32_t output(uint32_t pin) { return level[pin]; }
EXPORT(input) uint32_t input(uint32_t pin) { return applied[pin]; }

EXPORT(clk_now) double clk_now() { return static_cast<double>(now); }
EXPORT(row_at) Row* row_at() { return rows; }
// Return the number of rows since the last call. The rows are valid until the next `run`, which overwrites them.
EXPORT(take) uint32_t take() {
    const uint32_t taken = count;
    count = 0;
    return taken;
}

// Run up to n cycles and return their number. Stop earlier if there is no space for rows; with bit 0 of `until`
// also after the first step of a motor, with bit 1 after any change of an output.
EXPORT(run) double run(double n, uint32_t until) {
    const int64_t end = now + static_cast<int64_t>(n), begin = now;
    const uint32_t before = moved;
    // Space for the rows of one edge: each output, each input twice, a step of each motor.
    constexpr uint32_t room = kRows - kOutputs - 2 * kInputs - kAxes - 16;
    while (now < end && count < room) {
        while (queue_at != queue_end && queue[queue_at].t <= static_cast<double>(now) && count < room) {
            put(queue[queue_at].pin, queue[queue_at].value);
            ++queue_at;
        }
        // The pending inputs belong to this edge, so the edge must wait until there is space for them.
        if (count >= room) break;
        if (now == wave_next) {
            wave_next = INT64_MAX;
            for (Wave& one : waves) {
                if (!one.low) continue;
                if (one.next == now) {
                    const bool was = user[one.pin] & one.mask;
                    put(one.pin, was ? user[one.pin] & ~one.mask : user[one.pin] | one.mask);
                    one.next += was ? one.low : one.high;
                }
                if (one.next < wave_next) wave_next = one.next;
            }
        }
        rise(*top);
        const uint32_t rows_before = count;
        look();
        rearm(*top);
        ++now;
        if ((until & 1) && moved != before) break;
        if ((until & 2) && count != rows_before) break;
    }
    return static_cast<double>(now - begin);
}
