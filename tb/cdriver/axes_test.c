/* SPDX-License-Identifier: Apache-2.0 */
/* Runs the C driver of the PPMC-2104 on the simulated bus, and prints one result per line. pytest checks
 * the lines. */
#include <stdio.h>

#include "../../drivers/c/ppmc2104.h"
#include "axes_bus.h"

static const ppmc2104_config_t CONFIG = {4, false, false, false, 99, 49, 10};

static void show(const char *name, ppmc104_result_t result)
{
    printf("%s result=%d text=%s\n", name, (int)result, ppmc104_strerror(result));
}

static void where(ppmc2104_t *dev, const char *name, unsigned axis)
{
    int32_t position = 0;
    ppmc104_result_t result = ppmc2104_position(dev, axis, &position);
    printf("%s result=%d position=%ld\n", name, (int)result, (long)position);
}

static void ending(ppmc2104_t *dev, const char *name, unsigned axis)
{
    ppmc104_finish_t f = {false, false, false, false, false, 0, 0};
    uint32_t left = 0;
    ppmc104_result_t waited = ppmc2104_wait(dev, axis, &f);
    ppmc104_result_t asked = ppmc2104_remaining(dev, axis, &f, &left);
    printf("%s wait=%d read=%d raw=%02x left=%lu\n", name, (int)waited, (int)asked, f.raw, (unsigned long)left);
    axes_print_pulses(name, axis);
}

static ppmc104_result_t start(ppmc2104_t *dev, unsigned axis, ppmc2104_op_t op, uint8_t flags, uint8_t rate,
                              uint32_t pulses)
{
    ppmc2104_motion_t motion;
    motion.op = op;
    motion.flags = flags;
    motion.rate = rate;
    motion.pulses = pulses;
    return ppmc2104_start(dev, axis, &motion);
}

static void moves(ppmc2104_t *dev)
{
    show("init", ppmc2104_init(dev, 1, &CONFIG));
    show("init", ppmc2104_init(dev, 2, &CONFIG));
    where(dev, "unknown", 1);
    show("unknown move", ppmc2104_move_to(dev, 1, 5));
    show("zero", ppmc2104_set_position(dev, 1, 0));
    show("zero", ppmc2104_set_position(dev, 2, 1000));
    show("move", ppmc2104_move(dev, 1, 30));
    where(dev, "moving", 1);
    ending(dev, "move", 1);
    where(dev, "after move", 1);
    show("constant", start(dev, 2, PPMC2104_CONSTANT, PPMC104_CCW, 60, 300));
    printf("irq running=%d\n", (int)axes_irq());
    while (ppmc2104_busy(dev, 2)) {}
    printf("irq ended=%d\n", (int)axes_irq());
    ending(dev, "constant", 2);
    axes_run(200);
    printf("irq read=%d\n", (int)axes_irq());
    where(dev, "after constant", 2);
    show("to", ppmc2104_move_to(dev, 1, -10));
    ending(dev, "to", 1);
    show("there", ppmc2104_move_to(dev, 1, -10));
    show("step", start(dev, 1, PPMC2104_STEP, PPMC104_CCW, 0, 0));
    ending(dev, "step", 1);
    where(dev, "after step", 1);
    ending(dev, "step again", 1);
    where(dev, "still", 1);
}

static void together(ppmc2104_t *dev)
{
    const ppmc2104_motion_t first = {PPMC2104_MOVE, PPMC104_CW, 0, 25};
    const ppmc2104_motion_t second = {PPMC2104_CONSTANT, PPMC104_CCW, 70, 9};

    show("both", ppmc2104_start_both(dev, &first, &second));
    show("both busy", ppmc2104_start_both(dev, &first, &second));
    ending(dev, "first", 1);
    ending(dev, "second", 2);
    axes_input(AXES_BL, 2, true);
    show("both refused", ppmc2104_start_both(dev, &first, &second));
    axes_run(20000);
    axes_print_pulses("none", 1);
    where(dev, "not moved", 1);
    axes_input(AXES_BL, 2, false);
    show("one after", ppmc2104_move(dev, 1, 4));
    ending(dev, "one after", 1);
}

