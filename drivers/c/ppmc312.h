/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file ppmc312.h
 * Driver for the PPMC-312 on its parallel bus or on a serial line: C99, no dependencies, no heap, no floating point, no
 * globals.
 *
 * The driver uses the core in ppmc104.h: add ppmc104.c and ppmc312.c to a program. Results are those of
 * ppmc104.h. One ppmc312_t serves one part or station. Calls for the same part, or for stations on the same
 * line, must not overlap.
 *
 * A rate is the number of base clocks from one pulse to the next, so a small rate is fast. Distances are
 * pulses.
 */
#ifndef PPMC312_H
#define PPMC312_H

#include "ppmc104.h"
#include "ppmc_line.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Directions and options of a motion. */
#define PPMC312_CW 0x00u
#define PPMC312_CCW 0x40u
#define PPMC312_INDEX 0x10u /**< SEARCH, RETURN: the origin also requires the index of the encoder */

/** Base clocks with a 16 MHz crystal. */
typedef enum {
    PPMC312_8MHZ,
    PPMC312_1MHZ,
    PPMC312_500KHZ,
    PPMC312_250KHZ,
    PPMC312_62500HZ,
    PPMC312_15625HZ,
    PPMC312_PIN_RISING,
    PPMC312_PIN_FALLING
} ppmc312_clock_t;

/** Linear or sigmoid ramps. */
typedef struct {
    ppmc312_clock_t clock;
    bool sigmoid;
    uint16_t rate_start; /**< RS, 0x11 .. 0xFFFF, at least rate_high + 128 */
    uint16_t rate_high;  /**< RH, 2 .. 0xFFEF */
    uint32_t up;         /**< NA, acceleration pulses, 1 .. 0xFFFFFF; rejected with detail 05 if too small */
    uint16_t rate_stop;  /**< RP, range as rate_start; 0: deceleration like the acceleration. Only on the bus */
    uint32_t down;       /**< ND, range as `up`; ignored if rate_stop is 0 */
} ppmc312_table_t;

/** Free ramps. Each list begins with the fastest stage. Only on the bus. */
typedef struct {
    ppmc312_clock_t clock;
    uint8_t up_stages;     /**< 2 .. 127 */
    uint8_t down_stages;   /**< 2 .. 127; 0: the deceleration is as the acceleration */
    const uint16_t *rates; /**< one rate per stage of the longer ramp, each at least 2 */
    const uint32_t *up;    /**< pulses of each stage, 2 .. 0xFFFFFF */
    const uint32_t *down;  /**< as `up`; ignored if down_stages is 0 */
} ppmc312_curve_t;

/** Motions; the values are instruction codes. */
typedef enum {
    PPMC312_SEARCH = 0x10,       /**< at `rate`, until the origin */
    PPMC312_RETURN = 0x11,       /**< with ramps past the origin, then back to it at the start-up rate */
    PPMC312_MOVE = 0x82,         /**< `pulses` pulses with ramps */
    PPMC312_CONSTANT = 0x83,     /**< `pulses` pulses at `rate` */
    PPMC312_STEP = 0x84,         /**< one pulse */
    PPMC312_RUN = 0x85,          /**< with a ramp, until a stop */
    PPMC312_RUN_CONSTANT = 0x86  /**< at `rate`, until a stop */
} ppmc312_op_t;

/** Time at which an instruction is executed. With all values except NOW, the override buffer stores the
 * instruction, and its answer is a report. */
typedef enum {
    PPMC312_NOW = 0,
    PPMC312_AT_POSITION = 4, /**< not for motions */
    PPMC312_ON_EVENT0 = 5,   /**< falling edge of evt0_n. Motions: only on the bus, not SEARCH, RETURN, STEP */
    PPMC312_ON_EVENT1 = 7    /**< as PPMC312_ON_EVENT0, with evt1_n */
} ppmc312_when_t;

