/* SPDX-License-Identifier: Apache-2.0 */
/* Sends damaged replies to the C drivers. Usage: fuzz SEED COUNT. The program is built with sanitizers.
 * A call that does not return, a value from a damaged frame, or an access out of bounds ends the program
 * with an error. Otherwise, the program prints how often each result occurred. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../../drivers/c/pmc006.h"
#include "../../drivers/c/ppmc2104.h"
#include "../../drivers/c/ppmc312.h"

#define STREAM_MAX 200u
#define READS_MAX 4000000ul /* reads per call */

static uint32_t state;
static unsigned long reads, results[128];

static uint32_t random_bits(void)
{
    state ^= state << 13;
    state ^= state >> 17;
    state ^= state << 5;
    return state;
}

static unsigned below(unsigned limit)
{
    return random_bits() % limit;
}

static void fail(const char *what)
{
    printf("FAIL %s\n", what);
    exit(1);
}

static void count(ppmc104_result_t result)
{
    if ((unsigned)result >= 128u || strcmp(ppmc104_strerror(result), "unknown result") == 0) fail("result");
    ++results[result];
    reads = 0;
}

/* ---- a line with arbitrary characters ---- */

static uint8_t stream[STREAM_MAX];
static unsigned length, at;
static bool talks; /* 1: each request gets a reply, 0: the line is silent */

static void put(uint8_t byte)
{
    if (length < STREAM_MAX) stream[length++] = byte;
}

/* Damage the reply. kind: 1 inverts a bit, 2 removes bytes at the end, 3 inserts a byte at the beginning,
 * 4 appends random bytes, 5 overwrites a byte, 6 removes the first byte. Other values change nothing. */
static void damage(unsigned kind)
{
    if (length == 0u) return;
    switch (kind) {
    case 1: stream[below(length)] ^= (uint8_t)(1u << below(8)); break;
    case 2: length = below(length); break;
    case 3: put(0u); memmove(stream + 1, stream, length - 1u); stream[0] = (uint8_t)random_bits(); break;
    case 4: while (length < STREAM_MAX) put((uint8_t)random_bits()); break;
    case 5: stream[below(length)] = (uint8_t)random_bits(); break;
    case 6: memmove(stream, stream + 1, --length); break;
    default: break;
    }
}

static void (*respond)(const uint8_t *bytes, unsigned count);

static void send(void *ctx, const uint8_t *bytes, unsigned count_)
{
    (void)ctx;
    length = at = 0u;
    if (talks) respond(bytes, count_);
}

static bool receive(void *ctx, uint8_t *byte, unsigned milliseconds)
{
    (void)ctx;
    if (++reads > READS_MAX) fail("endless");
    if (milliseconds == 0u || at == length) return false;
    *byte = stream[at++];
    return true;
}

/* ---- PMC006B4 ---- */

static unsigned kind_of_damage;

static void controller(const uint8_t *bytes, unsigned size)
{
    unsigned n, sum = 0u;
    const unsigned from = length;
    (void)size;
    put(0xA5);
    put(0x7A);
    put(below(8) == 0u ? (uint8_t)random_bits() : bytes[1]);
    for (n = 0; n < 4u; ++n) put(below(3) == 0u ? bytes[3u + n] : (uint8_t)(below(4) == 0u ? random_bits() : 0u));
    if (bytes[2] == 'A') memcpy(stream + from + 3, bytes + 3, 4);
    for (n = from; n < length; ++n) sum += stream[n];
    put((uint8_t)sum);
    damage(kind_of_damage);
}

static bool contains(uint32_t value)
{
    unsigned n, k;
    for (n = 0; n + 8u <= length; ++n) {
        unsigned sum = 0u;
        uint32_t got = 0u;
        for (k = 0; k < 7u; ++k) sum += stream[n + k];
        for (k = 0; k < 4u; ++k) got |= (uint32_t)stream[n + 3u + k] << (8u * k);
        if (stream[n] == 0xA5 && stream[n + 1u] == 0x7A && stream[n + 2u] == 9u && stream[n + 7u] == (sum & 0xFFu) &&
            got == value) {
            return true;
        }
    }
    return false;
}

