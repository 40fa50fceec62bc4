/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file ppmc104.h
 * Driver for the PPMC-104 stepper controller: C99, no dependencies, no heap, no floating point, no globals.
 *
 * The driver reaches the part through two functions that the user supplies, one for a read cycle and one
 * for a write cycle. All waits are bounded. One ppmc104_t serves one part; calls for the same part must not
 * overlap (lock them, or keep them in one thread).
 *
 * Speeds are rate bytes, as the part takes them; ppmc104_rate_from_pps() and ppmc104_rate_to_mpps()
 * translate. Distances are pulses.
 */
#ifndef PPMC104_H
#define PPMC104_H

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Registers: the `reg` argument of the access functions. Memory mapped, register n is at byte address 4 n. */
#define PPMC104_REG_DATA 0u
#define PPMC104_REG_STATUS 1u /**< read: status, write: command */

/** Bits of the status register. */
#define PPMC104_STATUS_OBF 0x01u  /**< a byte can be fetched */
#define PPMC104_STATUS_IBF 0x02u  /**< do not write yet */
#define PPMC104_STATUS_BUSY 0x04u /**< an operation runs */
#define PPMC104_STATUS_ERR 0x80u  /**< the last byte was refused; bits 6..4 say why */

/** Result of every function that talks to the part. 1 .. 8 are the part's error numbers 0 .. 7, plus one. */
typedef enum {
    PPMC104_OK = 0,
    PPMC104_ERR_UNKNOWN = 1,        /**< number 0: no such command, or a stop with nothing to stop */
    PPMC104_ERR_BUSY = 2,           /**< number 1: not while an operation runs */
    PPMC104_ERR_UNINITIALISED = 3,  /**< number 2: an operation before a good initialisation */
    PPMC104_ERR_DATA = 4,           /**< number 3: a data byte nobody asked for, at rest */
    PPMC104_ERR_RAMP_LONG = 5,      /**< number 4: ramp longer than 11 220 pulses */
    PPMC104_ERR_RAMP = 6,           /**< number 5: high speed below start speed, or ramp below 4 pulses */
    PPMC104_ERR_DATA_BUSY = 7,      /**< number 6: a data byte nobody asked for, during an operation */
    PPMC104_ERR_DECELERATING = 8,   /**< number 7: it decelerates already */
    PPMC104_TIMEOUT = 16,           /**< the part did not get ready within the limit */
    PPMC104_NO_PART = 17,           /**< as TIMEOUT, and what was read cannot come from a part */
    PPMC104_BAD_ARGUMENT = 18       /**< out of range; nothing was sent */
} ppmc104_result_t;

/** Polls of the status register in a wait, if ppmc104_t::limit is left as ppmc104_setup() sets it. */
#define PPMC104_DEFAULT_LIMIT 1000000ul

/** One part. Fill it with ppmc104_setup(); `limit` and `give_up` may be changed at any time after it. */
typedef struct {
    uint8_t (*read)(void *ctx, unsigned reg);                 /**< one read cycle of register 0 or 1 */
    void (*write)(void *ctx, unsigned reg, uint8_t value);    /**< one write cycle */
    void *ctx;                                                /**< passed to the functions */
    /** Polls before a wait ends with a time-out, at least 1. Leave room: after an initialisation the part may
     *  be deaf for 40 000 clk (FAST) or 163 ms (DATASHEET). Not used if `give_up` is set. */
    unsigned long limit;
    /** If not null: called after each unsuccessful poll with the number of polls so far in this wait (from 1);
     *  true ends the wait with a time-out. It may look at a clock, feed a watchdog or sleep. */
    bool (*give_up)(void *ctx, unsigned long polls);
    bool starting; /**< of the driver: an operation was accepted and has not been seen running */
} ppmc104_t;

/** Base clock of the speeds. */
typedef enum {
    PPMC104_BASE_500K, /**< internal, pin CSEL = H: crystal / 32 */
    PPMC104_BASE_125K, /**< internal, pin CSEL = L: crystal / 128 */
    PPMC104_BASE_PIN   /**< pin CLOCK */
} ppmc104_base_t;

/** What the wiring of the part says about its speeds. */
typedef struct {
    uint32_t xtal_hz;    /**< parameter XTAL_HZ, 1 000 000 .. 16 000 000 */
    ppmc104_base_t base; /**< which base clock */
    uint32_t pin_hz;     /**< with PPMC104_BASE_PIN: its frequency, 1 .. xtal_hz / 16; else not used */
    bool extra;          /**< pin VSEL = L: 7.5 us more per interval; not with PPMC104_BASE_PIN */
} ppmc104_speed_t;

