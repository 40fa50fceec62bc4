"""tests/ppmc104/host"""
