/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file ppmc_line.h
 * Access functions of a serial line, for ppmc312.h and pmc006.h.
 */
#ifndef PPMC_LINE_H
#define PPMC_LINE_H

#include <stdbool.h>
#include <stdint.h>

/** A serial line with 8 data bits, no parity, one stop bit. Several stations may share one ppmc_line_t. */
typedef struct {
    /** Send bytes and return when the last stop bit was sent; on RS-485 also switch the driver on and off. */
    void (*send)(void *ctx, const uint8_t *bytes, unsigned count);
    /** Wait at most `milliseconds` for a byte; false if no byte has arrived. 0: return only a byte received
     * already. */
    bool (*receive)(void *ctx, uint8_t *byte, unsigned milliseconds);
    void *ctx; /**< passed to the functions */
    bool echo; /**< the receiver receives its own frames (two wires); the driver skips these frames */
} ppmc_line_t;

/** Of the drivers: discard bytes until the line was silent for `milliseconds`, or up to 64 bytes. */
static inline void ppmc_line_drain(const ppmc_line_t *line, unsigned milliseconds)
{
    uint8_t byte;
    unsigned n;

    for (n = 0; n < 64u && line->receive(line->ctx, &byte, milliseconds); ++n) {
    }
}

#endif
