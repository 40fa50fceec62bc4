/* SPDX-License-Identifier: Apache-2.0 */
#include "ppmc2104.h"

#include <stddef.h>

#define CODE_STOP 0x40u
#define CODE_STOP_SLOWLY 0x41u
#define CODE_FINISH 0x80u
#define CODE_INPUTS 0x81u
#define CODE_OUTPUTS 0x82u
#define CODE_REMAINING 0x83u
#define CODE_SWITCHING 0x84u
#define CODE_HOLD_DELAY 0x85u
#define CODE_ERROR 0x86u
#define CODE_EXCITATION_OFF 0xC0u
#define CODE_AUX_OUTPUTS 0xC1u
#define CODE_AUX_INPUTS 0xC2u
#define BOTH_AXES 3u
#define STATUS_ZERO 0x40u /* reads as 0 on every part */
#define SWITCHING_MIN 0x40u
#define RAMP_MIN 4u
#define RAMP_MAX 11220u
#define PULSES_MAX 0x1000000ul
#define INPUTS_ZERO 0x30u
#define UNREAD_MAX 5u /* an answer has 3 bytes */
#define ERROR_LAST 13u

static bool is_axis(unsigned axis)
{
    return axis == 1u || axis == 2u;
}

static uint8_t for_axis(unsigned code, unsigned axis)
{
    return (uint8_t)(code | (axis - 1u) << 5);
}

static uint8_t busy_bit(unsigned axis)
{
    return (uint8_t)(PPMC2104_STATUS_BUSY << (axis - 1u));
}

/* ---- bytes ---- */

void ppmc2104_setup(ppmc2104_t *dev, uint8_t (*read)(void *ctx, unsigned reg),
                    void (*write)(void *ctx, unsigned reg, uint8_t value), void (*run)(void *ctx, unsigned axes),
                    void *ctx)
{
    unsigned n;

    ppmc104_setup(&dev->bus, read, write, ctx);
    dev->bus.zero = STATUS_ZERO;
    dev->run = run;
    for (n = 0; n < 2u; ++n) {
        dev->order[n] = dev->bus.order;
        dev->position[n] = 0;
        dev->known[n] = false;
    }
}

uint8_t ppmc2104_status(ppmc2104_t *dev)
{
    return ppmc104_status(&dev->bus);
}

bool ppmc2104_busy(ppmc2104_t *dev, unsigned axis)
{
    return is_axis(axis) && (ppmc2104_status(dev) & busy_bit(axis)) != 0u;
}

/* Discard bytes that another program has not read. With DATASHEET timing, they stay until the next answer
 * is ready. */
static ppmc104_result_t drain(ppmc2104_t *dev)
{
    unsigned n;

    for (n = 0; n < UNREAD_MAX && (ppmc2104_status(dev) & PPMC104_STATUS_OBF) != 0u; ++n) {
        (void)dev->bus.read(dev->bus.ctx, PPMC104_REG_DATA);
    }
    return n < UNREAD_MAX ? PPMC104_OK : PPMC104_NO_PART;
}

static ppmc104_result_t fetch_byte(ppmc2104_t *dev, uint8_t code, uint8_t *byte)
{
    uint32_t value = 0u;
    ppmc104_result_t result = drain(dev);

    if (result == PPMC104_OK) {
        result = ppmc104_send(&dev->bus, PPMC104_REG_STATUS, code, 0u);
    }
    if (result == PPMC104_OK) {
        result = ppmc104_fetch(&dev->bus, 1u, &value);
    }
    *byte = (uint8_t)value;
    return result;
}

/* Read and clear both error registers. The result is the error of `axis`. If this error is 0, the result is
 * the error of the other axis. */
static ppmc104_result_t read_errors(ppmc2104_t *dev, unsigned axis)
{
    uint8_t number[2] = {0u, 0u}, first;
    unsigned n;

    for (n = 0; n < 2u; ++n) {
        ppmc104_result_t result = fetch_byte(dev, for_axis(CODE_ERROR, n + 1u), &number[n]);
        if (result != PPMC104_OK) {
            return result;
        }
    }
    first = number[axis - 1u] != 0u ? number[axis - 1u] : number[2u - axis];
    if (first > ERROR_LAST) {
        return PPMC104_NO_PART;
    }
    return first == 0u ? PPMC104_OK : (ppmc104_result_t)(PPMC2104_ERR_UNKNOWN - 1 + (int)first);
}

