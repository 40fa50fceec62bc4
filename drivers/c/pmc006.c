/* SPDX-License-Identifier: Apache-2.0 */
#include "pmc006.h"

#include <stddef.h>

#define HEAD 0xA5u
#define ANSWER 0x7Au
#define FRAME 8u
#define LAST_ADDRESS 120u
#define NOISE_MAX 64u
#define REPLY_MS 200u
#define BYTE_MS 50u
#define ATTEMPTS 4u
#define MARKS 199u /* the word pointer has the values 0 .. 199 */
#define FACTORY_SPEED 1000
#define STEP_ACK 3
#define EEPROM_BUSY 1

typedef struct {
    char code;
    char reader;  /* instruction that reads the value; if it equals `code`, data out of range also read it */
    int32_t read; /* data for the instruction `reader` */
    int32_t low, high;
} setting_t;

static const setting_t SETTINGS[] = {
    {'A', 0, 0, 0, 199},         {'F', 0, 0, 0, 1},          {'J', 'K', 0, 0, 3},      {'L', 'L', 0, 65, 3000},
    {'M', 'M', 0, 100, 1200},    {'P', 'P', 0, 300, 2000},   {'Q', 'U', 0, 1, 4},      {'S', 'S', 0, 65, 3000},
    {'T', 'T', 64, 0, 63},       {'Y', 'Y', 8, 0, 7},        {'Z', 'Z', 512, 0, 511},  {'a', 0, 0, 0, 1},
    {'d', 0, 0, 0, 1},           {'e', 'n', 0, 400, 4000},   {'f', 0, 0, 0, 3},        {'g', 0, 0, 0, 1},
    {'i', 0, 0, INT32_MIN, INT32_MAX}, {'m', 'k', 0, 0, 128}, {'o', 'h', 0, 0, 5},     {'u', 'r', 0, 0, 5},
    {'v', 'q', 0, 1, 16000},
    /* read-only values */
    {'R', 'R', 0, 1, 0},         {'X', 'X', 0, 1, 0},        {'x', 'x', 0, 1, 0},
};

static const setting_t *find(char code)
{
    unsigned n;

    for (n = 0; n < sizeof SETTINGS / sizeof SETTINGS[0]; ++n) {
        if (SETTINGS[n].code == code) {
            return &SETTINGS[n];
        }
    }
    return NULL;
}

/* ---- frames ---- */

static bool address_legal(unsigned address)
{
    return (address >= 1u && address <= LAST_ADDRESS) || address == PMC006_FACTORY;
}

ppmc104_result_t pmc006_setup(pmc006_t *dev, const ppmc_line_t *line, unsigned address)
{
    if (!address_legal(address)) {
        return PPMC104_BAD_ARGUMENT;
    }
    ppmc104_setup(&dev->core, NULL, NULL, line->ctx);
    dev->line = line;
    dev->address = (uint8_t)address;
    dev->reply_ms = REPLY_MS;
    dev->doubtful = dev->moving = dev->endless = dev->stop_ordered = dev->known = false;
    dev->mark = dev->ext = 0u;
    dev->speed = FACTORY_SPEED;
    dev->steps = 0;
    dev->begin = 0u;
    return PPMC104_OK;
}

static uint8_t sum_of(const uint8_t *frame)
{
    unsigned sum = 0u, n;

    for (n = 0; n < FRAME - 1u; ++n) {
        sum += frame[n];
    }
    return (uint8_t)(sum & 0xFFu);
}

