"""Tests that need yosys: FuseSoC builds boards."""
