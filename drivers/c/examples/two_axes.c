/* SPDX-License-Identifier: Apache-2.0 */
/* A PPMC-2104 on the bus of a soft CPU: both axes start on the same clock edge. A sketch: insert your RUN
 * pins. */
#include <stdint.h>

#include "../ppmc2104.h"

/* Addresses in your address decoder: data at +0, status and instruction code at +4, RUN pins at +16. */
#ifndef PPMC2104_BASE
#define PPMC2104_BASE 0x40000000u
#endif

static uint8_t bus_read(void *ctx, unsigned reg)
{
    return (uint8_t)(((volatile uint32_t *)ctx)[reg] & 0xFFu);
}

static void bus_write(void *ctx, unsigned reg, uint8_t value)
{
    ((volatile uint32_t *)ctx)[reg] = value;
}

static void run_pins(void *ctx, unsigned axes)
{
    ((volatile uint32_t *)ctx)[4] = axes;
}

int main(void)
{
    const ppmc2104_config_t config = {4u, false, true, false, 99u, 49u, 200u};
    const ppmc2104_motion_t x = {PPMC2104_MOVE, PPMC104_CW, 0u, 1000u};
    const ppmc2104_motion_t y = {PPMC2104_CONSTANT, PPMC104_CCW, 120u, 700u};
    ppmc2104_t part;
    ppmc104_result_t result;

    ppmc2104_setup(&part, bus_read, bus_write, run_pins, (void *)(uintptr_t)PPMC2104_BASE);
    result = ppmc2104_open(&part);
    if (result == PPMC104_OK) result = ppmc2104_init(&part, 1u, &config);
    if (result == PPMC104_OK) result = ppmc2104_init(&part, 2u, &config);
    if (result == PPMC104_OK) result = ppmc2104_start_both(&part, &x, &y);
    if (result == PPMC104_OK) result = ppmc2104_wait(&part, 1u, 0);
    if (result == PPMC104_OK) result = ppmc2104_wait(&part, 2u, 0);
    return (int)result; /* on a console, print ppmc104_strerror(result) */
}
