"""cocotb_tests/motion"""
