"""Tests of openppmc.litex in a SoC with a VexRiscv; `make test WITH=litex`."""
