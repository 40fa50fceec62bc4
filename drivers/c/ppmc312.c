/* SPDX-License-Identifier: Apache-2.0 */
#include "ppmc312.h"

#include <stddef.h>

/* Registers, written by `make packages` from packages/registers/ppmc312.rdl. */
#define REG_CSR 0x0u /**< control and status */
/** write: WCR, 0x20 opens the write window; read: RCR, rewinds the read window, reads as 0x00 */
#define REG_CONTROL 0x2u
#define REG_ADDRESS 0x3u /**< write: WAR, write pointer; read: RAR, read pointer */
#define REG_WRITE 0x5u /**< DWR, a byte into the write window; reads as 0x00 */
#define REG_READ 0x7u /**< DRR, the next byte of the read window */
#define CSR_EWRQ 0x40u /**< `wrq_n` requests a faster host to wait */
#define CSR_EWIRQ 0x20u /**< interrupt while MWEF = 0 */
#define CSR_ERIRQ 0x10u /**< interrupt while MREF = 0 */
#define CSR_MWEF 0x08u /**< the write window is closed: an instruction is being processed */
#define CSR_MREF 0x04u /**< no answer or report is in the read window */
/* End of the registers. */
#define CSR_ZERO 0x83u
#define WINDOW 0x20u
#define POINTER_EMPTY 0x40u
#define BLOCK_MIN 3u
#define BLOCK_MAX 32u

/* Headers of blocks. */
#define LAST_DATA 0x01u
#define OPENING 0x02u
#define HOST 0x03u

/* Control codes of the line; bits 7..4 are the kind. */
#define LINE_POLL 0x80u
#define LINE_INSTRUCTION 0x90u
#define LINE_BUSY 0x80u
#define LINE_READY 0x90u
#define LINE_DATA 0xA0u
#define LINE_REPORT 0xB0u
#define LINE_SUM_WRONG 0x41u
#define LINE_END_CODE 0x40u
#define LINE_DATA_MAX 5u
#define LINE_SEND_MAX 16u
#define LINE_STATIONS 16u
#define LINE_NOISE_MAX 64u
#define LINE_BYTE_MS 50u
#define LINE_REPLY_MS 300u
#define ATTEMPTS 5u

#define CODE_TABLE 0x00u
#define CODE_CURVE 0x01u
#define CODE_VERSION 0x40u
#define CODE_POSITION 0x42u
#define CODE_SET_POSITION 0x43u
#define CODE_EVENT 0x49u
#define CODE_STATUS 0x4Du
#define CODE_STOP 0x80u
#define CODE_CHANGE 0x87u
#define CODE_RESET 0xFFu
#define CODE_LAST_ERROR 0x4Eu
#define CODE_ERROR_COUNTS 0x4Fu
#define ANSWER_REGISTERED 0xE8u
#define ANSWER_REJECTED 0xF0u

#define OVERRIDE 0x04u
#define RATE_MIN_START 0x11u
#define RATE_MAX_HIGH 0xFFEFu
#define RATE_SPAN 128u
#define PULSES_24_BIT 0xFFFFFFul
#define STAGES_MIN 2u
#define STAGES_MAX 127u
#define EVENT_BYTES 9u
#define EVENT_BYTES_LINE 7u
#define COLLECT_MAX 256u
#define GAP_READS 4u /* reads of CSR between two blocks: MREF is 1 there for at least 8 cycles */
#define LOOK_POLLS 256u /* polls of CSR between two reads of the status in a wait */

/* Causes of the END codes 31 .. 39 of the line. */
static const uint8_t CAUSES[9] = {0x80u, 0x20u, 0x01u, 0x02u, 0u, 0x08u, 0x04u, 0x40u, 0x10u};

typedef struct {
    uint8_t header, code, count; /* count: number of data bytes after the code */
    uint8_t data[BLOCK_MAX];
} block_t;

/* ---- helpers ---- */

static unsigned put16(uint8_t *bytes, uint32_t value)
{
    bytes[0] = (uint8_t)(value >> 8 & 0xFFu);
    bytes[1] = (uint8_t)(value & 0xFFu);
    return 2u;
}

static unsigned put24(uint8_t *bytes, uint32_t value)
{
    bytes[0] = (uint8_t)(value >> 16 & 0xFFu);
    return 1u + put16(bytes + 1, value);
}

static unsigned put32(uint8_t *bytes, uint32_t value)
{
    bytes[0] = (uint8_t)(value >> 24 & 0xFFu);
    return 1u + put24(bytes + 1, value);
}

static uint32_t get32(const uint8_t *bytes)
{
    return (uint32_t)bytes[0] << 24 | (uint32_t)bytes[1] << 16 | (uint32_t)bytes[2] << 8 | bytes[3];
}

static void clear(ppmc312_t *dev)
{
    dev->table = dev->armed = dev->busy = dev->moving = dev->ended = dev->lost = false;
    dev->known[0] = dev->known[1] = false;
    dev->rate_min = dev->rate_max = 0u;
    dev->first = dev->stored = 0u;
    dev->detail[0] = dev->detail[1] = 0u;
}

void ppmc312_setup(ppmc312_t *dev, uint8_t (*read)(void *ctx, unsigned reg),
                   void (*write)(void *ctx, unsigned reg, uint8_t value), void *ctx)
{
    ppmc104_setup(&dev->bus, read, write, ctx);
    dev->bus.zero = CSR_ZERO;
    dev->bus.status_reg = REG_CSR;
    dev->line = NULL;
    dev->station = 0u;
    dev->sum_chars = false;
    dev->reply_ms = LINE_REPLY_MS;
    dev->op = PPMC312_MOVE;
    dev->flags = dev->cause = 0u;
    dev->pulses = dev->begin = dev->stopped_at = 0u;
    clear(dev);
}

ppmc104_result_t ppmc312_setup_line(ppmc312_t *dev, const ppmc_line_t *line, unsigned station)
{
    if (station >= LINE_STATIONS) {
        return PPMC104_BAD_ARGUMENT;
    }
    ppmc312_setup(dev, NULL, NULL, NULL);
    dev->bus.ctx = line->ctx;
    dev->line = line;
    dev->station = (uint8_t)station;
    return PPMC104_OK;
}

/* ---- reports ---- */

