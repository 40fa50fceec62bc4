/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file ppmc104.h
 * Driver for the PPMC-104 stepper controller: C99, no dependencies, no heap, no floating point, no
 * globals.
 * The driver accesses the part through two functions that the user supplies: one for a read access and one
 * for a write access. All waits are bounded. One ppmc104_t serves one part. Calls for the same part must not
 * overlap: use a lock, or keep them in one thread. Speeds are rate bytes, as in the commands of the part;
 * ppmc104_rate_from_pps() and ppmc104_rate_to_mpps() convert them. Distances are pulses.
 */
#ifndef PPMC104_H
#define PPMC104_H

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/** @name Registers
 * PPMC104_REG_...: the `reg` argument of the access functions. In a memory map, register n is at byte address 4 n.
 * PPMC104_STATUS_...: bits of the status register. @{ */
/* Registers, written by `make packages` from packages/registers/mailbox.rdl. */
#define PPMC104_REG_DATA 0x0u /**< read: byte of a response; write: data byte */
#define PPMC104_REG_STATUS 0x1u /**< result of the last byte, state of part and buffers */
#define PPMC104_REG_COMMAND 0x1u /**< command byte */
#define PPMC104_STATUS_ERR 0x80u /**< the most recent byte, command or data, was faulty */
/** ERR = 0: number of parameter bytes still expected, 0 to 4; ERR = 1: error number */
#define PPMC104_STATUS_NUM 0x70u
#define PPMC104_STATUS_BUSY 0x04u /**< an operation is running (not during initialisation) */
#define PPMC104_STATUS_IBF 0x02u /**< the input buffer is full: do not write */
#define PPMC104_STATUS_OBF 0x01u /**< the data register holds an unread byte */
/* End of the registers. */
/** @} */

/** Result of each function that accesses the part. 1 .. 8 are the error numbers 0 .. 7 of the part, plus
 * one. */
typedef enum {
    PPMC104_OK = 0,
    PPMC104_ERR_UNKNOWN = 1,        /**< number 0: unknown command, or stop without a motion */
    PPMC104_ERR_BUSY = 2,           /**< number 1: not allowed during an operation */
    PPMC104_ERR_UNINITIALISED = 3,  /**< number 2: operation before a valid initialisation */
    PPMC104_ERR_DATA = 4,           /**< number 3: data byte that was not requested, at standstill */
    PPMC104_ERR_RAMP_LONG = 5,      /**< number 4: ramp longer than 11 220 pulses */
    PPMC104_ERR_RAMP = 6,           /**< number 5: high speed below start speed, or ramp below 4 pulses */
    PPMC104_ERR_DATA_BUSY = 7,      /**< number 6: data byte that was not requested, during an operation */
    PPMC104_ERR_DECELERATING = 8,   /**< number 7: already decelerating */
    PPMC104_TIMEOUT = 16,           /**< the part was not ready within the limit */
    PPMC104_NO_PART = 17,           /**< as TIMEOUT, but the bytes that were read cannot be from a part */
    PPMC104_BAD_ARGUMENT = 18,      /**< argument out of range; nothing was sent */
    PPMC104_UNCONFIRMED = 19,       /**< the part does not confirm the end of the motion: it was reset, or the counts
                                     *   disagree; its position is unknown */
    PPMC104_POSITION_UNKNOWN = 20,  /**< no position was set since the last reset or unconfirmed end */
    PPMC104_BAD_REPLY = 21,         /**< the reply is damaged, or cannot belong to the request */
    PPMC104_REPORTS_LOST = 22,      /**< more reports than the driver can store */
    /* PPMC-2104: error numbers 1 .. 13 of the part, plus 32. */
    PPMC2104_ERR_UNKNOWN = 33,       /**< no such instruction */
    PPMC2104_ERR_DATA = 34,          /**< data byte that no instruction requested */
    PPMC2104_ERR_CUT = 35,           /**< an incomplete instruction was discarded */
    PPMC2104_ERR_UNINITIALISED = 36, /**< there is no initial setting */
    PPMC2104_ERR_BUSY = 37,          /**< not allowed during an operation of the axis */
    PPMC2104_ERR_STANDSTILL = 38,    /**< there is no motion to stop */
    PPMC2104_ERR_START = 39,         /**< a limit, the alarm or the origin is active: no motion */
    PPMC2104_ERR_NO_RAMP = 40,       /**< deceleration is not possible: the motion continues */
    PPMC2104_ERR_RAMP = 41,          /**< rates too close together, or ramp too short */
    PPMC2104_ERR_RAMP_LONG = 42,     /**< ramp longer than 11 220 pulses */
    PPMC2104_ERR_SWITCHING = 43,     /**< chopper time below 64 */
    PPMC2104_ERR_FAST = 44,          /**< too fast for one axis (DATASHEET) */
    PPMC2104_ERR_FAST_BOTH = 45,     /**< too fast while both axes run (DATASHEET) */
    /* PPMC-312: rejections. ppmc312_t::detail contains the numbers of the part. */
    PPMC312_ERR_PARAMETER = 64, /**< F0: a value is out of range */
    PPMC312_ERR_STATE = 65,     /**< F1: not allowed in this state */
    PPMC312_ERR_LIMIT = 66,     /**< F2: the limit in the direction of the motion is active */
    PPMC312_ERR_ALARM = 67,     /**< F4: alarm; call ppmc312_driver(dev, PPMC312_ALARM_CLEAR) */
    PPMC312_ERR_UNKNOWN = 68,   /**< F5: no such instruction */
    PPMC312_ERR_SIZE = 69,      /**< F6: wrong size */
    PPMC312_ERR_FULL = 70,      /**< F7: buffer full, or the other buffer uses the event pin */
    PPMC312_ERR_BUS_ONLY = 71,  /**< the serial line does not have this instruction; nothing was sent */
    /* PMC006B4. */
    PMC006_ERR_REFUSED = 96,  /**< the controller kept its old value, or did not start the motion */
    PMC006_ERR_BUSY = 97,     /**< not allowed while a motion is running */
    PMC006_ERR_EEPROM = 98,   /**< the EEPROM is busy, or the save has failed */
    PMC006_ERR_NO_SWITCH = 99 /**< the motion ended before the switch was active */
} ppmc104_result_t;

