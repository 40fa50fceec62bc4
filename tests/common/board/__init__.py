"""Tests of the virtual boards that `make board` builds: fixtures for all devices, ports, the
pseudo-terminal.
"""
