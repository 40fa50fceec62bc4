/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file stmc_ports.h
 * A J105 STMC in the I/O space of a PC: access functions for stmc_setup(), based on inb() and outb() or the
 * equivalents of the compiler. Supported are Linux on x86 (after ioperm(), therefore as root), DJGPP and Open
 * Watcom for DOS. For any other compiler, define STMC_INB(port) and STMC_OUTB(port, value) before you include
 * this file.
 */
#ifndef STMC_PORTS_H
#define STMC_PORTS_H

#include "stmc.h"

/** Port of the data register of the board. The next port is the status and command register. */
#ifndef STMC_BASE
#define STMC_BASE 0x3B0u
#endif

#if defined(STMC_INB) != defined(STMC_OUTB)
#error "define both STMC_INB and STMC_OUTB, or none"
#elif defined(STMC_INB)
/* the program has defined them */
#elif defined(__linux__) && (defined(__i386__) || defined(__x86_64__))
#include <sys/io.h>
#define STMC_INB(port) inb((unsigned short)(port))
#define STMC_OUTB(port, value) outb((value), (unsigned short)(port))
#elif defined(__DJGPP__)
#include <pc.h>
#define STMC_INB(port) inportb((unsigned short)(port))
#define STMC_OUTB(port, value) outportb((unsigned short)(port), (value))
#elif defined(__WATCOMC__)
#include <conio.h>
#define STMC_INB(port) ((uint8_t)inp(port))
#define STMC_OUTB(port, value) ((void)outp((port), (value)))
#else
#error "define STMC_INB(port) and STMC_OUTB(port, value) for this compiler"
#endif

static inline uint8_t stmc_port_read(void *ctx, unsigned reg)
{
    return STMC_INB((unsigned)(uintptr_t)ctx + reg);
}

static inline void stmc_port_write(void *ctx, unsigned reg, uint8_t value)
{
    STMC_OUTB((unsigned)(uintptr_t)ctx + reg, value);
}

/** Fill `dev` for a board at these ports, e.g. STMC_BASE. Makes no bus access. */
static inline void stmc_setup_ports(stmc_t *dev, unsigned base)
{
    stmc_setup(dev, stmc_port_read, stmc_port_write, (void *)(uintptr_t)base);
}

#endif