/** Initialisation. motor, half_step and active_high count only after reset or ppmc104_excitation_off(). */
typedef struct {
    uint8_t motor;       /**< phases: 3, 4 or 5 */
    bool half_step;      /**< half instead of full steps */
    bool active_high;    /**< H switches a coil on */
    bool chop;           /**< phases chopped at rest */
    bool external_clock; /**< base clock from pin CLOCK */
    uint8_t rate_start;  /**< RL, rate of the first and last pulses, high_rate .. 255 */
    uint8_t rate_high;   /**< RH, rate on the plateau, 0 .. rate_start */
    uint16_t ramp;       /**< PA, pulses from start to high speed, 4 .. 11 220 */
} ppmc104_config_t;

/** Flags of the operations. */
#define PPMC104_CW 0x00u
#define PPMC104_CCW 0x08u        /**< direction CCW; else CW */
#define PPMC104_NO_INT 0x10u     /**< no interrupt at the end */
#define PPMC104_POUT_ONLY 0x80u  /**< phases stand still; ppmc104_move() and ppmc104_run() only */

/** Finish status, decoded. All causes false: complete, or the origin was found. */
typedef struct {
    bool ended;        /**< an operation has ended since the last time this was read */
    bool stopped;      /**< by a stop command */
    bool alarm;        /**< by the alarm input */
    bool limit;        /**< by L1 or L2 */
    bool slow_limit;   /**< by L3 or L4 */
    uint8_t operation; /**< 2 step, 3 move, 4 constant, 5 jog, 6 run, 7 home */
    uint8_t raw;       /**< the byte itself */
} ppmc104_finish_t;

/** Pins of ppmc104_inputs(), 0 = active. */
#define PPMC104_IN_CNP 0x80u
#define PPMC104_IN_ALM 0x40u
#define PPMC104_IN_L1 0x08u
#define PPMC104_IN_L2 0x04u
#define PPMC104_IN_L3 0x02u
#define PPMC104_IN_L4 0x01u

/** Text for a result, e.g. for a log; never null. */
const char *ppmc104_strerror(ppmc104_result_t result);

/**
 * Nearest rate byte for a speed.
 * @param pps  pulses per second, 1 .. 500 000
 * @param rate the byte, if the result is PPMC104_OK
 * @return PPMC104_BAD_ARGUMENT if `speed` is not legal or the speed is out of its reach
 */
ppmc104_result_t ppmc104_rate_from_pps(const ppmc104_speed_t *speed, uint32_t pps, uint8_t *rate);

/**
 * Speed of a rate byte in thousandths of a pulse per second, rounded down.
 * @return 0 if `speed` is not legal
 */
uint32_t ppmc104_rate_to_mpps(const ppmc104_speed_t *speed, uint8_t rate);

/** Fill `dev`; no bus cycle. */
void ppmc104_setup(ppmc104_t *dev, uint8_t (*read)(void *ctx, unsigned reg),
                   void (*write)(void *ctx, unsigned reg, uint8_t value), void *ctx);

/** Is there a part that answers? Reads the input signals; nothing else changes. Not during an operation. */
ppmc104_result_t ppmc104_probe(ppmc104_t *dev);

/** Initialise. Never moves the motor. Values out of range: PPMC104_BAD_ARGUMENT. */
ppmc104_result_t ppmc104_init(ppmc104_t *dev, const ppmc104_config_t *config);

/** @name Operations
 * They return as soon as the part has accepted them. `flags` is a sum of the flags above, `pulses` is
 * 1 .. 16 777 216. @{ */
ppmc104_result_t ppmc104_step(ppmc104_t *dev, uint8_t flags);
/** With acceleration and deceleration, at the rates of the initialisation. */
ppmc104_result_t ppmc104_move(ppmc104_t *dev, uint8_t flags, uint32_t pulses);
ppmc104_result_t ppmc104_move_constant(ppmc104_t *dev, uint8_t flags, uint8_t rate, uint32_t pulses);
/** At constant speed until a stop or the hard limit. */
ppmc104_result_t ppmc104_jog(ppmc104_t *dev, uint8_t flags, uint8_t rate);
/** Accelerates, then runs until a stop or the slow-down limit. */
ppmc104_result_t ppmc104_run(ppmc104_t *dev, uint8_t flags);
/** At constant speed until the origin input; no pulse if it is active already. */
ppmc104_result_t ppmc104_home(ppmc104_t *dev, uint8_t flags, uint8_t rate);
/** @} */

