"""FuseSoC builds boards: what needs yosys."""
