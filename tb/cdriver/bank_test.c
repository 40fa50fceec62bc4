/* SPDX-License-Identifier: Apache-2.0 */
/* Runs the C driver of the bank on the simulated window, and prints one result per line. pytest checks the
 * lines. */
#include <stdio.h>

#include "../../drivers/c/ppmc_bank.h"
#include "window_bus.h"

#define AXES 8u

static const ppmc104_config_t CONFIG = {4, false, true, false, false, 59, 39, 6};
static ppmc_bank_t bank;
static ppmc_bank_axis_t axes[AXES];

static void show(const char *name, ppmc104_result_t result)
{
    printf("%s result=%d text=%s\n", name, (int)result, ppmc104_strerror(result));
}

/* Print the end of a motion, then its pulses. */
static void ending(const char *name, unsigned n)
{
    ppmc104_finish_t f = {false, false, false, false, false, 0, 0};
    uint32_t left = 0;
    int32_t position = 0;
    ppmc104_result_t waited = ppmc104_wait(&axes[n].part, &f);
    ppmc104_result_t asked = ppmc104_remaining(&axes[n].part, &f, &left);
    ppmc104_result_t where = ppmc_bank_position(&bank, n, &position);
    printf("%s wait=%d read=%d raw=%02x left=%lu position=%ld where=%d\n", name, (int)waited, (int)asked, f.raw,
           (unsigned long)left, (long)position, (int)where);
    window_print_pulses(name, n);
}

static void start(void)
{
    unsigned n;

    window_reset(true);
    show("absent", ppmc_bank_open(&bank, window_read, window_write, NULL));
    window_reset(false);
    window_run(32);
    window_write(NULL, PPMC_BANK_ADDRESS(0, PPMC_BANK_REG_MASK), 0x0F);
    show("open", ppmc_bank_open(&bank, window_read, window_write, NULL));
    printf("found axes=%u mask=%u\n", bank.axes, window_read(NULL, PPMC_BANK_ADDRESS(0, PPMC_BANK_REG_MASK)));
    for (n = 0; n < AXES; ++n) {
        show("axis", ppmc_bank_axis(&bank, n, &axes[n]));
        if (n != 1) show("init", ppmc104_init(&axes[n].part, &CONFIG));
    }
}

static void axes_alone(void)
{
    int32_t all[PPMC_BANK_AXES_MAX];
    unsigned n;

    show("move", ppmc104_move(&axes[7].part, PPMC104_CW, 30));
    show("constant", ppmc104_move_constant(&axes[3].part, PPMC104_CCW, 24, 12));
    printf("both busy=%llu irq=%d\n", (unsigned long long)ppmc_bank_busy(&bank), (int)window_irq());
    while (ppmc_bank_busy(&bank)) {}
    printf("ended pending=%llu irq=%d\n", (unsigned long long)ppmc_bank_pending(&bank), (int)window_irq());
    ending("move", 7);
    ending("constant", 3);
    printf("read pending=%llu irq=%d\n", (unsigned long long)ppmc_bank_pending(&bank), (int)window_irq());
    show("config", ppmc_bank_config(&bank, 3, false, true));
    show("slow", ppmc104_move_constant(&axes[3].part, PPMC104_CW, 9, 4));
    ending("slow", 3);
    show("config", ppmc_bank_config(&bank, 3, true, true));
    show("step", ppmc104_step(&axes[1].part, PPMC104_CW));
    ppmc_bank_positions(&bank, all);
    for (n = 0; n < AXES; ++n) printf("position axis=%u pulses=%ld\n", n, (long)all[n]);
}

static void groups(void)
{
    ppmc_bank_set_t refused = 0;

    show("hold", ppmc_bank_hold(&bank, 1u << 0 | 1u << 3 | 1u << 7));
    show("load", ppmc104_move(&axes[0].part, PPMC104_CW, 20));
    show("load", ppmc104_move_constant(&axes[3].part, PPMC104_CCW, 30, 5));
    show("load", ppmc104_move(&axes[7].part, PPMC104_CCW, 3));
    window_run(20000);
    window_print_pulses("held", 0);
    show("go", ppmc_bank_go(&bank, &refused));
    printf("started refused=%llu\n", (unsigned long long)refused);
    ending("first", 0);
    ending("second", 3);
    ending("third", 7);
    show("hold", ppmc_bank_hold(&bank, 1u << 0 | 1u << 1));
    show("load", ppmc104_move(&axes[0].part, PPMC104_CW, 5));
    show("go alone", ppmc_bank_go(&bank, &refused));
    printf("alone refused=%llu\n", (unsigned long long)refused);
    ending("alone", 0);
    show("hold", ppmc_bank_hold(&bank, 1u << 0));
    show("load", ppmc104_move(&axes[0].part, PPMC104_CW, 5));
    ppmc_bank_drop(&bank);
    ending("dropped", 0);
}

static void stops(void)
{
    show("load", ppmc104_move(&axes[6].part, PPMC104_CW, 100));
    show("load", ppmc104_move(&axes[5].part, PPMC104_CW, 40));
    window_run_pulses(6, 20);
    window_limit(6, true);
    ending("limit", 6);
    window_limit(6, false);
    ending("other", 5);
    show("load", ppmc104_jog(&axes[2].part, PPMC104_CW, 30));
    show("load", ppmc104_move(&axes[4].part, PPMC104_CCW, 1000));
    window_run_pulses(2, 9);
    ppmc_bank_stop_all(&bank);
    ending("jog", 2);
    ending("stopped", 4);
}

/* Reset the bank during a motion. */
static void reset(void)
{
    uint32_t left = 0;
    ppmc104_finish_t f = {false, false, false, false, false, 0, 0};

    show("load", ppmc104_move(&axes[0].part, PPMC104_CW, 1000));
    window_run_pulses(0, 7);
    window_reset(false);
    window_run(32);
    show("reset", ppmc104_wait(&axes[0].part, &f));
    show("reset left", ppmc104_remaining(&axes[0].part, &f, &left));
}

int main(void)
{
    start();
    axes_alone();
    groups();
    stops();
    reset();
    printf("done\n");
    return 0;
}
