/* SPDX-License-Identifier: Apache-2.0 */
/* Runs the C driver of the PPMC-312 on the simulated part, first on its bus ("bus ..."), then on a line
 * ("line ..."), and prints one result per line. pytest checks the lines. */
#include <stdio.h>
#include <string.h>

#include "../../drivers/c/ppmc312.h"
#include "block_bus.h"

static const ppmc312_table_t TABLE = {PPMC312_8MHZ, false, 250, 50, 1300, 0, 0};
static ppmc312_t dev;
static const char *way;

static void show(const char *name, ppmc104_result_t result)
{
    printf("%s %s result=%d detail=%02x text=%s\n", way, name, (int)result, dev.detail[0], ppmc104_strerror(result));
}

static void pulses(const char *name)
{
    char text[64];
    (void)snprintf(text, sizeof text, "%s %s", way, name);
    block_print_pulses(text);
}

static void ending(const char *name)
{
    ppmc312_end_t end = {0, false, 0};
    ppmc104_result_t result = ppmc312_wait(&dev, &end);
    printf("%s %s wait=%d cause=%02x complete=%d position=%ld\n", way, name, (int)result, end.cause, end.complete,
           (long)end.position);
    pulses(name);
}

static void where(const char *name)
{
    int32_t position = 0;
    ppmc104_result_t result = ppmc312_position(&dev, false, &position);
    printf("%s %s result=%d position=%ld\n", way, name, (int)result, (long)position);
}

static void report(const char *name)
{
    ppmc312_report_t r;
    unsigned n;
    for (n = 0; n < 20; ++n) {
        ppmc104_result_t result = ppmc312_report(&dev, &r);
        if (result != PPMC104_OK || r.code == PPMC312_REPORT_NONE) {
            printf("%s %s end result=%d\n", way, name, (int)result);
            return;
        }
        printf("%s %s source=%02x code=%02x count=%u data=%02x\n", way, name, r.source, r.code, r.count, r.data[0]);
    }
}

/* Make a falling edge. The pin remains low until the report has arrived, because DATASHEET timing needs 25
 * ms. */
static void edge(const char *name, block_pin_t pin)
{
    unsigned n;
    block_pin(pin, false);
    for (n = 0; n < 100; ++n) {
        block_run(4000);
        if (dev.line == NULL ? (block_read(NULL, 0) & 4u) == 0u : n >= 60) {
            break;
        }
    }
    block_pin(pin, true);
    block_run(20000);
    report(name);
}

static ppmc104_result_t start(ppmc312_op_t op, uint8_t flags, uint16_t rate, uint32_t count, ppmc312_when_t when)
{
    ppmc312_motion_t motion;
    motion.op = op;
    motion.flags = flags;
    motion.rate = rate;
    motion.pulses = count;
    motion.when = when;
    return ppmc312_start(&dev, &motion);
}

static void moves(void)
{
    uint8_t version = 0;
    ppmc312_table_t sigmoid = TABLE;

    show("open", ppmc312_open(&dev, &version));
    printf("%s version byte=%02x\n", way, version);
    where("unknown");
    show("early zero", ppmc312_set_position(&dev, false, 0));
    sigmoid.up = 20;
    show("short ramp", ppmc312_table(&dev, &sigmoid));
    sigmoid = TABLE;
    sigmoid.sigmoid = true;
    show("sigmoid", ppmc312_table(&dev, &sigmoid));
    show("table", ppmc312_table(&dev, &TABLE));
    show("unknown to", ppmc312_move_to(&dev, 5));
    show("zero", ppmc312_set_position(&dev, false, 100));
    show("move", ppmc312_move(&dev, 3000));
    ending("move");
    where("after move");
    show("constant", start(PPMC312_CONSTANT, PPMC312_CCW, 200, 40, PPMC312_NOW));
    ending("constant");
    show("to", ppmc312_move_to(&dev, 1000));
    ending("to");
    show("there", ppmc312_move_to(&dev, 1000));
    show("step", start(PPMC312_STEP, PPMC312_CW, 0, 0, PPMC312_NOW));
    ending("step");
    where("after step");
}

static void changes(void)
{
    show("run", start(PPMC312_RUN_CONSTANT, PPMC312_CW, 200, 0, PPMC312_NOW));
    block_run_pulses(10);
    show("change", ppmc312_change(&dev, true, 100, PPMC312_NOW, 0));
    block_run_pulses(400);
    show("faster", ppmc312_change(&dev, false, 60, PPMC312_NOW, 0));
    block_run_pulses(700);
    show("slowly", ppmc312_stop(&dev, true, PPMC312_NOW, 0));
    ending("slowly");
    show("stop there", ppmc312_stop(&dev, false, PPMC312_AT_POSITION, 8000));
    show("run to", start(PPMC312_RUN, PPMC312_CW, 0, 0, PPMC312_NOW));
    ending("run to");
    report("override");
    show("jog", start(PPMC312_RUN_CONSTANT, PPMC312_CCW, 200, 0, PPMC312_NOW));
    block_run_pulses(20);
    show("stop", ppmc312_stop(&dev, false, PPMC312_NOW, 0));
    ending("stop");
    report("stop left");
}

