/* SPDX-License-Identifier: Apache-2.0 */
/* Runs the C driver of the PMC006B4 on the simulated line, and prints one result per line. pytest checks
 * the lines. */
#include <stdio.h>

#include "../../drivers/c/pmc006.h"
#include "frame_bus.h"

static const ppmc_line_t LINE = {frame_send, frame_receive, NULL, false};
static pmc006_t dev;

static void show(const char *name, ppmc104_result_t result)
{
    printf("%s result=%d text=%s\n", name, (int)result, ppmc104_strerror(result));
}

static void ending(const char *name)
{
    pmc006_end_t e = {false, false, false, false, false, 0, 0};
    ppmc104_result_t result = pmc006_wait(&dev, &e);
    printf("%s wait=%d complete=%d ext1=%d ext2=%d stopped=%d steps=%ld position=%ld\n", name, (int)result,
           e.complete, e.ext1, e.ext2, e.stopped, (long)e.steps, (long)e.position);
    frame_print_steps(name);
}

static void where(const char *name)
{
    int32_t position = 0;
    ppmc104_result_t result = pmc006_position(&dev, &position);
    printf("%s result=%d position=%ld\n", name, (int)result, (long)position);
}

static void value(const char *name, char setting)
{
    int32_t got = 0;
    ppmc104_result_t result = pmc006_get(&dev, setting, &got);
    printf("%s result=%d value=%ld\n", name, (int)result, (long)got);
}

static void moves(void)
{
    show("setup", pmc006_setup(&dev, &LINE, PMC006_FACTORY));
    show("open", pmc006_open(&dev));
    where("unknown");
    show("unknown to", pmc006_move_to(&dev, 5));
    show("speed", pmc006_set(&dev, PMC006_MAX_SPEED, 16000));
    show("speed", pmc006_set(&dev, PMC006_START_SPEED, 3000));
    show("speed", pmc006_set(&dev, PMC006_STOP_SPEED, 3000));
    show("speed", pmc006_set(&dev, PMC006_ACCELERATION, 5));
    show("speed", pmc006_set(&dev, PMC006_DECELERATION, 5));
    show("zero", pmc006_set_position(&dev, 100));
    show("move", pmc006_move(&dev, 400));
    show("move again", pmc006_move(&dev, 5));
    ending("move");
    show("back", pmc006_move_to(&dev, 450));
    ending("back");
    where("after back");
    show("there", pmc006_move_to(&dev, 450));
    show("run", pmc006_run(&dev, true, 4000));
    frame_run_steps(100);
    show("faster", pmc006_set(&dev, PMC006_MAX_SPEED, 8000));
    frame_run_steps(300);
    show("slowly", pmc006_stop_slowly(&dev));
    ending("slowly");
    show("long", pmc006_move(&dev, -100000));
    frame_run_steps(50);
    show("long slowly", pmc006_stop_slowly(&dev));
    show("stop", pmc006_stop(&dev));
    ending("stop");
    show("nothing", pmc006_wait(&dev, NULL));
}

static void switches(void)
{
    pmc006_status_t status;

    show("ext on", pmc006_set(&dev, PMC006_EXT_ON, 2));
    show("ext move", pmc006_move(&dev, 5000));
    frame_run_steps(60);
    frame_ext(2, false);
    ending("ext");
    show("ext refused", pmc006_move(&dev, 5));
    frame_ext(2, true);
    show("ext clear", pmc006_clear_stops(&dev));
    frame_switch(40, false);
    show("home", pmc006_home(&dev, 1, false, 20));
    frame_print_steps("home");
    where("at home");
    show("home status", pmc006_status(&dev, &status));
    printf("home ext_on=%d busy=%d forward=%d\n", status.ext_on, status.busy, status.forward);
    frame_ext(1, true);
}

