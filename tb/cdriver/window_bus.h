/* SPDX-License-Identifier: Apache-2.0 */
/* Simulated window for the test of the bank's C driver: a bank of 8 axes, and the pulses of each axis. */
#ifndef WINDOW_BUS_H
#define WINDOW_BUS_H

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Access functions for ppmc_bank_open(). ctx is not used. Accesses are as short as the window allows
 * (BANK-WIN-04). */
uint8_t window_read(void *ctx, unsigned address);
void window_write(void *ctx, unsigned address, uint8_t value);

void window_reset(bool held);                              /* true: keep the reset active, false: reset pulse */
void window_run(unsigned clk);                             /* run this number of cycles */
void window_run_pulses(unsigned axis, unsigned count);     /* run until `count` pulses; at most 1 s */
void window_limit(unsigned axis, bool active);             /* CW limit of the axis */
bool window_irq(void);                                     /* true: int_n is low */
void window_print_pulses(const char *name, unsigned axis); /* "name cw=… ccw=… at t t t …"; times in cycles */

#ifdef __cplusplus
}
#endif

#endif
