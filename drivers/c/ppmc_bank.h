/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file ppmc_bank.h
 * Driver for a bank of PPMC-104 axes: C99, no dependencies, no heap, no floating point, no globals.
 * Each axis is a PPMC-104, so this driver uses ppmc104.h: add ppmc104.c and ppmc_bank.c to a program. The
 * user supplies two functions that access the window of 10 address bits. Axes count from 0, as in the
 * address. One ppmc_bank_t serves one bank. Calls for the same bank, including calls for its axes, must not
 * overlap.
 */
#ifndef PPMC_BANK_H
#define PPMC_BANK_H

#include "ppmc104.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Largest number of axes of a bank. Smaller banks have 4, 8, 16 or 32 axes. */
#define PPMC_BANK_AXES_MAX 64u

/** Address of a register of an axis: argument `address` of the access functions. In a memory map, multiply
 * it by 4. */
#define PPMC_BANK_ADDRESS(axis, reg) ((unsigned)(axis) << 4 | (unsigned)(reg))

/** @name Registers
 * In addition to 0 and 1, which are those of ppmc104.h. @{ */
/* Registers, written by `make packages` from packages/registers/ppmc_bank.rdl. */
#define PPMC_BANK_REG_CONFIG 0x2u /**< levels of the pins of the old chip */
/** position of the axis, low byte first; a read of the first byte latches the other three */
#define PPMC_BANK_REG_POSITION 0x4u
#define PPMC_BANK_REG_MASK 0x8u /**< byte k: members of the group */
#define PPMC_BANK_REG_PENDING 0x9u /**< byte k: map of the interrupts pending */
#define PPMC_BANK_REG_GO 0xAu /**< any byte: the held operations of the group continue; reads as 0x00 */
#define PPMC_BANK_REG_STOP 0xBu /**< any byte: every motion ends; reads as 0x00 */
#define PPMC_BANK_REG_INFO 0xCu /**< k = 0: 0x42 ("B"); 1: 0x01 (version); 2: N; else 0x00 */
#define PPMC_BANK_CONFIG_VSEL 0x02u /**< intervals by the rate formula alone, else 7.5 us longer */
#define PPMC_BANK_CONFIG_CSEL 0x01u /**< base clock XTAL / 32, else XTAL / 128 */
#define PPMC_BANK_INFO_MARK 0x42u /**< byte 0 */
#define PPMC_BANK_INFO_VERSION 0x01u /**< byte 1: version of the window */
/* End of the registers. */
/** @} */

/** Set of axes: bit n is axis n. */
typedef uint64_t ppmc_bank_set_t;

/** One bank. Fill it with ppmc_bank_open(). */
typedef struct {
    uint8_t (*read)(void *ctx, unsigned address);              /**< make one read access of the window */
    void (*write)(void *ctx, unsigned address, uint8_t value); /**< make one write access of the window */
    void *ctx;                                                 /**< argument of the two functions */
    uint8_t axes;                                              /**< number of axes */
    ppmc_bank_set_t held;                                      /**< private: MASK while a group is loaded */
} ppmc_bank_t;

/**
 * One axis. Fill it with ppmc_bank_axis(), and do not move it in memory, because `part` points to it. All
 * functions of ppmc104.h work with `&axis.part`; `part.limit` and `part.give_up` are those of ppmc104.h. If a
 * function needs a feature that a bank does not have (config.external_clock, ppmc104_aux...), the part
 * rejects it with PPMC104_ERR_UNKNOWN.
 */
typedef struct {
    ppmc104_t part;
    const ppmc_bank_t *bank;
    uint8_t number;
} ppmc_bank_axis_t;

/**
 * Fill `bank`, check which bank responds, and clear MASK. No motion starts, and running motions continue.
 * @return PPMC104_NO_PART if INFO is not that of a bank with version 1 of the window
 */
ppmc104_result_t ppmc_bank_open(ppmc_bank_t *bank, uint8_t (*read)(void *ctx, unsigned address),
                                void (*write)(void *ctx, unsigned address, uint8_t value), void *ctx);

/** Fill `axis`, without a bus access. If the bank has no axis with this number, the result is
 * PPMC104_BAD_ARGUMENT. */
ppmc104_result_t ppmc_bank_axis(const ppmc_bank_t *bank, unsigned number, ppmc_bank_axis_t *axis);

/**
 * Set the base clock of all operations and chopper phases that begin after this call. Both arguments are true
 * after reset.
 * @param fast  true: crystal / 32 (PPMC104_BASE_500K), false: crystal / 128 (PPMC104_BASE_125K)
 * @param plain true: intervals without the extra 7.5 us
 */
ppmc104_result_t ppmc_bank_config(const ppmc_bank_t *bank, unsigned number, bool fast, bool plain);

/** @name Positions
 * Number of pulses since the reset of the bank, CW positive. Allowed at any time. If the bank is reset
 * during a motion, ppmc104_wait() returns PPMC104_UNCONFIRMED, and the count begins at 0 again, regardless
 * of the position of the motor. @{ */
ppmc104_result_t ppmc_bank_position(const ppmc_bank_t *bank, unsigned number, int32_t *position);
/** @param positions array with one element for each axis of the bank */
void ppmc_bank_positions(const ppmc_bank_t *bank, int32_t *positions);
/** @} */

/** Return the axes whose motion has ended and whose finish status has not been read. int_n is low while
 * there are such axes. */
ppmc_bank_set_t ppmc_bank_pending(const ppmc_bank_t *bank);

/** Return the axes with BUSY = 1. */
ppmc_bank_set_t ppmc_bank_busy(const ppmc_bank_t *bank);

/** End all motions on the same rising edge, without ramps. */
void ppmc_bank_stop_all(const ppmc_bank_t *bank);

/** @name Groups
 * Motions that begin on the same rising edge. Call ppmc_bank_hold(). Then start the motions with the
 * functions of ppmc104.h; they wait with BUSY = 1. Then call ppmc_bank_go(), or ppmc_bank_drop() if one of
 * the motions was rejected. @{ */
/**
 * Let the next motions of these axes wait for ppmc_bank_go().
 * @return PPMC104_BAD_ARGUMENT: `axes` is empty, or contains an axis that does not exist. PPMC104_ERR_BUSY:
 * an axis moves
 */
ppmc104_result_t ppmc_bank_hold(ppmc_bank_t *bank, ppmc_bank_set_t axes);
/**
 * Start the waiting motions. The group ends.
 * @param refused axes that did not begin with the others; may be null
 * @return result of the first of these axes; PPMC104_ERR_UNKNOWN: no motion was waiting (it was never
 * started, or a switch has ended it)
 */
ppmc104_result_t ppmc_bank_go(ppmc_bank_t *bank, ppmc_bank_set_t *refused);
/** Cancel the group: a stop ends the waiting motions without a pulse (finish status `stopped`). */
void ppmc_bank_drop(ppmc_bank_t *bank);
/** @} */

#ifdef __cplusplus
}
#endif

#endif
