"""tests/ppmc312/board"""
