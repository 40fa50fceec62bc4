"""tests/common/model"""
