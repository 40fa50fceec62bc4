// SPDX-License-Identifier: Apache-2.0
// The functions of Arduino that the examples use, on the pins of a simulated part (sketch.h).
#ifndef ARDUINO_H
#define ARDUINO_H

#include <cstddef>
#include <cstdint>
#include <cstdio>

// Levels and modes are types, as in the newer cores of Arduino.
enum PinStatus { LOW, HIGH };
enum PinMode { INPUT, OUTPUT };
enum : uint8_t { A0 = 14, A1, A2, A3 };

void pinMode(uint8_t pin, PinMode mode);
void digitalWrite(uint8_t pin, PinStatus level);
PinStatus digitalRead(uint8_t pin);
void delay(unsigned long ms);
void delayMicroseconds(unsigned us);

struct SerialPort {
    void begin(unsigned long) {}
    void print(const char *text) { std::printf("%s", text); }
    void print(long value) { std::printf("%ld", value); }
    template <class Value>
    void println(Value value) {
        print(value);
        std::printf("\n");
    }
};

extern SerialPort Serial;

#endif
