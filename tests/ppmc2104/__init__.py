"""tests/ppmc2104"""
