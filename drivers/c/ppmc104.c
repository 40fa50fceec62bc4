/* SPDX-License-Identifier: Apache-2.0 */
/* Driver for the PPMC-104 stepper controller; ppmc104.h documents the functions. */
#include "ppmc104.h"

#include <stddef.h>

/* Command codes. The code of an operation is the sum of one of OP_... and flags from the header. */
#define CODE_INIT_S 0x20u
#define CODE_INIT_C 0x10u
#define CODE_INIT_L 0x08u
#define CODE_INIT_E 0x04u
#define CODE_STOP 0x40u
#define CODE_STOP_SLOWLY 0x41u
#define OP_STEP 0x42u
#define OP_MOVE 0x43u
#define OP_CONSTANT 0x44u
#define OP_JOG 0x45u
#define OP_RUN 0x46u
#define OP_HOME 0x47u
#define CODE_FINISH 0x80u
#define CODE_INPUTS 0x81u
#define CODE_OUTPUTS 0x82u
#define CODE_REMAINING 0x83u
#define CODE_UNKNOWN 0x87u /* unknown to all parts: rejected, without any other effect */
#define CODE_SWITCHING 0x84u
#define CODE_AUX_INPUTS 0x85u
#define CODE_AUX_OUTPUTS 0x86u
#define CODE_EXCITATION_OFF 0xC0u
#define CODE_AUX_ON 0xC1u
#define CODE_AUX_OFF 0xC2u

#define FINISH_CAUSES 0x78u
#define STATUS_ZERO 0x08u /* reads as 0 on every part */
#define RAMP_MIN 4u
#define RAMP_MAX 11220u
#define PULSES_MAX 0x1000000ul
#define PPS_MAX 500000ul
#define EXTRA_QUANTA 30u /* 7.5 us in units of 4 crystal cycles */

const char *ppmc104_strerror(ppmc104_result_t result)
{
    switch (result) {
    case PPMC104_OK: return "ok";
    case PPMC104_ERR_UNKNOWN: return "error 0: no such command, or nothing to stop";
    case PPMC104_ERR_BUSY: return "error 1: not while an operation runs";
    case PPMC104_ERR_UNINITIALISED: return "error 2: not initialised";
    case PPMC104_ERR_DATA: return "error 3: unexpected data byte";
    case PPMC104_ERR_RAMP_LONG: return "error 4: ramp longer than 11220 pulses";
    case PPMC104_ERR_RAMP: return "error 5: high speed below start speed, or ramp below 4 pulses";
    case PPMC104_ERR_DATA_BUSY: return "error 6: unexpected data byte, during an operation";
    case PPMC104_ERR_DECELERATING: return "error 7: decelerates already";
    case PPMC104_TIMEOUT: return "time-out: the part did not get ready";
    case PPMC104_NO_PART: return "time-out: no part answers, check address, wiring and reset";
    case PPMC104_BAD_ARGUMENT: return "argument out of range";
    case PPMC104_UNCONFIRMED: return "the part does not confirm the end of the motion";
    case PPMC104_POSITION_UNKNOWN: return "position unknown: find the origin, then set it";
    case PPMC104_BAD_REPLY: return "damaged reply: check wiring, speed and address";
    case PPMC104_REPORTS_LOST: return "reports lost: fetch them more often";
    case PPMC2104_ERR_UNKNOWN: return "error 1: no such instruction";
    case PPMC2104_ERR_DATA: return "error 2: unrequested data byte";
    case PPMC2104_ERR_CUT: return "error 3: an unfinished instruction was dropped";
    case PPMC2104_ERR_UNINITIALISED: return "error 4: no initial setting";
    case PPMC2104_ERR_BUSY: return "error 5: not while the axis moves";
    case PPMC2104_ERR_STANDSTILL: return "error 6: nothing to stop";
    case PPMC2104_ERR_START: return "error 7: limit, alarm or origin is active";
    case PPMC2104_ERR_NO_RAMP: return "error 8: nothing to decelerate, stop immediately";
    case PPMC2104_ERR_RAMP: return "error 9: rates or ramp out of range";
    case PPMC2104_ERR_RAMP_LONG: return "error 10: ramp longer than 11220 pulses";
    case PPMC2104_ERR_SWITCHING: return "error 11: chopper time below 64";
    case PPMC2104_ERR_FAST: return "error 12: too fast for one axis";
    case PPMC2104_ERR_FAST_BOTH: return "error 13: too fast for both axes";
    case PPMC312_ERR_PARAMETER: return "F0: a parameter is out of range";
    case PPMC312_ERR_STATE: return "F1: not in this state";
    case PPMC312_ERR_LIMIT: return "F2: the limit ahead is active";
    case PPMC312_ERR_ALARM: return "F4: alarm, clear it";
    case PPMC312_ERR_UNKNOWN: return "F5: no such instruction";
    case PPMC312_ERR_SIZE: return "F6: wrong size";
    case PPMC312_ERR_FULL: return "F7: buffer full, or event pin in use";
    case PPMC312_ERR_BUS_ONLY: return "only on the parallel bus";
    case PMC006_ERR_REFUSED: return "the controller refused it";
    case PMC006_ERR_BUSY: return "not while a motion runs";
    case PMC006_ERR_EEPROM: return "EEPROM busy, missing or failed";
    case PMC006_ERR_NO_SWITCH: return "the motion ended without the switch";
    }
    return "unknown result";
}