static void keep(ppmc312_t *dev, uint8_t source, uint8_t code, const uint8_t *data, unsigned count)
{
    ppmc312_report_t *report;
    unsigned n;

    if (code == PPMC312_REPORT_STOPPED && source == PPMC312_FROM_PART && dev->moving && !dev->ended) {
        dev->ended = true;
        dev->cause = data[0];
        dev->stopped_at = count >= 5u ? get32(data + 1) : 0u;
        return; /* ppmc312_wait() returns this report */
    }
    if (dev->stored == PPMC312_REPORTS_MAX) {
        dev->lost = true;
        dev->first = (uint8_t)((dev->first + 1u) % PPMC312_REPORTS_MAX);
        --dev->stored;
    }
    report = &dev->reports[(dev->first + dev->stored) % PPMC312_REPORTS_MAX];
    ++dev->stored;
    report->source = source;
    report->code = code;
    report->count = (uint8_t)(count < sizeof report->data ? count : sizeof report->data);
    for (n = 0; n < report->count; ++n) {
        report->data[n] = data[n];
    }
}

/* ---- blocks on the bus ---- */

/* Read the pending block. An invalid pointer, length or header indicates damage on the bus. */
static ppmc104_result_t read_block(ppmc312_t *dev, block_t *block)
{
    uint8_t raw[BLOCK_MAX];
    unsigned count = POINTER_EMPTY - dev->bus.read(dev->bus.ctx, REG_ADDRESS), n;

    if (count < BLOCK_MIN || count > BLOCK_MAX) {
        (void)dev->bus.read(dev->bus.ctx, REG_CONTROL); /* partly read by another program: begin again */
        count = POINTER_EMPTY - dev->bus.read(dev->bus.ctx, REG_ADDRESS);
        if (count < BLOCK_MIN || count > BLOCK_MAX) {
            return PPMC104_BAD_REPLY;
        }
    }
    for (n = count; n-- > 0u;) {
        raw[n] = dev->bus.read(dev->bus.ctx, REG_READ);
    }
    if (raw[1] != count - 2u) {
        return PPMC104_BAD_REPLY;
    }
    block->header = raw[0];
    block->code = raw[2];
    block->count = (uint8_t)(count - BLOCK_MIN);
    for (n = 0; n < block->count; ++n) {
        block->data[n] = raw[n + BLOCK_MIN];
    }
    return PPMC104_OK;
}

/* Store a block that is not an answer to the host. If the block is damaged, return an error. */
static ppmc104_result_t sort(ppmc312_t *dev, const block_t *block)
{
    const bool stopped = block->code == PPMC312_REPORT_STOPPED;

    if (block->header == PPMC312_FROM_PART && (!stopped || block->count == 5u)) {
        keep(dev, block->header, block->code, block->data, block->count);
        return PPMC104_OK;
    }
    if (block->header == PPMC312_FROM_EVENT || block->header == PPMC312_FROM_OVERRIDE) {
        keep(dev, block->header, block->code, block->data, block->count);
        return PPMC104_OK;
    }
    return PPMC104_BAD_REPLY;
}

/* Read all pending blocks. Discard an answer whose call has ended. */
static ppmc104_result_t collect_bus(ppmc312_t *dev)
{
    block_t block;
    unsigned n, empty = 0u;

    for (n = 0; n < COLLECT_MAX; ++n) {
        const uint8_t csr = dev->bus.read(dev->bus.ctx, REG_CSR);
        ppmc104_result_t result;
        if ((csr & CSR_ZERO) != 0u) {
            return PPMC104_NO_PART;
        }
        if ((csr & CSR_MREF) != 0u) {
            if (++empty > GAP_READS) {
                return PPMC104_OK;
            }
            continue;
        }
        empty = 0u;
        result = read_block(dev, &block);
        if (result == PPMC104_OK && block.header > HOST) {
            result = sort(dev, &block);
        }
        if (result != PPMC104_OK) {
            return result;
        }
    }
    return PPMC104_BAD_REPLY;
}

static ppmc104_result_t exchange_bus(ppmc312_t *dev, uint8_t header, const uint8_t *body, unsigned count,
                                     block_t *answer)
{
    uint8_t csr;
    unsigned n;
    ppmc104_result_t result = collect_bus(dev);

    if (result == PPMC104_OK) {
        result = ppmc104_poll(&dev->bus, CSR_MWEF, 0u, 0u, &csr);
    }
    if (result != PPMC104_OK) {
        return result;
    }
    dev->bus.write(dev->bus.ctx, REG_CONTROL, WINDOW);
    dev->bus.write(dev->bus.ctx, REG_ADDRESS, (uint8_t)(WINDOW - 2u - count));
    for (n = count; n-- > 0u;) {
        dev->bus.write(dev->bus.ctx, REG_WRITE, body[n]);
    }
    dev->bus.write(dev->bus.ctx, REG_WRITE, (uint8_t)count);
    dev->bus.write(dev->bus.ctx, REG_WRITE, header);
    for (n = 0; n < 2u * BLOCK_MAX; ++n) {
        result = ppmc104_poll(&dev->bus, CSR_MREF, 0u, 0u, &csr);
        if (result == PPMC104_OK) {
            result = read_block(dev, answer);
        }
        if (result != PPMC104_OK || answer->header <= HOST) {
            return result;
        }
        result = sort(dev, answer);
        if (result != PPMC104_OK) {
            return result;
        }
    }
    return PPMC104_BAD_REPLY;
}

/* ---- frames on the line ---- */

static uint8_t digit(unsigned value)
{
    return (uint8_t)(value < 10u ? '0' + value : 'a' + value - 10u);
}

/* Return the value of a hexadecimal digit, or 16 for any other character. On this line, capital letters
 * are an error. */
static unsigned digit_value(uint8_t character)
{
    if (character >= '0' && character <= '9') {
        return (unsigned)character - '0';
    }
    return character >= 'a' && character <= 'f' ? (unsigned)character - 'a' + 10u : 16u;
}

static uint8_t checksum(const ppmc312_t *dev, uint8_t control, const uint8_t *data, unsigned count)
{
    unsigned sum = dev->sum_chars ? 0u : control, n;

    for (n = 0; n < count; ++n) {
        sum += dev->sum_chars ? digit(data[n] >> 4) + (unsigned)digit(data[n] & 0x0Fu) : data[n];
    }
    return (uint8_t)(~sum & 0x7Fu);
}

static ppmc104_result_t send_frame(const ppmc312_t *dev, uint8_t control, const uint8_t *data, unsigned count)
{
    uint8_t frame[2u * LINE_SEND_MAX + 2u], byte;
    unsigned size = 0u, n;

    ppmc_line_drain(dev->line, 0u);
    frame[size++] = control;
    for (n = 0; n < count; ++n) {
        frame[size++] = digit(data[n] >> 4);
        frame[size++] = digit(data[n] & 0x0Fu);
    }
    frame[size++] = checksum(dev, control, data, count);
    dev->line->send(dev->line->ctx, frame, size);
    for (n = 0; dev->line->echo && n < size; ++n) {
        if (!dev->line->receive(dev->line->ctx, &byte, LINE_BYTE_MS) || byte != frame[n]) {
            return PPMC104_BAD_REPLY;
        }
    }
    return PPMC104_OK;
}

