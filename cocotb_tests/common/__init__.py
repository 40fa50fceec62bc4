"""cocotb_tests/common"""
