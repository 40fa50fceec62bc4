"""tests/stmc/packages"""
