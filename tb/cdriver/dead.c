/* SPDX-License-Identifier: Apache-2.0 */
/* Calls the C drivers on buses without a working part. Usage: dead SEED COUNT. Build it with sanitizers. All reads
 * return one value (each of 256), or random bits, of which some may be stuck. A line is silent, or it sends these
 * values without end. Each call must return a result after a limited number of accesses. If all reads return one
 * value, no call may confirm a motion or read a position. The program prints how often each result occurred, and
 * the largest number of accesses of a call. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../../drivers/c/pmc006.h"
#include "../../drivers/c/ppmc2104.h"
#include "../../drivers/c/ppmc312.h"
#include "../../drivers/c/ppmc_bank.h"
#include "../../drivers/c/stmc.h"

#define LIMIT 8u            /* polls in a wait */
#define ACCESSES_MAX 4000ul /* accesses of a call */

static uint32_t state;
static unsigned long accesses, most, results[128];
static uint8_t set_bits, clear_bits; /* stuck bits of all reads */
static bool random_reads, confirmed;
static const char *bus_name;

static uint32_t random_bits(void)
{
    state ^= state << 13;
    state ^= state >> 17;
    state ^= state << 5;
    return state;
}

static void fail(const char *what)
{
    printf("FAIL %s: %s, bits %02x stuck high, %02x stuck low\n", bus_name, what, set_bits, clear_bits);
    exit(1);
}

static void touch(void)
{
    if (++accesses > ACCESSES_MAX) fail("a call does not end");
}

static uint8_t read_bus(void *ctx, unsigned reg)
{
    (void)ctx;
    (void)reg;
    touch();
    return (uint8_t)(((random_reads ? random_bits() : 0u) | set_bits) & ~(unsigned)clear_bits);
}

static void write_bus(void *ctx, unsigned reg, uint8_t value)
{
    (void)ctx;
    (void)reg;
    (void)value;
    touch();
}

/* A call has returned this result. */
static ppmc104_result_t ended(ppmc104_result_t result)
{
    if ((unsigned)result >= 128u || strcmp(ppmc104_strerror(result), "unknown result") == 0) fail("unknown result");
    ++results[result];
    if (accesses > most) most = accesses;
    accesses = 0;
    return result;
}

/* A call that may succeed only with a working part. */
static void working(ppmc104_result_t result, const char *what)
{
    if (ended(result) == PPMC104_OK) {
        confirmed = true;
        if (!random_reads) fail(what);
    }
}

static void part_104(ppmc104_t *one)
{
    const ppmc104_config_t config = {4, false, true, false, false, 99, 49, 10};
    ppmc104_finish_t finish;
    uint32_t left = 0u;
    uint8_t byte = 0u;

    (void)ended(ppmc104_probe(one));
    (void)ended(ppmc104_init(one, &config));
    (void)ended(ppmc104_move(one, PPMC104_CW, 5));
    working(ppmc104_wait(one, &finish), "the end of a move is confirmed");
    (void)ended(ppmc104_move_constant(one, PPMC104_CCW, 9, 70000));
    working(ppmc104_wait(one, &finish), "the end of a move at constant speed is confirmed");
    (void)ended(ppmc104_step(one, PPMC104_CW));
    (void)ended(ppmc104_stop_slowly(one));
    working(ppmc104_wait(one, &finish), "the end of a step is confirmed");
    (void)ended(ppmc104_home(one, PPMC104_CW, 30));
    (void)ended(ppmc104_stop(one));
    (void)ended(ppmc104_finish(one, &finish));
    (void)ended(ppmc104_remaining(one, &finish, &left));
    (void)ended(ppmc104_inputs(one, &byte));
    (void)ended(ppmc104_outputs(one, &byte));
    (void)ended(ppmc104_switching(one, 99, 99));
    (void)ended(ppmc104_excitation_off(one));
}

