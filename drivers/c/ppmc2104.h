/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file ppmc2104.h
 * Driver for the PPMC-2104, two axes: C99, no dependencies, no heap, no floating point, no globals.
 *
 * The driver uses the core in ppmc104.h: add ppmc104.c and ppmc2104.c to a program. Results, flags and the
 * decoded finish status are the types of ppmc104.h. `axis` is 1 or 2 in all functions. One ppmc2104_t serves
 * one part. Calls for the same part must not overlap; an interrupt routine must not call a function while
 * another call is in progress.
 *
 * Speeds are rate bytes; ppmc104_rate_from_pps() with `extra` = false converts them. Distances are pulses.
 */
#ifndef PPMC2104_H
#define PPMC2104_H

#include "ppmc104.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Registers, written by `make packages` from packages/registers/ppmc2104.rdl. */
#define PPMC2104_REG_STATUS 0x1u /**< state of axes and buffers */
#define PPMC2104_STATUS_ERROR 0x80u /**< an error register is not 0, of axis 1 or axis 2 */
#define PPMC2104_STATUS_CMND2 0x20u /**< as CMND1, for axis 2 */
/** an instruction for axis 1 is incomplete (data bytes awaited), or its ramp table is queued or being
 * computed; in DATASHEET also while the instruction is processed */
#define PPMC2104_STATUS_CMND1 0x10u
#define PPMC2104_STATUS_BUSY2 0x08u /**< an operation of axis 2 is running or waits for RUN */
#define PPMC2104_STATUS_BUSY1 0x04u /**< an operation of axis 1 is running or waits for RUN */
#define PPMC2104_STATUS_IBF 0x02u /**< the input buffer is full: do not write */
#define PPMC2104_STATUS_OBF 0x01u /**< the data register holds an unread byte */
/* End of the registers. */
/** Bits of axis 1; shift them left by axis - 1. */
#define PPMC2104_STATUS_BUSY PPMC2104_STATUS_BUSY1
#define PPMC2104_STATUS_CMND PPMC2104_STATUS_CMND1

/** Levels of ppmc2104_inputs(), 0: active. */
#define PPMC2104_IN_ORG 0x80u
#define PPMC2104_IN_ALM 0x40u
#define PPMC2104_IN_FL 0x08u
#define PPMC2104_IN_FHL 0x04u
#define PPMC2104_IN_BL 0x02u
#define PPMC2104_IN_BHL 0x01u

/** One part. Fill it with ppmc2104_setup(). Then `bus.limit` and `bus.give_up` may be changed at any time. */
typedef struct {
    ppmc104_t bus; /**< access functions and limits of the waits */
    /** Set the RUN pins: bit n - 1 of `axes` is the level for axis n. Null if the program cannot change
     * them. */
    void (*run)(void *ctx, unsigned axes);
    ppmc104_order_t order[2]; /**< private: last operation of each axis */
    int32_t position[2];      /**< private: position at standstill */
    bool known[2];            /**< private: `position` is valid */
} ppmc2104_t;

/** Initial setting. motor, half_step, chop and external_clock take effect only after a reset or
 * ppmc2104_excitation_off(). */
typedef struct {
    uint8_t motor;       /**< number of phases: 3, 4 or 5 */
    bool half_step;      /**< half steps instead of full steps */
    bool chop;           /**< chop the phases at standstill */
    bool external_clock; /**< base clock from pin EXTCK */
    uint8_t rate_start;  /**< RL, rate of the first and last pulses, rate_high + 2 .. 255 */
    uint8_t rate_high;   /**< RH, rate on the plateau, at least 1 (with the external clock: 0) */
    uint16_t ramp;       /**< PA, pulses from start speed to high speed, 4 .. 11 220 */
} ppmc2104_config_t;

