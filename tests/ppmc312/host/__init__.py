"""tests/ppmc312/host"""
