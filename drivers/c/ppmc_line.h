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
    /** Send bytes, and return when the last stop bit was sent. On RS-485, also switch the driver
     * of the transceiver on and off. */
    void (*send)(void *ctx, const uint8_t *bytes, unsigned count);
    /** Wait at most `milliseconds` for a byte. False: no byte has arrived. 0: return only a byte that was
     * received before the call. */
    bool (*receive)(void *ctx, uint8_t *byte, unsigned milliseconds);
    void *ctx; /**< argument of the two functions */
    bool echo; /**< the receiver receives the frames of this host (two wires); the driver skips them */
} ppmc_line_t;

/** For the drivers only: discard bytes until the line was silent for `milliseconds`, or 64 bytes were
 * discarded. */
static inline void ppmc_line_drain(const ppmc_line_t *line, unsigned milliseconds)
{
    uint8_t byte;
    unsigned n;

    for (n = 0; n < 64u && line->receive(line->ctx, &byte, milliseconds); ++n) {
    }
}

#endif
