/* SPDX-License-Identifier: Apache-2.0 */
/* A PPMC-312 on a memory-mapped bus (register n at byte address 4 n): ramps, origin, move to a position. */
#include <stdint.h>

#include "../ppmc312.h"

#ifndef PPMC312_BASE
#define PPMC312_BASE 0x40000000u
#endif

static uint8_t bus_read(void *ctx, unsigned reg)
{
    return (uint8_t)(((volatile uint32_t *)ctx)[reg] & 0xFFu);
}

static void bus_write(void *ctx, unsigned reg, uint8_t value)
{
    ((volatile uint32_t *)ctx)[reg] = value;
}

int main(void)
{
    /* 1000 to 5000 pulses/s in 2000 pulses. */
    const ppmc312_table_t table = {PPMC312_1MHZ, false, 1000u, 200u, 2000u, 0u, 0u};
    const ppmc312_motion_t home = {PPMC312_RETURN, PPMC312_CCW, 0u, 0u, PPMC312_NOW};
    static ppmc312_t part;
    ppmc312_end_t end = {0u, false, 0};
    ppmc104_result_t result;

    ppmc312_setup(&part, bus_read, bus_write, (void *)(uintptr_t)PPMC312_BASE);
    part.bus.limit = 100000000ul; /* number of polls; a motion may take long */
    result = ppmc312_open(&part, 0);
    if (result == PPMC104_OK) result = ppmc312_table(&part, &table);
    if (result == PPMC104_OK) result = ppmc312_start(&part, &home);
    if (result == PPMC104_OK) result = ppmc312_wait(&part, &end);
    if (result == PPMC104_OK && end.cause != PPMC312_CAUSE_ORIGIN) return 100; /* a switch ended the search */
    if (result == PPMC104_OK) result = ppmc312_set_position(&part, false, 0);
    if (result == PPMC104_OK) result = ppmc312_move_to(&part, 5000);
    if (result == PPMC104_OK) result = ppmc312_wait(&part, &end);
    return (int)result;
}