static void ends(ppmc2104_t *dev)
{
    static const struct {
        axes_input_t which;
        const char *name;
        int32_t pulses;
    } cases[] = {{AXES_FL, "fl", 100}, {AXES_BL, "bl", -100}, {AXES_ALM, "alm", 100}, {AXES_FHL, "fhl", 100}};
    unsigned n;
    uint8_t levels = 0;

    for (n = 0; n < sizeof cases / sizeof cases[0]; ++n) {
        show(cases[n].name, ppmc2104_move(dev, 1, cases[n].pulses));
        axes_run_pulses(1, 20);
        axes_input(cases[n].which, 1, true);
        ending(dev, cases[n].name, 1);
        (void)ppmc2104_inputs(dev, 1, &levels);
        printf("%s inputs=%02x\n", cases[n].name, levels);
        axes_input(cases[n].which, 1, false);
    }
    show("home", start(dev, 2, PPMC2104_HOME, PPMC104_CW, 60, 0));
    axes_run_pulses(2, 7);
    axes_input(AXES_ORG, 2, true);
    ending(dev, "home", 2);
    show("at home", start(dev, 2, PPMC2104_HOME, PPMC104_CW, 60, 0));
    axes_input(AXES_ORG, 2, false);
    show("jog", start(dev, 1, PPMC2104_JOG, PPMC104_CW, 60, 0));
    axes_run_pulses(1, 9);
    show("jog slowly", ppmc2104_stop_slowly(dev, 1));
    show("jog stop", ppmc2104_stop(dev, 1));
    ending(dev, "jog", 1);
    show("run", start(dev, 2, PPMC2104_RUN, PPMC104_CCW, 0, 0));
    axes_run_pulses(2, 30);
    show("run slowly", ppmc2104_stop_slowly(dev, 2));
    ending(dev, "run", 2);
}

static void errors(ppmc2104_t *dev)
{
    static const uint8_t ramp[4] = {10, 9, 10, 0}, far_ramp[4] = {99, 49, 0xD5, 0x2B}, slow[2] = {0x3F, 0x80};
    static const uint8_t byte[1] = {0};
    ppmc2104_config_t bad = CONFIG;
    uint8_t levels = 0;

    axes_reset(false);
    show("E open", ppmc2104_open(dev));
    show("E uninitialised", ppmc2104_move(dev, 2, 10));
    /* The data bytes of this command are also rejected (P2104-BAD-06). ppmc2104_open() clears the
     * remaining errors. */
    show("E open", ppmc2104_open(dev));
    show("E unknown", ppmc2104_command(dev, 0x87, byte, 0));
    show("E ramp", ppmc2104_command(dev, 0x22, ramp, 4));
    show("E long", ppmc2104_command(dev, 0x02, far_ramp, 4));
    show("E switching", ppmc2104_command(dev, 0x84, slow, 2));
    show("E init", ppmc2104_init(dev, 1, &CONFIG));
    show("E init", ppmc2104_init(dev, 2, &CONFIG));
    show("E standstill", ppmc2104_stop(dev, 1));
    show("E busy start", ppmc2104_move(dev, 1, 60));
    show("E busy", ppmc2104_inputs(dev, 1, &levels));
    show("E busy move", ppmc2104_move(dev, 1, 5));
    show("E busy off", ppmc2104_excitation_off(dev, 1));
    show("E cut", ppmc2104_command(dev, 0x64, byte, 1));
    show("E cut by", ppmc2104_command(dev, 0xC2, byte, 0));
    show("E half", ppmc2104_command(dev, 0x64, byte, 1));
    show("E half stop", ppmc2104_stop(dev, 1));
    ending(dev, "E half", 1);
    axes_input(AXES_FL, 1, true);
    show("E start", ppmc2104_move(dev, 1, 5));
    axes_input(AXES_FL, 1, false);
    axes_print_pulses("A", 1);
    show("A axis", ppmc2104_move(dev, 3, 5));
    show("A axis 0", ppmc2104_stop(dev, 0));
    show("A none", ppmc2104_move(dev, 1, 0));
    show("A far", ppmc2104_move(dev, 1, 0x1000001));
    show("A lowest", ppmc2104_move(dev, 1, INT32_MIN));
    show("A flags", start(dev, 1, PPMC2104_STEP, PPMC104_POUT_ONLY, 0, 0));
    show("A aux", ppmc2104_aux_outputs(dev, 4));
    show("A switching", ppmc2104_switching(dev, 1, 63, 64));
    bad.rate_high = 98;
    show("A rates", ppmc2104_init(dev, 1, &bad));
    bad = CONFIG;
    bad.rate_high = 0;
    show("A high", ppmc2104_init(dev, 1, &bad));
    bad = CONFIG;
    bad.motor = 2;
    show("A motor", ppmc2104_init(dev, 1, &bad));
    bad = CONFIG;
    bad.ramp = 3;
    show("A ramp", ppmc2104_init(dev, 1, &bad));
    axes_print_pulses("A after", 1);
}