/* Return the number of data bytes of a reply, as far as its kind and first byte determine it. */
static unsigned reply_size(uint8_t kind, unsigned gives, const uint8_t *data, unsigned count)
{
    if (kind == LINE_DATA) {
        return gives;
    }
    return kind != LINE_REPORT ? 0u : count > 0u && data[0] == 0x2Au ? 3u : 1u;
}

static ppmc104_result_t parse_frame(const ppmc312_t *dev, unsigned gives, uint8_t *kind, uint8_t *data)
{
    const ppmc_line_t *line = dev->line;
    uint8_t control = 0u, character;
    unsigned digits = 0u, n;

    *kind = 0u;
    for (n = 0; n < LINE_NOISE_MAX; ++n) {
        if (!line->receive(line->ctx, &character, n == 0u ? dev->reply_ms : LINE_BYTE_MS)) {
            return n == 0u ? PPMC104_TIMEOUT : PPMC104_BAD_REPLY;
        }
        if ((character & 0x80u) != 0u) { /* a control code always begins a frame */
            control = character;
            *kind = control & 0xF0u;
            digits = 0u;
            if ((control & 0x40u) != 0u || (control & 0x0Fu) != dev->station) {
                return PPMC104_BAD_REPLY;
            }
        } else if (*kind == 0u) {
            return PPMC104_BAD_REPLY;
        } else if (digits < 2u * reply_size(*kind, gives, data, digits / 2u)) {
            const unsigned value = digit_value(character);
            if (value > 15u) {
                return PPMC104_BAD_REPLY;
            }
            data[digits / 2u] = (uint8_t)(digits % 2u == 0u ? value << 4 : data[digits / 2u] | value);
            ++digits;
        } else {
            return character == checksum(dev, control, data, digits / 2u) ? PPMC104_OK : PPMC104_BAD_REPLY;
        }
    }
    return PPMC104_BAD_REPLY;
}

/* After a damaged reply, the station may still be sending. */
static ppmc104_result_t receive_frame(const ppmc312_t *dev, unsigned gives, uint8_t *kind, uint8_t *data)
{
    ppmc104_result_t result = parse_frame(dev, gives, kind, data);

    if (result == PPMC104_BAD_REPLY) {
        ppmc_line_drain(dev->line, LINE_BYTE_MS);
    }
    return result;
}

/* Convert code and data of an instruction of the bus for the line. Return 0 if the line does not have the
 * instruction. */
static unsigned to_line(const uint8_t *body, unsigned count, uint8_t *out)
{
    static const uint8_t motions[5] = {0x83u, 0x84u, 0x82u, 0x86u, 0x85u}; /* instructions 82 .. 86 */
    const uint8_t code = body[0];
    const unsigned flags = count > 1u ? body[1] : 0u;
    unsigned skip = 2u, n;

    if (code == PPMC312_SEARCH || code == PPMC312_RETURN) {
        out[0] = (uint8_t)(0x77u + code + ((flags & PPMC312_CCW) >> 1) + (flags & PPMC312_INDEX));
    } else if (code >= PPMC312_MOVE && code <= PPMC312_RUN_CONSTANT) {
        if ((flags & OVERRIDE) != 0u) {
            return 0u;
        }
        out[0] = (uint8_t)(motions[code - PPMC312_MOVE] | (flags & PPMC312_CCW) >> 1);
    } else if (code == CODE_STOP || code == CODE_STOP + 1u || code == CODE_CHANGE || code == CODE_CHANGE + 1u) {
        out[0] = (uint8_t)(code < CODE_CHANGE ? code : code + 2u);
        if ((flags & OVERRIDE) != 0u) {
            out[0] = (uint8_t)(out[0] + ((flags & 1u) == 0u ? 0x10u : 0x20u + ((flags & 2u) << 3)));
        }
    } else if (code == CODE_POSITION || code == CODE_SET_POSITION) {
        out[0] = (uint8_t)(code | (flags & 1u) << 5);
    } else if (code == CODE_EVENT) {
        out[0] = (uint8_t)(code | (flags & 1u) << 4 | (flags & 2u) << 4);
        if ((flags & 2u) == 0u && count > 2u + EVENT_BYTES_LINE + 3u) {
            return 0u;
        }
    } else if (code == CODE_CURVE || code == 0x41u || code == 0x47u ||
               (code == CODE_TABLE && (flags & 0x10u) != 0u)) {
        return 0u;
    } else {
        out[0] = code == CODE_VERSION ? 0x41u : code;
        skip = code == 0x28u ? 2u : 1u;
    }
    for (n = skip; n < count; ++n) {
        out[1u + n - skip] = body[n];
    }
    n = count > skip ? 1u + count - skip : 1u;
    if (code == CODE_EVENT && (flags & 2u) == 0u) {
        while (n < 11u) {
            out[n++] = 0u;
        }
    }
    return n;
}

static unsigned line_gives(uint8_t code)
{
    switch (code) {
    case 0x25u: case LINE_END_CODE: case 0x41u: case CODE_LAST_ERROR: return 1u;
    case 0x27u: return 2u;
    case CODE_STATUS: case CODE_ERROR_COUNTS: return 3u;
    case 0x42u: case 0x62u: return 4u;
    default: return 0u;
    }
}

/* Send an instruction on the line. After a rejected checksum it is repeated, because it was not executed.
 * After other errors it is repeated if it only reads. Positions and states are read twice, because the
 * checksum does not cover bit 7 of a byte. */
static ppmc104_result_t talk(ppmc312_t *dev, const uint8_t *body, unsigned count, uint8_t *data, uint8_t *error)
{
    const unsigned gives = line_gives(body[0]);
    const bool twice = body[0] == 0x42u || body[0] == 0x62u || body[0] == CODE_STATUS;
    const bool clears = body[0] == CODE_LAST_ERROR || body[0] == CODE_ERROR_COUNTS;
    const uint8_t control = (uint8_t)(LINE_INSTRUCTION | dev->station);
    uint8_t last[LINE_DATA_MAX] = {0u, 0u, 0u, 0u, 0u}, kind = 0u;
    unsigned attempt, n;
    bool have = false;
    ppmc104_result_t result = PPMC104_BAD_REPLY;

    *error = 0u;
    for (attempt = 0; attempt < ATTEMPTS; ++attempt) {
        result = send_frame(dev, control, body, count);
        if (result == PPMC104_OK) {
            result = receive_frame(dev, gives, &kind, data);
        }
        if (result == PPMC104_OK && kind == LINE_REPORT && data[0] == LINE_SUM_WRONG) {
            result = PPMC104_BAD_REPLY;
            continue;
        }
        if (result == PPMC104_OK && kind == LINE_REPORT && data[0] >= 0x42u && data[0] <= 0x49u) {
            *error = data[0];
            return PPMC104_OK;
        }
        if (result == PPMC104_OK && kind != (gives != 0u ? LINE_DATA : LINE_READY)) {
            result = PPMC104_BAD_REPLY;
        }
        if (result == PPMC104_OK && !twice) {
            return result;
        }
        if (result == PPMC104_OK) {
            /* During a motion, two positions are never equal. Therefore the last attempt compares only the
             * upper bytes. */
            const unsigned compared = body[0] != CODE_STATUS && attempt + 1u == ATTEMPTS ? gives - 2u : gives;
            bool same = have;
            for (n = 0; n < gives; ++n) {
                same = same && (last[n] == data[n] || n >= compared);
                last[n] = data[n];
            }
            if (same) {
                return result;
            }
            have = true;
            result = PPMC104_BAD_REPLY;
        } else if (gives == 0u || clears) {
            return result; /* the instruction may have been executed */
        }
    }
    return result;
}