/* ---- speeds ---- */

static bool speed_legal(const ppmc104_speed_t *speed)
{
    if (speed->xtal_hz < 1000000ul || speed->xtal_hz > 16000000ul) {
        return false;
    }
    if (speed->base != PPMC104_BASE_PIN) {
        return true;
    }
    return !speed->extra && speed->pin_hz >= 1u && speed->pin_hz <= speed->xtal_hz / 16u;
}

/* Base clock periods in units of 4 crystal cycles. */
static uint32_t base_quanta(const ppmc104_speed_t *speed)
{
    return speed->base == PPMC104_BASE_500K ? 8u : 32u;
}

ppmc104_result_t ppmc104_rate_from_pps(const ppmc104_speed_t *speed, uint32_t pps, uint8_t *rate)
{
    uint32_t whole, part, count;

    if (!speed_legal(speed) || pps == 0u || pps > PPS_MAX) {
        return PPMC104_BAD_ARGUMENT;
    }
    if (speed->base == PPMC104_BASE_PIN) {
        whole = speed->pin_hz;
        part = pps;
    } else {
        uint32_t extra = speed->extra ? 4u * EXTRA_QUANTA * pps : 0u;
        if (extra >= speed->xtal_hz) {
            return PPMC104_BAD_ARGUMENT;
        }
        whole = speed->xtal_hz - extra;
        part = 4u * base_quanta(speed) * pps;
    }
    /* The interval is rounded, so the error of the speed is at most the error of half a rate step. */
    count = (whole + part / 2u) / part;
    if (count < 1u || count > 256u) {
        return PPMC104_BAD_ARGUMENT;
    }
    *rate = (uint8_t)(count - 1u);
    return PPMC104_OK;
}

uint32_t ppmc104_rate_to_mpps(const ppmc104_speed_t *speed, uint8_t rate)
{
    uint32_t count = (uint32_t)rate + 1u, whole, part;

    if (!speed_legal(speed)) {
        return 0u;
    }
    if (speed->base == PPMC104_BASE_PIN) {
        whole = speed->pin_hz;
        part = count;
    } else {
        whole = speed->xtal_hz;
        part = 4u * (count * base_quanta(speed) + (speed->extra ? EXTRA_QUANTA : 0u));
    }
    /* Two steps, so that 32 bits are sufficient. */
    return whole / part * 1000u + whole % part * 1000u / part;
}

/* ---- bytes ---- */

void ppmc104_setup(ppmc104_t *dev, uint8_t (*read)(void *ctx, unsigned reg),
                   void (*write)(void *ctx, unsigned reg, uint8_t value), void *ctx)
{
    dev->read = read;
    dev->write = write;
    dev->ctx = ctx;
    dev->starting = false;
    dev->status_reg = PPMC104_REG_STATUS;
    dev->zero = STATUS_ZERO;
    dev->order.operation = 0u;
    dev->order.flags = 0u;
    dev->order.ended = 0u;
    dev->order.counted = false;
    dev->order.pulses = 0u;
    dev->limit = PPMC104_DEFAULT_LIMIT;
    dev->give_up = NULL;
}