/* Send one frame, and receive the reply of the controller with address `from`. */
static ppmc104_result_t exchange(const pmc006_t *dev, char code, uint32_t data, uint8_t from, uint32_t *reply)
{
    const ppmc_line_t *line = dev->line;
    uint8_t frame[FRAME], byte;
    unsigned n, got = 0u;

    ppmc_line_drain(line, dev->doubtful ? BYTE_MS : 0u); /* a late reply may still arrive */
    frame[0] = HEAD;
    frame[1] = dev->address;
    frame[2] = (uint8_t)code;
    for (n = 0; n < 4u; ++n) {
        frame[3u + n] = (uint8_t)(data >> (8u * n) & 0xFFu);
    }
    frame[7] = sum_of(frame);
    line->send(line->ctx, frame, FRAME);
    for (n = 0; line->echo && n < FRAME; ++n) {
        if (!line->receive(line->ctx, &byte, BYTE_MS) || byte != frame[n]) {
            return PPMC104_BAD_REPLY;
        }
    }
    for (n = 0; got < FRAME; ++n) {
        if (n == NOISE_MAX) {
            return PPMC104_BAD_REPLY;
        }
        if (!line->receive(line->ctx, &byte, n == 0u ? dev->reply_ms : BYTE_MS)) {
            return n == 0u ? PPMC104_TIMEOUT : PPMC104_BAD_REPLY;
        }
        if (got != 0u || byte == HEAD) {
            frame[got++] = byte;
        }
    }
    if (frame[1] != ANSWER || frame[2] != from || frame[7] != sum_of(frame)) {
        return PPMC104_BAD_REPLY;
    }
    *reply = (uint32_t)frame[3] | (uint32_t)frame[4] << 8 | (uint32_t)frame[5] << 16 | (uint32_t)frame[6] << 24;
    return PPMC104_OK;
}

/* Replies do not contain the code of their instruction. After a silence or a damaged reply, a late reply
 * could therefore be taken for the reply to the next request. The word pointer is written with new values
 * until exactly the written value is returned. */
static ppmc104_result_t in_step(pmc006_t *dev)
{
    unsigned n;
    ppmc104_result_t result = PPMC104_OK;

    for (n = 0; dev->doubtful && n < ATTEMPTS; ++n) {
        uint32_t reply = 0u;
        dev->mark = (uint8_t)(dev->mark % MARKS + 1u);
        result = exchange(dev, 'A', dev->mark, dev->address, &reply);
        if (result == PPMC104_OK && reply != dev->mark) {
            result = PPMC104_BAD_REPLY;
        }
        dev->doubtful = result != PPMC104_OK;
    }
    return result;
}

ppmc104_result_t pmc006_ask(pmc006_t *dev, char code, int32_t data, int32_t *reply)
{
    uint32_t value = 0u;
    ppmc104_result_t result = in_step(dev);

    if (result == PPMC104_OK) {
        result = exchange(dev, code, (uint32_t)data, dev->address, &value);
        dev->doubtful = result != PPMC104_OK;
    }
    if (result == PPMC104_OK) {
        *reply = ppmc104_signed(value);
    }
    return result;
}

/* Like pmc006_ask(), for instructions that may be repeated. */
static ppmc104_result_t ask_again(pmc006_t *dev, char code, int32_t data, int32_t *reply)
{
    ppmc104_result_t result = PPMC104_TIMEOUT;
    unsigned n;

    for (n = 0; n < ATTEMPTS && result != PPMC104_OK; ++n) {
        result = pmc006_ask(dev, code, data, reply);
    }
    return result;
}

ppmc104_result_t pmc006_open(pmc006_t *dev)
{
    pmc006_status_t status;

    dev->known = dev->moving = false;
    dev->doubtful = true; /* an earlier program may have caused a reply that is still in transit */
    return pmc006_status(dev, &status);
}

/* ---- settings ---- */

static bool is_power(int32_t value)
{
    return (value & (value - 1)) == 0 && value != 1;
}

ppmc104_result_t pmc006_set(pmc006_t *dev, char setting, int32_t value)
{
    const setting_t *row = find(setting);
    int32_t reply = 0;
    ppmc104_result_t result;

    if (row == NULL || value < row->low || value > row->high || (setting == PMC006_MICROSTEPS && !is_power(value))) {
        return PPMC104_BAD_ARGUMENT;
    }
    result = ask_again(dev, setting, value, &reply);
    if (result == PPMC104_OK && reply != value) {
        return PMC006_ERR_REFUSED;
    }
    if (result == PPMC104_OK && setting == PMC006_MAX_SPEED) {
        dev->speed = value;
    } else if (result == PPMC104_OK && setting == PMC006_EXT_ON) {
        dev->ext = (uint8_t)value;
    } else if (result == PPMC104_OK && setting == PMC006_RELEASE && value != 0) {
        dev->stop_ordered = true;
    }
    return result;
}

