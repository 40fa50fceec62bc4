/* SPDX-License-Identifier: Apache-2.0 */
/* A PPMC-312 (station 1, 83 333 baud) and a PMC006B4 (address 7, 9600 baud), each on a UART of a
 * microcontroller. A sketch: insert your UART functions. */
#include "../pmc006.h"
#include "../ppmc312.h"

#include <stdio.h>

/* ---- write these functions for your controller; ctx is the number of the UART ---- */
static void uart_driver(const void *ctx, bool on) { (void)ctx; (void)on; } /* driver enable of the RS-485 transceiver */
static void uart_put(const void *ctx, uint8_t byte) { (void)ctx; (void)byte; }
static void uart_flush(const void *ctx) { (void)ctx; } /* waits until the last stop bit was sent */
static bool uart_get(const void *ctx, uint8_t *byte) { (void)ctx; (void)byte; return false; }
static void delay_ms(void) {}

static void line_send(void *ctx, const uint8_t *bytes, unsigned count)
{
    uart_driver(ctx, true);
    while (count-- > 0u) uart_put(ctx, *bytes++);
    uart_flush(ctx);
    uart_driver(ctx, false);
}

static bool line_receive(void *ctx, uint8_t *byte, unsigned milliseconds)
{
    while (!uart_get(ctx, byte)) {
        if (milliseconds-- == 0u) return false;
        delay_ms();
    }
    return true;
}

static ppmc104_result_t station(const ppmc_line_t *line)
{
    const ppmc312_table_t table = {PPMC312_1MHZ, false, 1000u, 200u, 2000u, 0u, 0u};
    static ppmc312_t part;
    ppmc312_end_t end;
    ppmc104_result_t result = ppmc312_setup_line(&part, line, 1u);

    if (result == PPMC104_OK) result = ppmc312_open(&part, NULL);
    if (result == PPMC104_OK) result = ppmc312_table(&part, &table);
    if (result == PPMC104_OK) result = ppmc312_move(&part, 5000);
    return result == PPMC104_OK ? ppmc312_wait(&part, &end) : result;
}

static ppmc104_result_t controller(const ppmc_line_t *line)
{
    static pmc006_t motor;
    pmc006_end_t end;
    ppmc104_result_t result = pmc006_setup(&motor, line, 7u);

    if (result == PPMC104_OK) result = pmc006_open(&motor);
    if (result == PPMC104_OK) result = pmc006_set(&motor, PMC006_MAX_SPEED, 3200);
    if (result == PPMC104_OK) result = pmc006_set(&motor, PMC006_CURRENT, 1200);
    if (result == PPMC104_OK) result = pmc006_home(&motor, 1u, false, 200);
    if (result == PPMC104_OK) result = pmc006_move_to(&motor, 2000);
    return result == PPMC104_OK ? pmc006_wait(&motor, &end) : result;
}

int main(void)
{
    static int uarts[2] = {0, 1};
    const ppmc_line_t fast = {line_send, line_receive, &uarts[0], false};
    const ppmc_line_t slow = {line_send, line_receive, &uarts[1], false};

    printf("PPMC-312: %s\n", ppmc104_strerror(station(&fast)));
    printf("PMC006B4: %s\n", ppmc104_strerror(controller(&slow)));
    return 0;
}