uint8_t ppmc104_status(ppmc104_t *dev)
{
    return dev->read(dev->ctx, dev->status_reg);
}

bool ppmc104_over(ppmc104_t *dev, unsigned long polls)
{
    return dev->give_up != NULL ? dev->give_up(dev->ctx, polls) : polls >= dev->limit;
}

ppmc104_result_t ppmc104_poll(ppmc104_t *dev, uint8_t mask, uint8_t value, uint8_t or_set, uint8_t *status)
{
    unsigned long polls = 0;

    for (;;) {
        *status = ppmc104_status(dev);
        if (((*status & mask) == value || (*status & or_set) != 0u) && (*status & dev->zero) == 0u) {
            return PPMC104_OK;
        }
        if (ppmc104_over(dev, ++polls)) {
            return (*status & dev->zero) != 0u ? PPMC104_NO_PART : PPMC104_TIMEOUT;
        }
    }
}

/* Wait until an accepted motion has begun, and return the status. With DATASHEET timing, BUSY rises 27 .. 112
 * us after the last byte of the motion, and the part accepts further bytes only then (P104-DS-03,
 * STMC-BUS-13). Therefore, if BUSY is 0, a byte without effect is sent. It may stay in the buffer when
 * BUSY rises, because the old chip accepts only stops during a fast motion (P104-DS-12). */
static ppmc104_result_t settle(ppmc104_t *dev, uint8_t *status)
{
    ppmc104_result_t result = ppmc104_poll(dev, PPMC104_STATUS_IBF, 0u, PPMC104_STATUS_BUSY, status);

    if (result == PPMC104_OK && (*status & PPMC104_STATUS_BUSY) == 0u) {
        dev->write(dev->ctx, PPMC104_REG_STATUS, CODE_UNKNOWN);
        result = ppmc104_poll(dev, PPMC104_STATUS_IBF, 0u, PPMC104_STATUS_BUSY, status);
    }
    dev->starting = dev->starting && result != PPMC104_OK;
    return result;
}

bool ppmc104_busy(ppmc104_t *dev)
{
    uint8_t status = ppmc104_status(dev);

    if (dev->starting && settle(dev, &status) != PPMC104_OK) {
        return true; /* the motor may be moving */
    }
    return (status & PPMC104_STATUS_BUSY) != 0u;
}

ppmc104_result_t ppmc104_send(ppmc104_t *dev, unsigned reg, uint8_t value, uint8_t or_set)
{
    uint8_t status;
    ppmc104_result_t result = ppmc104_poll(dev, PPMC104_STATUS_IBF, 0u, or_set, &status);

    if (result == PPMC104_OK) {
        dev->write(dev->ctx, reg, value);
    }
    return result;
}

/* Send one byte: wait for an empty buffer, write the byte, and check the response of the part. During a
 * motion, a stop does not wait for an empty buffer: a byte in the buffer is then from a call that has
 * timed out. */
static ppmc104_result_t put(ppmc104_t *dev, unsigned reg, uint8_t value)
{
    const bool stop = reg == PPMC104_REG_STATUS && (value == CODE_STOP || value == CODE_STOP_SLOWLY);
    uint8_t status;
    ppmc104_result_t result = ppmc104_send(dev, reg, value, stop ? PPMC104_STATUS_BUSY : 0u);

    if (result != PPMC104_OK) {
        return result;
    }
    result = ppmc104_poll(dev, PPMC104_STATUS_IBF, 0u, 0u, &status);
    if (result == PPMC104_OK && (status & PPMC104_STATUS_ERR) != 0u) {
        return (ppmc104_result_t)(PPMC104_ERR_UNKNOWN + ((status >> 4) & 7));
    }
    return result;
}

ppmc104_result_t ppmc104_data(ppmc104_t *dev, uint8_t value)
{
    return put(dev, PPMC104_REG_DATA, value);
}