/* During a motion, a stop does not wait for an empty buffer: it may replace a byte whose call has timed
 * out. */
ppmc104_result_t ppmc2104_command(ppmc2104_t *dev, uint8_t code, const uint8_t *data, unsigned count)
{
    const unsigned axis = (code & 0x20u) != 0u ? 2u : 1u;
    const bool stop = (code & 0xC6u) == 0x40u;
    uint8_t status = 0u;
    unsigned n;

    if (count > 4u) {
        return PPMC104_BAD_ARGUMENT;
    }
    /* Each byte is checked, because the data of a rejected code would overwrite its error number. */
    for (n = 0; n <= count; ++n) {
        ppmc104_result_t result = n == 0u
                                      ? ppmc104_send(&dev->bus, PPMC104_REG_STATUS, code, stop ? busy_bit(axis) : 0u)
                                      : ppmc104_send(&dev->bus, PPMC104_REG_DATA, data[n - 1u], 0u);
        if (result == PPMC104_OK) {
            result = ppmc104_poll(&dev->bus, PPMC104_STATUS_IBF, 0u, 0u, &status);
        }
        if (result == PPMC104_OK && (status & PPMC2104_STATUS_ERROR) != 0u) {
            result = read_errors(dev, axis);
        }
        if (result != PPMC104_OK) {
            return result;
        }
    }
    return PPMC104_OK;
}

ppmc104_result_t ppmc2104_ask(ppmc2104_t *dev, uint8_t code, unsigned count, uint32_t *value)
{
    ppmc104_result_t result = drain(dev);

    result = result == PPMC104_OK ? ppmc2104_command(dev, code, NULL, 0u) : result;
    return result == PPMC104_OK ? ppmc104_fetch(&dev->bus, count, value) : result;
}

static ppmc104_result_t ask_byte(ppmc2104_t *dev, unsigned axis, unsigned code, uint8_t *byte)
{
    uint32_t value = 0u;
    ppmc104_result_t result;

    if (!is_axis(axis)) {
        return PPMC104_BAD_ARGUMENT;
    }
    result = ppmc2104_ask(dev, for_axis(code, axis), 1u, &value);
    if (result == PPMC104_OK) {
        *byte = (uint8_t)value;
    }
    return result;
}

/* ---- set-up ---- */

ppmc104_result_t ppmc2104_open(ppmc2104_t *dev)
{
    uint8_t levels = 0u, status;
    uint32_t value = 0u;
    ppmc104_result_t result;

    dev->known[0] = dev->known[1] = false;
    /* Only error code reads have no side effect on motions. The first read may end an incomplete
     * instruction (error 3); then it returns no byte. */
    result = ppmc2104_command(dev, CODE_ERROR, NULL, 0u);
    if (result == PPMC104_TIMEOUT || result == PPMC104_NO_PART) {
        return result;
    }
    result = ppmc104_poll(&dev->bus, PPMC2104_STATUS_CMND, 0u, 0u, &status);
    result = result == PPMC104_OK ? read_errors(dev, 1u) : result;
    if (result == PPMC104_TIMEOUT || result == PPMC104_NO_PART) {
        return result;
    }
    result = ppmc2104_ask(dev, CODE_AUX_INPUTS, 1u, &value);
    if (result != PPMC104_OK || value > 3u) {
        return result != PPMC104_OK ? result : PPMC104_NO_PART;
    }
    if (ppmc2104_busy(dev, 1u)) {
        return PPMC104_OK;
    }
    result = ppmc2104_inputs(dev, 1u, &levels);
    return result == PPMC104_OK && (levels & INPUTS_ZERO) != 0u ? PPMC104_NO_PART : result;
}

