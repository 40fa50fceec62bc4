/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file pmc006.h
 * Driver for the PMC006B4 on an RS-232 or RS-485 line: C99, no dependencies, no heap, no floating point, no globals.
 *
 * The driver uses the core in ppmc104.h: add ppmc104.c and pmc006.c to a program. Results are those of
 * ppmc104.h. One pmc006_t serves one controller. Calls for controllers on the same line must not overlap.
 *
 * Distances are microsteps of the current setting. Speeds are microsteps per second.
 */
#ifndef PMC006_H
#define PMC006_H

#include "ppmc104.h"
#include "ppmc_line.h"

#ifdef __cplusplus
extern "C" {
#endif

#define PMC006_FACTORY 255u     /**< address of a new controller; others are 1 .. 120 */
#define PMC006_WORDS_MAX 200u   /**< words of a program, two per instruction */
#define PMC006_STEPS_MAX 2147483647l

/** Settings of pmc006_set() and pmc006_get(). The value is the letter of the instruction. Each comment states
 * the range, then the factory value. */
#define PMC006_ACCELERATION 'u'     /**< 0 .. 5: 1700 * 2^n steps/s^2; 0 */
#define PMC006_DECELERATION 'o'     /**< as PMC006_ACCELERATION */
#define PMC006_MAX_SPEED 'v'        /**< 1 .. 16 000; 1000 after each power-up */
#define PMC006_START_SPEED 'L'      /**< 65 .. 3000, not above the maximum speed; 600 */
#define PMC006_STOP_SPEED 'S'       /**< 65 .. 3000, not above the maximum speed; 600 */
#define PMC006_MICROSTEPS 'm'       /**< 0, 2, 4, 8, 16, 32, 64, 128; 16 */
#define PMC006_CURRENT 'e'          /**< peak current in mA, 400 .. 4000; 800 */
#define PMC006_REDUCE 'a'           /**< 1: reduced current at standstill; 1. Write only: see pmc006_status_t */
#define PMC006_HOLD 'Q'             /**< reduced current: 1/2, 1/4, 1/8, 1/16 for 1 .. 4; 1 */
#define PMC006_CURRENT_BOOST 'M'    /**< current compensation, 100 .. 1200; 300 */
#define PMC006_LEAD 'P'             /**< speed compensation, 300 .. 2000; 1250 */
#define PMC006_EXT_EDGE 'J'         /**< bits 0, 1 = 1: EXT1, EXT2 act on the rising edge; 0 */
#define PMC006_STALL_LENGTH 'T'     /**< samples, 0 .. 63; 64 after power-up, a value that T cannot write */
#define PMC006_STALL_MODE 'Y'       /**< bit 0: on, bit 1: stops the motor, bit 2: drives GPO5; 0 */
#define PMC006_STALL_LEVEL 'Z'      /**< 0 .. 511; 0 */
#define PMC006_AUTOSTART 'F'        /**< 1: run the program after power-up; 0 also halts it now. Write only */
#define PMC006_RELEASE 'g'          /**< 1: no current; stops a motion. Write only */
#define PMC006_EXT_ON 'f'           /**< bits 0, 1: EXT1, EXT2 stop the motor; 0 after each power-up. Write only */

/** Read-only values of pmc006_get(). */
#define PMC006_VERSION 'R'
#define PMC006_STALLED_AT 'X' /**< position of the last stall */
#define PMC006_PORTS 'x'      /**< bits 0 .. 2, 8, 9: GPI1 .. GPI5; 3 .. 7: GPO1 .. GPO5; 10, 11: EXT1, EXT2 */

/** One controller. Fill it with pmc006_setup(). */
typedef struct {
    ppmc104_t core;          /**< core.limit, core.give_up: limits of waits (motions, EEPROM) */
    const ppmc_line_t *line;
    uint8_t address;
    unsigned reply_ms;       /**< maximum time in ms until the first byte of a reply; 200 */
    /* private to the driver */
    bool doubtful, moving, endless, stop_ordered, known;
    uint8_t mark, ext;
    int32_t speed, steps;
    uint32_t begin;
} pmc006_t;

/** Status of the controller (instructions j and O). */
typedef struct {
    bool busy;          /**< a motion is being planned or is running */
    bool ext1, ext2;    /**< EXT1, EXT2 stopped the motor: starts are rejected until pmc006_clear_stops() */
    bool reduce;        /**< current reduction at standstill is on */
    bool stall;         /**< a stall was detected */
    bool released;      /**< no current in the motor */
    uint8_t ext_on;     /**< bits 0, 1: EXT1, EXT2 can stop the motor */
    bool speed_mode;    /**< pmc006_run() is active */
    bool forward;       /**< direction of the next motion */
    bool autostart;     /**< the program runs after power-up */
} pmc006_status_t;

/** End of a motion. */
typedef struct {
    bool complete;      /**< all steps were made */
    bool ext1, ext2;    /**< EXT1, EXT2 stopped the motor */
    bool stall;         /**< the controller has detected a stall */
    bool stopped;       /**< the driver has sent a stop */
    int32_t steps;      /**< steps made; forward is positive */
    int32_t position;   /**< step counter of the controller */
} pmc006_end_t;

/** Fill `dev`. Sends nothing. @param address 1 .. 120, or PMC006_FACTORY */
ppmc104_result_t pmc006_setup(pmc006_t *dev, const ppmc_line_t *line, unsigned address);
/** Wait until the controller responds. For up to 80 ms after power-up, it accepts no frames. Motions
 * continue. The position is unknown. */
ppmc104_result_t pmc006_open(pmc006_t *dev);

/** @name Settings
 * A setting is valid until the next power-up. pmc006_save() keeps it longer, if the manual allows this.
 * PMC006_ERR_REFUSED: the controller kept its old value. @{ */
ppmc104_result_t pmc006_set(pmc006_t *dev, char setting, int32_t value);
ppmc104_result_t pmc006_get(pmc006_t *dev, char setting, int32_t *value);
/** Change the address to 1 .. 120. */
ppmc104_result_t pmc006_set_address(pmc006_t *dev, unsigned address);
/** Save the settings in the EEPROM, and wait for the end of the write (which the original device does not
 * report). */
ppmc104_result_t pmc006_save(pmc006_t *dev);
/** @} */

/** @name Motions
 * The functions return when the controller has accepted the motion. @{ */
/** Move. @param steps forward is positive; neither 0 nor -2^31 */
ppmc104_result_t pmc006_move(pmc006_t *dev, int32_t steps);
/** Move to a position. @return PPMC104_BAD_ARGUMENT: this is the current position.
 * PPMC104_POSITION_UNKNOWN: as pmc006_position() */
ppmc104_result_t pmc006_move_to(pmc006_t *dev, int32_t position);
/** Run at constant speed until stopped. @param speed 1 .. 16 000; PMC006_MAX_SPEED changes it during the
 * run */
ppmc104_result_t pmc006_run(pmc006_t *dev, bool forward, int32_t speed);
/** Stop immediately. At standstill, this is not an error. */
ppmc104_result_t pmc006_stop(pmc006_t *dev);
/** Decelerate, then stop; only after pmc006_run(). During a move, the result is PMC006_ERR_REFUSED,
 * because the controller has no instruction for it. */
ppmc104_result_t pmc006_stop_slowly(pmc006_t *dev);
/**
 * Find a switch at EXT1 or EXT2, move away from it by `back` steps, and set the position to 0. The function
 * waits for the complete sequence, so the limit of the waits must be long enough.
 * @param ext 1 or 2
 * @param back 1 or more
 * @return PMC006_ERR_NO_SWITCH: the motion ended before the switch was active
 */
ppmc104_result_t pmc006_home(pmc006_t *dev, unsigned ext, bool forward, int32_t back);
/** @} */

/**
 * Wait for the end of the motion that this driver started.
 * @param end may be null; valid if the result is PPMC104_OK
 * @return PPMC104_UNCONFIRMED: the motor is at standstill, but neither the position, nor a flag of the
 * controller, nor a stop that was sent explains why, for example after a reset. PMC006_ERR_REFUSED: no motion
 * was started
 */
ppmc104_result_t pmc006_wait(pmc006_t *dev, pmc006_end_t *end);

ppmc104_result_t pmc006_status(pmc006_t *dev, pmc006_status_t *status);
/** Clear the flags of EXT1, EXT2 and the stall. */
ppmc104_result_t pmc006_clear_stops(pmc006_t *dev);
/**
 * Return the step counter of the controller.
 * @return PPMC104_POSITION_UNKNOWN: the position was not set since pmc006_open(), or the controller was
 * reset. The driver detects a reset only from a changed value of PMC006_MAX_SPEED (if it was not 1000) or of
 * PMC006_EXT_ON
 */
ppmc104_result_t pmc006_position(pmc006_t *dev, int32_t *position);
ppmc104_result_t pmc006_set_position(pmc006_t *dev, int32_t position);
/** Set the outputs GPO1 .. GPO5 to the levels in bits 0 .. 4. */
ppmc104_result_t pmc006_outputs(pmc006_t *dev, uint8_t bits);

/** @name Program
 * Words as in docs/pmc006/README.md, chapter 13: opcode and option, then the operand. @{ */
/** Load words into the program buffer, and read them back. @param count 1 .. PMC006_WORDS_MAX */
ppmc104_result_t pmc006_program(pmc006_t *dev, const uint32_t *words, unsigned count);
/** Write the buffer to the EEPROM, and wait for the end of the write. */
ppmc104_result_t pmc006_program_burn(pmc006_t *dev);
/** Run the program, beginning with this instruction, 0 .. 99. The step counter continues. The driver does not wait
 * for motions of a program. */
ppmc104_result_t pmc006_program_run(pmc006_t *dev, unsigned instruction);
/** Halt the program. It will not run after power-up (PMC006_AUTOSTART). A motion continues. */
ppmc104_result_t pmc006_program_halt(pmc006_t *dev);
/** @} */

/** Send one frame and read its reply, without repetition. Use it for instructions that have no function
 * here. */
ppmc104_result_t pmc006_ask(pmc006_t *dev, char code, int32_t data, int32_t *reply);

#ifdef __cplusplus
}
#endif

#endif