static void events(void)
{
    static const uint8_t on[1] = {0x01};
    ppmc312_motion_t motion = {PPMC312_CONSTANT, PPMC312_CW, 200, 12, PPMC312_NOW};

    show("event", ppmc312_event(&dev, 0, 0x26, on, 1));
    show("event move", ppmc312_event_motion(&dev, 1, &motion));
    edge("event 0", BLOCK_EVT0);
    printf("%s outputs pins=%02x\n", way, block_outputs());
    edge("event 1", BLOCK_EVT1);
    pulses("event 1");
    show("delete", ppmc312_event_delete(&dev, 0));
    show("delete", ppmc312_event_delete(&dev, 1));
    show("nothing to delete", ppmc312_event_delete(&dev, 0));
}

static void ends(void)
{
    show("table", ppmc312_table(&dev, &TABLE));
    show("fl", start(PPMC312_CONSTANT, PPMC312_CW, 200, 100, PPMC312_NOW));
    block_run_pulses(20);
    block_pin(BLOCK_FL, false);
    ending("fl");
    show("fl ahead", ppmc312_move(&dev, 5));
    block_pin(BLOCK_FL, true);
    show("search", start(PPMC312_SEARCH, PPMC312_CCW, 200, 0, PPMC312_NOW));
    block_run_pulses(7);
    block_pin(BLOCK_ORG, false);
    ending("search");
    block_pin(BLOCK_ORG, true);
    show("held", (block_pin(BLOCK_RUN, false), start(PPMC312_CONSTANT, PPMC312_CW, 200, 6, PPMC312_NOW)));
    block_run(10000);
    pulses("held before");
    block_pin(BLOCK_RUN, true);
    ending("held");
    show("alarm", start(PPMC312_CONSTANT, PPMC312_CW, 200, 100, PPMC312_NOW));
    block_run_pulses(9);
    block_pin(BLOCK_ALM, false);
    ending("alarm");
    report("alarm report");
    block_pin(BLOCK_ALM, true);
    block_run(20000);
    show("in alarm", ppmc312_move(&dev, 5));
    show("clear", ppmc312_driver(&dev, PPMC312_ALARM_CLEAR));
    show("after clear", start(PPMC312_CONSTANT, PPMC312_CW, 200, 3, PPMC312_NOW));
    ending("after clear");
}

static void others(void)
{
    uint8_t inputs = 0;
    uint16_t control = 0;
    ppmc312_status_t status = {0, 0, 0};

    show("O inputs", ppmc312_inputs(&dev, &inputs));
    show("O control", ppmc312_control_inputs(&dev, &control));
    show("O status", ppmc312_status(&dev, &status));
    printf("%s levels inputs=%02x control=%04x state=%02x\n", way, inputs, control, status.condition);
    show("O outputs", ppmc312_outputs(&dev, 0x15));
    show("O mask", ppmc312_input_mask(&dev, 0));
    show("O limit", ppmc312_speed_limit(&dev, 60));
    show("O end", ppmc312_end_monitor(&dev, false));
    show("O in position", ppmc312_in_position(&dev, 0));
    show("O encoder", ppmc312_encoder(&dev, 5000));
    show("O encoder off", ppmc312_encoder(&dev, 0));
    show("O interlock", ppmc312_interlock_at(&dev, 77));
    show("O excitation", ppmc312_driver(&dev, PPMC312_EXCITATION_ON));
    show("O encoder zero", ppmc312_set_position(&dev, true, -5));
    {
        int32_t position = 0;
        ppmc104_result_t result = ppmc312_position(&dev, true, &position);
        printf("%s encoder result=%d position=%ld\n", way, (int)result, (long)position);
    }
}

static void arguments(void)
{
    static const uint8_t none[1] = {0};
    ppmc312_table_t bad = TABLE;
    ppmc312_curve_t curve = {PPMC312_1MHZ, 1, 0, NULL, NULL, NULL};

    show("A none", start(PPMC312_MOVE, PPMC312_CW, 0, 0, PPMC312_NOW));
    show("A zero", ppmc312_move(&dev, 0));
    show("A flags", start(PPMC312_MOVE, 0x01, 0, 5, PPMC312_NOW));
    show("A index", start(PPMC312_MOVE, PPMC312_INDEX, 0, 5, PPMC312_NOW));
    show("A fast", start(PPMC312_CONSTANT, PPMC312_CW, 49, 5, PPMC312_NOW));
    show("A slow", start(PPMC312_CONSTANT, PPMC312_CW, 251, 5, PPMC312_NOW));
    show("A search", start(PPMC312_SEARCH, PPMC312_CW, 0, 0, PPMC312_NOW));
    show("A position", start(PPMC312_MOVE, PPMC312_CW, 0, 5, PPMC312_AT_POSITION));
    show("A change", ppmc312_change(&dev, true, 0, PPMC312_NOW, 0));
    show("A outputs", ppmc312_outputs(&dev, 64));
    show("A limit", ppmc312_speed_limit(&dev, 1));
    show("A buffer", ppmc312_event(&dev, 2, 0x26, none, 1));
    show("A long event", ppmc312_event(&dev, 0, 0x26, none, 10));
    show("A delete", ppmc312_event_delete(&dev, 2));
    show("A driver", ppmc312_driver(&dev, (ppmc312_driver_t)0x40));
    bad.rate_start = 177;
    show("A span", ppmc312_table(&dev, &bad));
    bad = TABLE;
    bad.up = 0x1000000;
    show("A up", ppmc312_table(&dev, &bad));
    bad = TABLE;
    bad.rate_high = 1;
    show("A high", ppmc312_table(&dev, &bad));
    bad = TABLE;
    bad.rate_stop = 250;
    show("A down", ppmc312_table(&dev, &bad));
    show("A stages", ppmc312_curve(&dev, &curve));
    show("A ask", ppmc312_ask(&dev, 0x40, none, 30, NULL, NULL));
    pulses("A");
}

