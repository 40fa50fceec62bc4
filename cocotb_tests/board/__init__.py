"""Tests of what rtl/boards adds around ppmc104_carrier, in simulation."""
