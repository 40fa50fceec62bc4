"""tests/common/packages"""
