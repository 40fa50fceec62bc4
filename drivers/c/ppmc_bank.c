/* SPDX-License-Identifier: Apache-2.0 */
#include "ppmc_bank.h"

#include <stddef.h>

#define ANY_AXIS 0u
#define GO_READS 16u /* a read takes at least 9 cycles, and GO is active for up to 64 cycles */

static uint8_t peek(const ppmc_bank_t *bank, unsigned number, unsigned reg)
{
    return bank->read(bank->ctx, PPMC_BANK_ADDRESS(number, reg));
}

static void poke(const ppmc_bank_t *bank, unsigned number, unsigned reg, uint8_t value)
{
    bank->write(bank->ctx, PPMC_BANK_ADDRESS(number, reg), value);
}

static ppmc_bank_set_t bit(unsigned number)
{
    return (ppmc_bank_set_t)1u << number;
}

static bool has(ppmc_bank_set_t axes, unsigned number)
{
    return (axes >> number & 1u) != 0u;
}

/* ---- an axis as a PPMC-104 ---- */

static uint8_t axis_read(void *ctx, unsigned reg)
{
    const ppmc_bank_axis_t *axis = (const ppmc_bank_axis_t *)ctx;
    return peek(axis->bank, axis->number, reg);
}

static void axis_write(void *ctx, unsigned reg, uint8_t value)
{
    const ppmc_bank_axis_t *axis = (const ppmc_bank_axis_t *)ctx;
    poke(axis->bank, axis->number, reg, value);
}

ppmc104_result_t ppmc_bank_axis(const ppmc_bank_t *bank, unsigned number, ppmc_bank_axis_t *axis)
{
    if (number >= bank->axes) {
        return PPMC104_BAD_ARGUMENT;
    }
    axis->bank = bank;
    axis->number = (uint8_t)number;
    ppmc104_setup(&axis->part, axis_read, axis_write, axis);
    return PPMC104_OK;
}

/* ---- the bank ---- */

/* In a register with one bit per axis, byte k is accessed at the address of axis k. */
static void write_mask(ppmc_bank_t *bank, ppmc_bank_set_t axes)
{
    unsigned k;

    bank->held = axes;
    for (k = 0; 8u * k < bank->axes; ++k) {
        poke(bank, k, PPMC_BANK_REG_MASK, (uint8_t)(axes >> (8u * k) & 0xFFu));
    }
}

static bool size_legal(uint8_t axes)
{
    return axes == 4u || axes == 8u || axes == 16u || axes == 32u || axes == PPMC_BANK_AXES_MAX;
}

ppmc104_result_t ppmc_bank_open(ppmc_bank_t *bank, uint8_t (*read)(void *ctx, unsigned address),
                                void (*write)(void *ctx, unsigned address, uint8_t value), void *ctx)
{
    bank->read = read;
    bank->write = write;
    bank->ctx = ctx;
    bank->axes = 0u;
    bank->held = 0u;
    if (peek(bank, 0u, PPMC_BANK_REG_INFO) != PPMC_BANK_INFO_MARK || peek(bank, 1u, PPMC_BANK_REG_INFO) != PPMC_BANK_INFO_VERSION ||
        !size_legal(peek(bank, 2u, PPMC_BANK_REG_INFO))) {
        return PPMC104_NO_PART;
    }
    bank->axes = peek(bank, 2u, PPMC_BANK_REG_INFO);
    write_mask(bank, 0u);
    return PPMC104_OK;
}

ppmc104_result_t ppmc_bank_config(const ppmc_bank_t *bank, unsigned number, bool fast, bool plain)
{
    if (number >= bank->axes) {
        return PPMC104_BAD_ARGUMENT;
    }
    poke(bank, number, PPMC_BANK_REG_CONFIG, (uint8_t)((fast ? PPMC_BANK_CONFIG_CSEL : 0u) | (plain ? PPMC_BANK_CONFIG_VSEL : 0u)));
    return PPMC104_OK;
}

