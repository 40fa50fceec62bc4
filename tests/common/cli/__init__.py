"""tests/common/cli"""