ppmc104_result_t ppmc104_command(ppmc104_t *dev, uint8_t code, const uint8_t *data, unsigned count)
{
    unsigned n;
    ppmc104_result_t result;

    if (count > 4u) {
        return PPMC104_BAD_ARGUMENT;
    }
    result = put(dev, PPMC104_REG_STATUS, code);
    for (n = 0; n < count && result == PPMC104_OK; ++n) {
        result = put(dev, PPMC104_REG_DATA, data[n]);
    }
    return result;
}

ppmc104_result_t ppmc104_fetch(ppmc104_t *dev, unsigned count, uint32_t *value)
{
    unsigned n;
    uint32_t sum = 0;

    if (count < 1u || count > 4u) {
        return PPMC104_BAD_ARGUMENT;
    }
    for (n = 0; n < count; ++n) {
        uint8_t status;
        ppmc104_result_t result = ppmc104_poll(dev, PPMC104_STATUS_OBF, PPMC104_STATUS_OBF, 0u, &status);
        if (result != PPMC104_OK) {
            return result;
        }
        sum |= (uint32_t)dev->read(dev->ctx, PPMC104_REG_DATA) << (8u * n);
    }
    *value = sum;
    return PPMC104_OK;
}

ppmc104_result_t ppmc104_ask(ppmc104_t *dev, uint8_t code, unsigned count, uint32_t *value)
{
    ppmc104_result_t result = ppmc104_command(dev, code, NULL, 0u);
    return result == PPMC104_OK ? ppmc104_fetch(dev, count, value) : result;
}

ppmc104_result_t ppmc104_ask_byte(ppmc104_t *dev, uint8_t code, uint8_t *byte)
{
    uint32_t value = 0;
    ppmc104_result_t result = ppmc104_ask(dev, code, 1u, &value);
    if (result == PPMC104_OK) {
        *byte = (uint8_t)value;
    }
    return result;
}

/* ---- set-up ---- */

ppmc104_result_t ppmc104_probe(ppmc104_t *dev)
{
    uint8_t levels = 0;
    ppmc104_result_t result = ppmc104_ask_byte(dev, CODE_INPUTS, &levels);
    /* Bits 5 and 4 read as 0 on every part. */
    return result == PPMC104_OK && (levels & 0x30u) != 0u ? PPMC104_NO_PART : result;
}

ppmc104_result_t ppmc104_init(ppmc104_t *dev, const ppmc104_config_t *config)
{
    uint8_t code, data[4];

    if (config->motor < 3u || config->motor > 5u || config->rate_high > config->rate_start ||
        config->ramp < RAMP_MIN || config->ramp > RAMP_MAX) {
        return PPMC104_BAD_ARGUMENT;
    }
    code = (uint8_t)((config->motor - 2u) | (config->half_step ? CODE_INIT_E : 0u) |
                     (config->active_high ? CODE_INIT_L : 0u) | (config->external_clock ? CODE_INIT_C : 0u) |
                     (config->chop ? CODE_INIT_S : 0u));
    data[0] = config->rate_start;
    data[1] = config->rate_high;
    data[2] = (uint8_t)(config->ramp & 0xFFu);
    data[3] = (uint8_t)(config->ramp >> 8);
    return ppmc104_command(dev, code, data, 4u);
}

/* ---- operations ---- */

/* `skip`: number of omitted parameters, counted from the rate byte on. */
static ppmc104_result_t operate(ppmc104_t *dev, unsigned op, uint8_t flags, uint8_t allowed, uint8_t rate,
                                uint32_t pulses, unsigned skip, unsigned count)
{
    uint8_t data[4];
    ppmc104_result_t result;

    if ((flags & (uint8_t)~allowed) != 0u || pulses < 1u || pulses > PULSES_MAX) {
        return PPMC104_BAD_ARGUMENT;
    }
    data[0] = rate;
    --pulses; /* the part expects the number of pulses minus 1 */
    data[1] = (uint8_t)(pulses & 0xFFu);
    data[2] = (uint8_t)(pulses >> 8 & 0xFFu);
    data[3] = (uint8_t)(pulses >> 16 & 0xFFu);
    result = ppmc104_command(dev, (uint8_t)(op | flags), data + skip, count);
    dev->starting = result == PPMC104_OK;
    if (result == PPMC104_OK || result == PPMC104_TIMEOUT) {
        dev->order.operation = (uint8_t)(op & 7u);
        dev->order.flags = flags;
        dev->order.ended = 0u;
        dev->order.counted = false;
        dev->order.pulses = op == OP_MOVE || op == OP_CONSTANT || op == OP_STEP ? pulses + 1u : PULSES_MAX;
    }
    return result;
}

