/* SPDX-License-Identifier: Apache-2.0 */
/* The simulated bus that the C driver is tested on: a PPMC-104 behind ppmc_wishbone, as the template has it. */
#ifndef SIM_BUS_H
#define SIM_BUS_H

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef enum { SIM_L1, SIM_L2, SIM_L3, SIM_L4, SIM_CNP, SIM_ALM } sim_switch_t;

/* Access functions for ppmc104_setup(); ctx is not used. A read that nobody answers for 64 clk gives 0xFF. */
uint8_t sim_read(void *ctx, unsigned reg);
void sim_write(void *ctx, unsigned reg, uint8_t value);

void sim_reset(bool held);               /* pulse the reset, or leave it active: nobody answers then */
void sim_run(unsigned clk);              /* let time pass */
void sim_run_pulses(unsigned count);     /* until the recorded pulses are that many; ends the program after 1 s */
void sim_switch(sim_switch_t which, bool active);
unsigned sim_phases(void);               /* pins S5..S1 in bits 4..0 */
bool sim_irq(void);                      /* interrupt pin of the bridge */
uint32_t sim_bridge(void);               /* bridge register, a bus cycle */
unsigned sim_cycles(void);               /* bus cycles answered so far */
unsigned sim_pulses(void);               /* pulses since sim_forget() */
void sim_forget(void);
void sim_print_pulses(const char *name); /* "name cw=… ccw=… at t t t …", times in clk */

#ifdef __cplusplus
}
#endif

#endif