/** Last operation. Only the driver writes it. */
typedef struct {
    uint8_t operation; /**< 2 .. 7 as in ppmc104_finish_t; 0: the driver has started no operation */
    uint8_t flags;     /**< flags of this operation */
    uint8_t ended;     /**< finish status of this operation, once it was read */
    bool counted;      /**< the end is confirmed and included in the position */
    uint32_t pulses;   /**< requested pulses; 16 777 216 for operations without a count */
} ppmc104_order_t;

/** Default of ppmc104_t::limit: polls of the status register in a wait. ppmc104_setup() sets it. */
#define PPMC104_DEFAULT_LIMIT 1000000ul

/** One part. Fill it with ppmc104_setup(). Then `limit` and `give_up` may be changed at any time. */
typedef struct {
    uint8_t (*read)(void *ctx, unsigned reg);                 /**< make one read access of register 0 or 1 */
    void (*write)(void *ctx, unsigned reg, uint8_t value);    /**< make one write access of register 0 or 1 */
    void *ctx;                                                /**< argument of the two functions */
    /** Number of polls until a wait times out, at least 1. Choose a large value: after an initialisation,
     * the part does not respond for up to 40 000 cycles (FAST) or 163 ms (DATASHEET). Ignored if `give_up` is
     * set. */
    unsigned long limit;
    /** If not null, this function is called after each unsuccessful poll, with the number of polls in this
     * wait (from 1). If it returns true, the wait times out. It may read a clock, trigger a watchdog, or
     * sleep. */
    bool (*give_up)(void *ctx, unsigned long polls);
    bool starting; /**< private: an operation was accepted, but BUSY = 1 was not read yet */
    uint8_t status_reg; /**< private: number of the status register */
    uint8_t zero;  /**< private: bits of the status register that read as 0 on every part */
    ppmc104_order_t order; /**< private: operation that ppmc104_wait() expects */
} ppmc104_t;