#define PLAIN (PPMC104_CCW | PPMC104_NO_INT)

ppmc104_result_t ppmc104_step(ppmc104_t *dev, uint8_t flags)
{
    return operate(dev, OP_STEP, flags, PLAIN, 0u, 1u, 0u, 0u);
}

ppmc104_result_t ppmc104_move(ppmc104_t *dev, uint8_t flags, uint32_t pulses)
{
    return operate(dev, OP_MOVE, flags, PLAIN | PPMC104_POUT_ONLY, 0u, pulses, 1u, 3u);
}

ppmc104_result_t ppmc104_move_constant(ppmc104_t *dev, uint8_t flags, uint8_t rate, uint32_t pulses)
{
    return operate(dev, OP_CONSTANT, flags, PLAIN, rate, pulses, 0u, 4u);
}

ppmc104_result_t ppmc104_jog(ppmc104_t *dev, uint8_t flags, uint8_t rate)
{
    return operate(dev, OP_JOG, flags, PLAIN, rate, 1u, 0u, 1u);
}

ppmc104_result_t ppmc104_run(ppmc104_t *dev, uint8_t flags)
{
    return operate(dev, OP_RUN, flags, PLAIN | PPMC104_POUT_ONLY, 0u, 1u, 0u, 0u);
}

ppmc104_result_t ppmc104_home(ppmc104_t *dev, uint8_t flags, uint8_t rate)
{
    return operate(dev, OP_HOME, flags, PLAIN, rate, 1u, 0u, 1u);
}

ppmc104_result_t ppmc104_stop(ppmc104_t *dev)
{
    return ppmc104_command(dev, CODE_STOP, NULL, 0u);
}

ppmc104_result_t ppmc104_stop_slowly(ppmc104_t *dev)
{
    return ppmc104_command(dev, CODE_STOP_SLOWLY, NULL, 0u);
}

ppmc104_result_t ppmc104_wait_by(ppmc104_t *dev, ppmc104_finish_t *finish, uint8_t remaining)
{
    uint8_t status;
    uint32_t number = 0;
    ppmc104_finish_t own;
    ppmc104_result_t result = settle(dev, &status);

    finish = finish != NULL ? finish : &own;
    if (result == PPMC104_OK) {
        result = ppmc104_poll(dev, PPMC104_STATUS_BUSY, 0u, 0u, &status);
    }
    if (result == PPMC104_OK) {
        result = ppmc104_finish(dev, finish);
    }
    if (result == PPMC104_OK) {
        ppmc104_recall(&dev->order, finish);
        result = ppmc104_ask(dev, remaining, 3u, &number);
    }
    return result == PPMC104_OK ? ppmc104_confirm(&dev->order, finish, number) : result;
}

ppmc104_result_t ppmc104_wait(ppmc104_t *dev, ppmc104_finish_t *finish)
{
    return ppmc104_wait_by(dev, finish, CODE_REMAINING);
}

/* ---- reads ---- */

static void decode(uint8_t raw, ppmc104_finish_t *finish)
{
    finish->ended = (raw & 0x80u) != 0u;
    finish->stopped = (raw & 0x40u) != 0u;
    finish->alarm = (raw & 0x20u) != 0u;
    finish->limit = (raw & 0x10u) != 0u;
    finish->slow_limit = (raw & 0x08u) != 0u;
    finish->operation = raw & 0x07u;
    finish->raw = raw;
}