ppmc104_result_t pmc006_get(pmc006_t *dev, char setting, int32_t *value)
{
    const setting_t *row = find(setting);

    return row == NULL || row->reader == 0 ? PPMC104_BAD_ARGUMENT : ask_again(dev, row->reader, row->read, value);
}

ppmc104_result_t pmc006_set_address(pmc006_t *dev, unsigned address)
{
    uint32_t reply = 0u;
    ppmc104_result_t result = in_step(dev);

    if (address < 1u || address > LAST_ADDRESS) {
        return PPMC104_BAD_ARGUMENT;
    }
    if (result == PPMC104_OK) {
        result = exchange(dev, 'w', address, (uint8_t)address, &reply);
        if (result == PPMC104_OK && reply != address) {
            result = PPMC104_BAD_REPLY;
        }
        dev->address = result == PPMC104_OK ? (uint8_t)address : dev->address;
        dev->doubtful = result != PPMC104_OK;
    }
    return result;
}

/* Send an instruction that begins a write to the EEPROM, and wait for its end. */
static ppmc104_result_t write_eeprom(pmc006_t *dev, char code)
{
    unsigned long polls = 0;
    int32_t reply = 0;
    ppmc104_result_t result = pmc006_ask(dev, code, 0, &reply);

    if (result == PPMC104_OK && reply != 1) {
        return PMC006_ERR_EEPROM;
    }
    while (result == PPMC104_OK) {
        result = ask_again(dev, 'V', 0, &reply);
        if (result == PPMC104_OK && reply != EEPROM_BUSY) {
            return reply == 0 ? PPMC104_OK : PMC006_ERR_EEPROM;
        }
        if (ppmc104_over(&dev->core, ++polls)) {
            return PPMC104_TIMEOUT;
        }
    }
    return result;
}

ppmc104_result_t pmc006_save(pmc006_t *dev)
{
    return write_eeprom(dev, 't');
}

/* ---- status and position ---- */

ppmc104_result_t pmc006_status(pmc006_t *dev, pmc006_status_t *status)
{
    int32_t one = 0, two = 0;
    ppmc104_result_t result = ask_again(dev, 'j', 0, &one);

    if (result == PPMC104_OK) {
        result = ask_again(dev, 'O', 0, &two);
    }
    if (result == PPMC104_OK && (one < 0 || one > 0x1F || two < 0 || two > 0x3F)) {
        dev->doubtful = true;
        return PPMC104_BAD_REPLY;
    }
    status->busy = (one & 1) != 0;
    status->ext1 = (one & 2) != 0;
    status->ext2 = (one & 4) != 0;
    status->reduce = (one & 8) != 0;
    status->stall = (one & 16) != 0;
    status->released = (two & 1) != 0;
    status->ext_on = (uint8_t)(two >> 1 & 3);
    status->speed_mode = (two & 8) != 0;
    status->forward = (two & 16) != 0;
    status->autostart = (two & 32) != 0;
    if (result == PPMC104_OK && status->ext_on != dev->ext) {
        dev->known = dev->known && dev->ext == 0u; /* a reset clears EXT_ON, a program can set it */
        dev->ext = status->ext_on;
    }
    return result;
}

ppmc104_result_t pmc006_clear_stops(pmc006_t *dev)
{
    static const char codes[3] = {'b', 'l', 'p'};
    int32_t reply = 0;
    unsigned n;
    ppmc104_result_t result = PPMC104_OK;

    for (n = 0; n < 3u && result == PPMC104_OK; ++n) {
        result = ask_again(dev, codes[n], 0, &reply);
    }
    return result;
}

