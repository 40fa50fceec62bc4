/* SPDX-License-Identifier: Apache-2.0 */
/* A J105 STMC in a PC, at 3B0h; Linux (as root) or DOS: probe, initialise, find the reference point, move. */
#include "../stmc_ports.h"

#include <stdio.h>

#define SEARCH_SPEED 345u
#define TOP_SPEED 825u

int main(void)
{
    stmc_config_t config = {4u, false, true, false, true, 0u, 0u, 400u};
    stmc_t axis;
    ppmc104_finish_t finish;
    uint8_t search = 0u;
    ppmc104_result_t result;

#ifdef __linux__
    if (ioperm(STMC_BASE, 2, 1) != 0) {
        printf("ports %xh, %xh: no permission, run this as root\n", STMC_BASE, STMC_BASE + 1u);
        return 1;
    }
#endif
    stmc_setup_ports(&axis, STMC_BASE);
    axis.bus.limit = 100000000ul; /* number of polls, about 1 us each on a real bus; a motion may take long */
    result = stmc_divisor(STMC_CLOCK_BOARD, SEARCH_SPEED, &config.divisor_start);
    if (result == PPMC104_OK) result = stmc_divisor(STMC_CLOCK_BOARD, TOP_SPEED, &config.divisor_high);
    search = config.divisor_start;
    if (result == PPMC104_OK) result = stmc_probe(&axis);
    if (result == PPMC104_OK) result = stmc_init(&axis, &config);
    /* Start-up sequence of the data sheet: move to the end of the travel, then back to the reference
     * point. */
    if (result == PPMC104_OK) result = stmc_jog(&axis, PPMC104_CCW, search);
    if (result == PPMC104_OK) result = stmc_wait(&axis, NULL);
    if (result == PPMC104_OK) result = stmc_home(&axis, PPMC104_CW, search);
    if (result == PPMC104_OK) result = stmc_wait(&axis, &finish);
    if (result == PPMC104_OK && finish.raw != 0x87u) {
        printf("no reference point, finish status %02x\n", finish.raw);
        return 1;
    }
    if (result == PPMC104_OK) result = stmc_move(&axis, PPMC104_CW, 800u);
    if (result == PPMC104_OK) result = stmc_wait(&axis, &finish);
    printf("%s\n", stmc_strerror(result));
    return result == PPMC104_OK ? 0 : 1;
}
