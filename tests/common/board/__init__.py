"""tests/common/board"""