/** Base clock of a speed. */
typedef enum {
    PPMC104_BASE_500K, /**< internal, pin CSEL high: crystal / 32 */
    PPMC104_BASE_125K, /**< internal, pin CSEL low: crystal / 128 */
    PPMC104_BASE_PIN   /**< pin CLOCK */
} ppmc104_base_t;

/** Wiring of the part that determines its speeds. */
typedef struct {
    uint32_t xtal_hz;    /**< parameter XTAL_HZ, 1 000 000 .. 16 000 000 */
    ppmc104_base_t base; /**< base clock */
    uint32_t pin_hz;     /**< with PPMC104_BASE_PIN: frequency in Hz, 1 .. xtal_hz / 16; otherwise ignored */
    bool extra;          /**< pin VSEL low: 7.5 us more per interval; not with PPMC104_BASE_PIN */
} ppmc104_speed_t;

/** Initialisation. motor, half_step and active_high take effect only after a reset or
 * ppmc104_excitation_off(). */
typedef struct {
    uint8_t motor;       /**< number of phases: 3, 4 or 5 */
    bool half_step;      /**< half steps instead of full steps */
    bool active_high;    /**< a high level energises a coil */
    bool chop;           /**< chop the phases at standstill */
    bool external_clock; /**< base clock from pin CLOCK */
    uint8_t rate_start;  /**< RL, rate of the first and last pulses, rate_high .. 255 */
    uint8_t rate_high;   /**< RH, rate on the plateau, 0 .. rate_start */
    uint16_t ramp;       /**< PA, pulses from start speed to high speed, 4 .. 11 220 */
} ppmc104_config_t;

/** Flags of the operations. */
#define PPMC104_CW 0x00u
#define PPMC104_CCW 0x08u        /**< direction CCW, otherwise CW */
#define PPMC104_NO_INT 0x10u     /**< no interrupt at the end */
#define PPMC104_POUT_ONLY 0x80u  /**< the phases do not change; only ppmc104_move() and ppmc104_run() */

/**
 * Decoded finish status. If `ended` is true and all causes are false, the operation is complete, or the
 * origin was found. After a reset, the part returns `operation` = 0; then the end of the motion is unknown.
 */
typedef struct {
    bool ended;        /**< an operation has ended since this status was last read */
    bool stopped;      /**< cause: stop command */
    bool alarm;        /**< cause: alarm input */
    bool limit;        /**< cause: L1 or L2 */
    bool slow_limit;   /**< cause: L3 or L4 */
    uint8_t operation; /**< 2 step, 3 move, 4 constant, 5 jog, 6 run, 7 home */
    uint8_t raw;       /**< finish status, not decoded */
} ppmc104_finish_t;

/** Pins of ppmc104_inputs(), 0 = active. */
#define PPMC104_IN_CNP 0x80u
#define PPMC104_IN_ALM 0x40u
#define PPMC104_IN_L1 0x08u
#define PPMC104_IN_L2 0x04u
#define PPMC104_IN_L3 0x02u
#define PPMC104_IN_L4 0x01u

/** Return the text of a result, e.g. for a log; never null. */
const char *ppmc104_strerror(ppmc104_result_t result);

/**
 * Return the nearest rate byte for a speed.
 * @param pps  pulses per second, 1 .. 500 000
 * @param rate rate byte; valid if the result is PPMC104_OK
 * @return PPMC104_BAD_ARGUMENT if `speed` is invalid, or if no rate byte is possible for this speed
 */
ppmc104_result_t ppmc104_rate_from_pps(const ppmc104_speed_t *speed, uint32_t pps, uint8_t *rate);

/**
 * Return the speed of a rate byte in thousandths of a pulse per second, rounded down.
 * @return 0 if `speed` is invalid
 */
uint32_t ppmc104_rate_to_mpps(const ppmc104_speed_t *speed, uint8_t rate);

/** Fill `dev`, without a bus access. */
void ppmc104_setup(ppmc104_t *dev, uint8_t (*read)(void *ctx, unsigned reg),
                   void (*write)(void *ctx, unsigned reg, uint8_t value), void *ctx);

/** Check that a part responds. The function only reads the input signals. Not during an operation. */
ppmc104_result_t ppmc104_probe(ppmc104_t *dev);