static ppmc104_result_t poll_line(ppmc312_t *dev, bool *news)
{
    static const struct {
        uint8_t said, source, code, value, count;
    } reports[] = {
        {0x46u, PPMC312_FROM_PART, PPMC312_REPORT_ALARM, 0u, 1u},
        {0x4Au, PPMC312_FROM_EVENT, PPMC312_REPORT_EVENT_FAILED, 0u, 0u},
        {0x4Bu, PPMC312_FROM_OVERRIDE, PPMC312_REPORT_OVERRIDE_FAILED, 0u, 0u},
        {0x28u, PPMC312_FROM_OVERRIDE, PPMC312_REPORT_EXECUTED, 0u, 0u},
        {0x29u, PPMC312_FROM_EVENT, PPMC312_REPORT_EXECUTED, 0u, 0u},
        {0x22u, PPMC312_FROM_PART, PPMC312_REPORT_INTERLOCK, 0u, 0u},
        {0x23u, PPMC312_FROM_PART, PPMC312_REPORT_RUN, 0u, 0u},
        {0x26u, PPMC312_FROM_PART, PPMC312_REPORT_IN_POSITION, 0u, 1u},
        {0x27u, PPMC312_FROM_PART, PPMC312_REPORT_IN_POSITION, 1u, 1u},
        {0x24u, PPMC312_FROM_PART, PPMC312_REPORT_ENCODER, 0u, 1u},
        {0x25u, PPMC312_FROM_PART, PPMC312_REPORT_ENCODER, 1u, 1u},
    };
    uint8_t data[LINE_DATA_MAX] = {0u, 0u, 0u, 0u, 0u}, kind = 0u;
    unsigned n;
    ppmc104_result_t result = send_frame(dev, (uint8_t)(LINE_POLL | dev->station), NULL, 0u);

    *news = false;
    if (result == PPMC104_OK) {
        result = receive_frame(dev, 1u, &kind, data);
    }
    dev->busy = result != PPMC104_OK || kind == LINE_BUSY;
    if (result != PPMC104_OK || kind == LINE_BUSY || kind == LINE_READY) {
        return result;
    }
    *news = true;
    if (kind == LINE_DATA && data[0] >= 0x31u && data[0] <= 0x39u && CAUSES[data[0] - 0x31u] != 0u) {
        data[0] = CAUSES[data[0] - 0x31u];
        keep(dev, PPMC312_FROM_PART, PPMC312_REPORT_STOPPED, data, 1u);
        return PPMC104_OK;
    }
    if (kind == LINE_REPORT && data[0] == 0x2Au) {
        keep(dev, PPMC312_FROM_PART, PPMC312_REPORT_INPUTS, data + 1, 2u);
        return PPMC104_OK;
    }
    for (n = 0; kind == LINE_REPORT && n < sizeof reports / sizeof reports[0]; ++n) {
        if (reports[n].said == data[0]) {
            keep(dev, reports[n].source, reports[n].code, &reports[n].value, reports[n].count);
            return PPMC104_OK;
        }
    }
    return PPMC104_BAD_REPLY;
}

static ppmc104_result_t exchange_line(ppmc312_t *dev, const uint8_t *body, unsigned count, block_t *answer)
{
    static const uint8_t codes[8] = {0xF0u, 0xF1u, 0xF2u, 0xF5u, 0xF5u, 0xF5u, 0xF6u, 0xF7u}; /* of 42 .. 49 */
    uint8_t out[BLOCK_MAX], error = 0u;
    unsigned sent = to_line(body, count, out), n, first = 0u;
    ppmc104_result_t result;

    if (sent == 0u || sent > LINE_SEND_MAX) {
        return PPMC312_ERR_BUS_ONLY;
    }
    for (n = 0; n < LINE_DATA_MAX + 1u; ++n) {
        answer->data[n] = 0u;
    }
    if (body[0] == CODE_POSITION) {
        first = 1u; /* the answer on the bus begins with the number of the counter */
        answer->data[0] = body[1];
    }
    if (body[0] == CODE_RESET) {
        result = send_frame(dev, (uint8_t)(LINE_INSTRUCTION | dev->station), out, sent);
    } else {
        result = talk(dev, out, sent, answer->data + first, &error);
    }
    answer->header = HOST;
    answer->code = error == 0u ? body[0] : codes[error - 0x42u];
    answer->count = (uint8_t)(error == 0u ? first + line_gives(out[0]) : 0u);
    return result;
}

/* ---- instructions ---- */

static ppmc104_result_t collect(ppmc312_t *dev)
{
    unsigned n;
    bool news = true;
    ppmc104_result_t result = PPMC104_OK;

    dev->busy = true;
    if (dev->line == NULL) {
        return collect_bus(dev);
    }
    for (n = 0; n < 2u * BLOCK_MAX && news && result == PPMC104_OK; ++n) {
        result = poll_line(dev, &news);
    }
    return news && result == PPMC104_OK ? PPMC104_BAD_REPLY : result;
}

