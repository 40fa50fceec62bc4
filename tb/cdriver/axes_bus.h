/* SPDX-License-Identifier: Apache-2.0 */
/* Simulated bus for the test of the PPMC-2104 C driver. The axes are 1 and 2. */
#ifndef AXES_BUS_H
#define AXES_BUS_H

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef enum { AXES_FL, AXES_BL, AXES_FHL, AXES_BHL, AXES_ORG, AXES_ALM } axes_input_t;

/* Access functions for ppmc2104_setup(). ctx is not used. */
uint8_t axes_read(void *ctx, unsigned reg);
void axes_write(void *ctx, unsigned reg, uint8_t value);
void axes_run_pins(void *ctx, unsigned axes);

void axes_reset(bool held);
void axes_run(unsigned cycles);
void axes_run_pulses(unsigned axis, unsigned count); /* until `count` pulses; after 1 s, the program ends */
void axes_input(axes_input_t which, unsigned axis, bool active);
bool axes_irq(void);
unsigned axes_pulses(unsigned axis);
void axes_print_pulses(const char *name, unsigned axis);

#ifdef __cplusplus
}
#endif

#endif
