/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file ppmc_bank.h
 * Driver for a bank of PPMC-104 axes: C99, no dependencies, no heap, no floating point, no globals.
 *
 * Each axis is a PPMC-104, so this driver stands on ppmc104.h: add ppmc104.c and ppmc_bank.c to a program. Two functions
 * that the user supplies reach the window of 10 address bits. Axes count from 0, as in the address. One ppmc_bank_t
 * serves one bank; calls for the same bank must not overlap, those for its axes included.
 */
#ifndef PPMC_BANK_H
#define PPMC_BANK_H

#include "ppmc104.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Most axes that a bank has; others have 4, 8, 16 or 32. */
#define PPMC_BANK_AXES_MAX 64u

/** Address of a register of an axis: the `address` argument of the access functions. Memory mapped, times 4. */
#define PPMC_BANK_ADDRESS(axis, reg) ((unsigned)(axis) << 4 | (unsigned)(reg))

/** Registers beside those of ppmc104.h, 0 and 1. */
#define PPMC_BANK_REG_CONFIG 0x2u
#define PPMC_BANK_REG_POSITION 0x4u
#define PPMC_BANK_REG_MASK 0x8u
#define PPMC_BANK_REG_PENDING 0x9u
#define PPMC_BANK_REG_GO 0xAu
#define PPMC_BANK_REG_STOP 0xBu
#define PPMC_BANK_REG_INFO 0xCu

/** Axes as a number: bit n is axis n. */
typedef uint64_t ppmc_bank_set_t;

/** One bank. Fill it with ppmc_bank_open(). */
typedef struct {
    uint8_t (*read)(void *ctx, unsigned address);              /**< one read cycle of the window */
    void (*write)(void *ctx, unsigned address, uint8_t value); /**< one write cycle */
    void *ctx;                                                 /**< passed to the functions */
    uint8_t axes;                                              /**< how many it has */
    ppmc_bank_set_t held;                                      /**< of the driver: MASK, while a group is loaded */
} ppmc_bank_t;

/**
 * One axis. Fill it with ppmc_bank_axis(), and leave it where it is: `part` points to it. Every function of ppmc104.h
 * works with `&axis.part`, and `part.limit` and `part.give_up` are as there. What a bank does not have
 * (config.external_clock, ppmc104_aux...) the part refuses with PPMC104_ERR_UNKNOWN.
 */
typedef struct {
    ppmc104_t part;
    const ppmc_bank_t *bank;
    uint8_t number;
} ppmc_bank_axis_t;

/**
 * Fill `bank` and look who is there; empties MASK. Nothing moves, and what moves goes on.
 * @return PPMC104_NO_PART if INFO is not that of a bank with version 1 of the window
 */
ppmc104_result_t ppmc_bank_open(ppmc_bank_t *bank, uint8_t (*read)(void *ctx, unsigned address),
                                void (*write)(void *ctx, unsigned address, uint8_t value), void *ctx);

/** Fill `axis`; no bus cycle. PPMC104_BAD_ARGUMENT if the bank does not have that number. */
ppmc104_result_t ppmc_bank_axis(const ppmc_bank_t *bank, unsigned number, ppmc_bank_axis_t *axis);

/**
 * Base clock of the operations and chopper phases that begin from now on; both true after reset.
 * @param fast  crystal / 32 (PPMC104_BASE_500K), else crystal / 128 (PPMC104_BASE_125K)
 * @param plain intervals without the extra 7.5 us
 */
ppmc104_result_t ppmc_bank_config(const ppmc_bank_t *bank, unsigned number, bool fast, bool plain);

/** @name Positions
 * Pulses since the reset of the bank, CW up. Allowed at any time. A reset during a motion makes ppmc104_wait() return
 * PPMC104_UNCONFIRMED; the count begins at 0 again then, wherever the motor is. @{ */
ppmc104_result_t ppmc_bank_position(const ppmc_bank_t *bank, unsigned number, int32_t *position);
/** @param positions as many as the bank has axes */
void ppmc_bank_positions(const ppmc_bank_t *bank, int32_t *positions);
/** @} */

/** Axes whose motion has ended and whose finish status nobody has read; int_n is low while there are any. */
ppmc_bank_set_t ppmc_bank_pending(const ppmc_bank_t *bank);

/** Axes with BUSY = 1. */
ppmc_bank_set_t ppmc_bank_busy(const ppmc_bank_t *bank);

/** Ends every motion on the same clk, without ramps. */
void ppmc_bank_stop_all(const ppmc_bank_t *bank);

/** @name Groups
 * Motions that begin on the same clk: ppmc_bank_hold(), the motions by the functions of ppmc104.h, which wait with
 * BUSY = 1, then ppmc_bank_go(), or ppmc_bank_drop() if one of them was refused. @{ */
/**
 * From now on motions of these axes wait for ppmc_bank_go().
 * @return PPMC104_BAD_ARGUMENT: none, or one that is not there; PPMC104_ERR_BUSY: one moves
 */
ppmc104_result_t ppmc_bank_hold(ppmc_bank_t *bank, ppmc_bank_set_t axes);
/**
 * Start what waits. Groups end here.
 * @param refused axes that did not begin with the others; may be null
 * @return result of the first of these: PPMC104_ERR_UNKNOWN if nothing waited (never started, or ended by a switch)
 */
ppmc104_result_t ppmc_bank_go(ppmc_bank_t *bank, ppmc_bank_set_t *refused);
/** Call the group off: what waits ends with a stop (finish status `stopped`), without a pulse. */
void ppmc_bank_drop(ppmc_bank_t *bank);
/** @} */

#ifdef __cplusplus
}
#endif

#endif
