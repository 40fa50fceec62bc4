// SPDX-License-Identifier: Apache-2.0
// Two axes of a bank on SPI: they start together, move, and move back.
// Wiring: SCK, MOSI (COPI), MISO (CIPO) of the board to sck, mosi, miso of the FPGA, pin 10 to spi_cs_n.
// The pins of the FPGA are 3.3 V: a board with 5 V needs level shifters.
#include <OpenPPMC.h>

static PpmcSpi bus(10);
static ppmc_bank_t bank;
static ppmc_bank_axis_t x, y;

// Report a failure, and stop the program here. A running move continues to its end.
static void check(const char *what, bool works, const char *text)
{
    if (works) return;
    Serial.print(what);
    Serial.print(": ");
    Serial.println(text);
    while (true) delay(1000);
}

static void check(const char *what, ppmc104_result_t result)
{
    check(what, result == PPMC104_OK, ppmc104_strerror(result));
}

void setup()
{
    // 4 phases, two at a time, switched on by a high level. 16 MHz / 32 = 500 kHz: start at 500 kHz / 60, high
    // speed 500 kHz / 40, 6 pulses of ramp.
    const ppmc104_config_t config = {4, false, true, false, false, 59, 39, 6};

    Serial.begin(115200);
    check("SPI", bus.begin(), "no bridge; check the wires, and select sck <= clk / 8");
    check("bank", ppmc_bank_open(&bank, PpmcSpi::read, PpmcSpi::write, &bus));
    check("axis 0", ppmc_bank_axis(&bank, 0, &x));
    check("axis 1", ppmc_bank_axis(&bank, 1, &y));
    check("initialise axis 0", ppmc104_init(&x.part, &config));
    check("initialise axis 1", ppmc104_init(&y.part, &config));
}

void loop()
{
    static uint8_t way = PPMC104_CW;
    ppmc104_finish_t end_x, end_y;
    int32_t at_x = 0, at_y = 0;

    check("group", ppmc_bank_hold(&bank, 1u << 0 | 1u << 1));
    check("move axis 0", ppmc104_move(&x.part, way, 200));
    check("move axis 1", ppmc104_move(&y.part, way, 50));
    check("start", ppmc_bank_go(&bank, NULL));  // both first pulses on the same clock edge
    check("wait for axis 0", ppmc104_wait(&x.part, &end_x));
    check("wait for axis 1", ppmc104_wait(&y.part, &end_y));
    check("position of axis 0", ppmc_bank_position(&bank, 0, &at_x));
    check("position of axis 1", ppmc_bank_position(&bank, 1, &at_y));
    check("SPI", bus.faults() == 0, "the status byte reports a fault; lower sck");
    Serial.print("position x=");
    Serial.print(at_x);
    Serial.print(" y=");
    Serial.println(at_y);
    if (end_x.limit || end_x.alarm || end_y.limit || end_y.alarm) Serial.println("a switch ended a move");
    way ^= PPMC104_CCW;
    delay(500);
}