static ppmc104_result_t count_of(pmc006_t *dev, uint32_t *count)
{
    int32_t position = 0;
    ppmc104_result_t result = ask_again(dev, 'c', 0, &position);

    *count = (uint32_t)position;
    return result;
}

/* Compare the values that a reset changes with the stored values. */
static ppmc104_result_t look_for_reset(pmc006_t *dev)
{
    pmc006_status_t status;
    int32_t speed = 0;
    ppmc104_result_t result = pmc006_status(dev, &status);

    if (result == PPMC104_OK) {
        result = pmc006_get(dev, PMC006_MAX_SPEED, &speed);
    }
    if (result == PPMC104_OK && speed != dev->speed) {
        dev->known = false;
        dev->speed = speed;
    }
    return result;
}

ppmc104_result_t pmc006_position(pmc006_t *dev, int32_t *position)
{
    uint32_t count = 0u;
    ppmc104_result_t result = count_of(dev, &count);

    if (result == PPMC104_OK) {
        result = look_for_reset(dev);
    }
    if (result == PPMC104_OK && !dev->known) {
        return PPMC104_POSITION_UNKNOWN;
    }
    if (result == PPMC104_OK) {
        *position = ppmc104_signed(count);
    }
    return result;
}

ppmc104_result_t pmc006_set_position(pmc006_t *dev, int32_t position)
{
    ppmc104_result_t result;

    if (dev->moving) {
        return PMC006_ERR_BUSY; /* the end of a motion could not be confirmed */
    }
    result = look_for_reset(dev);
    if (result == PPMC104_OK) {
        result = pmc006_set(dev, 'i', position);
    }
    dev->known = result == PPMC104_OK;
    return result;
}

ppmc104_result_t pmc006_outputs(pmc006_t *dev, uint8_t bits)
{
    const int32_t data = (int32_t)bits << 3;
    int32_t reply = 0;
    ppmc104_result_t result;

    if (bits > 31u) {
        return PPMC104_BAD_ARGUMENT;
    }
    result = ask_again(dev, 'y', data, &reply);
    return result == PPMC104_OK && reply != data ? PPMC104_BAD_REPLY : result;
}

/* ---- motions ---- */

/* Check the conditions of a start; set the direction; store the position. */
static ppmc104_result_t prepare(pmc006_t *dev, bool forward)
{
    pmc006_status_t status;
    ppmc104_result_t result = look_for_reset(dev);

    if (result == PPMC104_OK) {
        result = pmc006_status(dev, &status);
    }
    if (result == PPMC104_OK && status.busy) {
        return PMC006_ERR_BUSY;
    }
    if (result == PPMC104_OK && (status.ext1 || status.ext2 || status.released)) {
        return PMC006_ERR_REFUSED;
    }
    if (result == PPMC104_OK) {
        result = pmc006_set(dev, 'd', forward ? 1 : 0);
    }
    return result == PPMC104_OK ? count_of(dev, &dev->begin) : result;
}

/* A start is not repeated, because a lost reply does not indicate whether the motor moves. pmc006_wait()
 * determines this. */
static ppmc104_result_t begin(pmc006_t *dev, char code, int32_t data, bool endless, int32_t steps)
{
    int32_t reply = 0;
    ppmc104_result_t result = in_step(dev);

    if (result != PPMC104_OK) {
        return result;
    }
    result = pmc006_ask(dev, code, data, &reply);
    if (result == PPMC104_OK && reply == 0) {
        return PMC006_ERR_REFUSED;
    }
    dev->moving = true;
    dev->endless = endless;
    dev->steps = steps;
    dev->stop_ordered = false;
    return result == PPMC104_OK && reply != data && reply != STEP_ACK ? PPMC104_BAD_REPLY : result;
}

