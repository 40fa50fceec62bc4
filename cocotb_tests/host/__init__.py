"""cocotb_tests/host"""
