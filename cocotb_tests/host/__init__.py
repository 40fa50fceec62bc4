"""Simulations of the blocks in rtl/host: the strobe bus, the UART bridge, the on-chip buses."""
