/* SPDX-License-Identifier: Apache-2.0 */
/* Simulated ISA bus for the test of the STMC driver: a J105 board, 8-bit I/O accesses, and the steps of
 * its motor. */
#ifndef ISA_BUS_H
#define ISA_BUS_H

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef enum { ISA_L1, ISA_L2, ISA_L3, ISA_L4, ISA_CNP, ISA_MON } isa_input_t;

/* Port functions of the driver in this test. A read of an unused port returns FFh. */
uint8_t isa_in(unsigned port);
void isa_out(unsigned port, uint8_t value);
#define STMC_INB(port) isa_in(port)
#define STMC_OUTB(port, value) isa_out((port), (value))

void isa_reset(bool held);                   /* true: keep the reset active, false: reset pulse */
void isa_run(unsigned clk);                  /* run this number of cycles */
void isa_run_steps(unsigned count);          /* run until `count` steps; after 1 s, the program ends */
void isa_level(isa_input_t which, bool high);
bool isa_irq(void);                          /* level of the IRQ line */
unsigned isa_steps(void);                    /* number of steps since isa_print_steps() */
void isa_print_steps(const char *name);      /* "name cw=… ccw=… at t t t …"; times in cycles */

#ifdef __cplusplus
}
#endif

#endif
