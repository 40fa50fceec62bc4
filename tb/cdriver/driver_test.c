/* SPDX-License-Identifier: Apache-2.0 */
/* Runs the C driver on the simulated bus, and prints one result per line. pytest checks the lines. */
#include <stdio.h>

#include "../../drivers/c/ppmc104.h"
#include "sim_bus.h"

/* The motions are slow enough for the old chip, which accepts no bytes during faster motions (P104-DS-12). */
static const ppmc104_config_t CONFIG = {4, false, true, false, false, 59, 39, 6};
#define FAST_RATE 9 /* too fast for the old chip */

/* Each result has a separate call, so that the arguments are evaluated in order. */
static void show(const char *name, ppmc104_result_t result)
{
    printf("%s result=%d text=%s\n", name, (int)result, ppmc104_strerror(result));
}

static void ending(ppmc104_t *dev, const char *name)
{
    ppmc104_finish_t f = {false, false, false, false, false, 0, 0};
    uint32_t left = 0;
    ppmc104_result_t waited = ppmc104_wait(dev, &f);
    ppmc104_result_t asked = ppmc104_remaining(dev, &f, &left);
    printf("%s wait=%d read=%d raw=%02x ended=%d stopped=%d alarm=%d limit=%d slow=%d op=%d left=%lu\n", name,
           (int)waited, (int)asked, f.raw, f.ended, f.stopped, f.alarm, f.limit, f.slow_limit, f.operation,
           (unsigned long)left);
    sim_print_pulses(name);
}

static void moves(ppmc104_t *dev)
{
    uint32_t before, during;

    show("init", ppmc104_init(dev, &CONFIG));
    show("move", ppmc104_move(dev, PPMC104_CW, 30));
    during = sim_bridge();
    while (ppmc104_busy(dev)) {}
    before = sim_bridge();
    printf("irq running=%lu ended=%lu pin=%d\n", (unsigned long)during, (unsigned long)before, sim_irq());
    ending(dev, "move");
    printf("irq read=%lu pin=%d\n", (unsigned long)sim_bridge(), sim_irq());
    show("constant", ppmc104_move_constant(dev, PPMC104_CCW, 24, 300));
    ending(dev, "constant");
    show("quiet", ppmc104_move(dev, PPMC104_CW | PPMC104_NO_INT | PPMC104_POUT_ONLY, 12));
    while (ppmc104_busy(dev)) {}
    printf("quiet irq=%lu\n", (unsigned long)sim_bridge());
    ending(dev, "quiet");
    show("step", ppmc104_step(dev, PPMC104_CCW));
    ending(dev, "step");
}

static void ends(ppmc104_t *dev)
{
    static const struct {
        sim_switch_t which;
        const char *name;
        uint8_t flags;
    } cases[] = {{SIM_L1, "l1", PPMC104_CW}, {SIM_L2, "l2", PPMC104_CCW}, {SIM_ALM, "alm", PPMC104_CW},
                 {SIM_L3, "l3", PPMC104_CW}, {SIM_L4, "l4", PPMC104_CCW}};
    unsigned n;
    uint8_t inputs = 0;

    for (n = 0; n < sizeof cases / sizeof cases[0]; ++n) {
        show(cases[n].name, ppmc104_move(dev, cases[n].flags, 100));
        sim_run_pulses(20);
        sim_switch(cases[n].which, true);
        while (ppmc104_busy(dev)) {}
        ending(dev, cases[n].name);
        (void)ppmc104_inputs(dev, &inputs);
        printf("%s inputs=%02x\n", cases[n].name, inputs);
        sim_switch(cases[n].which, false);
    }
    /* With one pulse left, the part returns 0, as with no pulse left. */
    show("late", ppmc104_move(dev, PPMC104_CW, 25));
    sim_run_pulses(24);
    sim_switch(SIM_L1, true);
    ending(dev, "late");
    sim_switch(SIM_L1, false);
    show("home", ppmc104_home(dev, PPMC104_CCW, 49));
    sim_run_pulses(7);
    sim_switch(SIM_CNP, true);
    ending(dev, "home");
    sim_switch(SIM_CNP, false);
    show("jog", ppmc104_jog(dev, PPMC104_CW, 24));
    sim_run_pulses(9);
    show("jog stop", ppmc104_stop(dev));
    ending(dev, "jog");
    show("run", ppmc104_run(dev, PPMC104_CCW));
    sim_run_pulses(25);
    show("run stop", ppmc104_stop_slowly(dev));
    ending(dev, "run");
}

