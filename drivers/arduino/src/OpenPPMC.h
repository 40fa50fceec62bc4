/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file OpenPPMC.h
 * Access functions of the C drivers on an Arduino: a bank on SPI, and a part on an 8-bit bus.
 * The functions of ppmc_bank.h and ppmc104.h move the motors. For the other drivers of the library, include
 * their headers by name: stmc.h, ppmc2104.h, ppmc312.h, pmc006.h.
 */
#ifndef OPENPPMC_H
#define OPENPPMC_H

#include <Arduino.h>
#include <SPI.h>

#include "ppmc104.h"
#include "ppmc_bank.h"

/** Register window of a bank with ppmc_spi in front of it (docs/bank/spi.md). */
class PpmcSpi {
  public:
    /**
     * @param cs_pin pin connected to spi_cs_n
     * @param hz frequency of sck, at most an eighth of the frequency of `clk` in the FPGA
     */
    explicit PpmcSpi(uint8_t cs_pin, uint32_t hz = 1000000UL) : cs_(cs_pin), hz_(hz), faults_(0) {}

    /**
     * Set up the pins, and check that the bridge receives the bytes that this host sends. The check writes
     * MASK of axes 0 .. 3, which moves no motor.
     * @return false: no bridge, a wrong SPI mode, or sck is too fast
     */
    bool begin()
    {
        digitalWrite(cs_, HIGH);
        pinMode(cs_, OUTPUT);
        SPI.begin();
        frame(kMask, 0u, true); /* its status reports faults of earlier frames */
        faults_ = 0u;
        frame(kWrite | kMask, 0x05u, false);
        const bool same = frame(kMask, 0xFFu, true) == 0x05u;
        frame(kWrite | kMask, 0u, false);
        return frame(kMask, 0xFFu, true) == 0u && same && faults() == 0u;
    }

    /**
     * Return the errors since the last call as bits of the status byte, and clear them. 0: no error. 0x08: sck
     * is too fast, and the data read are not reliable. 0x04: a frame was cut. 0x02: a frame was rejected. Other
     * bits: no bridge, SPI mode 2, or sck is too fast.
     */
    uint8_t faults()
    {
        const uint8_t found = faults_;
        faults_ = 0u;
        return found;
    }

    /** @name Arguments of ppmc_bank_open(), whose `ctx` is the address of this object. @{ */
    static uint8_t read(void *self, unsigned address)
    {
        return static_cast<PpmcSpi *>(self)->frame(static_cast<uint16_t>(address), 0xFFu, true);
    }
    static void write(void *self, unsigned address, uint8_t value)
    {
        static_cast<PpmcSpi *>(self)->frame(static_cast<uint16_t>(kWrite | address), value, false);
    }
    /** @} */

  private:
    static const uint16_t kWrite = 0x8000u, kMask = PPMC_BANK_ADDRESS(0, PPMC_BANK_REG_MASK);

    /* `third`: the byte to write, or FF to request one byte. A read ends with 00, which requests no byte. */
    uint8_t frame(uint16_t header, uint8_t third, bool reads)
    {
        uint8_t status, value = 0u;

        SPI.beginTransaction(SPISettings(hz_, MSBFIRST, SPI_MODE0));
        digitalWrite(cs_, LOW);
        status = SPI.transfer(static_cast<uint8_t>(header >> 8));
        SPI.transfer(static_cast<uint8_t>(header & 0xFFu));
        SPI.transfer(third);
        if (reads) value = SPI.transfer(0u);
        digitalWrite(cs_, HIGH);
        SPI.endTransaction();
        /* Bit 0 is the interrupt of the bank. */
        faults_ = static_cast<uint8_t>(faults_ | ((status ^ 0x80u) & 0xFEu));
        return value;
    }

    uint8_t cs_;
    uint32_t hz_;
    uint8_t faults_;
};

/** A part with one address line on pins: D0 .. D7, A0, CS*, RD*, WR* (docs/ppmc104/README.md, chapter 4). */
class PpmcPins {
  public:
    /** @param data eight pins, D0 first; the array must exist as long as this object */
    PpmcPins(const uint8_t *data, uint8_t a0, uint8_t cs_n, uint8_t rd_n, uint8_t wr_n)
        : data_(data), a0_(a0), cs_(cs_n), rd_(rd_n), wr_(wr_n)
    {
    }

    /** Set up the pins; no access. */
    void begin()
    {
        digitalWrite(cs_, HIGH);
        digitalWrite(rd_, HIGH);
        digitalWrite(wr_, HIGH);
        pinMode(cs_, OUTPUT);
        pinMode(rd_, OUTPUT);
        pinMode(wr_, OUTPUT);
        pinMode(a0_, OUTPUT);
        drive(false);
    }

    /** @name Arguments of ppmc104_setup(), whose `ctx` is the address of this object. @{ */
    static uint8_t read(void *self, unsigned reg)
    {
        const PpmcPins &pins = *static_cast<PpmcPins *>(self);
        unsigned value = 0u, bit;

        pins.begin_strobe(pins.rd_, reg);
        for (bit = 0u; bit < 8u; ++bit) value |= (digitalRead(pins.data_[bit]) == HIGH ? 1u : 0u) << bit;
        pins.end_strobe(pins.rd_);
        return static_cast<uint8_t>(value);
    }
    static void write(void *self, unsigned reg, uint8_t value)
    {
        const PpmcPins &pins = *static_cast<PpmcPins *>(self);
        unsigned bit;

        pins.drive(true);
        for (bit = 0u; bit < 8u; ++bit) digitalWrite(pins.data_[bit], (value >> bit & 1u) != 0u ? HIGH : LOW);
        pins.begin_strobe(pins.wr_, reg);
        pins.end_strobe(pins.wr_);
        pins.drive(false);
    }
    /** @} */

  private:
    /* Let the controller drive the data lines, or release them. */
    void drive(bool on) const
    {
        for (unsigned bit = 0u; bit < 8u; ++bit) pinMode(data_[bit], on ? OUTPUT : INPUT);
    }

    /* Each level lasts at least 1 us; the part needs 250 ns at CLK_HZ = 16 MHz. */
    void begin_strobe(uint8_t pin, unsigned reg) const
    {
        digitalWrite(a0_, reg != 0u ? HIGH : LOW);
        digitalWrite(cs_, LOW);
        digitalWrite(pin, LOW);
        delayMicroseconds(1);
    }
    void end_strobe(uint8_t pin) const
    {
        digitalWrite(pin, HIGH);
        digitalWrite(cs_, HIGH);
        delayMicroseconds(1);
    }

    const uint8_t *data_;
    uint8_t a0_, cs_, rd_, wr_;
};

#endif
