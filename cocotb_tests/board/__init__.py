"""Tests of what rtl/boards adds around ppmc104_board, in simulation."""