static void fuzz_006(const ppmc_line_t *line)
{
    static const uint32_t words[3] = {1, 2, 3};
    pmc006_t dev;
    pmc006_status_t status;
    pmc006_end_t end;
    int32_t value = 0;
    ppmc104_result_t result;

    respond = controller;
    (void)pmc006_setup(&dev, line, 9);
    dev.core.limit = 3;
    kind_of_damage = below(12);
    result = pmc006_ask(&dev, (char)below(128), (int32_t)random_bits(), &value);
    if (result == PPMC104_OK && !contains((uint32_t)value)) fail("a value from a damaged frame");
    if (result != PPMC104_OK && kind_of_damage == 0u && talks && !line->echo && stream[2] == 9u) fail("a good frame");
    count(result);
    kind_of_damage = below(12);
    count(pmc006_status(&dev, &status));
    count(pmc006_move(&dev, (int32_t)random_bits()));
    dev.moving = true;
    count(pmc006_wait(&dev, &end));
    count(pmc006_position(&dev, &value));
    count(pmc006_home(&dev, 1u + below(2), below(2) != 0u, 5));
    count(pmc006_program(&dev, words, 3));
    count(pmc006_save(&dev));
    count(pmc006_set_address(&dev, 9));
}

/* ---- PPMC-312 on the line ---- */

static void station(const uint8_t *bytes, unsigned size)
{
    static const uint8_t kinds[4] = {0x80, 0x90, 0xA0, 0xB0};
    static const char digits[] = "0123456789abcdef";
    uint8_t data[8];
    unsigned n, sum, bytes_of_data = below(6);
    const uint8_t control = (uint8_t)(kinds[below(4)] | (below(8) == 0u ? below(16) : 3u));
    (void)size;
    (void)bytes;
    put(control);
    sum = control;
    for (n = 0; n < bytes_of_data; ++n) {
        data[n] = (uint8_t)(below(3) == 0u ? random_bits() : below(3) == 0u ? 0x38u : 0x20u + below(48));
        put((uint8_t)digits[data[n] >> 4]);
        put((uint8_t)digits[data[n] & 15u]);
        sum += data[n];
    }
    put((uint8_t)(~sum & 0x7Fu));
    damage(kind_of_damage);
}

static void use_312(ppmc312_t *dev)
{
    static const uint8_t bytes[30] = {3, 2, 1};
    ppmc312_motion_t motion = {PPMC312_MOVE, 0, 0, 5, PPMC312_NOW};
    const ppmc312_table_t table = {PPMC312_1MHZ, false, 1000, 200, 2000, 0, 0};
    ppmc312_report_t report;
    ppmc312_status_t status;
    ppmc312_end_t end;
    uint8_t answer[PPMC312_DATA_MAX], levels, version, counts[3];
    uint16_t control;
    unsigned got = 0u, n;
    int32_t position = 0;

    count(ppmc312_open(dev, &version));
    count(ppmc312_table(dev, &table));
    motion.op = (ppmc312_op_t)(below(2) == 0u ? 0x82u + below(5) : 0x10u + below(2));
    motion.when = (ppmc312_when_t)below(8);
    count(ppmc312_start(dev, &motion));
    dev->moving = true;
    count(ppmc312_wait(dev, &end));
    for (n = 0; n < 12u; ++n) count(ppmc312_report(dev, &report));
    if (report.count > sizeof report.data) fail("report");
    count(ppmc312_status(dev, &status));
    count(ppmc312_position(dev, below(2) != 0u, &position));
    count(ppmc312_move_to(dev, 12));
    count(ppmc312_inputs(dev, &levels));
    count(ppmc312_control_inputs(dev, &control));
    count(ppmc312_event(dev, below(3), (uint8_t)random_bits(), bytes, below(12)));
    count(ppmc312_stop(dev, true, (ppmc312_when_t)below(8), 5));
    count(ppmc312_line_errors(dev, &levels, counts));
    count(ppmc312_ask(dev, (uint8_t)random_bits(), bytes, below(32), answer, &got));
    if (got > PPMC312_DATA_MAX) fail("answer");
}

/* ---- buses with arbitrary data ---- */