ppmc104_result_t pmc006_move(pmc006_t *dev, int32_t steps)
{
    ppmc104_result_t result;

    if (steps == 0 || steps == INT32_MIN) {
        return PPMC104_BAD_ARGUMENT;
    }
    result = prepare(dev, steps > 0);
    return result == PPMC104_OK ? begin(dev, 's', steps > 0 ? steps : -steps, false, steps) : result;
}

ppmc104_result_t pmc006_move_to(pmc006_t *dev, int32_t position)
{
    int32_t now = 0;
    int64_t way;
    ppmc104_result_t result = pmc006_position(dev, &now);

    if (result != PPMC104_OK) {
        return result;
    }
    way = (int64_t)position - now;
    if (way > PMC006_STEPS_MAX || way < -PMC006_STEPS_MAX) {
        return PPMC104_BAD_ARGUMENT;
    }
    return pmc006_move(dev, (int32_t)way);
}

ppmc104_result_t pmc006_run(pmc006_t *dev, bool forward, int32_t speed)
{
    ppmc104_result_t result;

    if (speed < 1 || speed > 16000) {
        return PPMC104_BAD_ARGUMENT;
    }
    result = prepare(dev, forward);
    if (result == PPMC104_OK) {
        result = pmc006_set(dev, PMC006_MAX_SPEED, speed);
    }
    return result == PPMC104_OK ? begin(dev, 'N', 1, true, 0) : result;
}

ppmc104_result_t pmc006_stop(pmc006_t *dev)
{
    int32_t reply = 0;
    ppmc104_result_t result;

    dev->stop_ordered = true;
    result = ask_again(dev, 'I', 0, &reply);
    return result == PPMC104_OK && reply != 0 ? PPMC104_BAD_REPLY : result;
}

ppmc104_result_t pmc006_stop_slowly(pmc006_t *dev)
{
    pmc006_status_t status;
    int32_t reply = 0;
    ppmc104_result_t result = pmc006_status(dev, &status);

    if (result == PPMC104_OK && !status.speed_mode) {
        return PMC006_ERR_REFUSED;
    }
    if (result == PPMC104_OK) {
        dev->stop_ordered = true;
        result = ask_again(dev, 'N', 0, &reply);
    }
    return result;
}

ppmc104_result_t pmc006_wait(pmc006_t *dev, pmc006_end_t *end)
{
    const bool was_known = dev->known;
    pmc006_status_t status;
    unsigned long polls = 0;
    uint32_t count = 0u;
    int32_t made;
    bool complete, part;
    ppmc104_result_t result;

    if (!dev->moving) {
        return PMC006_ERR_REFUSED;
    }
    for (;;) {
        result = pmc006_status(dev, &status);
        if (result != PPMC104_OK) {
            return result;
        }
        if (!status.busy) {
            break;
        }
        if (ppmc104_over(&dev->core, ++polls)) {
            return PPMC104_TIMEOUT;
        }
    }
    result = count_of(dev, &count);
    if (result == PPMC104_OK) {
        result = look_for_reset(dev);
    }
    if (result != PPMC104_OK) {
        return result;
    }
    made = ppmc104_signed(count - dev->begin);
    complete = !dev->endless && made == dev->steps;
    part = dev->endless || (dev->steps > 0 ? made >= 0 && made <= dev->steps : made <= 0 && made >= dev->steps);
    dev->moving = false;
    if ((was_known && !dev->known) ||
        !(complete || (part && (status.ext1 || status.ext2 || status.stall || dev->stop_ordered)))) {
        dev->known = false;
        return PPMC104_UNCONFIRMED;
    }
    if (end != NULL) {
        end->complete = complete;
        end->ext1 = status.ext1;
        end->ext2 = status.ext2;
        end->stall = status.stall;
        end->stopped = dev->stop_ordered;
        end->steps = made;
        end->position = ppmc104_signed(count);
    }
    return PPMC104_OK;
}

