"""tests/ppmc312"""
