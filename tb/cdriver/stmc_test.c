/* SPDX-License-Identifier: Apache-2.0 */
/* Runs the STMC driver and its port functions on the simulated ISA bus, and prints one result per line.
 * pytest checks the lines. The external clock of the board is 1 MHz here: 16 cycles per tick. */
#include <stdio.h>

#include "isa_bus.h" /* before the driver: STMC_INB, STMC_OUTB */

#include "../../drivers/c/stmc_ports.h"

static const stmc_config_t CONFIG = {4, false, true, false, true, 20, 5, 8};

static void show(const char *name, ppmc104_result_t result)
{
    printf("%s result=%d text=%s\n", name, (int)result, stmc_strerror(result));
}

static void ending(stmc_t *dev, const char *name)
{
    ppmc104_finish_t f = {false, false, false, false, false, 0, 0};
    uint32_t left = 0;
    ppmc104_result_t waited = stmc_wait(dev, &f);
    ppmc104_result_t asked = stmc_remaining(dev, &f, &left);
    printf("%s wait=%d read=%d raw=%02x stopped=%d alarm=%d limit=%d slow=%d op=%d left=%lu\n", name, (int)waited,
           (int)asked, f.raw, f.stopped, f.alarm, f.limit, f.slow_limit, f.operation, (unsigned long)left);
    isa_print_steps(name);
}

static void moves(stmc_t *dev)
{
    stmc_config_t other = CONFIG;
    uint8_t outputs = 0, inputs = 0;

    show("probe", stmc_probe(dev));
    printf("default map=%d\n", (int)dev->map);
    show("init", stmc_init(dev, &CONFIG));
    show("outputs", stmc_outputs(dev, &outputs));
    show("inputs", stmc_inputs(dev, &inputs));
    printf("levels out=%02x in=%02x\n", outputs, inputs);
    show("move", stmc_move(dev, PPMC104_CW, 20));
    ending(dev, "move");
    show("constant", stmc_move_constant(dev, PPMC104_CCW, 7, 5));
    ending(dev, "constant");
    show("step", stmc_step(dev, PPMC104_CCW));
    ending(dev, "step");
    other.external_clock = false;
    show("init", stmc_init(dev, &other));
    show("internal", stmc_move(dev, PPMC104_CW, 4));
    ending(dev, "internal");
    other = CONFIG;
    other.ramp = 259;
    show("init", stmc_init(dev, &other));
    show("long", stmc_move(dev, PPMC104_CW, 60));
    ending(dev, "long");
    show("init", stmc_init(dev, &CONFIG));
}

/* Act like an interrupt routine: read the finish status, which clears the interrupt. */
static void interrupt(stmc_t *dev)
{
    ppmc104_finish_t f = {false, false, false, false, false, 0, 0};
    unsigned before, after;

    show("quiet", stmc_move(dev, PPMC104_CW | PPMC104_NO_INT, 3));
    while (stmc_busy(dev)) {}
    printf("irq quiet=%d\n", isa_irq());
    isa_print_steps("quiet");
    show("loud", stmc_move(dev, PPMC104_CW, 12));
    before = isa_irq();
    while (!isa_irq()) isa_run(1);
    after = isa_steps();
    show("service", stmc_finish(dev, &f));
    printf("irq running=%u steps=%u raw=%02x lifted=%d\n", before, after, f.raw, !isa_irq());
    isa_print_steps("loud");
    /* The interrupt routine runs after the next motion has begun. Its calls are rejected, and the
     * interrupt is served at the end of that motion. */
    show("late", stmc_move(dev, PPMC104_CW, 6));
    while (!isa_irq()) isa_run(1);
    show("late again", stmc_move(dev, PPMC104_CCW, 4));
    show("late service", stmc_finish(dev, &f));
    before = isa_irq();
    show("late wait", stmc_wait(dev, &f));
    printf("irq late=%u raw=%02x lifted=%d\n", before, f.raw, !isa_irq());
    isa_print_steps("late");
}

