/* SPDX-License-Identifier: Apache-2.0 */
/* Simulated PPMC-312 for the test of its C driver: parallel bus, or station 5 of a line at 83 333 baud. */
#ifndef BLOCK_BUS_H
#define BLOCK_BUS_H

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef enum { BLOCK_FL, BLOCK_BL, BLOCK_FHL, BLOCK_ORG, BLOCK_ALM, BLOCK_RUN, BLOCK_EVT0, BLOCK_EVT1 } block_pin_t;

uint8_t block_read(void *ctx, unsigned reg);
void block_write(void *ctx, unsigned reg, uint8_t value);
void block_send(void *ctx, const uint8_t *bytes, unsigned count);
bool block_receive(void *ctx, uint8_t *byte, unsigned milliseconds);

void block_reset(bool held, bool line);          /* line = true: serial mode, line = false: parallel bus */
void block_run(unsigned cycles);
void block_run_pulses(unsigned count);           /* until `count` pulses; after 1 s, the program ends */
void block_pin(block_pin_t which, bool high);
void block_damage(unsigned at, uint8_t flip);    /* invert bits of received byte number `at` of the line */
unsigned block_outputs(void);                    /* levels of the pins auxo_n */
void block_print_pulses(const char *name);

#ifdef __cplusplus
}
#endif

#endif
