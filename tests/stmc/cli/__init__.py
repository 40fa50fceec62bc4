"""tests/stmc/cli"""