/* `body` is code and parameters. A rejection becomes a result. An answer with another code is damaged. */
static ppmc104_result_t instruct(ppmc312_t *dev, uint8_t header, const uint8_t *body, unsigned count, uint8_t code,
                                 block_t *answer)
{
    static const ppmc104_result_t rejections[8] = {
        PPMC312_ERR_PARAMETER, PPMC312_ERR_STATE, PPMC312_ERR_LIMIT, PPMC104_BAD_REPLY,
        PPMC312_ERR_ALARM,     PPMC312_ERR_UNKNOWN, PPMC312_ERR_SIZE, PPMC312_ERR_FULL,
    };
    ppmc104_result_t result = dev->line == NULL ? exchange_bus(dev, header, body, count, answer)
                                                : exchange_line(dev, body, count, answer);

    if (result != PPMC104_OK || answer->code == code) {
        return result;
    }
    if (answer->code == ANSWER_REGISTERED) {
        return PPMC104_OK;
    }
    if (answer->code >= ANSWER_REJECTED && answer->code < ANSWER_REJECTED + 8u) {
        dev->detail[0] = answer->count > 0u ? answer->data[0] : 0u;
        dev->detail[1] = answer->count > 1u ? answer->data[1] : 0u;
        return rejections[answer->code - ANSWER_REJECTED];
    }
    return PPMC104_BAD_REPLY;
}

ppmc104_result_t ppmc312_ask(ppmc312_t *dev, uint8_t code, const uint8_t *data, unsigned count, uint8_t *answer,
                             unsigned *got)
{
    uint8_t body[BLOCK_MAX];
    block_t block;
    unsigned n;
    ppmc104_result_t result;

    if (count > 29u) {
        return PPMC104_BAD_ARGUMENT;
    }
    body[0] = code;
    for (n = 0; n < count; ++n) {
        body[n + 1u] = data[n];
    }
    result = instruct(dev, HOST, body, count + 1u, code, &block);
    for (n = 0; result == PPMC104_OK && answer != NULL && n < block.count && n < PPMC312_DATA_MAX; ++n) {
        answer[n] = block.data[n];
    }
    if (got != NULL) {
        *got = result == PPMC104_OK ? block.count : 0u;
    }
    return result;
}

/* Send an instruction whose answer must have exactly `want` bytes. */
static ppmc104_result_t ask_exactly(ppmc312_t *dev, uint8_t code, const uint8_t *data, unsigned count, uint8_t *answer,
                                    unsigned want)
{
    unsigned got = 0u;
    uint8_t all[PPMC312_DATA_MAX] = {0u};
    ppmc104_result_t result = ppmc312_ask(dev, code, data, count, all, &got);
    unsigned n;

    if (result == PPMC104_OK && got != want) {
        return PPMC104_BAD_REPLY;
    }
    for (n = 0; n < want; ++n) {
        answer[n] = all[n];
    }
    return result;
}

ppmc104_result_t ppmc312_status(ppmc312_t *dev, ppmc312_status_t *status)
{
    uint8_t data[3] = {0u, 0u, 0u};
    ppmc104_result_t result = ask_exactly(dev, CODE_STATUS, NULL, 0u, data, 3u);
    const uint8_t state = data[1];

    status->operation = data[0];
    status->condition = state;
    status->buffers = data[2];
    if (result == PPMC104_OK && (state == 0u || (state & (state - 1u)) != 0u || state > PPMC312_STATE_WRN)) {
        return PPMC104_BAD_REPLY;
    }
    if (result == PPMC104_OK && state == PPMC312_STATE_INI && dev->table) {
        dev->table = false; /* the part was reset */
        dev->known[0] = dev->known[1] = false;
    }
    return result;
}

ppmc104_result_t ppmc312_open(ppmc312_t *dev, uint8_t *version)
{
    uint8_t byte = 0u, csr;
    ppmc104_result_t result = PPMC104_OK;

    clear(dev);
    if (dev->line == NULL) {
        /* After a reset with DATASHEET timing, the part does not accept blocks for 1.6 ms. */
        result = ppmc104_poll(&dev->bus, CSR_MWEF, 0u, 0u, &csr);
        (void)dev->bus.read(dev->bus.ctx, REG_CONTROL);
    }
    if (result == PPMC104_OK) {
        result = collect(dev);
    }
    if (result == PPMC104_OK) {
        result = ask_exactly(dev, CODE_VERSION, NULL, 0u, &byte, 1u);
    }
    if (result == PPMC104_OK && version != NULL) {
        *version = byte;
    }
    return result;
}

ppmc104_result_t ppmc312_reset(ppmc312_t *dev)
{
    ppmc104_result_t result = ppmc312_ask(dev, CODE_RESET, NULL, 0u, NULL, NULL);

    clear(dev);
    return result;
}

/* ---- tables ---- */

static ppmc104_result_t look(ppmc312_t *dev)
{
    ppmc312_status_t status;

    return ppmc312_status(dev, &status);
}

static void new_table(ppmc312_t *dev, ppmc104_result_t result, uint32_t fast, uint32_t slow)
{
    if (result == PPMC104_OK) {
        dev->table = true;
        dev->armed = false;
        dev->rate_min = (uint16_t)fast;
        dev->rate_max = (uint16_t)slow;
    } else if (result != PPMC312_ERR_STATE) {
        dev->table = false;
    }
}

ppmc104_result_t ppmc312_table(ppmc312_t *dev, const ppmc312_table_t *table)
{
    const bool separate = table->rate_stop != 0u;
    const uint32_t least = (uint32_t)table->rate_high + RATE_SPAN;
    const uint32_t slow = separate && table->rate_stop > table->rate_start ? table->rate_stop : table->rate_start;
    uint8_t data[13];
    unsigned n = 1u;
    ppmc104_result_t result;

    if (table->clock > PPMC312_PIN_FALLING || table->rate_high < 2u || table->rate_high > RATE_MAX_HIGH ||
        table->rate_start < RATE_MIN_START || table->rate_start < least || table->up < 1u ||
        table->up > PULSES_24_BIT ||
        (separate && (table->rate_stop < RATE_MIN_START || table->rate_stop < least || table->down < 1u ||
                      table->down > PULSES_24_BIT))) {
        return PPMC104_BAD_ARGUMENT;
    }
    if (separate && dev->line != NULL) {
        return PPMC312_ERR_BUS_ONLY;
    }
    data[0] = (uint8_t)((unsigned)table->clock | (table->sigmoid ? 0x08u : 0u) | (separate ? 0x10u : 0u));
    n += put16(data + n, table->rate_start);
    n += separate ? put16(data + n, table->rate_stop) : 0u;
    n += put16(data + n, table->rate_high);
    n += put24(data + n, table->up);
    n += separate ? put24(data + n, table->down) : 0u;
    result = look(dev);
    if (result == PPMC104_OK) {
        result = ppmc312_ask(dev, CODE_TABLE, data, n, NULL, NULL);
        new_table(dev, result, table->rate_high, slow);
    }
    return result;
}