/** A motion. */
typedef struct {
    ppmc312_op_t op;
    uint8_t flags;       /**< PPMC312_CW or _CCW, and PPMC312_INDEX */
    uint16_t rate;       /**< 0: high rate of the table (not SEARCH), or rate_high .. slowest start or stop rate */
    uint32_t pulses;     /**< MOVE, CONSTANT: 1 .. 0xFFFFFFFF */
    ppmc312_when_t when;
} ppmc312_motion_t;

/** Causes of the end of a motion. */
#define PPMC312_CAUSE_ALARM 0x80u
#define PPMC312_CAUSE_NORMAL 0x40u
#define PPMC312_CAUSE_ORIGIN 0x20u
#define PPMC312_CAUSE_LOW 0x10u        /**< decelerating stop at the stop rate or slower */
#define PPMC312_CAUSE_STOP_SLOWLY 0x08u
#define PPMC312_CAUSE_STOP 0x04u
#define PPMC312_CAUSE_HIGH_LIMIT 0x02u /**< the high-speed limit caused the deceleration */
#define PPMC312_CAUSE_LIMIT 0x01u

/** End of a motion. */
typedef struct {
    uint8_t cause;    /**< one of PPMC312_CAUSE_... */
    bool complete;    /**< all pulses were made, or the origin was found */
    int32_t position; /**< pulse counter of the part */
} ppmc312_end_t;

/** Codes of the reports; see docs/ppmc312/README.md, chapter 6. */
#define PPMC312_REPORT_NONE 0x00u
#define PPMC312_REPORT_STOPPED 0xE0u        /**< cause, position (4 bytes, not on the line) */
#define PPMC312_REPORT_INTERLOCK 0xE1u
#define PPMC312_REPORT_RUN 0xE2u            /**< a motion that waited for RUN has begun */
#define PPMC312_REPORT_ENCODER 0xE3u        /**< 0: inside, 1: outside */
#define PPMC312_REPORT_IN_POSITION 0xE4u    /**< 0: inside, 1: outside */
#define PPMC312_REPORT_EXECUTED 0xE8u       /**< line only: an instruction was executed; the report does not name it */
#define PPMC312_REPORT_INPUTS 0xE9u         /**< flag (1: earlier changes were overwritten), changed bits */
#define PPMC312_REPORT_ALARM 0xF4u          /**< 0: pin, 1 .. 3: unread answers */
#define PPMC312_REPORT_EVENT_FAILED 0xF8u
#define PPMC312_REPORT_OVERRIDE_FAILED 0xF9u

/** Source of a report. */
#define PPMC312_FROM_PART 0x23u
#define PPMC312_FROM_EVENT 0x0Bu    /**< `code` is the code of the executed instruction */
#define PPMC312_FROM_OVERRIDE 0x1Bu /**< `code` is the code of the instruction in the override buffer */

#define PPMC312_DATA_MAX 29u   /**< data bytes of an answer */
#define PPMC312_REPORTS_MAX 8u /**< maximum number of reports that the driver stores */

/** A report. Additional data bytes are discarded. */
typedef struct {
    uint8_t source, code, count;
    uint8_t data[8];
} ppmc312_report_t;

/** States: ppmc312_status_t::condition. */
#define PPMC312_STATE_INI 0x01u /**< no table */
#define PPMC312_STATE_NOR 0x02u /**< ready */
#define PPMC312_STATE_ACC 0x04u
#define PPMC312_STATE_FIX 0x08u
#define PPMC312_STATE_ABN 0x10u /**< alarm */
#define PPMC312_STATE_WRN 0x20u /**< a motion waits for RUN */

/** Status; see docs/ppmc312/instructions.md, 4D. */
typedef struct {
    uint8_t operation, condition, buffers;
} ppmc312_status_t;

