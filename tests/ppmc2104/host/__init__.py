"""tests/ppmc2104/host"""
