"""tests/stmc/board"""