static void part_2104(void)
{
    const ppmc2104_config_t config = {4, false, false, false, 99, 49, 10};
    ppmc2104_t axes;
    ppmc104_finish_t finish;
    int32_t position = 0;
    uint8_t byte = 0u;
    unsigned axis;

    ppmc2104_setup(&axes, read_bus, write_bus, NULL, NULL);
    axes.bus.limit = LIMIT;
    (void)ended(ppmc2104_open(&axes));
    for (axis = 1; axis <= 2u; ++axis) {
        (void)ended(ppmc2104_init(&axes, axis, &config));
        (void)ended(ppmc2104_set_position(&axes, axis, 7));
        (void)ended(ppmc2104_move(&axes, axis, -5));
        working(ppmc2104_wait(&axes, axis, &finish), "the end of a move is confirmed");
        (void)ended(ppmc2104_move_to(&axes, axis, 900));
        (void)ended(ppmc2104_stop(&axes, axis));
        (void)ended(ppmc2104_stop_slowly(&axes, axis));
        (void)ended(ppmc2104_inputs(&axes, axis, &byte));
        if (ended(ppmc2104_position(&axes, axis, &position)) == PPMC104_OK && position != 7) {
            working(PPMC104_OK, "a position is read");
        }
        (void)ended(ppmc2104_excitation_off(&axes, axis));
    }
}

static void part_stmc(void)
{
    const stmc_config_t config = {4, false, true, false, false, 99, 49, 10};
    stmc_t dev;
    ppmc104_finish_t finish;
    uint32_t left = 0u;
    uint8_t byte = 0u;

    stmc_setup(&dev, read_bus, write_bus, NULL);
    dev.bus.limit = LIMIT;
    (void)ended(stmc_probe(&dev));
    (void)ended(stmc_init(&dev, &config));
    (void)ended(stmc_move(&dev, PPMC104_CW, 5));
    working(stmc_wait(&dev, &finish), "the end of a move is confirmed");
    (void)ended(stmc_stop(&dev));
    (void)ended(stmc_finish(&dev, &finish));
    (void)ended(stmc_remaining(&dev, &finish, &left));
    (void)ended(stmc_inputs(&dev, &byte));
}

static void part_bank(void)
{
    int32_t positions[PPMC_BANK_AXES_MAX];
    ppmc_bank_t bank;
    ppmc_bank_axis_t axis;
    ppmc_bank_set_t refused = 0u;

    if (ended(ppmc_bank_open(&bank, read_bus, write_bus, NULL)) == PPMC104_OK) {
        working(PPMC104_OK, "a bank is found");
    } else {
        bank.read = read_bus; /* a bank that fails after it was opened */
        bank.write = write_bus;
        bank.axes = PPMC_BANK_AXES_MAX;
        bank.held = 0u;
    }
    if (ended(ppmc_bank_axis(&bank, 3, &axis)) != PPMC104_OK) return;
    axis.part.limit = LIMIT;
    part_104(&axis.part);
    (void)ended(ppmc_bank_config(&bank, 3, true, true));
    ppmc_bank_positions(&bank, positions);
    (void)ended(PPMC104_OK);
    (void)ppmc_bank_pending(&bank);
    (void)ppmc_bank_busy(&bank);
    ppmc_bank_stop_all(&bank);
    (void)ended(PPMC104_OK);
    (void)ended(ppmc_bank_hold(&bank, 9u));
    (void)ended(ppmc_bank_go(&bank, &refused));
    ppmc_bank_drop(&bank);
    (void)ended(PPMC104_OK);
}

static void part_312(void)
{
    const ppmc312_table_t table = {PPMC312_1MHZ, false, 1000, 200, 2000, 0, 0};
    ppmc312_t dev;
    ppmc312_end_t end;
    ppmc312_report_t report;
    ppmc312_status_t status;
    int32_t position = 0;
    uint8_t version = 0u;
    unsigned n;

    ppmc312_setup(&dev, read_bus, write_bus, NULL);
    dev.bus.limit = LIMIT;
    working(ppmc312_open(&dev, &version), "a part is found");
    working(ppmc312_table(&dev, &table), "a table is loaded");
    dev.table = true;
    dev.rate_min = 200;
    dev.rate_max = 1000;
    working(ppmc312_move(&dev, 5), "a move is accepted");
    dev.moving = true;
    working(ppmc312_wait(&dev, &end), "the end of a move is confirmed");
    for (n = 0; n < 3u; ++n) (void)ended(ppmc312_report(&dev, &report));
    working(ppmc312_status(&dev, &status), "a status is read");
    working(ppmc312_position(&dev, false, &position), "a position is read");
    working(ppmc312_stop(&dev, true, PPMC312_NOW, 0), "a stop is accepted");
    working(ppmc312_set_position(&dev, false, 3), "a position is set");
    (void)ended(ppmc312_reset(&dev));
}