static ppmc104_result_t curve_list(ppmc312_t *dev, const ppmc312_curve_t *curve, unsigned list, unsigned stages,
                                   bool last)
{
    ppmc104_result_t result = PPMC104_OK;
    unsigned k = 0u;

    while (k < stages && result == PPMC104_OK) {
        uint8_t body[BLOCK_MAX];
        block_t answer;
        unsigned count = 0u, n;
        for (n = 0; n < 10u && k < stages; ++n, ++k) {
            count += list == 0u ? put16(body + count, curve->rates[k])
                                : put24(body + count, list == 1u ? curve->up[k] : curve->down[k]);
        }
        result = instruct(dev, last && k == stages ? LAST_DATA : 0u, body, count, CODE_CURVE, &answer);
    }
    return result;
}

static bool curve_legal(const ppmc312_curve_t *curve)
{
    const unsigned up = curve->up_stages, down = curve->down_stages, longer = up > down ? up : down;
    unsigned n;

    if (curve->clock > PPMC312_PIN_FALLING || up < STAGES_MIN || up > STAGES_MAX ||
        (down != 0u && (down < STAGES_MIN || down > STAGES_MAX))) {
        return false;
    }
    for (n = 0; n < longer; ++n) {
        if (curve->rates[n] < 2u || (n < up && (curve->up[n] < 2u || curve->up[n] > PULSES_24_BIT)) ||
            (n < down && (curve->down[n] < 2u || curve->down[n] > PULSES_24_BIT))) {
            return false;
        }
    }
    return true;
}

ppmc104_result_t ppmc312_curve(ppmc312_t *dev, const ppmc312_curve_t *curve)
{
    const unsigned up = curve->up_stages, down = curve->down_stages, longer = up > down ? up : down;
    uint8_t body[4];
    block_t answer;
    uint32_t fast, slow;
    unsigned n;
    ppmc104_result_t result;

    if (!curve_legal(curve)) {
        return PPMC104_BAD_ARGUMENT;
    }
    if (dev->line != NULL) {
        return PPMC312_ERR_BUS_ONLY;
    }
    body[0] = CODE_CURVE;
    body[1] = (uint8_t)((unsigned)curve->clock | (down != 0u ? 0x10u : 0u));
    body[2] = (uint8_t)up;
    body[3] = (uint8_t)down;
    result = look(dev);
    if (result == PPMC104_OK) {
        result = instruct(dev, OPENING, body, down != 0u ? 4u : 3u, CODE_CURVE, &answer);
    }
    if (result == PPMC104_OK) result = curve_list(dev, curve, 0u, longer, false);
    if (result == PPMC104_OK) result = curve_list(dev, curve, 1u, up, down == 0u);
    if (result == PPMC104_OK) result = curve_list(dev, curve, 2u, down, true);
    fast = slow = curve->rates[0];
    for (n = 1; n < longer; ++n) {
        fast = curve->rates[n] < fast ? curve->rates[n] : fast;
        slow = curve->rates[n] > slow ? curve->rates[n] : slow;
    }
    new_table(dev, result, fast, slow);
    return result;
}

/* ---- motions ---- */

static bool rate_legal(const ppmc312_t *dev, uint16_t rate)
{
    return !dev->table || (rate >= dev->rate_min && rate <= dev->rate_max);
}

/* Encode a motion as code and parameters. Return 0 if the motion is not allowed. */
static unsigned encode(const ppmc312_t *dev, const ppmc312_motion_t *motion, uint8_t *body)
{
    const bool origin = motion->op == PPMC312_SEARCH || motion->op == PPMC312_RETURN;
    const bool counted = motion->op == PPMC312_MOVE || motion->op == PPMC312_CONSTANT;
    const unsigned allowed = PPMC312_CCW | (origin ? PPMC312_INDEX : 0u);
    const bool event = motion->when == PPMC312_ON_EVENT0 || motion->when == PPMC312_ON_EVENT1;
    unsigned n = 2u;

    if ((!origin && (motion->op < PPMC312_MOVE || motion->op > PPMC312_RUN_CONSTANT)) ||
        (motion->flags & ~allowed) != 0u || (counted && motion->pulses == 0u) ||
        (motion->when != PPMC312_NOW && (!event || origin || motion->op == PPMC312_STEP))) {
        return 0u;
    }
    if (motion->op != PPMC312_STEP &&
        (motion->rate == 0u ? motion->op == PPMC312_SEARCH : !rate_legal(dev, motion->rate))) {
        return 0u;
    }
    body[0] = (uint8_t)motion->op;
    body[1] = (uint8_t)(motion->flags | (unsigned)motion->when);
    n += motion->op != PPMC312_STEP ? put16(body + n, motion->rate) : 0u;
    n += counted ? put32(body + n, motion->pulses) : 0u;
    return n;
}

static ppmc104_result_t count_of(ppmc312_t *dev, bool encoder, uint32_t *count)
{
    const uint8_t which = encoder ? 1u : 0u;
    uint8_t data[5];
    ppmc104_result_t result = ask_exactly(dev, CODE_POSITION, &which, 1u, data, 5u);

    if (result == PPMC104_OK && data[0] != which) {
        return PPMC104_BAD_REPLY;
    }
    if (result == PPMC104_OK) {
        *count = get32(data + 1);
    }
    return result;
}

ppmc104_result_t ppmc312_start(ppmc312_t *dev, const ppmc312_motion_t *motion)
{
    uint8_t body[BLOCK_MAX];
    uint32_t begin = 0u;
    const unsigned count = encode(dev, motion, body);
    ppmc104_result_t result;

    if (count == 0u) {
        return PPMC104_BAD_ARGUMENT;
    }
    if (motion->when != PPMC312_NOW) {
        dev->armed = true;
        return ppmc312_ask(dev, body[0], body + 1, count - 1u, NULL, NULL);
    }
    result = count_of(dev, false, &begin);
    if (result != PPMC104_OK) {
        return result;
    }
    result = ppmc312_ask(dev, body[0], body + 1, count - 1u, NULL, NULL);
    if (result == PPMC104_OK || result == PPMC104_TIMEOUT || result == PPMC104_BAD_REPLY) {
        dev->moving = true;
        dev->ended = false;
        dev->op = motion->op;
        dev->flags = motion->flags;
        dev->begin = begin;
        dev->pulses = motion->op == PPMC312_STEP ? 1u : motion->pulses;
    }
    return result;
}

ppmc104_result_t ppmc312_move(ppmc312_t *dev, int32_t pulses)
{
    ppmc312_motion_t motion = {PPMC312_MOVE, PPMC312_CW, 0u, 0u, PPMC312_NOW};

    motion.pulses = (uint32_t)pulses;
    if (pulses < 0) {
        motion.flags = PPMC312_CCW;
        motion.pulses = ~motion.pulses + 1u;
    }
    return ppmc312_start(dev, &motion);
}