/** No further pulse. PPMC104_ERR_UNKNOWN if nothing runs. During a motion a stop replaces a byte that still waits. */
ppmc104_result_t ppmc104_stop(ppmc104_t *dev);
/** Decelerate, then end. PPMC104_ERR_DECELERATING if it does already, PPMC104_ERR_UNKNOWN if nothing runs. */
ppmc104_result_t ppmc104_stop_slowly(ppmc104_t *dev);

/** Status register; needs no handshake. */
uint8_t ppmc104_status(ppmc104_t *dev);
/**
 * True while an operation runs, from the return of the function that started it on. A part with DATASHEET timing shows
 * BUSY up to 112 us later (rule P104-DS-03); the first call after a start may wait for that with an unknown command,
 * which leaves error 0 in the status register. True as well if that wait ends with a time-out.
 */
bool ppmc104_busy(ppmc104_t *dev);
/**
 * Wait for the end of the operation, then read the finish status (which lifts the interrupt).
 * The limit of the waits (`limit`, `give_up`) must be long enough for the motion.
 * @param finish may be null
 */
ppmc104_result_t ppmc104_wait(ppmc104_t *dev, ppmc104_finish_t *finish);

/** @name Reads
 * Not during an operation (PPMC104_ERR_BUSY). @{ */
/**
 * Lifts the interrupt. Call it before the next operation of an interrupt-driven program: once that runs, the part
 * refuses, the interrupt stays, and the end makes no new edge. So a routine for a late interrupt takes PPMC104_ERR_BUSY
 * as "not now" and returns.
 */
ppmc104_result_t ppmc104_finish(ppmc104_t *dev, ppmc104_finish_t *finish);
ppmc104_result_t ppmc104_inputs(ppmc104_t *dev, uint8_t *levels);          /**< PPMC104_IN_..., 0 = active */
ppmc104_result_t ppmc104_outputs(ppmc104_t *dev, uint8_t *levels);         /**< S1..S5, hold, dir: bits 7..3, 2, 1 */
ppmc104_result_t ppmc104_aux_inputs(ppmc104_t *dev, uint8_t *levels);      /**< AUXI3..0 in bits 3..0 */
/**
 * Pulses that the last operation did not put out, 0 .. 16 777 216. Uses and keeps no finish status, so the
 * caller gives the one of this operation: the part's number alone cannot tell 0 pulses from 1.
 */
ppmc104_result_t ppmc104_remaining(ppmc104_t *dev, const ppmc104_finish_t *finish, uint32_t *pulses);
/** What the part's number of remaining pulses means after a motion with this finish status. */
uint32_t ppmc104_left(const ppmc104_finish_t *finish, uint32_t number);
/** @} */

/** Chopper times at rest, 0 .. 255: about 3 us each plus 27 us (on) and 33 us (off). Not during an operation. */
ppmc104_result_t ppmc104_switching(ppmc104_t *dev, uint8_t on, uint8_t off);
/** Bits 3..0: 1 puts L on AUXO3..0. Always allowed. */
ppmc104_result_t ppmc104_aux_outputs(ppmc104_t *dev, uint8_t bits);
/** Pin AUX: true puts L on it. Always allowed. */
ppmc104_result_t ppmc104_aux(ppmc104_t *dev, bool on);
/**
 * All coils off, initialisation void. PPMC104_ERR_BUSY during an operation: the part would take it for AUX ON. At rest
 * it is sent behind a command that the part does not know, which comes through only once a motion that was just sent
 * has begun (see ppmc104_busy()).
 */
ppmc104_result_t ppmc104_excitation_off(ppmc104_t *dev);

/** @name Bytes
 * For commands that have no function here. @{ */
/** A command and its parameters; after each byte the part is asked whether it took it. count 0 .. 4. */
ppmc104_result_t ppmc104_command(ppmc104_t *dev, uint8_t code, const uint8_t *data, unsigned count);
/** One data byte. */
ppmc104_result_t ppmc104_data(ppmc104_t *dev, uint8_t value);
/** `count` bytes of an answer, low byte first. count 1 .. 4. */
ppmc104_result_t ppmc104_fetch(ppmc104_t *dev, unsigned count, uint32_t *value);
/** A read command and its answer of `count` bytes. */
ppmc104_result_t ppmc104_ask(ppmc104_t *dev, uint8_t code, unsigned count, uint32_t *value);
/** A read command and its answer of one byte. */
ppmc104_result_t ppmc104_ask_byte(ppmc104_t *dev, uint8_t code, uint8_t *byte);
/** @} */

#ifdef __cplusplus
}
#endif

#endif