/* Make a motion and wait for its end. The result is PMC006_ERR_NO_SWITCH unless all steps were made. */
static ppmc104_result_t travel(pmc006_t *dev, int32_t steps)
{
    pmc006_end_t end = {false, false, false, false, false, 0, 0};
    ppmc104_result_t result = pmc006_move(dev, steps);

    if (result == PPMC104_OK) {
        result = pmc006_wait(dev, &end);
    }
    return result == PPMC104_OK && !end.complete ? PMC006_ERR_NO_SWITCH : result;
}

ppmc104_result_t pmc006_home(pmc006_t *dev, unsigned ext, bool forward, int32_t back)
{
    const int32_t bit = ext == 1u ? 1 : 2, away = forward ? -back : back;
    const int32_t far_away = forward ? INT32_MAX : -INT32_MAX;
    pmc006_end_t end = {false, false, false, false, false, 0, 0};
    int32_t ports = 0, edge = 0;
    ppmc104_result_t result;

    if (ext < 1u || ext > 2u || back < 1) {
        return PPMC104_BAD_ARGUMENT;
    }
    result = pmc006_clear_stops(dev);
    if (result == PPMC104_OK) result = pmc006_get(dev, PMC006_PORTS, &ports);
    if (result == PPMC104_OK) result = pmc006_get(dev, PMC006_EXT_EDGE, &edge);
    /* The stop acts on an edge. If the switch is already active, the motor first moves away from it. */
    if (result == PPMC104_OK && ((ports >> 10 & bit) != 0) == ((edge & bit) != 0)) {
        result = travel(dev, away);
    }
    if (result == PPMC104_OK) result = pmc006_set(dev, PMC006_EXT_ON, dev->ext | bit);
    if (result == PPMC104_OK) result = pmc006_move(dev, far_away);
    if (result == PPMC104_OK) result = pmc006_wait(dev, &end);
    if (result == PPMC104_OK && !(ext == 1u ? end.ext1 : end.ext2)) {
        return PMC006_ERR_NO_SWITCH;
    }
    if (result == PPMC104_OK) result = pmc006_clear_stops(dev);
    if (result == PPMC104_OK) result = travel(dev, away);
    return result == PPMC104_OK ? pmc006_set_position(dev, 0) : result;
}

/* ---- program ---- */

ppmc104_result_t pmc006_program(pmc006_t *dev, const uint32_t *words, unsigned count)
{
    int32_t reply = 0;
    unsigned n;
    ppmc104_result_t result;

    if (count < 1u || count > PMC006_WORDS_MAX) {
        return PPMC104_BAD_ARGUMENT;
    }
    result = pmc006_set(dev, 'A', 0);
    for (n = 0; n < count && result == PPMC104_OK; ++n) {
        result = pmc006_ask(dev, 'W', ppmc104_signed(words[n]), &reply);
    }
    if (result == PPMC104_OK) {
        result = pmc006_set(dev, 'A', 0);
    }
    for (n = 0; n < count && result == PPMC104_OK; ++n) {
        result = pmc006_ask(dev, 'G', 0, &reply);
        if (result == PPMC104_OK && (uint32_t)reply != words[n]) {
            return PMC006_ERR_REFUSED; /* a program is running, or the buffer is being saved */
        }
    }
    return result;
}

ppmc104_result_t pmc006_program_burn(pmc006_t *dev)
{
    return write_eeprom(dev, 'B');
}

ppmc104_result_t pmc006_program_run(pmc006_t *dev, unsigned instruction)
{
    int32_t reply = 0;
    ppmc104_result_t result;

    if (instruction > 99u) {
        return PPMC104_BAD_ARGUMENT;
    }
    result = pmc006_set(dev, 'A', (int32_t)(2u * instruction));
    if (result == PPMC104_OK) {
        result = pmc006_ask(dev, 'z', 0, &reply);
    }
    return result == PPMC104_OK && reply != 1 ? PMC006_ERR_REFUSED : result;
}

ppmc104_result_t pmc006_program_halt(pmc006_t *dev)
{
    return pmc006_set(dev, PMC006_AUTOSTART, 0);
}
