"""tests/ppmc2104/board"""