/* ---- lines ---- */

static bool silent;

static void send(void *ctx, const uint8_t *bytes, unsigned count)
{
    (void)ctx;
    (void)bytes;
    (void)count;
    touch();
}

static bool receive(void *ctx, uint8_t *byte, unsigned milliseconds)
{
    (void)milliseconds;
    *byte = read_bus(ctx, 0);
    return !silent;
}

static void part_006(const ppmc_line_t *line)
{
    pmc006_t dev;
    pmc006_end_t end;
    pmc006_status_t status;
    int32_t value = 0;

    (void)pmc006_setup(&dev, line, 9);
    dev.core.limit = LIMIT;
    working(pmc006_open(&dev), "a controller is found");
    working(pmc006_status(&dev, &status), "a status is read");
    working(pmc006_set(&dev, PMC006_MAX_SPEED, 900), "a speed is set");
    working(pmc006_set_position(&dev, 4), "a position is set");
    dev.known = true;
    working(pmc006_move(&dev, 5), "a move is accepted");
    dev.moving = true;
    working(pmc006_wait(&dev, &end), "the end of a move is confirmed");
    working(pmc006_stop(&dev), "a stop is accepted");
    working(pmc006_position(&dev, &value), "a position is read");
    working(pmc006_home(&dev, 1, true, 5), "a switch is found");
    working(pmc006_save(&dev), "settings are saved");
}

static void station_312(const ppmc_line_t *line)
{
    ppmc312_t dev;
    ppmc312_end_t end;
    int32_t position = 0;
    uint8_t version = 0u;

    (void)ppmc312_setup_line(&dev, line, 3);
    dev.bus.limit = LIMIT;
    working(ppmc312_open(&dev, &version), "a station is found");
    working(ppmc312_move(&dev, 5), "a move is accepted");
    dev.moving = true;
    working(ppmc312_wait(&dev, &end), "the end of a move is confirmed");
    working(ppmc312_position(&dev, false, &position), "a position is read");
    working(ppmc312_stop(&dev, true, PPMC312_NOW, 0), "a stop is accepted");
}

static void lines(void)
{
    ppmc_line_t line = {send, receive, NULL, false};
    unsigned k;

    for (k = 0; k < 4u; ++k) {
        silent = k % 2u == 0u;
        line.echo = k >= 2u;
        bus_name = "PMC006B4";
        part_006(&line);
        bus_name = "PPMC-312 on a line";
        station_312(&line);
    }
}

static void all_parts(void)
{
    ppmc104_t one;

    accesses = 0;
    bus_name = "PPMC-104";
    ppmc104_setup(&one, read_bus, write_bus, NULL);
    one.limit = LIMIT;
    part_104(&one);
    bus_name = "PPMC-2104";
    part_2104();
    bus_name = "STMC";
    part_stmc();
    bus_name = "bank";
    part_bank();
    bus_name = "PPMC-312";
    part_312();
    lines();
}

int main(int argc, char **argv)
{
    unsigned long n, count, lucky = 0;
    unsigned k;

    bus_name = "usage: dead SEED COUNT";
    if (argc != 3) fail("arguments");
    state = (uint32_t)strtoul(argv[1], NULL, 10) * 2654435761u | 1u;
    count = strtoul(argv[2], NULL, 10);
    for (k = 0; k < 256u; ++k) { /* all reads return k */
        set_bits = (uint8_t)k;
        clear_bits = (uint8_t)~k;
        all_parts();
    }
    random_reads = true;
    for (n = 0; n < count; ++n) {
        set_bits = n % 2u == 0u ? 0u : (uint8_t)(random_bits() & random_bits() & random_bits());
        clear_bits = n % 2u == 0u ? 0u : (uint8_t)(random_bits() & random_bits());
        confirmed = false;
        all_parts();
        lucky += confirmed;
    }
    for (k = 0; k < 128u; ++k) {
        if (results[k] != 0u) printf("%u %lu %s\n", k, results[k], ppmc104_strerror((ppmc104_result_t)k));
    }
    printf("accesses %lu\nrandom %lu of %lu\n", most, lucky, count);
    return 0;
}