static void errors(ppmc104_t *dev)
{
    static const uint8_t long_ramp[4] = {19, 9, 0xD5, 0x2B}; /* PA = 11 221, too large */
    static const uint8_t bad_ramp[4] = {9, 19, 6, 0};
    ppmc104_config_t bad = CONFIG;
    uint8_t byte = 0;

    sim_reset(false);
    show("E uninitialised", ppmc104_move(dev, PPMC104_CW, 10));
    show("E unknown", ppmc104_command(dev, 0x87, &byte, 0));
    show("E nothing to stop", ppmc104_stop(dev));
    show("E data", ppmc104_data(dev, 0x55));
    show("E long ramp", ppmc104_command(dev, 0x0A, long_ramp, 4));
    show("E bad ramp", ppmc104_command(dev, 0x0A, bad_ramp, 4));
    show("E init", ppmc104_init(dev, &CONFIG));
    /* While the ramp table is being built, the byte waits. The driver must wait before it reads ERR. */
    show("E late", ppmc104_command(dev, 0x87, &byte, 0));
    show("E start", ppmc104_move(dev, PPMC104_CW, 60));
    show("E busy", ppmc104_inputs(dev, &byte));
    show("E busy off", ppmc104_excitation_off(dev));
    show("E data busy", ppmc104_data(dev, 0x55));
    sim_run_pulses(30);
    show("E stop slowly", ppmc104_stop_slowly(dev));
    show("E decelerating", ppmc104_stop_slowly(dev));
    ending(dev, "E");
    show("E flags", ppmc104_step(dev, PPMC104_POUT_ONLY));
    show("E none", ppmc104_move(dev, PPMC104_CW, 0));
    show("E too many", ppmc104_move(dev, PPMC104_CW, 0x1000001));
    bad.motor = 6;
    show("E motor", ppmc104_init(dev, &bad));
    bad = CONFIG;
    bad.ramp = 11221;
    show("E ramp", ppmc104_init(dev, &bad));
    bad = CONFIG;
    bad.rate_high = 60;
    show("E rates", ppmc104_init(dev, &bad));
}

/* Read the status and send commands immediately after the last byte of an operation. With DATASHEET
 * timing, BUSY is then still 0. */
static void gap(ppmc104_t *dev)
{
    uint8_t levels = 0;

    sim_reset(false);
    show("G init", ppmc104_init(dev, &CONFIG));
    show("G look", ppmc104_move(dev, PPMC104_CW, 12));
    printf("G look bare=%d", ppmc104_status(dev) >> 2 & 1);
    printf(" busy=%d", ppmc104_busy(dev));
    printf(" again=%d\n", ppmc104_busy(dev));
    ending(dev, "G look");
    printf("G look rest=%d\n", ppmc104_busy(dev));
    show("G off", ppmc104_move(dev, PPMC104_CW, 12));
    show("G off refused", ppmc104_excitation_off(dev));
    ending(dev, "G off");
    show("G now", ppmc104_excitation_off(dev));
    show("G init", ppmc104_init(dev, &CONFIG));
    show("G fast", ppmc104_jog(dev, PPMC104_CW, FAST_RATE));
    show("G fast refused", ppmc104_excitation_off(dev));
    sim_run_pulses(3);
    dev->limit = 20;
    show("G fast read", ppmc104_inputs(dev, &levels));
    dev->limit = PPMC104_DEFAULT_LIMIT;
    show("G fast stop", ppmc104_stop(dev));
    ending(dev, "G fast");
    show("G wait", ppmc104_step(dev, PPMC104_CW));
    ending(dev, "G wait");
}

/* A simulated part that returns a finish status and three bytes of remaining pulses. */
static struct {
    uint8_t finish, left;
    unsigned bytes;
} fake;

