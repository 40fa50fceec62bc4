"""tests/stmc"""