ppmc104_result_t ppmc2104_init(ppmc2104_t *dev, unsigned axis, const ppmc2104_config_t *config)
{
    uint8_t data[4], status;
    unsigned code;
    ppmc104_result_t result;

    if (!is_axis(axis) || config->motor < 3u || config->motor > 5u ||
        config->rate_start < (unsigned)config->rate_high + 2u ||
        (config->rate_high == 0u && !config->external_clock) || config->ramp < RAMP_MIN || config->ramp > RAMP_MAX) {
        return PPMC104_BAD_ARGUMENT;
    }
    code = config->motor - 2u;
    code |= config->half_step ? 0x04u : 0u;
    code |= config->external_clock ? 0x08u : 0u;
    code |= config->chop ? 0x10u : 0u;
    data[0] = config->rate_start;
    data[1] = config->rate_high;
    data[2] = (uint8_t)(config->ramp & 0xFFu);
    data[3] = (uint8_t)(config->ramp >> 8);
    result = ppmc2104_command(dev, for_axis(code, axis), data, 4u);
    if (result != PPMC104_OK) {
        return result;
    }
    return ppmc104_poll(&dev->bus, (uint8_t)(PPMC2104_STATUS_CMND << (axis - 1u)), 0u, 0u, &status);
}

/* ---- motions ---- */

static bool legal(const ppmc2104_motion_t *motion)
{
    const bool counted = motion->op == PPMC2104_MOVE || motion->op == PPMC2104_CONSTANT;
    const bool ramped = motion->op == PPMC2104_MOVE || motion->op == PPMC2104_RUN;
    const unsigned allowed = PPMC104_CCW | PPMC104_NO_INT | (ramped ? PPMC104_POUT_ONLY : 0u);

    return motion->op >= PPMC2104_STEP && motion->op <= PPMC2104_HOME && (motion->flags & ~allowed) == 0u &&
           (!counted || (motion->pulses >= 1u && motion->pulses <= PULSES_MAX));
}

static ppmc104_result_t send_motion(ppmc2104_t *dev, unsigned axis, const ppmc2104_motion_t *motion)
{
    ppmc104_order_t *order = &dev->order[axis - 1u];
    const bool counted = motion->op == PPMC2104_MOVE || motion->op == PPMC2104_CONSTANT;
    uint8_t data[4];
    unsigned count = 0u;
    uint32_t left = motion->pulses - 1u; /* the part expects the number of pulses minus 1 */
    ppmc104_result_t result;

    if (motion->op == PPMC2104_CONSTANT || motion->op == PPMC2104_JOG || motion->op == PPMC2104_HOME) {
        data[count++] = motion->rate;
    }
    if (counted) {
        data[count++] = (uint8_t)(left & 0xFFu);
        data[count++] = (uint8_t)(left >> 8 & 0xFFu);
        data[count++] = (uint8_t)(left >> 16 & 0xFFu);
    }
    /* Bit 7 of the code selects "pulses only" in both parts. */
    result = ppmc2104_command(dev, for_axis(0x40u | motion->flags | (unsigned)motion->op, axis), data, count);
    if (result == PPMC104_OK || result == PPMC104_TIMEOUT) {
        /* If the end of the last motion was not confirmed, the position is unknown. */
        dev->known[axis - 1u] = dev->known[axis - 1u] && (order->operation == 0u || order->counted);
        order->operation = (uint8_t)motion->op;
        order->flags = motion->flags;
        order->ended = 0u;
        order->counted = false;
        order->pulses = counted ? motion->pulses : motion->op == PPMC2104_STEP ? 1u : PULSES_MAX;
    }
    return result;
}

ppmc104_result_t ppmc2104_start(ppmc2104_t *dev, unsigned axis, const ppmc2104_motion_t *motion)
{
    return is_axis(axis) && legal(motion) ? send_motion(dev, axis, motion) : PPMC104_BAD_ARGUMENT;
}

ppmc104_result_t ppmc2104_move(ppmc2104_t *dev, unsigned axis, int32_t pulses)
{
    ppmc2104_motion_t motion = {PPMC2104_MOVE, PPMC104_CW, 0u, 0u};

    motion.pulses = (uint32_t)pulses;
    if (pulses < 0) {
        motion.flags = PPMC104_CCW;
        motion.pulses = ~motion.pulses + 1u;
    }
    return ppmc2104_start(dev, axis, &motion);
}

ppmc104_result_t ppmc2104_move_to(ppmc2104_t *dev, unsigned axis, int32_t position)
{
    int32_t now = 0;
    int64_t way;
    ppmc104_result_t result = ppmc2104_position(dev, axis, &now);

    if (result != PPMC104_OK) {
        return result;
    }
    way = (int64_t)position - now;
    if (way > (int64_t)PULSES_MAX || way < -(int64_t)PULSES_MAX) {
        return PPMC104_BAD_ARGUMENT;
    }
    return ppmc2104_move(dev, axis, (int32_t)way);
}