static void settings(void)
{
    static const struct {
        char setting;
        int32_t low, high;
    } all[] = {{'u', 0, 5}, {'o', 0, 5}, {'v', 1, 16000}, {'L', 65, 3000}, {'S', 65, 3000}, {'m', 0, 128},
               {'e', 400, 4000}, {'Q', 1, 4}, {'M', 100, 1200}, {'P', 300, 2000}, {'J', 0, 3}, {'T', 0, 63},
               {'Y', 0, 7}, {'Z', 0, 511}};
    unsigned n;

    for (n = 0; n < sizeof all / sizeof all[0]; ++n) {
        int32_t low = -1, high = -1;
        ppmc104_result_t first = pmc006_set(&dev, all[n].setting, all[n].low);
        ppmc104_result_t got = pmc006_get(&dev, all[n].setting, &low);
        ppmc104_result_t second = pmc006_set(&dev, all[n].setting, all[n].high);
        ppmc104_result_t got_too = pmc006_get(&dev, all[n].setting, &high);
        printf("setting of=%c set=%d%d get=%d%d ok=%d below=%d above=%d\n", all[n].setting, (int)first, (int)second,
               (int)got, (int)got_too, low == all[n].low && high == all[n].high,
               (int)pmc006_set(&dev, all[n].setting, all[n].low - 1),
               (int)pmc006_set(&dev, all[n].setting, all[n].high + 1));
    }
    show("A microsteps", pmc006_set(&dev, PMC006_MICROSTEPS, 3));
    show("A microsteps 1", pmc006_set(&dev, PMC006_MICROSTEPS, 1));
    show("A unknown", pmc006_set(&dev, '?', 1));
    show("A read only", pmc006_set(&dev, PMC006_VERSION, 1));
    show("A none", pmc006_move(&dev, 0));
    show("A lowest", pmc006_move(&dev, INT32_MIN));
    show("A speed", pmc006_run(&dev, true, 16001));
    show("A no speed", pmc006_run(&dev, true, 0));
    show("A outputs", pmc006_outputs(&dev, 32));
    show("A address", pmc006_set_address(&dev, 121));
    show("A ext", pmc006_home(&dev, 3, true, 5));
    show("A back", pmc006_home(&dev, 1, true, 0));
    show("A instruction", pmc006_program_run(&dev, 100));
    show("A words", pmc006_program(&dev, NULL, 201));
    show("A setup", pmc006_setup(&dev, &LINE, 121));
    value("version", PMC006_VERSION);
    show("outputs", pmc006_outputs(&dev, 0x15));
    printf("pins gpo=%02x\n", frame_outputs());
    show("release", pmc006_set(&dev, PMC006_RELEASE, 1));
    show("released", pmc006_move(&dev, 5));
    show("release", pmc006_set(&dev, PMC006_RELEASE, 0));
}

static void memory(void)
{
    /* Program: set output 2, make 200 steps, wait for standstill, set output 1, end. */
    static const uint32_t words[10] = {0x0211, 1, 0x0001, 200, 0x0810, 0, 0x0111, 1, 0x0000, 0};
    pmc006_status_t status;

    show("M speed", pmc006_set(&dev, PMC006_MAX_SPEED, 8000));
    show("M address", pmc006_set_address(&dev, 7));
    show("M current", pmc006_set(&dev, PMC006_CURRENT, 1200));
    show("M save", pmc006_save(&dev));
    frame_reset();
    show("M open", pmc006_open(&dev));
    value("M kept", PMC006_CURRENT);
    frame_eeprom(false);
    show("M missing", pmc006_save(&dev));
    frame_eeprom(true); /* the memory is blank after a loss of power */
    show("M save again", pmc006_save(&dev));
    show("M speed", pmc006_set(&dev, PMC006_MAX_SPEED, 8000));
    show("M outputs", pmc006_outputs(&dev, 0));
    show("M program", pmc006_program(&dev, words, 10));
    show("M burn", pmc006_program_burn(&dev));
    frame_print_steps("M before");
    show("M run", pmc006_program_run(&dev, 0));
    show("M while", pmc006_program(&dev, words + 2, 2));
    show("M halt", pmc006_program_halt(&dev));
    frame_run_steps(200);
    do {
        show("M status", pmc006_status(&dev, &status));
    } while (status.busy);
    frame_print_steps("M run");
    printf("M pins gpo=%02x\n", frame_outputs());
}

static void faults(void)
{
    pmc006_t other;

    show("F speed", pmc006_set(&dev, PMC006_MAX_SPEED, 3000));
    show("F zero", pmc006_set_position(&dev, 77));
    frame_damage(4, 0x10);
    where("F sum");
    frame_damage(0, 0x01);
    where("F head");
    frame_damage(2, 0x08);
    where("F address");
    frame_damage(7, 0x80);
    show("F start", pmc006_set(&dev, PMC006_START_SPEED, 3000));
    show("F stop", pmc006_set(&dev, PMC006_STOP_SPEED, 3000));
    /* The reply to a start is damaged, so pmc006_wait() must determine whether the motor moves. Seven
     * replies precede it: status twice, q, j, O, d, c. */
    frame_damage(8 * 7 + 4, 0x01);
    show("F lost", pmc006_move(&dev, 60));
    ending("F lost");
    where("F where");
    (void)pmc006_setup(&other, &LINE, 55);
    other.reply_ms = 5;
    show("F absent", pmc006_open(&other));
}

static void unconfirmed(void)
{
    show("U zero", pmc006_set_position(&dev, 500));
    show("U move", pmc006_move(&dev, 3000));
    frame_run_steps(250);
    frame_reset();
    show("U open", pmc006_set(&dev, PMC006_STALL_MODE, 0));
    ending("U move");
    where("U where");
    show("U speed", pmc006_set(&dev, PMC006_MAX_SPEED, 3000));
    show("U zero", pmc006_set_position(&dev, 500));
    where("U set");
    frame_reset();
    where("U rest");
}

int main(void)
{
    frame_reset();
    moves();
    switches();
    settings();
    memory();
    faults();
    unconfirmed();
    printf("done\n");
    return 0;
}
