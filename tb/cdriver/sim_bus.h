/* SPDX-License-Identifier: Apache-2.0 */
/* Simulated bus for the test of the C driver: a PPMC-104 accessed through ppmc_wishbone, as in the
 * template. */
#ifndef SIM_BUS_H
#define SIM_BUS_H

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef enum { SIM_L1, SIM_L2, SIM_L3, SIM_L4, SIM_CNP, SIM_ALM } sim_switch_t;

/* Access functions for ppmc104_setup(). ctx is not used. If a read gets no response for 64 cycles, it
 * returns 0xFF. */
uint8_t sim_read(void *ctx, unsigned reg);
void sim_write(void *ctx, unsigned reg, uint8_t value);

void sim_reset(bool held);               /* true: keep the reset active (no responses), false: reset pulse */
void sim_run(unsigned clk);              /* run this number of cycles */
void sim_run_pulses(unsigned count);     /* run until `count` pulses; after 1 s, the program ends */
void sim_switch(sim_switch_t which, bool active);
unsigned sim_phases(void);               /* levels of the pins S5..S1 in bits 4..0 */
bool sim_irq(void);                      /* level of the interrupt pin of the bridge */
uint32_t sim_bridge(void);               /* bridge register; one bus access */
unsigned sim_cycles(void);               /* number of bus accesses with a response so far */
unsigned sim_pulses(void);               /* number of pulses since sim_forget() */
void sim_forget(void);
void sim_print_pulses(const char *name); /* "name cw=… ccw=… at t t t …"; times in cycles */

#ifdef __cplusplus
}
#endif

#endif