static uint8_t fake_read(void *ctx, unsigned reg)
{
    (void)ctx;
    if (reg == PPMC104_REG_STATUS) return PPMC104_STATUS_OBF;
    return fake.bytes++ == 0 ? fake.finish : fake.bytes == 2 ? fake.left : 0;
}

static void fake_write(void *ctx, unsigned reg, uint8_t value)
{
    (void)ctx;
    if (reg == PPMC104_REG_STATUS) fake.bytes = value == 0x83 ? 1 : 0;
}

/* Ends that the part does not confirm: it was reset, it made another motion, or its count disagrees. */
static void unconfirmed(ppmc104_t *dev)
{
    static const struct {
        const char *name;
        uint8_t finish, left;
    } cases[] = {{"U complete", 0x83, 0}, {"U count", 0x83, 247}, {"U operation", 0x84, 0}, {"U idle", 0x00, 0},
                 {"U not ended", 0x40, 9}, {"U stopped", 0xC3, 99}, {"U too many left", 0xC3, 100}};
    ppmc104_finish_t f = {false, false, false, false, false, 0, 0};
    ppmc104_t other;
    uint32_t left = 99;
    unsigned n;

    show("U init", ppmc104_init(dev, &CONFIG));
    show("U move", ppmc104_move(dev, PPMC104_CW, 1000));
    sim_run_pulses(47);
    sim_reset(false);
    show("U reset", ppmc104_wait(dev, &f));
    show("U reset left", ppmc104_remaining(dev, &f, &left));
    show("U reset again", ppmc104_wait(dev, (ppmc104_finish_t *)0));
    ppmc104_setup(&other, sim_read, sim_write, (void *)0);
    show("U init", ppmc104_init(dev, &CONFIG));
    show("U home", ppmc104_home(dev, PPMC104_CW, 40));
    sim_reset(false);
    show("U other", ppmc104_init(&other, &CONFIG));
    show("U other", ppmc104_move(&other, PPMC104_CW, 3));
    show("U replaced", ppmc104_wait(dev, (ppmc104_finish_t *)0));
    show("U move", ppmc104_move(dev, PPMC104_CW, 5));
    while (ppmc104_busy(dev)) {}
    show("U routine", ppmc104_finish(dev, &f)); /* an interrupt routine has already read the status */
    show("U after it", ppmc104_wait(dev, &f));
    printf("U after it raw=%02x\n", f.raw);
    for (n = 0; n < sizeof cases / sizeof cases[0]; ++n) {
        ppmc104_setup(&other, fake_read, fake_write, (void *)0);
        (void)ppmc104_move(&other, PPMC104_CW, 100);
        fake.finish = cases[n].finish;
        fake.left = cases[n].left;
        show(cases[n].name, ppmc104_wait(&other, (ppmc104_finish_t *)0));
    }
    sim_forget();
}

static void pins(ppmc104_t *dev)
{
    uint8_t outputs = 0, aux = 0xFF;
    show("aux on", ppmc104_aux(dev, true));
    show("aux bits", ppmc104_aux_outputs(dev, 0x5));
    show("aux off", ppmc104_aux(dev, false));
    show("switching", ppmc104_switching(dev, 10, 20));
    show("aux in", ppmc104_aux_inputs(dev, &aux));
    show("outputs", ppmc104_outputs(dev, &outputs));
    printf("pins aux=%02x outputs=%02x\n", aux, outputs);
    show("off", ppmc104_excitation_off(dev));
    show("off move", ppmc104_move(dev, PPMC104_CW, 5));
}

static void motors(ppmc104_t *dev)
{
    unsigned n, step;

    for (n = 0; n < 24; ++n) {
        ppmc104_config_t c = CONFIG;
        unsigned seen = 0;
        c.motor = (uint8_t)(3 + n % 3);
        c.half_step = (n / 3 & 1) != 0;
        c.active_high = (n / 6 & 1) != 0;
        c.chop = n / 12 != 0;
        sim_reset(false);
        printf("motor init=%d phases=%u half=%d high=%d chop=%d rows=", (int)ppmc104_init(dev, &c), c.motor,
               c.half_step, c.active_high, c.chop);
        for (step = 0; step < 4; ++step) {
            uint8_t outputs = 0;
            (void)ppmc104_outputs(dev, &outputs);
            printf("%02x,", outputs >> 3);
            (void)ppmc104_step(dev, PPMC104_CW);
            (void)ppmc104_wait(dev, (ppmc104_finish_t *)0);
        }
        for (step = 0; step < 6000; ++step) {
            sim_run(1);
            seen |= 1u << (sim_phases() == (c.active_high ? 0x00u : 0x1Fu));
        }
        printf(" chopped=%d\n", seen == 3);
    }
    sim_forget();
}

