/* SPDX-License-Identifier: Apache-2.0 */
/* Program of a LiteX SoC with a PPMC-104 ("stepper") and, optionally, a bank ("bank"): makes moves with
 * the C drivers of this project, and prints one result per line on the UART. pytest checks the lines, and
 * the pulses that the test bench counts. */
#include <generated/csr.h>
#include <generated/mem.h>
#include <generated/soc.h>
#include <irq.h>

#include "ppmc104.h"
#include "ppmc_bank.h"

static uint8_t rd(void *base, unsigned reg) { return (uint8_t)((volatile uint32_t *)base)[reg]; }
static void wr(void *base, unsigned reg, uint8_t value) { ((volatile uint32_t *)base)[reg] = value; }

static const ppmc104_speed_t speed = {CONFIG_CLOCK_FREQUENCY, PPMC104_BASE_500K, 0, false};
static ppmc104_t stepper;
static volatile unsigned interrupts;

/* The compiler uses these functions to copy structures, and there is no C library. */
void *memcpy(void *to, const void *from, unsigned long size)
{
    char *d = to;
    const char *s = from;
    while (size--) *d++ = *s++;
    return to;
}

void *memset(void *to, int value, unsigned long size)
{
    char *d = to;
    while (size--) *d++ = (char)value;
    return to;
}

/* crt0.S calls this function. The interrupt is a level that a read of the finish status clears. Until
 * then, it is masked. */
void isr(void)
{
    if (irq_pending() & irq_getmask() & (1u << STEPPER_INTERRUPT)) {
        ++interrupts;
        stepper_ev_enable_write(0);
    }
}

static void put(const char *text)
{
    for (; *text; ++text) {
        while (uart_txfull_read()) {}
        uart_rxtx_write((uint8_t)*text);
    }
}

static void value(const char *name, long number)
{
    char digits[12], *at = digits + sizeof digits - 1;
    unsigned long rest = number < 0 ? 0ul - (unsigned long)number : (unsigned long)number;
    *at = 0;
    do {
        *--at = (char)('0' + rest % 10);
        rest /= 10;
    } while (rest);
    put(name);
    if (number < 0) put("-");
    put(at);
}

static ppmc104_config_t config(void)
{
    ppmc104_config_t c = {4, false, true, false, false, 0, 0, 20};
    value("rates start=", ppmc104_rate_from_pps(&speed, 2500, &c.rate_start));
    value(" high=", ppmc104_rate_from_pps(&speed, 10000, &c.rate_high));
    put("\n");
    return c;
}

/* Make a move whose end is reported by an interrupt. */
static void move(const char *name, uint8_t flags, uint32_t pulses)
{
    ppmc104_finish_t finish = {false, false, false, false, false, 0, 0};
    uint32_t left = 0;
    unsigned before = interrupts;

    stepper_ev_enable_write(1);
    put(name);
    value(" move=", ppmc104_move(&stepper, flags, pulses));
    value(" early=", (long)(interrupts - before));
    while (interrupts == before) {}
    value(" interrupts=", (long)(interrupts - before));
    value(" pending=", (long)stepper_ev_status_read());
    value(" finish=", ppmc104_finish(&stepper, &finish));
    value(" lifted=", !stepper_ev_status_read());
    value(" ended=", finish.ended);
    value(" limit=", finish.limit);
    value(" read=", ppmc104_remaining(&stepper, &finish, &left));
    value(" left=", (long)left);
    put("\n");
}

#ifdef BANK_BASE
static void axes(void)
{
    static ppmc_bank_axis_t axis[4];
    ppmc_bank_t bank;
    ppmc104_config_t c = config();
    uint8_t flags[4] = {PPMC104_CW, PPMC104_CCW, PPMC104_CW, PPMC104_CCW};
    unsigned n;
    int32_t position;

    value("bank open=", ppmc_bank_open(&bank, rd, wr, (void *)BANK_BASE));
    value(" axes=", bank.axes);
    put("\n");
    for (n = 0; n < 4; ++n) {
        ppmc_bank_axis(&bank, n, &axis[n]);
        value("axis init=", ppmc104_init(&axis[n].part, &c));
        value(" move=", ppmc104_move(&axis[n].part, flags[n], 50 + 10 * n));
        put("\n");
    }
    for (n = 0; n < 4; ++n) {
        value("axis wait=", ppmc104_wait(&axis[n].part, 0));
        value(" read=", ppmc_bank_position(&bank, n, &position));
        value(" position=", position);
        put("\n");
    }
}
#endif

int main(void)
{
    ppmc104_config_t c;

    irq_setmask(1u << STEPPER_INTERRUPT);
    irq_setie(1);
    c = config();
    ppmc104_setup(&stepper, rd, wr, (void *)STEPPER_BASE);
    value("probe=", ppmc104_probe(&stepper));
    value(" init=", ppmc104_init(&stepper, &c));
    put("\n");
    move("cw", PPMC104_CW, 300);
    move("ccw", PPMC104_CCW, 120);
    put("switch\n"); /* after 50 more pulses, the test bench activates L1 */
    move("limited", PPMC104_CW, 200);
#ifdef BANK_BASE
    axes();
#endif
    put("done\n");
    return 0;
}
