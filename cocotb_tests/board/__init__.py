"""Simulations of the blocks that rtl/boards adds around ppmc104_carrier."""
