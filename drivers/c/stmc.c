/* SPDX-License-Identifier: Apache-2.0 */
/* Driver for the controller of the J105 STMC; stmc.h documents the functions. */
#include "stmc.h"

/* Read codes, indexed by map: data sheet, family. */
static const uint8_t CODE_INPUTS[2] = {0x82u, 0x81u};
static const uint8_t CODE_OUTPUTS[2] = {0x83u, 0x82u};
static const uint8_t CODE_REMAINING[2] = {0x84u, 0x83u};

#define CODE_INIT_CHOP 0x20u
#define CODE_INIT_EXTERNAL 0x10u
#define CODE_INIT_POSITIVE 0x08u
#define CODE_INIT_HALF 0x04u

#define INPUTS_ZERO 0x30u /* read as 0 on every part */
#define CLOCK_MAX 1000000ul

const char *stmc_strerror(ppmc104_result_t result)
{
    if (result == PPMC104_ERR_RAMP) {
        return "error 5: divisor 0, or top speed below start speed";
    }
    return ppmc104_strerror(result);
}

/* ---- speeds ---- */

ppmc104_result_t stmc_divisor(uint32_t clock_hz, uint32_t speed, uint8_t *divisor)
{
    uint32_t nearest;

    if (clock_hz == 0u || clock_hz > CLOCK_MAX || speed == 0u || speed > clock_hz) {
        return PPMC104_BAD_ARGUMENT;
    }
    nearest = (clock_hz + speed / 2u) / speed;
    if (nearest < STMC_DIVISOR_MIN || nearest > 255u) {
        return PPMC104_BAD_ARGUMENT;
    }
    *divisor = (uint8_t)nearest;
    return PPMC104_OK;
}

uint32_t stmc_milli_speed(uint32_t clock_hz, uint8_t divisor)
{
    if (clock_hz == 0u || clock_hz > CLOCK_MAX || divisor == 0u) {
        return 0u;
    }
    return clock_hz / divisor * 1000u + clock_hz % divisor * 1000u / divisor;
}

/* ---- set-up ---- */

void stmc_setup(stmc_t *dev, uint8_t (*read)(void *ctx, unsigned reg),
                void (*write)(void *ctx, unsigned reg, uint8_t value), void *ctx)
{
    ppmc104_setup(&dev->bus, read, write, ctx);
    dev->map = STMC_MAP_FAMILY;
    dev->probed = false;
}

ppmc104_result_t stmc_probe(stmc_t *dev)
{
    uint8_t levels = 0;
    uint32_t steps;
    /* The highest read code exists in one map only. In the other map it is unknown, even during a motion. */
    ppmc104_result_t result = ppmc104_ask(&dev->bus, CODE_REMAINING[STMC_MAP_SHEET], 3u, &steps);

    if (result == PPMC104_TIMEOUT || result == PPMC104_NO_PART) {
        return result;
    }
    dev->map = result == PPMC104_ERR_UNKNOWN ? STMC_MAP_FAMILY : STMC_MAP_SHEET;
    result = stmc_inputs(dev, &levels);
    dev->probed = result == PPMC104_OK;
    return result == PPMC104_OK && (levels & INPUTS_ZERO) != 0u ? PPMC104_NO_PART : result;
}

ppmc104_result_t stmc_init(stmc_t *dev, const stmc_config_t *config)
{
    uint8_t code, data[4];

    if (config->motor < 3u || config->motor > 5u || config->divisor_high < 1u ||
        config->divisor_high > config->divisor_start) {
        return PPMC104_BAD_ARGUMENT;
    }
    code = (uint8_t)((config->motor - 2u) | (config->half_step ? CODE_INIT_HALF : 0u) |
                     (config->active_high ? CODE_INIT_POSITIVE : 0u) |
                     (config->external_clock ? CODE_INIT_EXTERNAL : 0u) | (config->chop ? CODE_INIT_CHOP : 0u));
    data[0] = config->divisor_start;
    data[1] = config->divisor_high;
    data[2] = (uint8_t)(config->ramp & 0xFFu);
    data[3] = (uint8_t)(config->ramp >> 8);
    return ppmc104_command(&dev->bus, code, data, 4u);
}

