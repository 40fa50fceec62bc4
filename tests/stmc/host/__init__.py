"""tests/stmc/host"""