static uint8_t noise(void *ctx, unsigned reg)
{
    const unsigned *part = (const unsigned *)ctx;
    if (++reads > READS_MAX) fail("endless");
    if (below(8) == 0u) return (uint8_t)random_bits();
    if (*part == 312u) {
        switch (reg) {
        case 0: return (uint8_t)(below(3) * 4u);
        case 3: return (uint8_t)(0x40u - below(34));
        default: return (uint8_t)(below(2) == 0u ? below(8) : 0x23u + below(3) * 0x5Fu);
        }
    }
    return reg == 0u ? (uint8_t)below(16) : (uint8_t)(below(4) | below(2) << 7);
}

/* Valid blocks with arbitrary contents, one after the other. */
static struct {
    uint8_t bytes[32];
    unsigned left;
} block;

static uint8_t blocks(void *ctx, unsigned reg)
{
    static const uint8_t headers[8] = {3, 3, 3, 3, 0x23, 0x0B, 0x1B, 2};
    static const uint8_t codes[12] = {0xE0, 0xE3, 0xE9, 0xF0, 0xF1, 0xF4, 0xF7, 0x4D, 0x42, 0x40, 0x00, 0xE8};
    unsigned n, size;
    (void)ctx;
    if (++reads > READS_MAX) fail("endless");
    if (block.left == 0u && reg == 0u && below(3) != 0u) {
        size = 3u + below(30);
        for (n = 0; n < size; ++n) block.bytes[n] = (uint8_t)random_bits();
        block.bytes[0] = headers[below(8)];
        block.bytes[1] = (uint8_t)(size - 2u);
        block.bytes[2] = codes[below(12)];
        block.left = size;
    }
    switch (reg) {
    case 0: return block.left == 0u ? 4u : 0u;
    case 3: return (uint8_t)(0x40u - block.left);
    case 7: return block.left == 0u ? 0u : block.bytes[--block.left];
    default: return 0u;
    }
}

static void swallow(void *ctx, unsigned reg, uint8_t value)
{
    (void)ctx;
    (void)reg;
    (void)value;
}

static void fuzz_bus(void)
{
    unsigned part = 312u;
    ppmc312_t dev;
    ppmc2104_t axes;
    ppmc104_t one;
    ppmc104_finish_t finish;
    const ppmc2104_config_t config = {4, false, false, false, 99, 49, 10};
    uint32_t left = 0u;
    uint8_t byte = 0u;

    ppmc312_setup(&dev, below(2) == 0u ? noise : blocks, swallow, &part);
    dev.bus.limit = 1u + below(20);
    use_312(&dev);
    part = 0u;
    ppmc2104_setup(&axes, noise, swallow, NULL, &part);
    axes.bus.limit = 20;
    count(ppmc2104_open(&axes));
    count(ppmc2104_init(&axes, 1, &config));
    count(ppmc2104_move(&axes, 2, 5));
    count(ppmc2104_wait(&axes, 2, &finish));
    count(ppmc2104_stop(&axes, 1));
    count(ppmc2104_inputs(&axes, 1, &byte));
    ppmc104_setup(&one, noise, swallow, &part);
    one.limit = 20;
    count(ppmc104_move(&one, PPMC104_CW, 5));
    count(ppmc104_wait(&one, &finish));
    count(ppmc104_remaining(&one, &finish, &left));
}

int main(int argc, char **argv)
{
    ppmc_line_t line = {send, receive, NULL, false};
    unsigned long n, runs;
    unsigned k;

    if (argc != 3) fail("usage: fuzz SEED COUNT");
    state = (uint32_t)strtoul(argv[1], NULL, 10) * 2654435761u | 1u;
    runs = strtoul(argv[2], NULL, 10);
    for (n = 0; n < runs; ++n) {
        ppmc312_t dev;
        talks = below(16) != 0u;
        line.echo = below(8) == 0u;
        fuzz_006(&line);
        respond = station;
        kind_of_damage = below(12);
        (void)ppmc312_setup_line(&dev, &line, 3);
        dev.bus.limit = 1u + below(20);
        dev.sum_chars = below(8) == 0u;
        use_312(&dev);
        fuzz_bus();
    }
    for (k = 0; k < 128u; ++k) {
        if (results[k] != 0u) printf("%u %lu %s\n", k, results[k], ppmc104_strerror((ppmc104_result_t)k));
    }
    return 0;
}