/** Initialise. Never moves the motor. If a value is out of range, the result is PPMC104_BAD_ARGUMENT. */
ppmc104_result_t ppmc104_init(ppmc104_t *dev, const ppmc104_config_t *config);

/** @name Operations
 * The functions return when the part has accepted the operation. `flags` is the sum of the flags above.
 * `pulses` is 1 .. 16 777 216. @{ */
ppmc104_result_t ppmc104_step(ppmc104_t *dev, uint8_t flags);
/** Move with acceleration and deceleration, at the rates of the initialisation. */
ppmc104_result_t ppmc104_move(ppmc104_t *dev, uint8_t flags, uint32_t pulses);
ppmc104_result_t ppmc104_move_constant(ppmc104_t *dev, uint8_t flags, uint8_t rate, uint32_t pulses);
/** Move at constant speed until a stop or the limit switch. */
ppmc104_result_t ppmc104_jog(ppmc104_t *dev, uint8_t flags, uint8_t rate);
/** Accelerate, then run until a stop or the slow-down limit. */
ppmc104_result_t ppmc104_run(ppmc104_t *dev, uint8_t flags);
/** Move at constant speed until the origin input is active. If it is already active, output no pulse. */
ppmc104_result_t ppmc104_home(ppmc104_t *dev, uint8_t flags, uint8_t rate);
/** @} */

/** Stop without a further pulse. Without a motion, the result is PPMC104_ERR_UNKNOWN. During a motion, a
 * stop replaces a byte that waits in the buffer. */
ppmc104_result_t ppmc104_stop(ppmc104_t *dev);
/** Decelerate, then end. The result is PPMC104_ERR_DECELERATING if the motor is already decelerating, and
 * PPMC104_ERR_UNKNOWN without a motion. */
ppmc104_result_t ppmc104_stop_slowly(ppmc104_t *dev);

/** Return the status register. This needs no handshake. */
uint8_t ppmc104_status(ppmc104_t *dev);
/**
 * Return true while an operation is running. An operation counts as running as soon as the function that
 * starts it has returned. With DATASHEET timing, BUSY rises up to 112 us later (rule P104-DS-03). Therefore
 * the first call after a start may wait for BUSY by sending an unknown command, which leaves error 0 in the
 * status register. If this wait times out, the result is also true.
 */
bool ppmc104_busy(ppmc104_t *dev);
/**
 * Wait for the end of the operation, and read the finish status, which clears the interrupt. Compare the
 * finish status and the remaining pulses with the operation that was started. It is not an error if an
 * interrupt routine has already read the finish status.
 * The limit of the waits (`limit`, `give_up`) must be long enough for the motion.
 * @param finish may be null; valid if the result is PPMC104_OK or PPMC104_UNCONFIRMED
 * @return PPMC104_UNCONFIRMED: the part was reset during the motion, executes a motion of another program, or
 * its count disagrees
 */
ppmc104_result_t ppmc104_wait(ppmc104_t *dev, ppmc104_finish_t *finish);

/** @name Reads
 * Not allowed during an operation (PPMC104_ERR_BUSY). @{ */
/**
 * Read the finish status, which clears the interrupt. An interrupt-driven program must call this function
 * before the next operation. During the next operation, the part rejects the read, the interrupt remains
 * pending, and the end of the operation causes no new edge. Therefore, if an interrupt routine is late and
 * receives PPMC104_ERR_BUSY, it must only return.
 */
ppmc104_result_t ppmc104_finish(ppmc104_t *dev, ppmc104_finish_t *finish);
ppmc104_result_t ppmc104_inputs(ppmc104_t *dev, uint8_t *levels);          /**< PPMC104_IN_..., 0: active */
ppmc104_result_t ppmc104_outputs(ppmc104_t *dev, uint8_t *levels);         /**< S1..S5, hold, dir: bits 7..3, 2, 1 */
ppmc104_result_t ppmc104_aux_inputs(ppmc104_t *dev, uint8_t *levels);      /**< AUXI3..0 in bits 3..0 */
/**
 * Return the number of pulses that the last operation did not make, 0 .. 16 777 216. The caller passes the
 * finish status of this operation, because the number in the part does not distinguish 0 pulses from 1. This
 * function does not read the finish status, and the driver does not store it.
 * @return PPMC104_UNCONFIRMED if this is the finish status of a part that was reset
 */
