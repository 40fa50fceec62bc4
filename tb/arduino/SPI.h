// SPDX-License-Identifier: Apache-2.0
// The functions of Arduino's SPI that the library uses, on the pins of a simulated part (sketch.h).
#ifndef SPI_H
#define SPI_H

#include <Arduino.h>

enum : uint8_t { LSBFIRST = 0, MSBFIRST = 1, SPI_MODE0 = 0x00, SPI_MODE1 = 0x04 };

struct SPISettings {
    SPISettings(uint32_t clock, uint8_t bits, uint8_t kind) : hz(clock), order(bits), mode(kind) {}
    uint32_t hz;
    uint8_t order, mode;
};

struct SPIPort {
    void begin() {}
    void beginTransaction(const SPISettings &settings);
    uint8_t transfer(uint8_t value);
    void endTransaction();
};

extern SPIPort SPI;

#endif
