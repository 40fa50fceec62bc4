"""Scripts of this folder that pytest runs by themselves have the build that most simulations have."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from cocotb_tests.harness.scripts import building

from .builds import F8B


@pytest.fixture(autouse=True)
def fast_build() -> Iterator[None]:
    """8 MHz, 115200 baud."""
    with building(F8B):
        yield