static void external(ppmc104_t *dev)
{
    ppmc104_config_t c = CONFIG;
    c.external_clock = true;
    sim_reset(false);
    show("external", ppmc104_init(dev, &c));
    show("external", ppmc104_move(dev, PPMC104_CW, 5));
    sim_run(20000);
    printf("external busy=%d pulses=%u\n", ppmc104_busy(dev), sim_pulses());
    show("external", ppmc104_stop(dev));
}

static bool three(void *ctx, unsigned long polls)
{
    unsigned *calls = (unsigned *)ctx;
    ++*calls;
    return polls >= 3;
}

static uint8_t full_read(void *ctx, unsigned reg)
{
    (void)ctx;
    (void)reg;
    return PPMC104_STATUS_IBF;
}

static uint8_t zero_read(void *ctx, unsigned reg)
{
    (void)ctx;
    (void)reg;
    return 0;
}

static void dead(ppmc104_t *dev)
{
    unsigned calls = 0, before;
    ppmc104_t other;

    sim_reset(true);
    before = sim_cycles();
    dev->limit = 50;
    show("dead probe", ppmc104_probe(dev));
    show("dead init", ppmc104_init(dev, &CONFIG));
    printf("dead answered=%u\n", sim_cycles() - before);
    ppmc104_setup(&other, full_read, sim_write, &calls);
    other.give_up = three;
    show("full probe", ppmc104_probe(&other));
    printf("full calls=%u\n", calls);
    ppmc104_setup(&other, zero_read, sim_write, &calls);
    other.limit = 20;
    show("zero probe", ppmc104_probe(&other));
    sim_reset(false);
    dev->limit = 3;
    (void)ppmc104_command(dev, 0x0A, (const uint8_t *)"\073\047\006", 4);
    show("short wait", ppmc104_probe(dev));
    dev->limit = PPMC104_DEFAULT_LIMIT;
    show("alive", ppmc104_probe(dev));
}

static void rates(void)
{
    static const uint32_t wanted[] = {0, 1, 488, 489, 500, 1953, 1954, 2500, 9999, 27000, 100000, 105264, 500000, 500001};
    static const uint32_t crystals[] = {16000000, 8000000, 1000000, 500000};
    unsigned c, b, x, n;

    for (c = 0; c < 4; ++c) {
        for (b = 0; b < 3; ++b) {
            for (x = 0; x < 2; ++x) {
                ppmc104_speed_t speed = {0, PPMC104_BASE_500K, 40000, false};
                speed.xtal_hz = crystals[c];
                speed.base = (ppmc104_base_t)b;
                speed.extra = x != 0;
                for (n = 0; n < sizeof wanted / sizeof wanted[0]; ++n) {
                    uint8_t rate = 0;
                    ppmc104_result_t result = ppmc104_rate_from_pps(&speed, wanted[n], &rate);
                    printf("rate xtal=%lu base=%u extra=%u pps=%lu result=%d rate=%d mpps=%lu\n",
                           (unsigned long)crystals[c], b, x, (unsigned long)wanted[n], (int)result, rate,
                           (unsigned long)ppmc104_rate_to_mpps(&speed, rate));
                }
            }
        }
    }
}

int main(void)
{
    ppmc104_t dev;
    ppmc104_setup(&dev, sim_read, sim_write, (void *)0);
    show("probe", ppmc104_probe(&dev));
    moves(&dev);
    ends(&dev);
    pins(&dev);
    errors(&dev);
    unconfirmed(&dev);
    motors(&dev);
    external(&dev);
    gap(&dev);
    dead(&dev);
    rates();
    printf("done cycles=%u\n", sim_cycles());
    return 0;
}
