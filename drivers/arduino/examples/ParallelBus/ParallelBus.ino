// SPDX-License-Identifier: Apache-2.0
// A PPMC-104 on the bus of the old chip, with its 8 data lines on digital pins: moves to and fro.
// Wiring: D0 .. D7 to pins 2 .. 9, A0 to A0, CS* to A1, RD* to A2, WR* to A3.
// The pins of an FPGA are 3.3 V: a board with 5 V needs level shifters (docs/boards.md).
#include <OpenPPMC.h>

static const uint8_t DATA[8] = {2, 3, 4, 5, 6, 7, 8, 9};
static PpmcPins bus(DATA, A0, A1, A2, A3);
static ppmc104_t axis;

// Report a failure, and stop the program here. A running move continues to its end.
static void check(const char *what, ppmc104_result_t result)
{
    if (result == PPMC104_OK) return;
    Serial.print(what);
    Serial.print(": ");
    Serial.println(ppmc104_strerror(result));
    while (true) delay(1000);
}

void setup()
{
    // 4 phases, two at a time, switched on by a high level. With CSEL high, 16 MHz / 32 = 500 kHz: start at
    // 500 kHz / 60, high speed 500 kHz / 40, 6 pulses of ramp.
    const ppmc104_config_t config = {4, false, true, false, false, 59, 39, 6};

    Serial.begin(115200);
    bus.begin();
    ppmc104_setup(&axis, PpmcPins::read, PpmcPins::write, &bus);
    check("part", ppmc104_probe(&axis));
    check("initialise", ppmc104_init(&axis, &config));
}

void loop()
{
    static uint8_t way = PPMC104_CW;
    ppmc104_finish_t end;
    uint32_t left = 0;

    check("move", ppmc104_move(&axis, way, 200));
    check("wait", ppmc104_wait(&axis, &end));
    check("remaining", ppmc104_remaining(&axis, &end, &left));
    Serial.print("moved left=");
    Serial.println(left);
    if (end.limit || end.alarm) Serial.println("a switch ended the move");
    way ^= PPMC104_CCW;
    delay(500);
}