static void pins(ppmc2104_t *dev)
{
    uint8_t aux = 0, outputs = 0;

    show("P switching", ppmc2104_switching(dev, 1, 64, 128));
    show("P hold", ppmc2104_hold_delay(dev, 2, 3));
    show("P aux", ppmc2104_aux_outputs(dev, 1));
    show("P aux in", ppmc2104_aux_inputs(dev, &aux));
    show("P outputs", ppmc2104_outputs(dev, 1, &outputs));
    printf("pins aux=%02x outputs=%02x\n", aux, outputs);
    show("P off", ppmc2104_excitation_off(dev, 1));
    where(dev, "P off where", 1);
}

static void unconfirmed(ppmc2104_t *dev)
{
    ppmc104_finish_t f = {false, false, false, false, false, 0, 0};
    uint32_t left = 0;

    show("U init", ppmc2104_init(dev, 1, &CONFIG));
    show("U zero", ppmc2104_set_position(dev, 1, 77));
    show("U move", ppmc2104_move(dev, 1, 3000));
    axes_run_pulses(1, 40);
    axes_reset(false);
    show("U reset", ppmc2104_wait(dev, 1, &f));
    show("U reset left", ppmc2104_remaining(dev, 1, &f, &left));
    where(dev, "U where", 1);
    show("U init", ppmc2104_init(dev, 1, &CONFIG));
    show("U zero", ppmc2104_set_position(dev, 1, 0));
    show("U move", ppmc2104_move(dev, 1, 6));
    while (ppmc2104_busy(dev, 1)) {}
    show("U routine", ppmc2104_finish(dev, 1, &f));
    show("U after it", ppmc2104_wait(dev, 1, &f));
    where(dev, "U six", 1);
}

static uint8_t ones(void *ctx, unsigned reg)
{
    (void)ctx;
    (void)reg;
    return 0xFF;
}

static uint8_t zeros(void *ctx, unsigned reg)
{
    (void)ctx;
    (void)reg;
    return 0;
}

static void dead(ppmc2104_t *dev)
{
    ppmc2104_t other;

    ppmc2104_setup(&other, ones, axes_write, NULL, NULL);
    other.bus.limit = 20;
    show("dead ones", ppmc2104_open(&other));
    ppmc2104_setup(&other, zeros, axes_write, NULL, NULL);
    other.bus.limit = 20;
    show("dead zeros", ppmc2104_open(&other));
    axes_reset(true);
    dev->bus.limit = 50;
    show("dead held", ppmc2104_open(dev));
    dev->bus.limit = PPMC104_DEFAULT_LIMIT;
    axes_reset(false);
    show("dead again", ppmc2104_open(dev));
    show("dead init", ppmc2104_init(dev, 2, &CONFIG));
    show("dead jog", start(dev, 2, PPMC2104_JOG, PPMC104_CW, 200, 0));
    dev->bus.limit = 10;
    show("dead short", ppmc2104_wait(dev, 2, NULL));
    dev->bus.limit = PPMC104_DEFAULT_LIMIT;
    show("dead stop", ppmc2104_stop(dev, 2));
    show("dead end", ppmc2104_wait(dev, 2, NULL));
}

int main(void)
{
    ppmc2104_t dev;
    ppmc2104_setup(&dev, axes_read, axes_write, axes_run_pins, NULL);
    show("open", ppmc2104_open(&dev));
    moves(&dev);
    together(&dev);
    ends(&dev);
    errors(&dev);
    pins(&dev);
    unconfirmed(&dev);
    dead(&dev);
    printf("done\n");
    return 0;
}