ppmc104_result_t ppmc104_remaining(ppmc104_t *dev, const ppmc104_finish_t *finish, uint32_t *pulses);
/** Return the number of remaining pulses. `number` is the value that the part returns for it, `finish` is the
 * finish status of the motion. */
uint32_t ppmc104_left(const ppmc104_finish_t *finish, uint32_t number);
/** @} */

/** Set the times with which the phases are chopped at standstill, 0 .. 255: about 3 us per unit, plus 27 us
 * (on) and 33 us (off). Not during an operation. */
ppmc104_result_t ppmc104_switching(ppmc104_t *dev, uint8_t on, uint8_t off);
/** Set the auxiliary outputs: a 1 in bit n drives AUXOn low, n = 0 .. 3. Always allowed. */
ppmc104_result_t ppmc104_aux_outputs(ppmc104_t *dev, uint8_t bits);
/** Set the pin AUX: true drives the pin low. Always allowed. */
ppmc104_result_t ppmc104_aux(ppmc104_t *dev, bool on);
/**
 * Switch all coils off. Then the initialisation is no longer valid. During an operation, the result is
 * PPMC104_ERR_BUSY, because the part would execute the code as AUX ON. At standstill, this function first
 * sends a command that the part does not know. If a motion has just been started, the part accepts this
 * command only when the motion has begun (see ppmc104_busy()).
 */
ppmc104_result_t ppmc104_excitation_off(ppmc104_t *dev);

/** @name Bytes
 * For commands that have no function here. @{ */
/** Send a command and its parameters. After each byte, check that the part has accepted it. `count` is 0
 * .. 4. */
ppmc104_result_t ppmc104_command(ppmc104_t *dev, uint8_t code, const uint8_t *data, unsigned count);
/** Send one data byte. */
ppmc104_result_t ppmc104_data(ppmc104_t *dev, uint8_t value);
/** Read `count` bytes of an answer, low byte first. `count` is 1 .. 4. */
ppmc104_result_t ppmc104_fetch(ppmc104_t *dev, unsigned count, uint32_t *value);
/** Send a read command and read its answer of `count` bytes. */
ppmc104_result_t ppmc104_ask(ppmc104_t *dev, uint8_t code, unsigned count, uint32_t *value);
/** Send a read command and read its answer of one byte. */
ppmc104_result_t ppmc104_ask_byte(ppmc104_t *dev, uint8_t code, uint8_t *byte);
/** @} */

/** @name Core
 * The drivers of the other parts use these functions. Programs do not need them. @{ */
/** Poll until (status & mask) == value, or a bit of `or_set` is 1. `status` receives the last status. */
ppmc104_result_t ppmc104_poll(ppmc104_t *dev, uint8_t mask, uint8_t value, uint8_t or_set, uint8_t *status);
/** Return true if a wait has exceeded its limit after this number of unsuccessful polls. */
bool ppmc104_over(ppmc104_t *dev, unsigned long polls);
/** Wait until IBF = 0, or until a bit of `or_set` is 1, then write a byte. */
ppmc104_result_t ppmc104_send(ppmc104_t *dev, unsigned reg, uint8_t value, uint8_t or_set);
/** Decode a finish status, and store the end of the operation in `order`. */
void ppmc104_decode_finish(uint8_t raw, ppmc104_order_t *order, ppmc104_finish_t *finish);
/** If the finish status was read before, replace it by the stored finish status. */
void ppmc104_recall(ppmc104_order_t *order, ppmc104_finish_t *finish);
/** Compare the finish status, and the number that the part returns for the remaining pulses, with `order`. */
ppmc104_result_t ppmc104_confirm(const ppmc104_order_t *order, const ppmc104_finish_t *finish, uint32_t number);
/** As ppmc104_wait(), with `remaining` as the code that reads the remaining pulses. */
ppmc104_result_t ppmc104_wait_by(ppmc104_t *dev, ppmc104_finish_t *finish, uint8_t remaining);
/** Convert 32 bits in two's complement to a signed value. */
int32_t ppmc104_signed(uint32_t value);
/** @} */

#ifdef __cplusplus
}
#endif

#endif
