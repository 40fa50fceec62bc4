"""tests/ppmc104"""