static void ends(stmc_t *dev)
{
    static const struct {
        isa_input_t which;
        const char *name;
        uint8_t flags;
    } cases[] = {{ISA_L1, "l1", PPMC104_CW}, {ISA_L2, "l2", PPMC104_CCW}, {ISA_MON, "mon", PPMC104_CW},
                 {ISA_L3, "l3", PPMC104_CW}, {ISA_L4, "l4", PPMC104_CCW}};
    unsigned n;
    uint8_t inputs = 0;

    for (n = 0; n < sizeof cases / sizeof cases[0]; ++n) {
        show(cases[n].name, stmc_move(dev, cases[n].flags, 100));
        isa_run_steps(30);
        isa_level(cases[n].which, false);
        ending(dev, cases[n].name);
        (void)stmc_inputs(dev, &inputs);
        printf("%s inputs=%02x\n", cases[n].name, inputs);
        isa_level(cases[n].which, true);
    }
    show("home", stmc_home(dev, PPMC104_CCW, 10));
    isa_run_steps(7);
    isa_level(ISA_CNP, false);
    ending(dev, "home");
    show("there", stmc_home(dev, PPMC104_CCW, 10));
    ending(dev, "there");
    isa_level(ISA_CNP, true);
    show("jog", stmc_jog(dev, PPMC104_CW, 10));
    isa_run_steps(9);
    show("jog stop", stmc_stop(dev));
    ending(dev, "jog");
    show("run", stmc_run(dev, PPMC104_CCW));
    isa_run_steps(25);
    show("run stop", stmc_stop_slowly(dev));
    ending(dev, "run");
}

static void errors(stmc_t *dev)
{
    static const uint8_t zero[4] = {0, 3, 0, 0}, swapped[4] = {5, 20, 8, 0};
    stmc_config_t bad = CONFIG;
    uint8_t byte = 0;

    isa_reset(false);
    show("E uninitialised", stmc_move(dev, PPMC104_CW, 10));
    show("E unknown", ppmc104_command(&dev->bus, 0x84, &byte, 0));
    show("E nothing to stop", stmc_stop(dev));
    show("E data", ppmc104_data(&dev->bus, 0x55));
    show("E swapped", ppmc104_command(&dev->bus, 0x1A, swapped, 4));
    show("E init", stmc_init(dev, &CONFIG));
    show("E zero", ppmc104_command(&dev->bus, 0x44, zero, 4));
    show("E start", stmc_move(dev, PPMC104_CW, 60));
    show("E busy", stmc_inputs(dev, &byte));
    show("E busy probe", stmc_probe(dev));
    show("E data busy", ppmc104_data(&dev->bus, 0x55));
    isa_run_steps(30);
    show("E stop slowly", stmc_stop_slowly(dev));
    show("E decelerating", stmc_stop_slowly(dev));
    ending(dev, "E");
    show("A pulses only", stmc_move(dev, PPMC104_POUT_ONLY, 5));
    show("A run pulses only", stmc_run(dev, PPMC104_POUT_ONLY));
    show("A flags", stmc_step(dev, 0x20));
    show("A none", stmc_move(dev, PPMC104_CW, 0));
    show("A too many", stmc_move(dev, PPMC104_CW, 0x1000001));
    show("A divisor", stmc_move_constant(dev, PPMC104_CW, 0, 5));
    show("A jog divisor", stmc_jog(dev, PPMC104_CW, 0));
    show("A home divisor", stmc_home(dev, PPMC104_CW, 0));
    bad.motor = 2;
    show("A motor", stmc_init(dev, &bad));
    bad = CONFIG;
    bad.divisor_high = 21;
    show("A divisors", stmc_init(dev, &bad));
    bad.divisor_high = 0;
    show("A no divisor", stmc_init(dev, &bad));
    isa_print_steps("A");
}

/* Reset during a motion. After a reset, bit 7 of the finish status is set (STMC-FIN-01). */
static void unconfirmed(stmc_t *dev)
{
    ppmc104_finish_t f = {false, false, false, false, false, 0, 0};
    uint32_t left = 0;

    show("U init", stmc_init(dev, &CONFIG));
    show("U move", stmc_move(dev, PPMC104_CW, 1000));
    isa_run_steps(24);
    isa_reset(false);
    show("U reset", stmc_wait(dev, &f));
    show("U reset left", stmc_remaining(dev, &f, &left));
    isa_print_steps("U");
}

