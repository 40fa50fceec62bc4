"""cocotb_tests/ppmc312/stages"""
