// SPDX-License-Identifier: Apache-2.0
// Runs a sketch: supplies time and Serial, and ends the program when the sketch has stopped. The file that
// includes this header connects the pins of the board.
#ifndef SKETCH_H
#define SKETCH_H

#include <Arduino.h>

#include <cstdlib>

SerialPort Serial;

double sc_time_stamp() { return 0; }

void board_run(unsigned cycles);  // run the simulated part for this number of cycles of 16 MHz

void delayMicroseconds(unsigned us) { board_run(16 * us); }

// A sketch that reports a failure waits forever; ten such waits end the program. Waits are shortened to 1 ms.
void delay(unsigned long ms) {
    static unsigned waits = 0;
    if (ms >= 1000 && ++waits == 10) {
        std::printf("stopped\ndone\n");
        std::exit(0);
    }
    delayMicroseconds(1000);
}

// Report that a rule of the bus or of the API is violated, and end the program.
[[noreturn]] inline void violated(const char *what) {
    std::printf("FAIL %s\n", what);
    std::exit(1);
}

#endif