ppmc104_result_t ppmc312_move_to(ppmc312_t *dev, int32_t position)
{
    ppmc312_motion_t motion = {PPMC312_MOVE, PPMC312_CW, 0u, 0u, PPMC312_NOW};
    int32_t now = 0;
    ppmc104_result_t result = ppmc312_position(dev, false, &now);

    if (result != PPMC104_OK) {
        return result;
    }
    motion.flags = position < now ? PPMC312_CCW : PPMC312_CW;
    motion.pulses = position < now ? (uint32_t)now - (uint32_t)position : (uint32_t)position - (uint32_t)now;
    return ppmc312_start(dev, &motion);
}

static ppmc104_result_t triggered(ppmc312_t *dev, uint8_t code, const uint16_t *rate, ppmc312_when_t when,
                                  int32_t position)
{
    uint8_t data[8];
    unsigned n = 1u;

    if (when != PPMC312_NOW && when != PPMC312_AT_POSITION && when != PPMC312_ON_EVENT0 &&
        when != PPMC312_ON_EVENT1) {
        return PPMC104_BAD_ARGUMENT;
    }
    if (rate != NULL && (*rate == 0u || !rate_legal(dev, *rate))) {
        return PPMC104_BAD_ARGUMENT;
    }
    data[0] = (uint8_t)when;
    n += rate != NULL ? put16(data + n, *rate) : 0u;
    n += when == PPMC312_AT_POSITION ? put32(data + n, (uint32_t)position) : 0u;
    dev->armed = dev->armed || when != PPMC312_NOW;
    return ppmc312_ask(dev, code, data, n, NULL, NULL);
}

ppmc104_result_t ppmc312_stop(ppmc312_t *dev, bool slowly, ppmc312_when_t when, int32_t position)
{
    return triggered(dev, (uint8_t)(CODE_STOP + (slowly ? 1u : 0u)), NULL, when, position);
}

ppmc104_result_t ppmc312_change(ppmc312_t *dev, bool ramp, uint16_t rate, ppmc312_when_t when, int32_t position)
{
    return triggered(dev, (uint8_t)(CODE_CHANGE + (ramp ? 0u : 1u)), &rate, when, position);
}

/* Return whether the end of the motion agrees with the order. */
static bool agrees(const ppmc312_t *dev)
{
    const bool endless = dev->op != PPMC312_MOVE && dev->op != PPMC312_CONSTANT && dev->op != PPMC312_STEP;
    const uint32_t way = dev->stopped_at - dev->begin;
    const uint32_t made = (dev->flags & PPMC312_CCW) != 0u ? ~way + 1u : way;

    if (dev->cause == 0u || (dev->cause & (dev->cause - 1u)) != 0u) {
        return false;
    }
    if (endless) {
        return dev->cause != PPMC312_CAUSE_NORMAL;
    }
    return dev->cause == PPMC312_CAUSE_NORMAL ? made == dev->pulses : made <= dev->pulses;
}

/* The part is at standstill, but the report of the end is missing. On the line, a damaged frame may be the
 * cause. */
static ppmc104_result_t recover(ppmc312_t *dev)
{
    const uint8_t code = LINE_END_CODE;
    uint8_t data[LINE_DATA_MAX] = {0u}, error;

    if (dev->line == NULL || talk(dev, &code, 1u, data, &error) != PPMC104_OK || error != 0u || data[0] < 0x31u ||
        data[0] > 0x39u) {
        return PPMC104_UNCONFIRMED;
    }
    dev->ended = true;
    dev->cause = CAUSES[data[0] - 0x31u];
    return PPMC104_OK;
}

ppmc104_result_t ppmc312_wait(ppmc312_t *dev, ppmc312_end_t *end)
{
    unsigned long polls = 0;
    bool rests = false;
    ppmc104_result_t result;

    if (!dev->moving) {
        return PPMC312_ERR_STATE;
    }
    for (;;) {
        result = collect(dev);
        if (result == PPMC104_BAD_REPLY && dev->line != NULL) {
            result = PPMC104_OK; /* a damaged report: see recover() */
            dev->busy = false;
        }
        if (result != PPMC104_OK) {
            return result;
        }
        if (!dev->ended && rests) {
            result = recover(dev);
            if (result != PPMC104_OK) {
                break;
            }
        }
        if (dev->ended) {
            break;
        }
        if (dev->line != NULL ? !dev->busy : !dev->armed && polls % LOOK_POLLS == 0u) {
            ppmc312_status_t status;
            result = ppmc312_status(dev, &status);
            if (result != PPMC104_OK) {
                return result;
            }
            rests = (status.condition & (PPMC312_STATE_ACC | PPMC312_STATE_FIX | PPMC312_STATE_WRN)) == 0u;
        }
        if (!rests && ppmc104_over(&dev->bus, ++polls)) {
            return PPMC104_TIMEOUT;
        }
    }
    if (result == PPMC104_OK && dev->line != NULL) {
        result = count_of(dev, false, &dev->stopped_at);
        if (result != PPMC104_OK) {
            return result;
        }
    }
    dev->moving = false;
    if (result == PPMC104_OK && agrees(dev)) {
        if (end != NULL) {
            end->cause = dev->cause;
            end->complete = dev->cause == PPMC312_CAUSE_NORMAL || dev->cause == PPMC312_CAUSE_ORIGIN;
            end->position = ppmc104_signed(dev->stopped_at);
        }
        return PPMC104_OK;
    }
    dev->known[0] = dev->known[1] = false;
    return PPMC104_UNCONFIRMED;
}

ppmc104_result_t ppmc312_report(ppmc312_t *dev, ppmc312_report_t *report)
{
    ppmc104_result_t result = collect(dev);

    report->code = PPMC312_REPORT_NONE;
    report->count = 0u;
    if (result != PPMC104_OK) {
        return result;
    }
    if (dev->lost) {
        dev->lost = false;
        return PPMC104_REPORTS_LOST;
    }
    if (dev->stored != 0u) {
        *report = dev->reports[dev->first];
        dev->first = (uint8_t)((dev->first + 1u) % PPMC312_REPORTS_MAX);
        --dev->stored;
    }
    return PPMC104_OK;
}

/* ---- positions ---- */

ppmc104_result_t ppmc312_position(ppmc312_t *dev, bool encoder, int32_t *position)
{
    ppmc312_status_t status;
    uint32_t count = 0u;
    ppmc104_result_t result = count_of(dev, encoder, &count);

    /* The state is read after the counter, so that a reset between the two is detected. */
    if (result == PPMC104_OK) {
        result = ppmc312_status(dev, &status);
    }
    if (result == PPMC104_OK && (!dev->known[encoder] || status.condition == PPMC312_STATE_INI)) {
        return PPMC104_POSITION_UNKNOWN;
    }
    if (result == PPMC104_OK) {
        *position = ppmc104_signed(count);
    }
    return result;
}

