"""tests/ppmc2104/cli"""
