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
    PPMC104_BAD_ARGUMENT = 18,      /**< out of range; nothing was sent */
    PPMC104_UNCONFIRMED = 19,       /**< the part does not confirm the end of the motion: it was reset, or the counts
                                     *   disagree; its position is unknown */
    PPMC104_POSITION_UNKNOWN = 20,  /**< no position was set since the last reset or unconfirmed end */
    PPMC104_BAD_REPLY = 21,         /**< a reply is damaged or cannot belong to the request */
    PPMC104_REPORTS_LOST = 22,      /**< more reports than the driver can store */
    /* PPMC-2104: its error numbers 1 .. 13, plus 32. */
    PPMC2104_ERR_UNKNOWN = 33,       /**< no such instruction */
    PPMC2104_ERR_DATA = 34,          /**< a data byte that no instruction requested */
    PPMC2104_ERR_CUT = 35,           /**< an unfinished instruction was dropped */
    PPMC2104_ERR_UNINITIALISED = 36, /**< no initial setting */
    PPMC2104_ERR_BUSY = 37,          /**< not while the axis moves */
    PPMC2104_ERR_STANDSTILL = 38,    /**< nothing to stop */
    PPMC2104_ERR_START = 39,         /**< limit, alarm or origin active: nothing moves */
    PPMC2104_ERR_NO_RAMP = 40,       /**< nothing to decelerate: the motion continues */
    PPMC2104_ERR_RAMP = 41,          /**< rates or ramp too short */
    PPMC2104_ERR_RAMP_LONG = 42,     /**< ramp longer than 11 220 pulses */
    PPMC2104_ERR_SWITCHING = 43,     /**< chopper time below 64 */
    PPMC2104_ERR_FAST = 44,          /**< faster than one axis may run (DATASHEET) */
    PPMC2104_ERR_FAST_BOTH = 45,     /**< faster than both axes may run (DATASHEET) */
    /* PPMC-312: rejections; ppmc312_t::detail has the part's numbers. */
    PPMC312_ERR_PARAMETER = 64, /**< F0: a value is out of range */
    PPMC312_ERR_STATE = 65,     /**< F1: not in this state */
    PPMC312_ERR_LIMIT = 66,     /**< F2: the limit in the direction of the motion is active */
    PPMC312_ERR_ALARM = 67,     /**< F4: alarm; the part needs ppmc312_driver(dev, PPMC312_ALARM_CLEAR) */
    PPMC312_ERR_UNKNOWN = 68,   /**< F5: no such instruction */
    PPMC312_ERR_SIZE = 69,      /**< F6: wrong size */
    PPMC312_ERR_FULL = 70,      /**< F7: buffer full, or the event pin serves the other buffer */
    PPMC312_ERR_BUS_ONLY = 71,  /**< the serial line does not have this instruction; nothing was sent */
    /* PMC006B4 */
    PMC006_ERR_REFUSED = 96,  /**< the controller kept its old value, or did not start */
    PMC006_ERR_BUSY = 97,     /**< not while a motion runs */
    PMC006_ERR_EEPROM = 98,   /**< the EEPROM is busy, or the save has failed */
    PMC006_ERR_NO_SWITCH = 99 /**< the motion ended without the switch */
} ppmc104_result_t;

/** Last operation: written by the driver only. */
typedef struct {
    uint8_t operation; /**< 2 .. 7 as in ppmc104_finish_t, 0: the driver has not started one */
    uint8_t flags;     /**< its flags */
    uint8_t ended;     /**< its finish status, if it has been read */
    bool counted;      /**< its end is confirmed and is part of the position */
    uint32_t pulses;   /**< requested; operations without a count: 16 777 216 */
} ppmc104_order_t;

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
    uint8_t status_reg; /**< of the driver: number of the status register */
    uint8_t zero;  /**< of the driver: bits of the status register that read 0 on every part */
    ppmc104_order_t order; /**< of the driver: what ppmc104_wait() expects */
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

/**
 * Finish status, decoded. `ended` and all causes false: complete, or the origin was found. A part that was reset has
 * `operation` 0: nothing is known then.
 */
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
 * Wait for the end of the operation, then read the finish status (which clears the interrupt) and compare it and the
 * remaining pulses with the operation that was started. An interrupt routine may have read the finish status before.
 * The limit of the waits (`limit`, `give_up`) must be long enough for the motion.
 * @param finish may be null; valid if the result is PPMC104_OK or PPMC104_UNCONFIRMED
 * @return PPMC104_UNCONFIRMED: the part was reset during the motion, runs another program's motion, or disagrees about
 *         the count
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
 * @return PPMC104_UNCONFIRMED if that is the finish status of a part that was reset
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

/** @name Core
 * Shared by the drivers of the other parts; programs do not need it. @{ */
/** Poll until status & mask == value, or a bit of `or_set` is 1; `status` receives the last byte read. */
ppmc104_result_t ppmc104_poll(ppmc104_t *dev, uint8_t mask, uint8_t value, uint8_t or_set, uint8_t *status);
/** Whether a wait has taken too long after this number of unsuccessful polls. */
bool ppmc104_over(ppmc104_t *dev, unsigned long polls);
/** Wait until IBF = 0, or until a bit of `or_set` is 1, then write a byte. */
ppmc104_result_t ppmc104_send(ppmc104_t *dev, unsigned reg, uint8_t value, uint8_t or_set);
/** Decode a finish status; the end of `order` is remembered in it. */
void ppmc104_decode_finish(uint8_t raw, ppmc104_order_t *order, ppmc104_finish_t *finish);
/** Replace a finish status that was read before by the remembered one. */
void ppmc104_recall(ppmc104_order_t *order, ppmc104_finish_t *finish);
/** Compare the finish status and the part's number of remaining pulses with the order. */
ppmc104_result_t ppmc104_confirm(const ppmc104_order_t *order, const ppmc104_finish_t *finish, uint32_t number);
/** ppmc104_wait() with another code of the remaining pulses. */
ppmc104_result_t ppmc104_wait_by(ppmc104_t *dev, ppmc104_finish_t *finish, uint8_t remaining);
/** Two's complement of 32 bits. */
int32_t ppmc104_signed(uint32_t value);
/** @} */

#ifdef __cplusplus
}
#endif

#endif
