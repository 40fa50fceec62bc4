/* SPDX-License-Identifier: Apache-2.0 */
/* Simulated PMC006B4 with an EEPROM, for the test of its C driver: 8 MHz, 115 200 baud. */
#ifndef FRAME_BUS_H
#define FRAME_BUS_H

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

void frame_send(void *ctx, const uint8_t *bytes, unsigned count);
bool frame_receive(void *ctx, uint8_t *byte, unsigned milliseconds);

void frame_reset(void);
void frame_run_steps(unsigned count);          /* until `count` steps; after 2 s, the program ends */
void frame_ext(unsigned number, bool high);
void frame_switch(unsigned after, bool high);  /* set EXT1 at step number `after`, counted from now */
void frame_eeprom(bool on);
void frame_damage(unsigned at, uint8_t flip);  /* invert bits of received byte number `at` */
unsigned frame_outputs(void);
void frame_print_steps(const char *name);

#ifdef __cplusplus
}
#endif

#endif