ppmc104_result_t ppmc_bank_position(const ppmc_bank_t *bank, unsigned number, int32_t *position)
{
    unsigned n;
    uint32_t value = 0u;

    if (number >= bank->axes) {
        return PPMC104_BAD_ARGUMENT;
    }
    /* The lowest byte is read first, because this read latches the other bytes. */
    for (n = 0; n < 4u; ++n) {
        value |= (uint32_t)peek(bank, number, PPMC_BANK_REG_POSITION + n) << (8u * n);
    }
    *position = ppmc104_signed(value);
    return PPMC104_OK;
}

void ppmc_bank_positions(const ppmc_bank_t *bank, int32_t *positions)
{
    unsigned number;

    for (number = 0; number < bank->axes; ++number) {
        (void)ppmc_bank_position(bank, number, &positions[number]);
    }
}

ppmc_bank_set_t ppmc_bank_pending(const ppmc_bank_t *bank)
{
    unsigned k;
    ppmc_bank_set_t axes = 0u;

    for (k = 0; 8u * k < bank->axes; ++k) {
        axes |= (ppmc_bank_set_t)peek(bank, k, PPMC_BANK_REG_PENDING) << (8u * k);
    }
    return axes;
}

ppmc_bank_set_t ppmc_bank_busy(const ppmc_bank_t *bank)
{
    unsigned number;
    ppmc_bank_set_t axes = 0u;

    for (number = 0; number < bank->axes; ++number) {
        if ((peek(bank, number, PPMC104_REG_STATUS) & PPMC104_STATUS_BUSY) != 0u) {
            axes |= bit(number);
        }
    }
    return axes;
}

void ppmc_bank_stop_all(const ppmc_bank_t *bank)
{
    poke(bank, ANY_AXIS, PPMC_BANK_REG_STOP, 0u);
}

/* ---- groups ---- */

ppmc104_result_t ppmc_bank_hold(ppmc_bank_t *bank, ppmc_bank_set_t axes)
{
    if (axes == 0u || (bank->axes < PPMC_BANK_AXES_MAX && axes >> bank->axes != 0u)) {
        return PPMC104_BAD_ARGUMENT;
    }
    if ((ppmc_bank_busy(bank) & axes) != 0u) {
        return PPMC104_ERR_BUSY;
    }
    write_mask(bank, axes);
    return PPMC104_OK;
}

ppmc104_result_t ppmc_bank_go(ppmc_bank_t *bank, ppmc_bank_set_t *refused)
{
    const ppmc_bank_set_t axes = bank->held;
    ppmc_bank_set_t without = 0u;
    ppmc104_result_t result = PPMC104_OK;
    unsigned n;

    if (axes == 0u) {
        return PPMC104_BAD_ARGUMENT;
    }
    poke(bank, ANY_AXIS, PPMC_BANK_REG_GO, 0u);
    for (n = 0; n < GO_READS; ++n) {
        (void)peek(bank, ANY_AXIS, PPMC104_REG_STATUS);
    }
    for (n = 0; n < bank->axes; ++n) {
        const uint8_t status = has(axes, n) ? peek(bank, n, PPMC104_REG_STATUS) : 0u;
        if ((status & PPMC104_STATUS_ERR) == 0u) {
            continue;
        }
        without |= bit(n);
        if (result == PPMC104_OK) {
            result = (ppmc104_result_t)(PPMC104_ERR_UNKNOWN + ((status >> 4) & 7));
        }
    }
    write_mask(bank, 0u);
    if (refused != NULL) {
        *refused = without;
    }
    return result;
}

void ppmc_bank_drop(ppmc_bank_t *bank)
{
    unsigned n;
    ppmc_bank_axis_t axis;
    const ppmc_bank_set_t waiting = ppmc_bank_busy(bank) & bank->held;

    for (n = 0; n < bank->axes; ++n) {
        if (has(waiting, n) && ppmc_bank_axis(bank, n, &axis) == PPMC104_OK) {
            (void)ppmc104_stop(&axis.part);
        }
    }
    write_mask(bank, 0u);
}
