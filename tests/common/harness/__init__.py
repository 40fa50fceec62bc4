"""tests/common/harness"""
