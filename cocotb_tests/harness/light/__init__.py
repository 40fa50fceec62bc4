"""cocotb_tests/harness/light"""