/* ---- motions ---- */

ppmc104_result_t stmc_step(stmc_t *dev, uint8_t flags)
{
    return ppmc104_step(&dev->bus, flags);
}

ppmc104_result_t stmc_move(stmc_t *dev, uint8_t flags, uint32_t steps)
{
    return (flags & PPMC104_POUT_ONLY) != 0u ? PPMC104_BAD_ARGUMENT : ppmc104_move(&dev->bus, flags, steps);
}

ppmc104_result_t stmc_move_constant(stmc_t *dev, uint8_t flags, uint8_t divisor, uint32_t steps)
{
    return divisor == 0u ? PPMC104_BAD_ARGUMENT : ppmc104_move_constant(&dev->bus, flags, divisor, steps);
}

ppmc104_result_t stmc_jog(stmc_t *dev, uint8_t flags, uint8_t divisor)
{
    return divisor == 0u ? PPMC104_BAD_ARGUMENT : ppmc104_jog(&dev->bus, flags, divisor);
}

ppmc104_result_t stmc_run(stmc_t *dev, uint8_t flags)
{
    return (flags & PPMC104_POUT_ONLY) != 0u ? PPMC104_BAD_ARGUMENT : ppmc104_run(&dev->bus, flags);
}

ppmc104_result_t stmc_home(stmc_t *dev, uint8_t flags, uint8_t divisor)
{
    return divisor == 0u ? PPMC104_BAD_ARGUMENT : ppmc104_home(&dev->bus, flags, divisor);
}

ppmc104_result_t stmc_stop(stmc_t *dev)
{
    return ppmc104_stop(&dev->bus);
}

ppmc104_result_t stmc_stop_slowly(stmc_t *dev)
{
    return ppmc104_stop_slowly(&dev->bus);
}

bool stmc_busy(stmc_t *dev)
{
    return ppmc104_busy(&dev->bus);
}

ppmc104_result_t stmc_wait(stmc_t *dev, ppmc104_finish_t *finish)
{
    /* A wrong code would be another read. Therefore the read codes must be known. */
    if (!dev->probed) {
        uint8_t status;
        ppmc104_result_t result = PPMC104_OK;
        if (ppmc104_busy(&dev->bus)) {
            result = ppmc104_poll(&dev->bus, PPMC104_STATUS_BUSY, 0u, 0u, &status);
        }
        result = result == PPMC104_OK ? stmc_probe(dev) : result;
        if (result != PPMC104_OK) {
            return result;
        }
    }
    return ppmc104_wait_by(&dev->bus, finish, CODE_REMAINING[dev->map]);
}

/* ---- reads ---- */

ppmc104_result_t stmc_finish(stmc_t *dev, ppmc104_finish_t *finish)
{
    return ppmc104_finish(&dev->bus, finish);
}

ppmc104_result_t stmc_inputs(stmc_t *dev, uint8_t *levels)
{
    return ppmc104_ask_byte(&dev->bus, CODE_INPUTS[dev->map], levels);
}

ppmc104_result_t stmc_outputs(stmc_t *dev, uint8_t *levels)
{
    return ppmc104_ask_byte(&dev->bus, CODE_OUTPUTS[dev->map], levels);
}

ppmc104_result_t stmc_remaining(stmc_t *dev, const ppmc104_finish_t *finish, uint32_t *steps)
{
    uint32_t value = 0;
    ppmc104_result_t result;

    if (finish->operation == 0u) {
        return PPMC104_UNCONFIRMED;
    }
    result = ppmc104_ask(&dev->bus, CODE_REMAINING[dev->map], 3u, &value);
    if (result == PPMC104_OK) {
        *steps = ppmc104_left(finish, value);
    }
    return result;
}
