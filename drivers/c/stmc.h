/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file stmc.h
 * Driver for the controller of the J105 STMC: C99, no dependencies, no heap, no floating point, no globals.
 *
 * Handshake, status register, error numbers and motion codes are those of the PPMC-104, so this driver uses
 * ppmc104.h: add ppmc104.c and stmc.c to a program. Results, flags and the decoded finish status are the
 * types of ppmc104.h. stmc_ports.h contains the access functions for the board on ISA or PC/104. Speeds are
 * divisors, as in the commands of the part: the speed is step clock / divisor steps per second. Distances are
 * steps.
 */
#ifndef STMC_H
#define STMC_H

#include "ppmc104.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Step clocks in Hz: the internal clock of the part (with a 16 MHz crystal), and the "external" clock of
 * the J105 board. */
#define STMC_CLOCK_INTERNAL 12500u
#define STMC_CLOCK_BOARD 48675u

/** Lowest divisor that stmc_divisor() returns, because the data sheet advises against lower divisors. The
 * part accepts 1 .. 255. */
#define STMC_DIVISOR_MIN 5u

/** Codes of the read commands of the part: parameter READ_MAP, by default FAMILY. */
typedef enum {
    STMC_MAP_SHEET, /**< 80h, 82h, 83h, 84h */
    STMC_MAP_FAMILY /**< 80h .. 83h, as in the related devices */
} stmc_map_t;

/** One part. Fill it with stmc_setup(). Then `bus.limit` and `bus.give_up` may be changed at any time. */
typedef struct {
    ppmc104_t bus;  /**< access functions of the part; limits of the waits */
    stmc_map_t map; /**< detected by stmc_probe() */
    bool probed;    /**< private: stmc_probe() was called; otherwise, stmc_wait() calls it */
} stmc_t;

/** Initialisation. motor, half_step and active_high take effect only after a reset. */
typedef struct {
    uint8_t motor;         /**< number of phases: 3, 4 or 5 */
    bool half_step;        /**< half steps instead of full steps */
    bool active_high;      /**< a high level energises a phase; true for the driver on the board */
    bool chop;             /**< chop the phases at standstill */
    bool external_clock;   /**< true: external step clock, false: internal step clock */
    uint8_t divisor_start; /**< D1, divisor of the first and last steps, divisor_high .. 255 */
    uint8_t divisor_high;  /**< D2, divisor at the top speed, 1 .. divisor_start */
    uint16_t ramp;         /**< PA, steps from start to top speed; 0: no ramp */
} stmc_config_t;

/** Levels of stmc_inputs(). The switches are active low. MON = 1 permits motions. */
#define STMC_IN_CNP 0x80u
#define STMC_IN_MON 0x40u
#define STMC_IN_L1 0x08u
#define STMC_IN_L2 0x04u
#define STMC_IN_L3 0x02u
#define STMC_IN_L4 0x01u

/** Return the text of a result, e.g. for a log; never null. */
const char *stmc_strerror(ppmc104_result_t result);

/**
 * Return the nearest divisor for a speed. Example: for 345 steps/s at 48 675 Hz, it is 141.
 * @param clock_hz step clock, 1 .. 1 000 000
 * @param speed    steps per second, 1 or more
 * @param divisor  STMC_DIVISOR_MIN .. 255, if the result is PPMC104_OK
 * @return PPMC104_BAD_ARGUMENT if no divisor is possible for this speed
 */
ppmc104_result_t stmc_divisor(uint32_t clock_hz, uint32_t speed, uint8_t *divisor);

/** Return the speed of a divisor in thousandths of a step per second, rounded down. Return 0 for an
 * invalid divisor or clock. */
uint32_t stmc_milli_speed(uint32_t clock_hz, uint8_t divisor);

/** Fill `dev`, without a bus access. */
void stmc_setup(stmc_t *dev, uint8_t (*read)(void *ctx, unsigned reg),
                void (*write)(void *ctx, unsigned reg, uint8_t value), void *ctx);

/** Check that a part responds, and detect its read codes. Never moves the motor. PPMC104_ERR_BUSY during a
 * motion. */
ppmc104_result_t stmc_probe(stmc_t *dev);

/** Initialise. Never moves the motor. If a value is out of range, the result is PPMC104_BAD_ARGUMENT. */
ppmc104_result_t stmc_init(stmc_t *dev, const stmc_config_t *config);

/** @name Motions
 * The functions return when the part has accepted the motion. `flags` is the sum of PPMC104_CW or
 * PPMC104_CCW, and PPMC104_NO_INT. `steps` is 1 .. 16 777 216, a divisor is 1 .. 255. @{ */
ppmc104_result_t stmc_step(stmc_t *dev, uint8_t flags);
/** Move with acceleration and deceleration, at the speeds of the initialisation. */
ppmc104_result_t stmc_move(stmc_t *dev, uint8_t flags, uint32_t steps);
ppmc104_result_t stmc_move_constant(stmc_t *dev, uint8_t flags, uint8_t divisor, uint32_t steps);
/** Move at constant speed until a stop or the stop limit. */
ppmc104_result_t stmc_jog(stmc_t *dev, uint8_t flags, uint8_t divisor);
/** Accelerate, then run until a stop or the deceleration limit. */
ppmc104_result_t stmc_run(stmc_t *dev, uint8_t flags);
/** Move at constant speed until the reference point. If it is already active, make no step. Any limit also
 * ends the motion. */
ppmc104_result_t stmc_home(stmc_t *dev, uint8_t flags, uint8_t divisor);
/** @} */

/** Stop without a further step. Without a motion, the result is PPMC104_ERR_UNKNOWN. */
ppmc104_result_t stmc_stop(stmc_t *dev);
/** Decelerate, then end. The result is PPMC104_ERR_DECELERATING if the motor is already decelerating, and
 * PPMC104_ERR_UNKNOWN without a motion. */
ppmc104_result_t stmc_stop_slowly(stmc_t *dev);

/** Return true while a motion is running. A motion counts as running as soon as the function that starts it
 * has returned; see ppmc104_busy(). */
bool stmc_busy(stmc_t *dev);
/**
 * Wait for the end of the motion, and read the finish status, which clears the interrupt. Compare the finish
 * status and the remaining steps with the motion that was started; PPMC104_UNCONFIRMED as in ppmc104_wait().
 * The limit of the waits (`bus.limit`, `bus.give_up`) must be long enough for the motion.
 * @param finish may be null
 */
ppmc104_result_t stmc_wait(stmc_t *dev, ppmc104_finish_t *finish);

/** @name Reads
 * Not allowed during a motion (PPMC104_ERR_BUSY). @{ */
/** Read the finish status, which clears the interrupt. For PPMC104_ERR_BUSY in an interrupt routine, see
 * ppmc104_finish(). `ended` is always true. `alarm` means that MON was low. */
ppmc104_result_t stmc_finish(stmc_t *dev, ppmc104_finish_t *finish);
ppmc104_result_t stmc_inputs(stmc_t *dev, uint8_t *levels);  /**< STMC_IN_... */
ppmc104_result_t stmc_outputs(stmc_t *dev, uint8_t *levels); /**< S1..S5, HOLD, direction: bits 7..3, 2, 1 */
/** Return the steps that the last motion did not make, 0 .. 16 777 216. `finish` is its finish status, see
 * ppmc104_remaining(). */
ppmc104_result_t stmc_remaining(stmc_t *dev, const ppmc104_finish_t *finish, uint32_t *steps);
/** @} */

#ifdef __cplusplus
}
#endif

#endif
