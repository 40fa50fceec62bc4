"""tests/stmc/model"""