/** Operations. */
typedef enum {
    PPMC2104_STEP = 2,     /**< one pulse */
    PPMC2104_MOVE = 3,     /**< `pulses` pulses with acceleration and deceleration */
    PPMC2104_CONSTANT = 4, /**< `pulses` pulses at `rate` */
    PPMC2104_JOG = 5,      /**< at `rate`, until a stop or the limit */
    PPMC2104_RUN = 6,      /**< with acceleration, until a stop or the slow-down limit */
    PPMC2104_HOME = 7      /**< at `rate`, until the origin; rejected if it is already active */
} ppmc2104_op_t;

/** A motion. */
typedef struct {
    ppmc2104_op_t op;
    uint8_t flags;   /**< PPMC104_CW or _CCW, _NO_INT; MOVE and RUN: also _POUT_ONLY */
    uint8_t rate;    /**< CONSTANT, JOG, HOME: 1 .. 255, with the external clock 0 .. 255; else ignored */
    uint32_t pulses; /**< MOVE, CONSTANT: 1 .. 16 777 216; otherwise ignored */
} ppmc2104_motion_t;

/**
 * Fill `dev`, without a bus access.
 * @param run may be null, see ppmc2104_t
 */
void ppmc2104_setup(ppmc2104_t *dev, uint8_t (*read)(void *ctx, unsigned reg),
                    void (*write)(void *ctx, unsigned reg, uint8_t value), void (*run)(void *ctx, unsigned axes),
                    void *ctx);

/**
 * Check that a part responds. Incomplete instructions end, and the error registers are cleared. Motions
 * continue. Afterwards, the positions are unknown.
 */
ppmc104_result_t ppmc2104_open(ppmc2104_t *dev);

/** Make the initial setting of an axis and wait until its ramp table is ready. Never moves the motor. */
ppmc104_result_t ppmc2104_init(ppmc2104_t *dev, unsigned axis, const ppmc2104_config_t *config);

/** @name Motions
 * The functions return when the part has accepted the motion. PPMC2104_ERR_START: a limit, the alarm or
 * the origin is active; nothing moves. @{ */
ppmc104_result_t ppmc2104_start(ppmc2104_t *dev, unsigned axis, const ppmc2104_motion_t *motion);
/** Move with ramps. @param pulses CW positive, -16 777 216 .. 16 777 216, not 0 */
ppmc104_result_t ppmc2104_move(ppmc2104_t *dev, unsigned axis, int32_t pulses);
/** Move with ramps to a position. The result is PPMC104_POSITION_UNKNOWN as with ppmc2104_position(), or
 * PPMC104_BAD_ARGUMENT if `position` is the current position or too far away. */
ppmc104_result_t ppmc2104_move_to(ppmc2104_t *dev, unsigned axis, int32_t position);
/**
 * Start both axes on the same clock edge: `run` sets RUN low, both motions are sent, and `run` sets RUN high.
 * If one of them is rejected, neither axis moves.
 * @return PPMC104_BAD_ARGUMENT without `run`
 */
ppmc104_result_t ppmc2104_start_both(ppmc2104_t *dev, const ppmc2104_motion_t *first,
                                     const ppmc2104_motion_t *second);
/** End the motion without a further pulse. At standstill, the result is PPMC2104_ERR_STANDSTILL. */
ppmc104_result_t ppmc2104_stop(ppmc2104_t *dev, unsigned axis);
/**
 * Decelerate, then end. If a deceleration is not possible (constant speed, waiting for RUN, already
 * decelerating), the result is PPMC2104_ERR_NO_RAMP, and the motion continues.
 */
ppmc104_result_t ppmc2104_stop_slowly(ppmc2104_t *dev, unsigned axis);
/** @} */

/** Return the status register. This needs no handshake. */
uint8_t ppmc2104_status(ppmc2104_t *dev);
/** Return true if an operation of the axis is running or waits for RUN. */
bool ppmc2104_busy(ppmc2104_t *dev, unsigned axis);