/** One part. Fill it with ppmc312_setup() or ppmc312_setup_line(). */
typedef struct {
    ppmc104_t bus;           /**< access functions of the bus; bus.limit, bus.give_up: limits of all waits */
    const ppmc_line_t *line; /**< serial line; null on the bus */
    uint8_t station;         /**< line only: station number */
    bool sum_chars;          /**< line only: SUM_MODE "CHARS"; may be changed after ppmc312_setup_line() */
    unsigned reply_ms;       /**< line only: maximum time in ms until the first byte of a reply; 300 */
    uint8_t detail[2];       /**< data of the last rejection: error number of F0, or s and condition of F1 */
    /* private to the driver */
    bool table, armed, busy, moving, ended, known[2];
    uint16_t rate_min, rate_max;
    ppmc312_op_t op;
    uint8_t flags, cause;
    uint32_t pulses, begin, stopped_at;
    ppmc312_report_t reports[PPMC312_REPORTS_MAX];
    uint8_t first, stored;
    bool lost;
} ppmc312_t;

/** Fill `dev` for the parallel bus. Makes no bus access. `reg` is the register number, 0 .. 7. */
void ppmc312_setup(ppmc312_t *dev, uint8_t (*read)(void *ctx, unsigned reg),
                   void (*write)(void *ctx, unsigned reg, uint8_t value), void *ctx);
/** Fill `dev` for a station of a line, 0 .. 15. Sends nothing. */
ppmc104_result_t ppmc312_setup_line(ppmc312_t *dev, const ppmc_line_t *line, unsigned station);

/** Check that the part responds, read the pending blocks, and read the version. Motions continue. The
 * positions are unknown. */
ppmc104_result_t ppmc312_open(ppmc312_t *dev, uint8_t *version);
/** Reset with instruction FF. Afterwards there is no table, and the position is unknown. */
ppmc104_result_t ppmc312_reset(ppmc312_t *dev);

/** Set up linear or sigmoid ramps; only at standstill. After a rejected table, the part has no table. */
ppmc104_result_t ppmc312_table(ppmc312_t *dev, const ppmc312_table_t *table);
/** Set up free ramps. */
ppmc104_result_t ppmc312_curve(ppmc312_t *dev, const ppmc312_curve_t *curve);

/** @name Motions
 * The functions return when the part has accepted the motion. PPMC312_ERR_LIMIT: the motor does not move.
 * @{ */
ppmc104_result_t ppmc312_start(ppmc312_t *dev, const ppmc312_motion_t *motion);
/** Move with ramps at the high rate. @param pulses CW is positive; not 0 */
ppmc104_result_t ppmc312_move(ppmc312_t *dev, int32_t pulses);
/** Move with ramps to a position. @return PPMC104_BAD_ARGUMENT: this is the current position.
 * PPMC104_POSITION_UNKNOWN: as ppmc312_position() */
ppmc104_result_t ppmc312_move_to(ppmc312_t *dev, int32_t position);
/** Stop immediately or with the ramp. @param position only for PPMC312_AT_POSITION */
ppmc104_result_t ppmc312_stop(ppmc312_t *dev, bool slowly, ppmc312_when_t when, int32_t position);
/** Change the rate of the running motion, along the ramp or immediately. */
ppmc104_result_t ppmc312_change(ppmc312_t *dev, bool ramp, uint16_t rate, ppmc312_when_t when, int32_t position);
/** @} */

/**
 * Wait for the end of the motion that this driver started. The function reads all reports; ppmc312_report()
 * returns the reports of other events. While override or event buffers are in use, the driver sends no status
 * instruction on the bus, because an unread answer together with a trigger causes an alarm. If the part is
 * reset during this time, the wait ends with PPMC104_TIMEOUT.
 * @param end may be null; valid if the result is PPMC104_OK
 * @return PPMC104_UNCONFIRMED: the part is at standstill without a report, or its position disagrees with the
 * order. PPMC312_ERR_STATE: no motion was started
 */
ppmc104_result_t ppmc312_wait(ppmc312_t *dev, ppmc312_end_t *end);

/** Read reports, and return the oldest one. If there is no report, `code` is PPMC312_REPORT_NONE. */
ppmc104_result_t ppmc312_report(ppmc312_t *dev, ppmc312_report_t *report);