ppmc104_result_t ppmc2104_start_both(ppmc2104_t *dev, const ppmc2104_motion_t *first,
                                     const ppmc2104_motion_t *second)
{
    const uint8_t idle = (uint8_t)(busy_bit(1u) | busy_bit(2u));
    uint8_t status;
    unsigned axis;
    ppmc104_result_t result;

    if (dev->run == NULL || !legal(first) || !legal(second)) {
        return PPMC104_BAD_ARGUMENT;
    }
    if ((ppmc2104_status(dev) & idle) != 0u) {
        return PPMC2104_ERR_BUSY;
    }
    dev->run(dev->bus.ctx, 0u);
    result = send_motion(dev, 1u, first);
    if (result == PPMC104_OK) {
        result = send_motion(dev, 2u, second);
    }
    /* With DATASHEET timing, RUN is not sampled until the processing windows have closed (P2104-DS-14). */
    if (result == PPMC104_OK) {
        result = ppmc104_poll(&dev->bus, PPMC2104_STATUS_CMND | PPMC2104_STATUS_CMND << 1, 0u, 0u, &status);
    }
    for (axis = 1u; axis <= 2u && result != PPMC104_OK; ++axis) {
        if (ppmc2104_busy(dev, axis)) {
            const ppmc104_result_t stopped = ppmc2104_stop(dev, axis);
            const ppmc104_result_t ended = stopped == PPMC104_OK ? ppmc2104_wait(dev, axis, NULL) : stopped;
            if (ended != PPMC104_OK) {
                return ended; /* RUN stays low, because this axis would move */
            }
        }
    }
    dev->run(dev->bus.ctx, BOTH_AXES);
    return result;
}

static ppmc104_result_t stop_by(ppmc2104_t *dev, unsigned axis, unsigned code)
{
    ppmc104_result_t result;

    if (!is_axis(axis)) {
        return PPMC104_BAD_ARGUMENT;
    }
    result = ppmc2104_command(dev, for_axis(code, axis), NULL, 0u);
    /* The stop takes effect even if it ended an incomplete instruction (P2104-STP-07). */
    return result == PPMC2104_ERR_CUT ? PPMC104_OK : result;
}

ppmc104_result_t ppmc2104_stop(ppmc2104_t *dev, unsigned axis)
{
    return stop_by(dev, axis, CODE_STOP);
}

ppmc104_result_t ppmc2104_stop_slowly(ppmc2104_t *dev, unsigned axis)
{
    return stop_by(dev, axis, CODE_STOP_SLOWLY);
}

/* ---- ends and positions ---- */

ppmc104_result_t ppmc2104_finish(ppmc2104_t *dev, unsigned axis, ppmc104_finish_t *finish)
{
    uint8_t raw = 0u;
    ppmc104_result_t result = ask_byte(dev, axis, CODE_FINISH, &raw);

    if (result == PPMC104_OK) {
        ppmc104_decode_finish(raw, &dev->order[axis - 1u], finish);
    }
    return result;
}

ppmc104_result_t ppmc2104_remaining(ppmc2104_t *dev, unsigned axis, const ppmc104_finish_t *finish, uint32_t *pulses)
{
    uint32_t value = 0u;
    ppmc104_result_t result;

    if (!is_axis(axis)) {
        return PPMC104_BAD_ARGUMENT;
    }
    if (finish->operation == 0u) {
        return PPMC104_UNCONFIRMED;
    }
    result = ppmc2104_ask(dev, for_axis(CODE_REMAINING, axis), 3u, &value);
    if (result == PPMC104_OK) {
        *pulses = ppmc104_left(finish, value);
    }
    return result;
}

