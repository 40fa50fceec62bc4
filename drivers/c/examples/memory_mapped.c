/* SPDX-License-Identifier: Apache-2.0 */
/* A PPMC-104 on the bus of a soft CPU, through ppmc_wishbone or ppmc_axil: initialise, find the origin,
 * move. */
#include <stdint.h>

#include "../ppmc104.h"

/* Address of the bridge in your address decoder: data at +0, status and command at +4, interrupt at +8. */
#ifndef PPMC104_BASE
#define PPMC104_BASE 0x40000000u
#endif

static uint8_t bus_read(void *ctx, unsigned reg)
{
    volatile uint32_t *base = (volatile uint32_t *)ctx;
    return (uint8_t)(base[reg] & 0xFFu);
}

static void bus_write(void *ctx, unsigned reg, uint8_t value)
{
    volatile uint32_t *base = (volatile uint32_t *)ctx;
    base[reg] = value;
}

int main(void)
{
    const ppmc104_speed_t speed = {16000000u, PPMC104_BASE_500K, 0u, false};
    ppmc104_config_t config = {4u, false, true, false, false, 0u, 0u, 100u};
    ppmc104_t axis;
    ppmc104_finish_t finish;
    uint8_t search;
    ppmc104_result_t result;

    ppmc104_setup(&axis, bus_read, bus_write, (void *)(uintptr_t)PPMC104_BASE);
    result = ppmc104_rate_from_pps(&speed, 2500u, &config.rate_start);
    if (result == PPMC104_OK) result = ppmc104_rate_from_pps(&speed, 10000u, &config.rate_high);
    if (result == PPMC104_OK) result = ppmc104_rate_from_pps(&speed, 2000u, &search);
    if (result == PPMC104_OK) result = ppmc104_probe(&axis);
    if (result == PPMC104_OK) result = ppmc104_init(&axis, &config);
    if (result == PPMC104_OK) result = ppmc104_home(&axis, PPMC104_CCW, search);
    if (result == PPMC104_OK) result = ppmc104_wait(&axis, &finish);
    if (result == PPMC104_OK && finish.limit) return 100; /* the limit was active before the origin */
    if (result == PPMC104_OK) result = ppmc104_move(&axis, PPMC104_CW, 1000u);
    if (result == PPMC104_OK) result = ppmc104_wait(&axis, &finish);
    return (int)result; /* on a console, print ppmc104_strerror(result) */
}