/** Return the state of the part. Allowed at any time. */
ppmc104_result_t ppmc312_status(ppmc312_t *dev, ppmc312_status_t *status);
/**
 * Return the pulse position or the encoder position. Allowed at any time.
 * @return PPMC104_POSITION_UNKNOWN: ppmc312_set_position() was not called since the last reset, or the part
 * has no table, because it may have been reset
 */
ppmc104_result_t ppmc312_position(ppmc312_t *dev, bool encoder, int32_t *position);
/** Set the pulse or encoder position. Only at standstill and with a table. */
ppmc104_result_t ppmc312_set_position(ppmc312_t *dev, bool encoder, int32_t position);

/** @name Event buffers 0 and 1
 * An edge of the pin executes the next entry, in the order in which they were stored. @{ */
ppmc104_result_t ppmc312_event_motion(ppmc312_t *dev, unsigned buffer, const ppmc312_motion_t *motion);
/** Store another instruction: its code and parameters as on the bus.
 * @param count 0 .. 9, on the line 0 .. 7 */
ppmc104_result_t ppmc312_event(ppmc312_t *dev, unsigned buffer, uint8_t code, const uint8_t *data, unsigned count);
/** Delete the last entry. If there is no entry, the result is PPMC312_ERR_FULL. */
ppmc104_result_t ppmc312_event_delete(ppmc312_t *dev, unsigned buffer);
/** @} */

/** Instructions without parameters for the driver of the motor. */
typedef enum {
    PPMC312_EXCITATION_ON = 0x20,
    PPMC312_EXCITATION_OFF = 0x21,
    PPMC312_COUNTER_CLEAR = 0x22,
    PPMC312_ZERO_CLAMP = 0x23,
    PPMC312_ALARM_CLEAR = 0x24, /**< also ends the abnormal state */
    PPMC312_INTERLOCK = 0x44,   /**< each call toggles interlock control */
    PPMC312_RUN_MONITOR = 0x45  /**< each call toggles the RUN monitoring */
} ppmc312_driver_t;
ppmc104_result_t ppmc312_driver(ppmc312_t *dev, ppmc312_driver_t what);

ppmc104_result_t ppmc312_inputs(ppmc312_t *dev, uint8_t *levels);          /**< AUXI */
ppmc104_result_t ppmc312_control_inputs(ppmc312_t *dev, uint16_t *levels); /**< 27: its first byte in bits 15..8 */
ppmc104_result_t ppmc312_outputs(ppmc312_t *dev, uint8_t bits);            /**< bits 5..0; 1: low */
ppmc104_result_t ppmc312_input_mask(ppmc312_t *dev, uint8_t mask);         /**< monitored bits of AUXI; 0: off */
ppmc104_result_t ppmc312_speed_limit(ppmc312_t *dev, uint16_t rate);       /**< high-speed limit, 2 or more */
ppmc104_result_t ppmc312_end_monitor(ppmc312_t *dev, bool on);             /**< true: an end also requires end_n = L */
ppmc104_result_t ppmc312_in_position(ppmc312_t *dev, uint16_t range);      /**< in-position monitor; 0: off */
ppmc104_result_t ppmc312_encoder(ppmc312_t *dev, uint16_t range);          /**< deviation monitor; 0: off */
ppmc104_result_t ppmc312_interlock_at(ppmc312_t *dev, int32_t position);
/** Line only: return the last error code, and the framing, overrun and checksum errors since the last
 * read. */
ppmc104_result_t ppmc312_line_errors(ppmc312_t *dev, uint8_t *last, uint8_t counts[3]);

/**
 * Send any instruction of the bus and read its answer. On the line, the instruction is translated.
 * @param count  parameter bytes, 0 .. 29
 * @param answer array of PPMC312_DATA_MAX bytes, or null
 * @param got    number of data bytes of the answer, or null
 */
ppmc104_result_t ppmc312_ask(ppmc312_t *dev, uint8_t code, const uint8_t *data, unsigned count, uint8_t *answer,
                             unsigned *got);

#ifdef __cplusplus
}
#endif

#endif