/* First there is no device at these ports. Then a motion takes longer than the limit of the wait. */
static void dead(stmc_t *dev)
{
    stmc_t other;

    stmc_setup_ports(&other, STMC_BASE + 2u);
    other.bus.limit = 20;
    show("dead ports", stmc_probe(&other));
    show("dead init", stmc_init(&other, &CONFIG));
    isa_reset(false);
    show("again", stmc_init(dev, &CONFIG));
    show("again", stmc_jog(dev, PPMC104_CW, 200));
    dev->bus.limit = 10;
    show("short wait", stmc_wait(dev, (ppmc104_finish_t *)0));
    dev->bus.limit = PPMC104_DEFAULT_LIMIT;
    show("again", stmc_stop(dev));
    show("again", stmc_wait(dev, (ppmc104_finish_t *)0));
    isa_print_steps("again");
}

/* Registers of a part that has the read codes of the related devices. An answer is the low half of its
 * code. */
typedef struct {
    uint8_t status, answer;
    unsigned left;
    bool busy;
} sheet_t;

static uint8_t sheet_read(void *ctx, unsigned reg)
{
    sheet_t *part = (sheet_t *)ctx;
    if (reg == PPMC104_REG_STATUS) {
        return (uint8_t)(part->status | (part->left != 0u ? PPMC104_STATUS_OBF : 0u));
    }
    part->left -= part->left != 0u;
    return part->answer;
}

static void sheet_write(void *ctx, unsigned reg, uint8_t value)
{
    sheet_t *part = (sheet_t *)ctx;
    const uint8_t busy = part->busy ? PPMC104_STATUS_BUSY : 0u;
    if (reg != PPMC104_REG_STATUS || (value != 0x80u && (value < 0x82u || value > 0x84u))) {
        part->status = 0x80u | busy;
    } else if (part->busy) {
        part->status = 0x94u;
    } else {
        part->status = 0u;
        part->answer = value & 0x0Fu;
        part->left = value == 0x84u ? 3u : 1u;
    }
}

static void sheet(void)
{
    const ppmc104_finish_t complete = {true, false, false, false, false, 3, 0x83};
    sheet_t part = {0, 0, 0, false};
    stmc_t dev;
    uint8_t inputs = 0, outputs = 0;
    uint32_t left = 0;

    stmc_setup(&dev, sheet_read, sheet_write, &part);
    show("sheet probe", stmc_probe(&dev));
    show("sheet", stmc_inputs(&dev, &inputs));
    show("sheet", stmc_outputs(&dev, &outputs));
    show("sheet", stmc_remaining(&dev, &complete, &left));
    printf("sheet map=%d inputs=%02x outputs=%02x left=%lx\n", (int)dev.map, inputs, outputs, (unsigned long)left);
    part.busy = true;
    dev.map = STMC_MAP_FAMILY;
    show("sheet busy", stmc_probe(&dev));
    printf("sheet busy map=%d\n", (int)dev.map);
}

static void speeds(void)
{
    static const uint32_t clocks[] = {0, STMC_CLOCK_INTERNAL, STMC_CLOCK_BOARD, 1000000, 1000001};
    static const uint32_t wanted[] = {0, 1, 48, 49, 50, 190, 191, 345, 825, 2500, 2778, 2779, 9735, 10817, 48675, 200000};
    unsigned c, n;

    for (c = 0; c < sizeof clocks / sizeof clocks[0]; ++c) {
        for (n = 0; n < sizeof wanted / sizeof wanted[0]; ++n) {
            uint8_t divisor = 0;
            ppmc104_result_t result = stmc_divisor(clocks[c], wanted[n], &divisor);
            printf("speed clock=%lu speed=%lu result=%d divisor=%d milli=%lu\n", (unsigned long)clocks[c],
                   (unsigned long)wanted[n], (int)result, divisor,
                   (unsigned long)stmc_milli_speed(clocks[c], divisor));
        }
    }
}

int main(void)
{
    stmc_t dev;
    stmc_setup_ports(&dev, STMC_BASE);
    moves(&dev);
    interrupt(&dev);
    ends(&dev);
    errors(&dev);
    unconfirmed(&dev);
    dead(&dev);
    sheet();
    speeds();
    printf("done steps=%u\n", isa_steps());
    return 0;
}