static void bus_only(void)
{
    static const uint16_t rates[3] = {100, 200, 400};
    static const uint32_t up[3] = {30, 20, 10}, down[2] = {15, 5};
    ppmc312_curve_t curve = {PPMC312_8MHZ, 3, 2, rates, up, down};
    ppmc312_table_t separate = TABLE;

    separate.rate_stop = 180;
    separate.down = 1500;
    show("B separate", ppmc312_table(&dev, &separate));
    show("B curve", ppmc312_curve(&dev, &curve));
    show("B move", ppmc312_move(&dev, 200));
    ending("B move");
    show("B event move", start(PPMC312_MOVE, PPMC312_CW, 0, 8, PPMC312_ON_EVENT1));
    edge("B event", BLOCK_EVT1);
    pulses("B event");
}

static void unconfirmed(void)
{
    const bool line = dev.line != NULL;
    uint8_t version;

    show("U reset", ppmc312_reset(&dev));
    if (line) block_run(20000);
    show("U open", ppmc312_open(&dev, &version));
    show("U table", ppmc312_table(&dev, &TABLE));
    show("U zero", ppmc312_set_position(&dev, false, 500));
    show("U move", ppmc312_move(&dev, 3000));
    block_run_pulses(100);
    block_reset(false, line);
    ending("U move");
    where("U where");
    show("U table", ppmc312_table(&dev, &TABLE));
    show("U zero", ppmc312_set_position(&dev, false, 500));
    block_reset(false, line);
    show("U table", ppmc312_table(&dev, &TABLE));
    where("U rest");
    show("U zero", ppmc312_set_position(&dev, false, 500));
    show("U move again", start(PPMC312_CONSTANT, PPMC312_CW, 200, 50, PPMC312_NOW));
    ending("U again");
    where("U again where");
    show("U nothing", ppmc312_wait(&dev, NULL));
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

static void line_faults(void)
{
    uint8_t version = 0, last = 0, counts[3] = {0, 0, 0};
    ppmc_line_t line = {block_send, block_receive, NULL, false};
    ppmc312_t other;
    int32_t position = 0;

    show("L zero", ppmc312_set_position(&dev, false, 0x1234));
    block_damage(1, 0x01);
    show("L digit", ppmc312_position(&dev, false, &position));
    printf("%s L digit position=%lx\n", way, (unsigned long)position);
    block_damage(8, 0x08); /* inverts bit 7 of a byte, which the checksum does not cover */
    show("L blind", ppmc312_position(&dev, false, &position));
    printf("%s L blind position=%lx\n", way, (unsigned long)position);
    block_damage(0, 0x02);
    show("L address", ppmc312_outputs(&dev, 1));
    show("L errors", ppmc312_line_errors(&dev, &last, counts));
    show("L station", ppmc312_setup_line(&other, &line, 16));
    (void)ppmc312_setup_line(&other, &line, 6);
    other.reply_ms = 5;
    printf("%s L absent result=%d\n", way, (int)ppmc312_open(&other, &version));
    show("L curve", ppmc312_ask(&dev, 0x41, NULL, 0, NULL, NULL));
}

int main(void)
{
    static const ppmc_line_t line = {block_send, block_receive, NULL, false};
    uint8_t version = 0;

    way = "bus";
    block_reset(false, false);
    ppmc312_setup(&dev, block_read, block_write, NULL);
    moves();
    changes();
    events();
    ends();
    others();
    arguments();
    bus_only();
    unconfirmed();
    block_reset(true, false);
    dev.bus.limit = 50;
    show("dead", ppmc312_open(&dev, &version));
    ppmc312_setup(&dev, ones, block_write, NULL);
    dev.bus.limit = 50;
    show("ones", ppmc312_open(&dev, &version));
    ppmc312_setup(&dev, zeros, block_write, NULL);
    dev.bus.limit = 50;
    show("zeros", ppmc312_open(&dev, &version));

    way = "line";
    block_reset(false, true);
    show("setup", ppmc312_setup_line(&dev, &line, 5));
    moves();
    changes();
    events();
    ends();
    others();
    arguments();
    unconfirmed();
    line_faults();
    printf("done\n");
    return 0;
}
