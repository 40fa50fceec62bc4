"""tests/ppmc312/line"""
