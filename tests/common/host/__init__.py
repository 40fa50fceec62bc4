"""tests/common/host"""
