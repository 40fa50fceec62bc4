/* SPDX-License-Identifier: Apache-2.0 */
/* A PPMC-104 on the pins of a microcontroller; the software generates the strobes. A sketch: insert your
 * pin functions. Times of the part (docs/ppmc104/README.md, chapter 4, at CLK_HZ = 16 MHz): read data are
 * valid 250 ns after the start of the read strobe, a write strobe lasts at least 73 ns, and strobes are at
 * least 73 ns apart. On most controllers, one function call per pin takes long enough. On a faster
 * controller, call bus_delay(). The port must be 5 V tolerant, or the part must run at 3.3 V. */
#include "../ppmc104.h"

#include <stdio.h>

/* ---- write these functions for your controller ---- */
static void pin_a0(bool level) { (void)level; }
static void pin_cs_n(bool level) { (void)level; }
static void pin_rd_n(bool level) { (void)level; }
static void pin_wr_n(bool level) { (void)level; }
static void port_drive(bool on) { (void)on; } /* 1: drive D7..D0; off after reset */
static void port_put(uint8_t value) { (void)value; }
static uint8_t port_get(void) { return 0xFFu; } /* insert the read of D7..D0 */
static void bus_delay(void) {} /* 250 ns */

static uint8_t bus_read(void *ctx, unsigned reg)
{
    uint8_t value;
    (void)ctx;
    pin_a0(reg != 0u);
    pin_cs_n(false);
    pin_rd_n(false);
    bus_delay();
    value = port_get();
    pin_rd_n(true);
    pin_cs_n(true);
    return value;
}

static void bus_write(void *ctx, unsigned reg, uint8_t value)
{
    (void)ctx;
    pin_a0(reg != 0u);
    port_put(value);
    port_drive(true);
    pin_cs_n(false);
    pin_wr_n(false);
    bus_delay();
    pin_wr_n(true);
    pin_cs_n(true);
    port_drive(false);
}

int main(void)
{
    ppmc104_t axis;
    ppmc104_result_t result;

    pin_cs_n(true);
    pin_rd_n(true);
    pin_wr_n(true);
    ppmc104_setup(&axis, bus_read, bus_write, NULL);
    result = ppmc104_probe(&axis);
    printf("%s\n", ppmc104_strerror(result));
    return result == PPMC104_OK ? 0 : 1;
}