ppmc104_result_t ppmc2104_wait(ppmc2104_t *dev, unsigned axis, ppmc104_finish_t *finish)
{
    ppmc104_finish_t own;
    ppmc104_order_t *order;
    uint32_t number = 0u, made;
    uint8_t status;
    ppmc104_result_t result;

    if (!is_axis(axis)) {
        return PPMC104_BAD_ARGUMENT;
    }
    finish = finish != NULL ? finish : &own;
    order = &dev->order[axis - 1u];
    result = ppmc104_poll(&dev->bus, busy_bit(axis), 0u, 0u, &status);
    if (result == PPMC104_OK) {
        result = ppmc2104_finish(dev, axis, finish);
    }
    if (result == PPMC104_OK) {
        ppmc104_recall(order, finish);
        result = ppmc2104_ask(dev, for_axis(CODE_REMAINING, axis), 3u, &number);
    }
    if (result != PPMC104_OK) {
        return result;
    }
    result = ppmc104_confirm(order, finish, number);
    if (result != PPMC104_OK) {
        dev->known[axis - 1u] = false;
        order->operation = 0u;
    } else if (!order->counted) {
        /* An origin search sets no cause bit, but may leave pulses. */
        made = order->pulses - (finish->operation == PPMC2104_HOME ? number + 1u : ppmc104_left(finish, number));
        made = (order->flags & PPMC104_CCW) != 0u ? ~made + 1u : made;
        dev->position[axis - 1u] = ppmc104_signed((uint32_t)dev->position[axis - 1u] + made);
        order->counted = true;
    }
    return result;
}

ppmc104_result_t ppmc2104_position(ppmc2104_t *dev, unsigned axis, int32_t *position)
{
    if (!is_axis(axis)) {
        return PPMC104_BAD_ARGUMENT;
    }
    if (!dev->known[axis - 1u]) {
        return PPMC104_POSITION_UNKNOWN;
    }
    if (dev->order[axis - 1u].operation != 0u && !dev->order[axis - 1u].counted) {
        return PPMC2104_ERR_BUSY;
    }
    *position = dev->position[axis - 1u];
    return PPMC104_OK;
}

ppmc104_result_t ppmc2104_set_position(ppmc2104_t *dev, unsigned axis, int32_t position)
{
    if (!is_axis(axis)) {
        return PPMC104_BAD_ARGUMENT;
    }
    if (ppmc2104_busy(dev, axis)) {
        return PPMC2104_ERR_BUSY;
    }
    dev->position[axis - 1u] = position;
    dev->known[axis - 1u] = true;
    dev->order[axis - 1u].counted = true;
    return PPMC104_OK;
}

/* ---- other functions ---- */

ppmc104_result_t ppmc2104_inputs(ppmc2104_t *dev, unsigned axis, uint8_t *levels)
{
    return ask_byte(dev, axis, CODE_INPUTS, levels);
}

ppmc104_result_t ppmc2104_outputs(ppmc2104_t *dev, unsigned axis, uint8_t *levels)
{
    return ask_byte(dev, axis, CODE_OUTPUTS, levels);
}

ppmc104_result_t ppmc2104_aux_inputs(ppmc2104_t *dev, uint8_t *levels)
{
    return ask_byte(dev, 1u, CODE_AUX_INPUTS, levels);
}

ppmc104_result_t ppmc2104_switching(ppmc2104_t *dev, unsigned axis, uint8_t on, uint8_t off)
{
    uint8_t data[2];

    if (!is_axis(axis) || on < SWITCHING_MIN || off < SWITCHING_MIN) {
        return PPMC104_BAD_ARGUMENT;
    }
    data[0] = on;
    data[1] = off;
    return ppmc2104_command(dev, for_axis(CODE_SWITCHING, axis), data, 2u);
}

ppmc104_result_t ppmc2104_hold_delay(ppmc2104_t *dev, unsigned axis, uint8_t units)
{
    return is_axis(axis) ? ppmc2104_command(dev, for_axis(CODE_HOLD_DELAY, axis), &units, 1u) : PPMC104_BAD_ARGUMENT;
}

ppmc104_result_t ppmc2104_aux_outputs(ppmc2104_t *dev, uint8_t bits)
{
    return bits > 3u ? PPMC104_BAD_ARGUMENT
                     : ppmc2104_command(dev, (uint8_t)(CODE_AUX_OUTPUTS | (unsigned)bits << 4), NULL, 0u);
}

ppmc104_result_t ppmc2104_excitation_off(ppmc2104_t *dev, unsigned axis)
{
    ppmc104_result_t result;

    if (!is_axis(axis)) {
        return PPMC104_BAD_ARGUMENT;
    }
    result = ppmc2104_command(dev, for_axis(CODE_EXCITATION_OFF, axis), NULL, 0u);
    if (result == PPMC104_OK) {
        dev->known[axis - 1u] = false;
    }
    return result;
}
