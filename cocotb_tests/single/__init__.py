"""cocotb_tests/single"""
