"""Random user programs for the PMC006: legal and illegal instructions, loops, waits, keys."""

from __future__ import annotations

import random

from .programs import END, Op, goto, out, rot

COUNTS = (0, 1, 2, 3, 5, 9, 30, 255, 256, 300, 1000, 0x7FFFFFFF, -1)
SPEEDS = (3000, 3000, 2999, 5000, 9000, 16_000, 1, 0, 500, 16_001, -5)


def random_op(rng: random.Random, size: int) -> Op:
    """Return one instruction for a program of `size` instructions; some operands and options are illegal."""
    target = rng.randrange(size) if rng.random() < 0.9 else rng.choice((99, 100, -1, 200))
    bit = rng.choice((0, 1, 1, 0, rng.randrange(-3, 9)))
    source = rng.choice((*range(1, 10), 8, 8, 0, 10, 255))
    makers = (
        (6, lambda: rot(rng.choice(COUNTS))),
        (3, lambda: Op(0x10, 8, 0)),
        (2, lambda: Op(0x10, source, bit)),
        (2, lambda: Op(0x02, 0, rng.choice((0, 2, 4, 8, 16, 32, 64, 128, 3)))),
        (3, lambda: Op(0x03, 0, bit)),
        (1, lambda: Op(0x04, 0, bit)),
        (1, lambda: Op(0x05, 0, rng.choice((0, 0, 1, 2)))),
        (1, lambda: Op(rng.choice((0x06, 0x07)), rng.randrange(256), bit)),
        (3, lambda: Op(0x08, rng.choice((0, 0, 0, 1, 2)), rng.choice(SPEEDS))),
        (1, lambda: Op(0x09, 0, rng.choice((0, 5, 6, 4, 5, 7, -1)))),
        (1, lambda: Op(0x0A, 0, rng.choice((0, 1, 2, 3, 4)))),
        (3, lambda: Op(rng.choice((0x0B, 0x0B, 0x0C)))),
        (2, lambda: goto(target)),
        (4, lambda: goto(target, rng.choice((0x0E, 0x0F)))),
        (4, lambda: out(rng.choice((1, 2, 3, 4, 5, 5, 0, 6)), bit)),
        (3, lambda: Op(0x12, source, rng.choice((0, 1, 2, 3, 31, 30, -1)))),
        (1, lambda: Op(0x13, rng.choice((1, 1, 0, 2)), target)),
        (1, lambda: Op(0x14, rng.choice((1, 1, 0, 3)), bit)),
        (1, lambda: rng.choice((END, Op(0x15), Op(0xFF, 3, 7), Op(rng.randrange(256), source, bit)))),
    )
    make = rng.choices([make for _, make in makers], [weight for weight, _ in makers])[0]
    return make()


def random_program(rng: random.Random) -> list[Op]:
    """Return a program of three to ten instructions; most end with a jump back or END."""
    size = rng.randint(3, 10)
    program = [random_op(rng, size) for _ in range(size - 1)]
    if rng.random() < 0.4:
        # A loop that ends after a few iterations, as in the programs of the manual.
        program[-2:] = [Op(0x0B), Op(0x12, 8, rng.randint(1, 3)), goto(rng.randrange(size), 0x0E)]
    return [*program, rng.choice((END, goto(0), goto(rng.randrange(size)), random_op(rng, size)))]