/**
 * Wait for the end of the motion. Read the finish status, which clears the interrupt, and the remaining
 * pulses.
 * The limit of the waits must be long enough for the motion.
 * @param finish may be null; valid if the result is PPMC104_OK or PPMC104_UNCONFIRMED
 * @return PPMC104_UNCONFIRMED: the part does not confirm the end of this motion, for example because it was
 * reset during the motion; then the position is unknown
 */
ppmc104_result_t ppmc2104_wait(ppmc2104_t *dev, unsigned axis, ppmc104_finish_t *finish);

/**
 * Return the position of the axis at standstill: pulses since ppmc2104_set_position(), CW positive, modulo
 * 2^32. The part has no position counter; the driver counts the motions that ppmc2104_wait() has confirmed.
 * @return PPMC104_POSITION_UNKNOWN: the position was not set, or is unknown after an unconfirmed end.
 * PPMC2104_ERR_BUSY: call ppmc2104_wait() first
 */
ppmc104_result_t ppmc2104_position(ppmc2104_t *dev, unsigned axis, int32_t *position);
/** Set the position of the axis, for example to 0 after PPMC2104_HOME. Only at standstill. */
ppmc104_result_t ppmc2104_set_position(ppmc2104_t *dev, unsigned axis, int32_t position);

/** @name Reads
 * Not during an operation of the axis (PPMC2104_ERR_BUSY), except ppmc2104_aux_inputs(). An operation that waits
 * for RUN also counts. @{ */
/** Read the finish status, which clears the interrupt of this axis. An interrupt-driven program must call
 * this function before the next start. */
ppmc104_result_t ppmc2104_finish(ppmc2104_t *dev, unsigned axis, ppmc104_finish_t *finish);
ppmc104_result_t ppmc2104_inputs(ppmc2104_t *dev, unsigned axis, uint8_t *levels);  /**< PPMC2104_IN_... */
ppmc104_result_t ppmc2104_outputs(ppmc2104_t *dev, unsigned axis, uint8_t *levels); /**< S1..S5, hold, dir */
/** Return the pulses that the last motion did not make. `finish` is its finish status, see
 * ppmc104_remaining(). */
ppmc104_result_t ppmc2104_remaining(ppmc2104_t *dev, unsigned axis, const ppmc104_finish_t *finish, uint32_t *pulses);
ppmc104_result_t ppmc2104_aux_inputs(ppmc2104_t *dev, uint8_t *levels); /**< AUXI1, AUXI0 in bits 1, 0 */
/** @} */

/** Set the times with which the phases are chopped at standstill, in units of 0.5 us, 64 .. 255 each. Not
 * during an operation of the axis. */
ppmc104_result_t ppmc2104_switching(ppmc2104_t *dev, unsigned axis, uint8_t on, uint8_t off);
/** Set the time from the end of a motion to HOLD: 128 us * (units + 1). Not during an operation of the
 * axis. */
ppmc104_result_t ppmc2104_hold_delay(ppmc2104_t *dev, unsigned axis, uint8_t units);
/** Set the auxiliary outputs: 1 in bit 1 drives AUXO1 low, 1 in bit 0 drives AUXO0 low. */
ppmc104_result_t ppmc2104_aux_outputs(ppmc2104_t *dev, uint8_t bits);
/** Switch all coils of the axis off. Then the initial setting is no longer valid, and the position is
 * unknown. Not during an operation of the axis. */
ppmc104_result_t ppmc2104_excitation_off(ppmc2104_t *dev, unsigned axis);

/**
 * Send a command and its parameters, and read the result of their check. Use it for commands that have no
 * function here.
 * @param count 0 .. 4
 */
ppmc104_result_t ppmc2104_command(ppmc2104_t *dev, uint8_t code, const uint8_t *data, unsigned count);
/** Send a read command and read its answer of `count` bytes, 1 .. 3. */
ppmc104_result_t ppmc2104_ask(ppmc2104_t *dev, uint8_t code, unsigned count, uint32_t *value);

#ifdef __cplusplus
}
#endif

#endif
