"""FuseSoC builds boards: tests that need yosys."""