void ppmc104_decode_finish(uint8_t raw, ppmc104_order_t *order, ppmc104_finish_t *finish)
{
    decode(raw, finish);
    if (finish->ended && order->ended == 0u && finish->operation == order->operation) {
        order->ended = raw;
    }
}

void ppmc104_recall(ppmc104_order_t *order, ppmc104_finish_t *finish)
{
    if (!finish->ended && order->ended != 0u && (order->ended & 0x7Fu) == finish->raw) {
        decode(order->ended, finish);
    }
}

ppmc104_result_t ppmc104_confirm(const ppmc104_order_t *order, const ppmc104_finish_t *finish, uint32_t number)
{
    if (!finish->ended || finish->operation != order->operation) {
        return PPMC104_UNCONFIRMED;
    }
    if ((finish->raw & FINISH_CAUSES) == 0u) {
        return number == 0u || finish->operation == (OP_HOME & 7u) ? PPMC104_OK : PPMC104_UNCONFIRMED;
    }
    return number < order->pulses ? PPMC104_OK : PPMC104_UNCONFIRMED;
}

int32_t ppmc104_signed(uint32_t value)
{
    return value <= (uint32_t)INT32_MAX ? (int32_t)value : -(int32_t)(~value) - 1;
}

ppmc104_result_t ppmc104_finish(ppmc104_t *dev, ppmc104_finish_t *finish)
{
    uint8_t raw = 0;
    ppmc104_result_t result = ppmc104_ask_byte(dev, CODE_FINISH, &raw);
    if (result == PPMC104_OK) {
        ppmc104_decode_finish(raw, &dev->order, finish);
    }
    return result;
}

ppmc104_result_t ppmc104_inputs(ppmc104_t *dev, uint8_t *levels)
{
    return ppmc104_ask_byte(dev, CODE_INPUTS, levels);
}

ppmc104_result_t ppmc104_outputs(ppmc104_t *dev, uint8_t *levels)
{
    return ppmc104_ask_byte(dev, CODE_OUTPUTS, levels);
}

ppmc104_result_t ppmc104_aux_inputs(ppmc104_t *dev, uint8_t *levels)
{
    return ppmc104_ask_byte(dev, CODE_AUX_INPUTS, levels);
}

ppmc104_result_t ppmc104_remaining(ppmc104_t *dev, const ppmc104_finish_t *finish, uint32_t *pulses)
{
    uint32_t value = 0;
    ppmc104_result_t result;

    if (finish->operation == 0u) {
        return PPMC104_UNCONFIRMED;
    }
    result = ppmc104_ask(dev, CODE_REMAINING, 3u, &value);
    if (result == PPMC104_OK) {
        *pulses = ppmc104_left(finish, value);
    }
    return result;
}

uint32_t ppmc104_left(const ppmc104_finish_t *finish, uint32_t number)
{
    return number != 0u || (finish->raw & FINISH_CAUSES) != 0u ? number + 1u : 0u;
}

/* ---- other functions ---- */

ppmc104_result_t ppmc104_switching(ppmc104_t *dev, uint8_t on, uint8_t off)
{
    uint8_t data[2];
    data[0] = on;
    data[1] = off;
    return ppmc104_command(dev, CODE_SWITCHING, data, 2u);
}

ppmc104_result_t ppmc104_aux_outputs(ppmc104_t *dev, uint8_t bits)
{
    return bits > 0x0Fu ? PPMC104_BAD_ARGUMENT : ppmc104_command(dev, CODE_AUX_OUTPUTS, &bits, 1u);
}

ppmc104_result_t ppmc104_aux(ppmc104_t *dev, bool on)
{
    return ppmc104_command(dev, on ? CODE_AUX_ON : CODE_AUX_OFF, NULL, 0u);
}

ppmc104_result_t ppmc104_excitation_off(ppmc104_t *dev)
{
    uint8_t status;
    ppmc104_result_t result = settle(dev, &status);

    if (result != PPMC104_OK) {
        return result;
    }
    return (status & PPMC104_STATUS_BUSY) != 0u ? PPMC104_ERR_BUSY
                                                : ppmc104_command(dev, CODE_EXCITATION_OFF, NULL, 0u);
}
