"""tests/ppmc312/cli"""