ppmc104_result_t ppmc312_set_position(ppmc312_t *dev, bool encoder, int32_t position)
{
    uint8_t data[5];
    ppmc104_result_t result = look(dev);

    if (result == PPMC104_OK && !dev->table) {
        return PPMC312_ERR_STATE;
    }
    data[0] = encoder ? 1u : 0u;
    (void)put32(data + 1, (uint32_t)position);
    if (result == PPMC104_OK) {
        result = ppmc312_ask(dev, CODE_SET_POSITION, data, 5u, NULL, NULL);
    }
    dev->known[encoder] = result == PPMC104_OK;
    return result;
}

/* ---- event buffers ---- */

ppmc104_result_t ppmc312_event(ppmc312_t *dev, unsigned buffer, uint8_t code, const uint8_t *data, unsigned count)
{
    uint8_t all[4u + EVENT_BYTES], status = 0u;
    unsigned n;
    ppmc104_result_t result;

    if (buffer > 1u || count > EVENT_BYTES) {
        return PPMC104_BAD_ARGUMENT;
    }
    all[0] = (uint8_t)buffer;
    all[1] = HOST;
    all[2] = (uint8_t)(count + 1u);
    all[3] = code;
    for (n = 0; n < count; ++n) {
        all[4u + n] = data[n];
    }
    dev->armed = true;
    if (dev->line != NULL) {
        return ppmc312_ask(dev, CODE_EVENT, all, 4u + count, NULL, NULL);
    }
    result = ask_exactly(dev, CODE_EVENT, all, 4u + count, &status, 1u);
    dev->detail[0] = status;
    return result == PPMC104_OK && status != 0u ? PPMC312_ERR_FULL : result;
}

ppmc104_result_t ppmc312_event_motion(ppmc312_t *dev, unsigned buffer, const ppmc312_motion_t *motion)
{
    uint8_t body[BLOCK_MAX];
    const unsigned count = motion->when == PPMC312_NOW ? encode(dev, motion, body) : 0u;

    return count != 0u ? ppmc312_event(dev, buffer, body[0], body + 1, count - 1u) : PPMC104_BAD_ARGUMENT;
}

ppmc104_result_t ppmc312_event_delete(ppmc312_t *dev, unsigned buffer)
{
    const uint8_t data = (uint8_t)(buffer | 2u);
    uint8_t status = 0u;
    ppmc104_result_t result;

    if (buffer > 1u) {
        return PPMC104_BAD_ARGUMENT;
    }
    if (dev->line != NULL) {
        return ppmc312_ask(dev, CODE_EVENT, &data, 1u, NULL, NULL);
    }
    result = ask_exactly(dev, CODE_EVENT, &data, 1u, &status, 1u);
    return result == PPMC104_OK && status != 3u && status != 4u ? PPMC312_ERR_FULL : result;
}

/* ---- inputs, outputs, monitors ---- */

ppmc104_result_t ppmc312_driver(ppmc312_t *dev, ppmc312_driver_t what)
{
    const bool known = (what >= PPMC312_EXCITATION_ON && what <= PPMC312_ALARM_CLEAR) || what == PPMC312_INTERLOCK ||
                       what == PPMC312_RUN_MONITOR;

    return known ? ppmc312_ask(dev, (uint8_t)what, NULL, 0u, NULL, NULL) : PPMC104_BAD_ARGUMENT;
}

ppmc104_result_t ppmc312_inputs(ppmc312_t *dev, uint8_t *levels)
{
    return ask_exactly(dev, 0x25u, NULL, 0u, levels, 1u);
}

ppmc104_result_t ppmc312_control_inputs(ppmc312_t *dev, uint16_t *levels)
{
    uint8_t data[2];
    ppmc104_result_t result = ask_exactly(dev, 0x27u, NULL, 0u, data, 2u);

    if (result == PPMC104_OK) {
        *levels = (uint16_t)((unsigned)data[0] << 8 | data[1]);
    }
    return result;
}

ppmc104_result_t ppmc312_outputs(ppmc312_t *dev, uint8_t bits)
{
    return bits > 63u ? PPMC104_BAD_ARGUMENT : ppmc312_ask(dev, 0x26u, &bits, 1u, NULL, NULL);
}

ppmc104_result_t ppmc312_input_mask(ppmc312_t *dev, uint8_t mask)
{
    uint8_t data[2];

    data[0] = 1u;
    data[1] = mask;
    return ppmc312_ask(dev, 0x28u, data, 2u, NULL, NULL);
}

ppmc104_result_t ppmc312_speed_limit(ppmc312_t *dev, uint16_t rate)
{
    uint8_t data[2];

    (void)put16(data, rate);
    return rate < 2u ? PPMC104_BAD_ARGUMENT : ppmc312_ask(dev, 0x05u, data, 2u, NULL, NULL);
}

ppmc104_result_t ppmc312_end_monitor(ppmc312_t *dev, bool on)
{
    const uint8_t data = on ? 1u : 0u;

    return ppmc312_ask(dev, 0x06u, &data, 1u, NULL, NULL);
}

static ppmc104_result_t monitor(ppmc312_t *dev, uint8_t code, uint16_t range)
{
    uint8_t data[3];

    data[0] = range != 0u ? 3u : 0u;
    (void)put16(data + 1, range);
    return ppmc312_ask(dev, code, data, 3u, NULL, NULL);
}

ppmc104_result_t ppmc312_in_position(ppmc312_t *dev, uint16_t range)
{
    return monitor(dev, 0x02u, range);
}

ppmc104_result_t ppmc312_encoder(ppmc312_t *dev, uint16_t range)
{
    return monitor(dev, 0x03u, range);
}

ppmc104_result_t ppmc312_interlock_at(ppmc312_t *dev, int32_t position)
{
    uint8_t data[4];

    (void)put32(data, (uint32_t)position);
    return ppmc312_ask(dev, 0x04u, data, 4u, NULL, NULL);
}

ppmc104_result_t ppmc312_line_errors(ppmc312_t *dev, uint8_t *last, uint8_t counts[3])
{
    uint8_t code = CODE_LAST_ERROR, data[LINE_DATA_MAX] = {0u}, error = 0u;
    unsigned n;
    ppmc104_result_t result;

    if (dev->line == NULL) {
        return PPMC104_BAD_ARGUMENT;
    }
    result = talk(dev, &code, 1u, data, &error);
    *last = data[0];
    code = CODE_ERROR_COUNTS;
    if (result == PPMC104_OK && error == 0u) {
        result = talk(dev, &code, 1u, data, &error);
    }
    for (n = 0; n < 3u; ++n) {
        counts[n] = data[n];
    }
    return result == PPMC104_OK && error != 0u ? PPMC312_ERR_STATE : result;
}
